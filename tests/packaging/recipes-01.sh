# The files for Spack, conda and containers, which are not built here, are at least whole:
# they parse, name the version of the program, and call and copy what is there.
root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
bash -n "$root/packaging/conda/build.sh"
/usr/bin/python3 -B - "$root" <<'PYTHON'
import ast, pathlib, re, sys
import jinja2, yaml
root = pathlib.Path(sys.argv[1])
version = re.search(r"project\(geocone VERSION ([\d.]+)",
                    (root / "CMakeLists.txt").read_text()).group(1)

# Spack: a class Geocone whose body and methods are made of Spack's directives.
text = (root / "packaging/spack/package.py").read_text()
tree = ast.parse(text)
package, = (node for node in tree.body if isinstance(node, ast.ClassDef))
assert package.name == "Geocone" and package.bases[0].id == "CMakePackage"
calls = [(node.func.id, node) for node in ast.walk(package)
         if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)]
assert {name for name, _ in calls} == {"depends_on", "version", "license", "generator"}
assert [node.args[0].value for name, node in calls if name == "version"] == [version]
assert all(word.arg == "type" for name, node in calls if name == "depends_on"
           for word in node.keywords)

# conda: what the template gives is YAML with what a recipe needs.
jinja = jinja2.Environment(undefined=jinja2.StrictUndefined)
recipe = yaml.safe_load(jinja.from_string(
    (root / "packaging/conda/meta.yaml").read_text()).render(
        compiler=lambda language: f"{language}-compiler"))
assert recipe["package"] == {"name": "geocone", "version": version}
assert (root / "packaging/conda" / recipe["source"][0]["path"]).resolve() == root.resolve()
assert re.fullmatch(r"[0-9a-f]{64}", recipe["source"][1]["sha256"])
script = (root / "packaging/conda/build.sh").read_text()
for source in recipe["source"]:
    assert f"cmake -S {source['folder']} " in script
assert (root / recipe["about"]["license_file"].removeprefix("geocone/")).is_file()
file, = re.findall(r"example\('([^']*)'\)", "".join(recipe["test"]["commands"]))
assert (root / "prm" / file).is_file()

# All find what find_package and find_library of CMake ask for, and Python's modules.
spack = {node.args[0].value.split("@")[0].split("+")[0].split("~")[0] for name, node in
         calls if name == "depends_on" and isinstance(node.args[0], ast.Constant)}
conda = {line.split()[0] for line in recipe["requirements"]["host"]}
for one, other in (("mpi", "openmpi"), ("hdf5", "hdf5"), ("suite-sparse", "suitesparse"),
                   ("mumps", "mumps-mpi"), ("gmsh", "gmsh"), ("eigen", "eigen"),
                   ("nlohmann-json", "nlohmann_json"), ("xsimd", "xsimd"),
                   ("zlib-api", "zlib"), ("python", "python")):
    assert one in spack and other in conda, (one, other)
for module in "numpy", "matplotlib", "pillow", "jinja2", "h5py", "meshio":
    assert f'"{module}"' in text
    assert any(line.startswith(module) for line in recipe["requirements"]["run"])

# The container: every instruction is one of Containerfiles, and what is copied is there.
lines = (root / "packaging/Containerfile").read_text().replace("\\\n", "").splitlines()
words = [line.split() for line in lines if line and not line.startswith("#")]
assert {line[0] for line in words} <= {"FROM", "WORKDIR", "COPY", "RUN", "USER",
                                       "ENTRYPOINT", "CMD"}
copied = [name for line in words if line[0] == "COPY" and "--from=build" not in line
          for name in line[1:-1]]
for name in copied:
    assert (root / name).exists(), name
# Those that scripts/package and the installation by CMake take from the source.
asked = set(re.findall(r'\$root"?/([\w.]+)', (root / "scripts/package").read_text()))
asked |= {name.split("/")[0] for line in re.findall(
    r"^install\((?:DIRECTORY|PROGRAMS|SCRIPT) ([^\n]*)",
    (root / "CMakeLists.txt").read_text(), re.M)
    for name in line.split(" DESTINATION")[0].rstrip(")").split()}
assert {"scripts", "prm", "python", "packaging"} <= asked
assert asked - {"build"} <= set(copied), asked - set(copied)
PYTHON

# geocone.run: parameters count instead of those of the file; a free folder is taken; what
# fails is an exception with the program's words, and never a shell's.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
PYTHONPATH=$root/python /usr/bin/python3 -B - "$program" "$root/tests/footing_coarse.prm" \
  <<'PYTHON'
import os, sys
import geocone
program, file = sys.argv[1:]
short = {"Output/Report for tests": "none", "Output/Pictures": False,
         "Loading/push/Duration": 0.02}
def run(parameters=(), **options):
    return geocone.run(file, {**short, **dict(parameters)},
                       **{"program": program, **options})

coarse = run({"Mesh/Cell size": 0.2, "Observation/Conditions": ["footing"],
              "Geometry/Box": [[-1, -2], [1, 0]]})
assert str(coarse.folder) == "results/footing_coarse" and coarse.status == "finished"
assert coarse.value("size/cells") == 200  # 10 x 10 squares of two triangles
assert len(coarse.statistics["step"]) == 1
assert coarse.parameters["Mesh/Cell size"] == "0.2"
assert coarse.parameters["Geometry/Box"] == "-1, -2; 1, 0"
assert str(run().folder) == "results/footing_coarse-2"
both = run(ranks=2, output="a folder; touch shell 'x' $(touch shell)")
assert both.value("size/ranks") == 2 and not os.path.exists("shell")

def fails(words, *arguments, **options):
    try:
        run(*arguments, **options)
    except geocone.RunFailed as problem:
        assert words in str(problem) and "\n" not in str(problem), str(problem)
        return problem
    raise AssertionError(words)
problem = fails("parameter 'Mesh/Cell size' = '-1' allowed: > 0", {"Mesh/Cell size": -1})
assert not problem.folder.exists()
fails("it exists and is not empty", {"Output/If folder exists": "refuse"},
      output=coarse.folder)
fails("there is no program './none'", program="./none")
fails("Not A Parameter", {"Mesh/Not A Parameter; touch shell": 1})
# One that ends by itself leaves what can be read.
problem = fails("expected newton/steps >= 2: NO",
                {"Output/Expectations": "newton/steps >= 2"})
assert geocone.read(problem.folder).value("newton/steps") == 1
fails("no end in 2 s", {"Loading/push/Duration": 1e6}, time_limit=2)
assert not os.path.exists("shell")
PYTHON

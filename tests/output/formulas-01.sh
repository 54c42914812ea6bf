# What formulas may say: each of these is taken, or refused with a remedy that tells why,
# and the library that reads them prints nothing of its own.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 - "$program" "$root/tests/footing_coarse.prm" <<'PYTHON'
import re, subprocess, sys
program, file = sys.argv[1:]

def answers(formulas, parameter="Boundary conditions/footing/Velocity y"):
    """What one call says to each of them: nothing, or the error."""
    *sections, name = parameter.split("/")
    for i, formula in enumerate(formulas):
        with open(f"{i}.prm", "w") as scene:
            scene.write("\n".join([f"include {file}", *(f"subsection {section}" for section in sections),
                                   f"  set {name} = {formula}", *("end" for _ in sections), ""]))
    files = [f"{i}.prm" for i in range(len(formulas))]
    run = subprocess.run([program, "--check", *files], capture_output=True, text=True)
    assert all(line.startswith("warning: ") for line in run.stderr.splitlines()), run.stderr
    found = re.split(r"^\d+\.prm: ", run.stdout, flags=re.MULTILINE)
    assert found[0] == "" and len(found) == len(files) + 1, run.stdout
    for text in found[1:]:
        assert text == "right\n" or text.startswith("refused\nerror: "), text
    texts = [text.partition("\n")[2] for text in found[1:]]
    assert run.returncode == any(texts)
    return dict(zip(formulas, texts))

def answer(formula, parameter="Boundary conditions/footing/Velocity y"):
    """What a dry run says to a formula of the call."""
    run = subprocess.run([program, file, "--dry-run", "--quiet",
                          "--set", f"{parameter} = {formula}"],
                         capture_output=True, text=True)
    lines = run.stderr.splitlines()
    assert not lines or lines[0].startswith(("error: ", "warning: ")), run.stderr
    assert run.returncode == (1 if "error: " in run.stderr else 0), run.stderr
    return run.stderr if run.returncode else ""

right = ("-0.02", "-.02", "-2.e-2*1E+0", "+x - 1", "x*-y", "2^-1*(-x)^2", "-(-x)", "pi*_pi*_e",
                "if(t >= 1, 1, if(x <= 0.05, 2, 3))", "(t == 1) + (t != 1)", "(x > 0) & (y < 1) | (t > 0)",
                "x > 0 ? y > 0 ? 1 : 2 : 3", "min(1) + max(x, y, t) + avg(1, 2) + sum (1, 2)",
                "abs(x)+acos(x)+acosh(1+x)+asin(x)+asinh(x)+atan(x)+atan2(y,x)+atanh(x)+ceil(x)+cos(x)+cosh(x)",
                "cot(1)+csc(1)+erfc(x)+exp(x)+floor(x)+int(x)+ln(1+x)+log(1+x)+log10(1+x)+log2(1+x)",
                "pow(x, 2)+rint(x)+sec(x)+sign(x)+sin(x)+sinh(x)+sqrt(x)+tan(x)+tanh(x)")
point = "decimals with a point"
wrong = (("-0,02", point), ("(0,02)", point), ("0,0626 - x^2", point), ("sin(0,02)", point),
                       ("min(1, 0,02*t)", "begins with zeros"), ("t/0,5", "divides by zero"), ("0/0", "divides by zero"),
                       ("x=3", "'=='"), ("t = 1", "'=='"), ("1e400", "finite"), ("rand()", "from run to run"),
                       ("rand_seed(1)", "from run to run"), ("z", "'z' is unknown"), ("X", "'X' is unknown"),
                       ("nan", "unknown"), ("inf", "unknown"), ("sine(x)", "functions are abs"), ("sin", "sin(...)"),
                       ("sin x", "sin(...)"), ("2x", "from 'x' on"), ("x y", "from 'y' on"), ("x;y", "from ';y' on"),
                       ("--x", "from '-x' on"), ("x**2", "x^2"), ("x && y", "'and'"), ("(x", "')' is missing"),
                       ("x)", "no '('"), ("1-", "at its end"), ("if(x, 1)", "3 arguments"), ("min()", "from ')' on"),
                       ("x ? 1", "lacks its ':'"), ("()", "from ')' on"), ("1e", "at its end"), (".", "at its end"),
                       ('"a"', "from"), ("(" * 200 + "x" + ")" * 200, "nested"),
                       ("sqrt(-1)", "finite numbers; at ("), ("log(-x)", "it is none"), ("1/(x-x)", "it is infinite"))
said = answers([*right, *(formula for formula, _ in wrong)])
for formula in right:
    assert said[formula] == "", (formula, said[formula])
for formula, words in wrong:
    assert words in said[formula] and "remedy: " in said[formula], (formula, said[formula])
# The same in a call.
for formula, words in (("-0.02", ""), ("-0,02", point), ("z", "'z' is unknown"), ("x#y", "from '#y' on")):
    text = answer(formula)
    assert words in text and bool(text) == bool(words), (formula, text)
# A formula without a value at a place where nothing is prescribed is not asked.
assert answer("-0.02/sqrt(0.3 - x)") == ""
assert "'t' " not in answer("0.2 - x", "Boundary conditions/footing/Where")
assert "does not depend on t" in answer("t", "Boundary conditions/footing/Where")
PYTHON

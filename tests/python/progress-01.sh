# A long run would say nothing, a callable would see it only at the end, and one that raises
# an error would leave the run computing.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
PYTHONPATH=$root/python /usr/bin/python3 -B - "$program" "$root" <<'PYTHON'
import contextlib, io, os, sys
import geocone
from geocone.progress import progress_in
program, root = sys.argv[1:]
short = {"Output/Report for tests": "none", "Output/Pictures": False, "Mesh/Cell size": 0.25,
         "Output/Verbosity": 1}
def run(name="tests/footing_coarse.prm", parameters=short, **options):
    return geocone.run(f"{root}/{name}", parameters, program=program, **options)

# Each step, with the time of its scene; results are those of a quiet run.
heard = []
with contextlib.redirect_stdout(io.StringIO()) as said:
    result = run(progress=heard.append)
assert said.getvalue() == ""
assert [state.step for state in heard] == list(range(1, 11))
assert {(state.steps, state.end_time) for state in heard} == {(10, 0.2)}
for state, time in zip(heard, result.statistics["time (s)"]):
    assert abs(state.time - time) < 1e-9 and state.seconds_left >= 0.
    assert state.text.startswith(f"step {state.step}/10  t = ")
assert heard[-1].seconds_left == 0.
assert run().summary["limit_load"] == result.summary["limit_load"]

# It is called while the run goes on, and its error ends the run, with a checkpoint.
class Enough(Exception):
    pass
def stops(state):
    assert geocone.read("endless").status == "running"
    if state.step == 3:
        raise Enough
try:
    run(parameters={**short, "Loading/push/Duration": 1e5}, output="endless", progress=stops)
    raise AssertionError
except Enough:
    pass
assert geocone.read("endless").status.startswith("stopped")
assert any(name.startswith("checkpoint") for name in os.listdir("endless"))

# Asked twice to end, e.g. by the errors of two runs, it is not killed by the second signal.
from geocone.runner import command, finish, start
child = start(command(program, f"{root}/tests/footing_coarse.prm", [
    "Loading/push/Duration = 1e5", "Output/Verbosity = 1"], "twice", quiet=False))
def asks_twice(line):
    if line.startswith("step 1/"):
        child.ask_to_end()
        child.ask_to_end()
finish(child, hear=asks_twice)
assert geocone.read("twice").status.startswith("stopped")

# Meshes of bounds, explicit steps, a line on the screen, errors.
heard = []
bounds = run("prm/safety/slope_2to1.prm",
             {"Output/Pictures": False, "Analysis/Gap tolerance": 0.05, "Output/Expectations": ""},
             progress=heard.append)
assert [state.step for state in heard] == list(range(1, len(heard) + 1)) and len(heard) > 1
assert heard[0].steps is None and heard[0].time is None and "factor of safety" in heard[0].text
heard = []
run("prm/explicit/translation.prm", {"Output/Pictures": False}, progress=heard.append)
assert heard and heard[-1].step == heard[-1].steps and heard[-1].time is not None
with contextlib.redirect_stdout(io.StringIO()) as said:
    run(progress=True)
lines = said.getvalue().split("\r")
assert len(lines) == 11 and lines[0] == "" and lines[-1].endswith("\n")
try:
    run(parameters={"Mesh/Cell size": -1}, progress=True)
    raise AssertionError
except geocone.RunFailed as problem:
    assert str(problem) == ("parameter 'Mesh/Cell size' = '-1' allowed: > 0 "
                            "remedy: give it in m"), str(problem)
# The reason is what was expected, not the name of a picture that is drawn afterwards.
try:
    run(parameters={**short, "Output/Pictures": True, "Loading/push/Duration": 0.04,
                    "Output/Expectations": "newton/steps >= 99"}, progress=heard.append)
    raise AssertionError
except geocone.RunFailed as problem:
    assert str(problem).startswith("expected newton/steps >= 99: NO"), str(problem)
assert run(parameters={**short, "Output/Verbosity": 2, "Loading/push/Duration": 0.04},
           progress=heard.append).status == "finished"
assert [state.step for state in heard[-2:]] == [1, 2]

# Lines between steps, and others.
state = progress_in("step 4  t = 0.4 s  20 substeps, 85 iterations so far", lambda: 2.)
assert state[1:] == (4, None, 0.4, 2., None)
for line in "results in step 3/4", "10 steps, 6.0 iterations per step", "steps", "":
    assert progress_in(line, None) is None

# Several runs: whose it is.
heard = []
geocone.run_many(f"{root}/tests/footing_coarse.prm", {
    name: {**short, "Loading/push/Duration": 0.04} for name in ("a", 2.0)},
    program=program, output="many", progress=lambda *state: heard.append(state))
assert sorted((str(name), state.step) for name, state in heard) == [
    ("2.0", 1), ("2.0", 2), ("a", 1), ("a", 2)]
assert os.path.isdir("many/2")
def fails(name, state):
    raise Enough(name)
try:
    geocone.run_many(f"{root}/tests/footing_coarse.prm", {
        name: {**short, "Loading/push/Duration": 1e5} for name in "ab"}, program=program,
        output="ended", progress=fails)
    raise AssertionError
except Enough:
    assert {geocone.read(f"ended/{name}").status.partition(":")[0]
            for name in os.listdir("ended")} == {"stopped"}
PYTHON

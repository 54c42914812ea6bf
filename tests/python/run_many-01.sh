# geocone.run_many: variants side by side, each as run() computes it alone; no more at a
# time than there are cores; what fails is told, and the others are there; an interrupted
# call leaves nothing running.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
PYTHONPATH=$root/python /usr/bin/python3 -B - "$program" "$root/tests/footing_coarse.prm" \
  <<'PYTHON'
import os, signal, subprocess, sys, threading, time
import geocone
from geocone.side_by_side import SideBySide
program, file = sys.argv[1:]
short = {"Output/Report for tests": "none", "Output/Pictures": False,
         "Loading/push/Duration": 0.02}
def many(variants, **options):
    return geocone.run_many(file, {name: {**short, **parameters}
                                   for name, parameters in variants.items()},
                            **{"program": program, **options})

sizes = 0.2, 0.25, 0.5
runs = many({size: {"Mesh/Cell size": size} for size in sizes}, cores=3)
assert tuple(runs) == sizes  # in order, whichever has ended first
for size, run in runs.items():
    assert str(run.folder) == f"results/footing_coarse/{size}"
    assert run.parameters["Mesh/Cell size"] == str(size)
alone = geocone.run(file, {**short, "Mesh/Cell size": 0.25}, program=program)
assert str(alone.folder) == "results/footing_coarse-2"
for name in "load (N/m)", "displacement (m)":
    assert alone.statistics[name].tolist() == runs[0.25].statistics[name].tolist()
both = many({"two": {}}, ranks=2, cores=1, output="elsewhere")["two"]
assert both.value("size/ranks") == 2 and str(both.folder) == "elsewhere/two"
assert many({}) == {}

# One that is refused: the others have been computed all the same.
bad = {"bad": {"Mesh/Cell size": -1}, "good": {}, "worse": {"No/Parameter": 1}}
results = many(bad, keep_failed=True, output="kept")
assert list(results) == list(bad) and results["good"].status == "finished"
assert "'-1'" in str(results["bad"]) and "No" in str(results["worse"])
try:
    many(bad, output="thrown")
    raise AssertionError("a run that fails")
except geocone.RunFailed as problem:
    assert str(problem) == str(results["bad"]) and str(problem.folder) == "thrown/bad"
assert geocone.read("thrown/good").status == "finished"
for names in ("..",), ("",), ("a/b",), (1, "1"):
    try:
        many({name: {} for name in names}, output="names")
        raise AssertionError(names)
    except ValueError as problem:
        assert f"'{names[-1]}'" in str(problem)
assert not os.path.exists("names")
try:
    many({"a": {}}, cores=0)
    raise AssertionError("no cores")
except ValueError as problem:
    assert "allowed: 1 and more" in str(problem)

# Cores: jobs of 1, 1, 2 and (more than there are) 3 cores on two.
running, most, lock = [0], [0], threading.Lock()
def job(cores):
    def work():
        with lock:
            running[0] += cores
            most[0] = max(most[0], running[0])
        time.sleep(0.05)
        with lock:
            running[0] -= cores
    return work
SideBySide(2).do([(1, job(1)), (1, job(1)), (2, job(2)), (3, job(2)), (1, job(1))] * 3)
assert most[0] == 2, most

# A job that fails ends the others, and its error is thrown.
calls, ended = SideBySide(2), []
def fails():
    time.sleep(0.3)
    raise KeyError("told")
began = time.monotonic()
try:
    calls.do([(1, lambda: ended.append(calls.call(["sleep", "60"]))), (1, fails),
              (1, lambda: ended.append("after"))])
    raise AssertionError("a job that fails")
except KeyError as problem:
    assert problem.args == ("told",) and time.monotonic() - began < 20.
assert [one.code for one in ended] == [-signal.SIGTERM] and calls.stopped

# Ctrl-C: both runs end as stopped ones do, and can be resumed.
script = f"""
import geocone
geocone.run_many({file!r}, {{name: {{"Loading/push/Duration": 1e6, "Output/Pictures": False}}
                 for name in "ab"}}, cores=2, output="endless", program={program!r})
"""
child = subprocess.Popen([sys.executable, "-B", "-c", script], stderr=subprocess.PIPE)
for _ in range(6000):
    if all(os.path.exists(f"endless/{name}/statistics.csv") for name in "ab"):
        break
    time.sleep(0.01)
child.send_signal(signal.SIGINT)
_, words = child.communicate(timeout=60)
assert words.decode().strip().endswith("KeyboardInterrupt"), words
for name in "ab":
    run = geocone.read(f"endless/{name}")
    assert run.status.startswith("stopped"), run.status
PYTHON

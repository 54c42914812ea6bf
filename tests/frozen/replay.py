#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solves the frozen problems of this folder again and checks what comes out:

    replay.py PROGRAM FOLDER fem|mpm         # by default options, exact law
    replay.py PROGRAM FOLDER memory          # without dilatancy, by friction with memory
    replay.py PROGRAM FOLDER formulations    # all agree where flow is associated

FOLDER takes the results. Solved is what holds for the law that is asked for. Fails if
a problem is solved that was not before, too: it is to be taken off the list then."""

import json
import pathlib
import re
import shutil
import subprocess
import sys

import h5py

HERE = pathlib.Path(__file__).resolve().parent

# Problems that default options do not solve with the exact law, and those where
# rounding decides: fem_huge_step_theta0 takes 35 to 45 iterations of the natural map
# where rho changes by 1e-9 of itself, and may have 40.
UNSOLVED = {"mpm_slope_huge_theta0"}
EITHER = {"fem_unload_theta0", "fem_failed_blend_theta0", "fem_failed_lag_theta0",
          "fem_huge_step_theta0", "mpm_failed_lag_theta0"}

# With a memory of four steps: steps that a run cuts. Not more than these.
CUT = {"fem_failed_lag_theta0", "fem_huge_step_theta0", "fem_unload_theta0",
       "mpm_slope_failed_lag_theta0", "mpm_slope_huge_theta0"}

# Iterations that no problem of a class may need: about a quarter more than was seen
# (fem_nu049_theta0_cold took 74 with assertions, where it is rounded otherwise).
BOUNDS = {("fem", "assoc"): 220, ("fem", "half"): 45, ("fem", "theta0"): 95,
          ("mpm", "assoc"): 40, ("mpm", "half"): 50, ("mpm", "theta0"): 85}
NATURAL_MAP = 1e-11
AGREEMENT = 1e-9  # of stresses, relative to the largest one

# Problems in stresses lose digits: z is a small difference of W s and q. Here more
# than elsewhere, and so does the residual of the velocities that belong to them.
LOOSE = {"fem_huge_step_assoc": 1e-8, "fem_phi45_assoc_cold": 1e-8}
# Gauss-Seidel would take more than 3000 sweeps for the others.
GAUSS_SEIDEL = {"mpm_column_assoc_step15"}


def flow(name):
    """The class of a problem, by its name."""
    return next((part for part in ("half", "theta0") if part in name), "assoc")


def with_memory(file):
    """Settings for a memory of four steps; runs begin with sixteen."""
    with h5py.File(file) as problem:
        step = problem["step"][0]
        materials = bytes(problem["materials"][:]).decode()
    names = re.findall(r"^  subsection (\w+)$", materials, re.MULTILINE)
    return ["Time stepping/Friction = automatic",
            *(f"Materials/{name}/Friction memory = {4. * step:.10g}" for name in names)]


def solve(program, files, folder, *settings):
    """Summary and stresses of replays by the names of their files, all in one call of the
    program; (None, message) of those that ended otherwise."""
    shutil.rmtree(folder, ignore_errors=True)  # of an earlier call
    command = [program, *files, "--quiet"]
    for text in ("Output/If folder exists = overwrite",
                 "Time stepping/Friction = exact", *settings):
        command += ["--set", text]
    command += ["--output", folder / files[0].stem if len(files) == 1 else folder]
    result = subprocess.run(command, capture_output=True, text=True, timeout=600)
    found = {}
    for file in files:
        results = folder / file.stem
        if not (results / "summary.json").exists():
            found[file.stem] = None, result.stderr.strip() or f"exit code {result.returncode}"
            continue
        summary = json.loads((results / "summary.json").read_text())
        lines = (results / "stress.csv").read_text().splitlines()[1:]
        found[file.stem] = summary, [float(value) for line in lines for value in line.split(",")]
    all_solved = all(summary and summary["converged"] for summary, _ in found.values())
    if (result.returncode == 0) != all_solved:
        sys.exit(f"exit code {result.returncode}: {result.stderr.strip()}")
    return found


def groups(files, key):
    """Files by a key of each."""
    found = {}
    for file in files:
        found.setdefault(key(file), []).append(file)
    return found


def check(name, summary):
    """What is wrong with a replay, in words."""
    solved = summary["converged"]
    if name not in EITHER and solved != (name not in UNSOLVED):
        return "is solved now" if solved else "is not solved: " + summary["reason"]
    if solved and summary["friction_lag"] != 0.:
        return "is solved with friction that lags"
    if solved and summary["natural_map_error"] > NATURAL_MAP:
        return f"has the natural-map error {summary['natural_map_error']:.1e}"
    bound = BOUNDS[name[:3], flow(name)]
    if solved and summary["iterations"] > bound:
        return f"needs {summary['iterations']} iterations, more than {bound}"
    return None


def formulations(name, summary):
    """The formulations that can solve a problem, other than the return map."""
    yield "natural map"
    if "static" in name:  # what is reduced needs a mass
        return
    yield "reduced"
    if summary["constraints"] > 0:
        yield "reduced with multipliers"
    if name in GAUSS_SEIDEL:
        yield "Gauss-Seidel"


def compare(program, files, folder):
    """What formulations say otherwise than the default does, in words."""
    accurate = "Newton/Tolerance = 1e-12"
    expected = solve(program, files, folder / "default", accurate)
    asked = [(file, formulation) for file in files
             for formulation in formulations(file.stem, expected[file.stem][0])]
    for formulation, pairs in groups(asked, lambda pair: pair[1]).items():
        natural = formulation == "natural map"
        found = solve(program, [file for file, _ in pairs], folder / formulation,
                      f"Newton/Formulation = {formulation}", *([accurate] if natural else []))
        for name, (summary, stress) in found.items():
            if summary is None or natural and not summary["converged"]:
                yield f"{name}, {formulation}: {stress if summary is None else summary['reason']}"
                continue
            exact = expected[name][1]
            error = max(abs(a - b) for a, b in zip(stress, exact)) / max(map(abs, exact))
            if not error <= (AGREEMENT if natural else LOOSE.get(name, AGREEMENT)):
                yield f"{name}, {formulation}: stresses differ by {error:.1e}"


def main():
    program, folder, what = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    errors = []
    if what == "formulations":
        errors += compare(program, [file for file in sorted(HERE.glob("*.h5"))
                                    if flow(file.stem) == "assoc" and file.stem not in UNSOLVED],
                          folder)
    elif what == "memory":
        for settings, files in groups(sorted(HERE.glob("*theta0*.h5")),
                                      lambda file: tuple(with_memory(file))).items():
            for name, (summary, stress) in solve(program, files, folder, *settings).items():
                error = (stress if summary is None else
                         None if summary["converged"] or name in CUT else
                         summary["reason"])
                if error:
                    errors.append(f"{name}: {error}")
    else:
        files = sorted(HERE.glob(what + "_*.h5"))
        if len(files) < 20:
            errors.append(f"only {len(files)} problems {what}_*.h5")
        names = {file.stem for file in HERE.glob("*.h5")}
        errors += [f"{name}: is missing" for name in (UNSOLVED | EITHER) - names]
        for name, (summary, stress) in solve(program, files, folder).items():
            error = stress if summary is None else check(name, summary)
            if error:
                errors.append(f"{name}: {error}")
    print("\n".join(errors))
    return len(errors) > 0


if __name__ == "__main__":
    sys.exit(main())

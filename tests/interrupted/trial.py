#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Interrupts runs at random moments and checks what they leave:

    trial.py PROGRAM                       # each deed once for each method
    trial.py PROGRAM --count 10 --seed 3   # ten times
    trial.py PROGRAM --cases fem:kill:1 explicit:full-disk-hdf5:2   # METHOD:DEED:RANKS

Deeds: kill (SIGKILL to all ranks), kill-rank (to one of two), terminate (SIGTERM) and
interrupt (SIGINT; both to mpirun if there are two ranks), memory (no more of it; not of
explicit runs on two ranks, whose steps allocate nothing but within Open MPI, which then
waits for ever), full-disk-vtu and full-disk-hdf5 (a small file system is mounted, which
needs root), remove (the run's folder is removed).

Afterwards, within two seconds of the end: summary.json tells how the run ended, never
that it goes on; tables have whole lines; each file of a record (.pvd, .xdmf) can be
read; no temporary file is left but by SIGKILL; the exit code is as it is documented.
Exit code 1 if anything else is found."""

import argparse
import csv
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path

import h5py

TESTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS))
from processes import ranks_of  # noqa: E402

METHODS = {  # a scene that would go on for hours, with fields at each step
    "fem": ("footing_coarse.prm", {"Loading/push/Duration": "1000",
                                   "Loading/push/Output every": "1"}),
    "mpm": ("mpm/column-collapse-01.prm", {"Loading/fall/Duration": "1000",
                                           "Loading/fall/Output every": "1"}),
    "explicit": ("explicit/block.prm", {"Loading/settle/Duration": "1000",
                                        "Loading/settle/Step size": "0.02",
                                        "Loading/settle/Output every": "1"})}
ALWAYS = {"Output/Expectations": "", "Output/Report for tests": "none",
          "Output/Pictures": "false", "Output/Fields": "true"}
# Of each deed: how the status begins, and the exit codes (of mpirun any but 0).
DEEDS = {"kill": (("killed",), (-signal.SIGKILL,)),
         "kill-rank": (("killed", "stopped", "failed"), ()),
         "terminate": (("stopped",), (143,)),
         "interrupt": (("stopped",), (130,)),
         "memory": (("failed",), (1,)),
         "full-disk-vtu": (("failed",), (1,)),
         "full-disk-hdf5": (("failed",), (1,)),
         "remove": ((), (1,))}
PATIENCE = 120.  # s, for the start and the end of a run
TELLS_WITHIN = 2.  # s after its end a run has told how it ended


class Wrong(Exception):
    """What a run should not have done or left."""


class Skipped(Exception):
    """Why a case cannot be tried here."""


def wait_for(condition, seconds):
    """Whether a condition comes true within some time."""
    end = time.monotonic() + seconds
    while not (found := condition()) and time.monotonic() < end:
        time.sleep(0.02)
    return found


def command(program, method, deed, folder, n_ranks):
    """The call of a run."""
    file, settings = METHODS[method]
    settings = {**settings, **ALWAYS,
                "Output/Fields format": "hdf5" if deed.endswith("hdf5") else "vtu"}
    call = [program, TESTS / file, "--quiet", "--output", folder]
    for name, value in settings.items():
        call += ["--set", f"{name} = {value}"]
    return (["mpirun", "-np", str(n_ranks)] if n_ranks > 1 else []) + call


def do(deed, child, program, folder):
    """Interrupts a run."""
    if deed in ("kill", "kill-rank"):
        ranks = ranks_of(child, program)
        for pid in ranks[-1:] if deed == "kill-rank" else ranks:
            os.kill(pid, signal.SIGKILL)
    elif deed == "terminate":
        child.terminate()
    elif deed == "interrupt":
        child.send_signal(signal.SIGINT)
    elif deed == "memory":
        for pid in ranks_of(child, program):
            used = int(Path(f"/proc/{pid}/statm").read_text().split()[0])
            size = used * resource.getpagesize()
            resource.prlimit(pid, resource.RLIMIT_AS, (size, size))
            # What the heap still has free would last for long.
            resource.prlimit(pid, resource.RLIMIT_DATA, (1, 1))
    elif deed == "remove":
        # At once: else a file may be written while the folder is emptied.
        gone = folder.with_name("gone")
        folder.rename(gone)
        shutil.rmtree(gone)


def check_tables(folder):
    """Tables have whole lines."""
    for path in folder.glob("*.csv"):
        text = path.read_text()
        if text and not text.endswith("\n"):
            raise Wrong(f"{path.name}: the last line is not whole")
        if len({len(line) for line in csv.reader(text.splitlines())}) > 1:
            raise Wrong(f"{path.name}: lines of different lengths")


def check_fields(folder):
    """All that the records name can be read."""
    try:
        for record in folder.glob("*.pvd"):
            for entry in ElementTree.parse(record).getroot().iter("DataSet"):
                file = folder / entry.get("file")
                root = ElementTree.parse(file).getroot()
                for piece in root.iter("Piece"):
                    if piece.get("Source"):
                        ElementTree.parse(folder / piece.get("Source"))
        for record in folder.glob("*.xdmf"):
            for item in ElementTree.parse(record).getroot().iter("DataItem"):
                name, _, path = (item.text or "").strip().partition(":")
                if name.endswith(".h5"):
                    with h5py.File(folder / name) as file:
                        file[path][...]
    except (ElementTree.ParseError, OSError, LookupError, ValueError) as problem:
        raise Wrong(f"{record.name} names what cannot be read: {problem}") from problem


def status_of(folder):
    """The status in summary.json, which is always whole."""
    try:
        return json.loads((folder / "summary.json").read_text())["status"]
    except (OSError, ValueError, LookupError) as problem:
        raise Wrong(f"summary.json cannot be read: {problem}") from problem


def check(deed, n_ranks, folder, code, errors):
    """Whether a run has ended as it should."""
    beginnings, codes = DEEDS[deed]
    if code == 0 or (n_ranks == 1 and code not in codes):
        raise Wrong(f"exit code {code} instead of {codes}: {errors[-300:]}")
    if deed == "remove":
        if "error: " not in errors:
            raise Wrong("no message")
        return "no folder"
    ended = wait_for(lambda: status_of(folder) != "running", TELLS_WITHIN)
    status = status_of(folder)
    if not ended or not status.startswith(beginnings):
        raise Wrong(f"status '{status}'")
    if "failed" in beginnings and n_ranks == 1 and "remedy:" not in errors:
        raise Wrong(f"no remedy: {errors[-300:]}")
    check_tables(folder)
    check_fields(folder)
    parts = [path.name for path in folder.glob("*.part")]
    if parts and not deed.startswith("kill"):
        raise Wrong(f"left: {', '.join(parts)}")
    return status


def mount(folder, size):
    """Mounts a file system of some bytes, or skips the case."""
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Skipped(f"no file system can be mounted: {done.stderr.strip()}")


def attempt(program, method, deed, n_ranks, rng, work):
    """Tries a case in a folder; returns the status that the run has left."""
    shutil.rmtree(work, ignore_errors=True)
    disk = work / "disk"
    disk.mkdir(parents=True)
    folder, full = disk / "run", deed.startswith("full-disk")
    delay, size = rng.uniform(0., 1.5), rng.randrange(300_000, 1_500_000)
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "TMPDIR": "/tmp",
                   "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_rmaps_base_oversubscribe": "1",
                   "OMPI_MCA_mpi_yield_when_idle": "1",
                   "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
    if full:
        mount(disk, size)
    try:
        with open(work / "out", "wb") as out, open(work / "err", "wb") as err:
            child = subprocess.Popen(
                list(map(str, command(program, method, deed, folder, n_ranks))),
                cwd=work, stdout=out, stderr=err, env=environment,
                start_new_session=True)
            try:
                table = folder / "statistics.csv"
                begun = wait_for(lambda: child.poll() is not None or (
                    table.exists() and table.read_text().count("\n") > 2), PATIENCE)
                if not begun or (child.poll() is not None and not full):
                    raise Wrong("the run does not begin: " +
                                (work / "err").read_text()[-300:])
                if not full:
                    time.sleep(delay)
                    do(deed, child, program, folder)
                code = child.wait(PATIENCE)
            except subprocess.TimeoutExpired as problem:
                raise Wrong(f"no end in {PATIENCE:g} s") from problem
            finally:
                if child.poll() is None:
                    os.killpg(child.pid, signal.SIGKILL)
                    child.wait()
        return check(deed, n_ranks, folder, code,
                     (work / "err").read_text(errors="replace"))
    finally:
        if full:
            # What has failed is kept for a look, without the mount.
            kept = work / "left"
            shutil.copytree(disk, kept, dirs_exist_ok=True)
            subprocess.run(["umount", disk], check=True)


def main():
    """Tries what the command line asks for; returns the exit code."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--count", type=int, default=1, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    parser.add_argument("--cases", nargs="+", metavar="METHOD:DEED:RANKS",
                        help="default: all methods and deeds, on one rank or two")
    parser.add_argument("--output", type=Path, metavar="FOLDER",
                        help="is emptied; default: a new one")
    call = parser.parse_args()
    # Runs of a job in the background would ignore it, too.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    program = call.program.resolve()
    output = (call.output or Path(tempfile.mkdtemp(prefix="interrupted-"))).resolve()
    cases = [case.split(":") for case in call.cases or ()]
    if any(len(case) != 3 or case[0] not in METHODS or case[1] not in DEEDS or
           case[2] not in ("1", "2") for case in cases):
        parser.error(f"a case is one of {', '.join(METHODS)}, of {', '.join(DEEDS)}, and "
                     "1 or 2, between colons")
    cases = cases or [(method, deed, ranks) for method in METHODS for deed in DEEDS
                      for ranks in ("1", "2")
                      if (ranks == "2" or deed != "kill-rank") and
                      (method, deed, ranks) != ("explicit", "memory", "2")]
    found = Counter()
    for method, deed, ranks in cases:
        for i in range(call.count):
            name = f"{method}-{deed}-{ranks}-{i}"
            rng = random.Random(f"{call.seed} {name}")
            try:
                verdict = "good"
                told = attempt(program, method, deed, int(ranks), rng, output / name)
                shutil.rmtree(output / name)
            except Skipped as reason:
                verdict, told = "skipped", reason
            except Wrong as problem:
                verdict, told = "WRONG", problem
            found[verdict] += 1
            print(f"{verdict:8} {name}: {' '.join(str(told).split())[:200]}", flush=True)
    print(", ".join(f"{n} {verdict}" for verdict, n in found.items()) + f", {output}")
    return 1 if found["WRONG"] else 0


if __name__ == "__main__":
    sys.exit(main())

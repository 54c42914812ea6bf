# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Effects of a design of two levels, of responses that are known; and the design of the
study of the slope cut."""

import itertools
import sys
from pathlib import Path

import numpy as np

from geocone.parameter_file import parameters_of
from geocone.report import slope_cut
from geocone.report.study_file import read_study

study = read_study(Path(sys.argv[1]))
single = [run for run in study.runs if run.group == "one at a time"]
runs = [run for run in study.runs if run.group == "design" and
        run.axes["points"] == "2 x 2 points"]
PAUSE = "Loading/settle/Duration"  # differs where a slope needs longer to come to rest


def row_of(run):
    """A run as figures and tables get it."""
    return {"group": run.group, "axes": run.axes, "status": "finished", "name": run.name}


def changed(run):
    """The constants of the soil that a run sets."""
    parts = [text.split(" = ") for text in run.settings if text.startswith("Materials/")]
    assert len(dict(parts)) == len(parts), run.name
    return dict(parts)


# The study: 16 runs of 8 factors, each letter the variant of that factor; the values of
# the scene are between the low and the high ones.
by_variant = {run.axes["variant"]: changed(run) for run in single}
base, factors = slope_cut.variants([row_of(run) for run in single])
assert base["axes"]["variant"] == "base" and by_variant["base"] == {}
assert [*factors] == ["M", "cb", "OCR", "structure", "alpha", "cR", "ca", "cbeta"], factors
scene = parameters_of(study.runs[0].file)
for factor, levels in factors.items():
    low, high = (by_variant[f"{factor} {side} {levels[side][0]}"] for side in ("low", "high"))
    assert low.keys() == high.keys() and low, factor
    for name in low:
        assert float(low[name]) < float(scene[name]) < float(high[name]), name
assert len(runs) == 16 and len(single) == 17
for run in runs:
    wanted = {}
    for letter, (factor, levels) in zip(run.axes["levels"], factors.items(), strict=True):
        side = {"L": "low", "H": "high"}[letter]
        wanted |= by_variant[f"{factor} {side} {levels[side][0]}"]
    assert changed(run) == wanted, run.name
    others = {text.split(" = ")[0] for text in run.settings if
              not text.startswith("Materials/")} - {PAUSE}
    assert others == {text.split(" = ")[0] for text in single[0].settings}, others

# Main effects are twice the coefficients, and exact; all others are zero.
signs = slope_cut.signs_of([run.axes["levels"] for run in runs])
A, B, C, D, E = signs.T[:5]
products = slope_cut.interactions(signs)
assert signs.shape == (16, 8) and products.shape == (16, 7)
assert np.array_equal(signs > 0., [[letter == "H" for letter in run.axes["levels"]]
                                   for run in runs])
assert np.array_equal(slope_cut.effects_of(signs, 7. + 3. * A - 2. * B),
                      [6., -4., 0., 0., 0., 0., 0., 0.])
assert np.array_equal(slope_cut.effects_of(products, 7. + 3. * A - 2. * B), np.zeros(7))

# The product of two factors is in no main effect and in one column, which four pairs share;
# that of three is the main effect of a fourth.
pairs = [signs[:, i] * signs[:, j] for i, j in itertools.combinations(range(8), 2)]
for pair in pairs:
    assert np.array_equal(slope_cut.effects_of(signs, pair), np.zeros(8))
    found = np.abs(slope_cut.effects_of(products, pair))
    assert np.array_equal(np.sort(found), [0., 0., 0., 0., 0., 0., 2.]), found
    assert sum(abs(pair @ other) == 16. for other in pairs) == 4
assert np.array_equal(slope_cut.effects_of(signs, 5. * B * C * D),
                      [0., 0., 0., 0., 10., 0., 0., 0.]) and np.array_equal(B * C * D, E)

# Other sets of runs are refused: a factor that is a product of two others, a run that is
# missing, or twice.
letters = [run.axes["levels"] for run in runs]
third = [text[:2] + "LH"[text[0] == text[1]] for text in letters]
for wrong in third, letters[1:], letters[1:] + letters[1:2], ["x" + text[1:] for text in letters]:
    try:
        slope_cut.signs_of(wrong)
    except ValueError as problem:
        assert "resolution IV" in str(problem), problem
    else:
        raise AssertionError(wrong)

try:
    slope_cut.compared([row_of(run) for run in single[:-2] + runs], {"points": "2 x 2 points"})
except ValueError as problem:
    assert "a letter for each factor" in str(problem), problem
else:
    raise AssertionError("a factor without variants")

# The table: ranked by size, in the order of the letters; a slope that stands counts with
# the end of its run, 10 s, and is told.
TIMES = {run.name: time for run, time in zip(
    runs, 5. + 0.5 * A - C + np.where((A > 0.) & (C < 0.), np.inf, 0.))}
slope_cut.followed = lambda rows: 10.
slope_cut.response = lambda row, name, options: TIMES.get(row["name"], 4.)
expected = np.array([min(TIMES[run.name], 10.) for run in runs])
head, lines = slope_cut.ranking([row_of(run) for run in single + runs], {
    "response": "time of failure", "points": "2 x 2 points", "toe": 14.})
assert all(len(line) == len(head) for line in lines) and len(lines) == 10
assert [line[1] for line in lines[:2]] == ["OCR", "M"], lines
for line, column in zip(lines, (C, A)):
    effect = expected[column > 0.].mean() - expected[column < 0.].mean()
    assert line[6] == f"{effect:+.2f}" and abs(effect) > 1., (line, effect)
assert [line[-1] for line in lines[:2]] == ["4, 0", "0, 4"], lines
assert all(line[6] == "+0.00" and line[-1] == "2, 2" for line in lines[2:8]), lines
# That only one corner stands is a product of M and OCR, the only one.
rms = np.sqrt(((A * C) @ expected / 8.)**2 / 7.)
assert lines[9][6] == f"{rms:.2f}" and rms > 0.5, (lines[9], rms)
# Factors that multiply a time have no interactions in its logarithm.
TIMES = {run.name: time for run, time in zip(runs, 2. * 1.5**A * 0.8**B)}
lines = slope_cut.ranking([row_of(run) for run in single + runs], {
    "response": "time of failure", "points": "2 x 2 points", "toe": 14.})[1]
assert [line[1] for line in lines[:2]] == ["M", "cb"], lines
assert [line[8] for line in lines[:8]] == ["2.25", "0.64"] + ["1.00"] * 6, lines
assert lines[9][6] != "0.00" and lines[9][8] == "1.00", lines

# The time of failure, from the columns of a run: between two steps, since the cut, where
# the displacement of before does not count.
folder = Path("run")
folder.mkdir()
steps = np.arange(0., 3.1, 0.2)
moved = np.where(steps > 1., 0.3 + 0.8 * (steps - 1.), 0.3)
(folder / "statistics.csv").write_text("\n".join(
    ["time (s),removed mass (kg/m),displacement of point 1 x (m),displacement of point 1 y (m),"
     "displacement of point 2 x (m),displacement of point 2 y (m)"] +
    [f"{time},{5. * (time > 1.1)},{0.6 * u},{-0.8 * u},0,0" for time, u in zip(steps, moved)]))
time = slope_cut.failure_time({"folder": folder}, 1)
assert abs(time - 1.25) < 1e-9, time
assert slope_cut.failure_time({"folder": folder}, 2) == np.inf

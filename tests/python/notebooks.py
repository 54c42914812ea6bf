"""Runs the notebooks of a folder with quick = True, and looks at what they show.
notebooks.py FOLDER PAGES: they are run in the working folder; what they show is written
to the folder PAGES as HTML."""

import pathlib
import re
import sys

import nbformat
from nbconvert import HTMLExporter
from nbconvert.preprocessors import ExecutePreprocessor

folder, pages = map(pathlib.Path, sys.argv[1:])


class Shown:
    """What an executed notebook shows."""

    def __init__(self, notebook):
        outputs = [output for cell in notebook.cells if cell.cell_type == "code"
                   for output in cell.outputs]
        self.text = "\n".join(
            output.text if output.output_type == "stream" else
            output.data.get("text/markdown", output.data.get("text/plain", ""))
            for output in outputs)
        self.pictures = sum("image/png" in output.get("data", {}) for output in outputs)
        self.rows = [[cell.strip() for cell in line.strip("|").split("|")]
                     for line in self.text.splitlines() if line.startswith("| ")]

    def number(self, pattern):
        """The number that a text has in the place of the pattern's group."""
        return float(re.search(pattern, self.text).group(1))


def run(file):
    """Executes a notebook as it is stored, but quickly."""
    notebook = nbformat.read(file, as_version=4)
    nbformat.validate(notebook)
    switches = 0
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert not cell.outputs and cell.execution_count is None, (
                f"{file.name} is stored with outputs: clear them")
            if "parameters" in cell.metadata.get("tags", []):
                assert cell.source.startswith("quick = False"), cell.source
                cell.source, switches = "quick = True", switches + 1
    assert switches == ("quick" in file.read_text()), file
    ExecutePreprocessor(timeout=300, kernel_name="python3").preprocess(notebook, {})
    page, _ = HTMLExporter().from_notebook_node(notebook)
    (pages / f"{file.stem}.html").write_text(page)
    return Shown(notebook)


def footing(shown):
    """Errors against Prandtl are positive, and fall with the size of the cells."""
    assert shown.number(r"Prandtl: ([\d.]+) N/m") == 8288.21  # validation.md
    errors = [float(row[-1]) for row in shown.rows[2:]]
    assert len(errors) == 4
    assert 0. < errors[1] < errors[0] < 40. and 0. < errors[3] < errors[2] < 80., errors
    assert shown.pictures == 3
    assert "parameter 'Materials/soil/Friction angle' = '95'" in shown.text


def slope_factor_of_safety(shown):
    """The brackets hold the factors that are known."""
    lower, upper = (shown.number(rf"'{side}': ([\d.]+)") for side in ("lower", "upper"))
    assert lower <= 1.380 <= upper <= 1.1 * lower, (lower, upper)  # Bishop, Morgenstern
    slopes = [(float(row[1]), float(row[2])) for row in shown.rows[2:]]
    assert len(slopes) == 3
    for (low, high), (steeper_low, steeper_high) in zip(slopes, slopes[1:]):
        assert low < high and steeper_low < low and steeper_high < high
    assert 0.95 * lower < shown.number(r"by steps ([\d.]+)") < 1.1 * upper
    assert shown.pictures == 3


def calibration(shown):
    """The constants of the synthetic data are found, and the misfit is their noise."""
    rows = shown.rows[1:]
    assert len(rows) == 4
    for _, _, found, spread, true in rows:
        assert abs(float(found) - float(true)) < 4. * float(spread) < 0.4 * float(true), rows
    assert 0.005 < shown.number(r"mean misfit ([\d.]+)") < 0.015
    assert shown.pictures == 1


def element_tests(shown):
    """Strengths are those of the closed form."""
    rows = shown.rows[2:]
    assert len(rows) == 3
    for _, computed, known in rows:
        assert abs(float(computed) / float(known) - 1.) < 1e-5
    assert shown.pictures == 2


checks = {file.stem: file for file in sorted(folder.glob("*.ipynb"))}
for name, file in checks.items():
    globals()[name](run(file))
    print(name)
assert len(checks) == 4

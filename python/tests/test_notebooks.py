"""Runs a notebook as a person does, cell by cell, and looks whether it is clean: test_notebooks.py NOTEBOOK.

What a notebook claims it asserts itself; a cell that fails is shown with its number. Jupyter is not needed.
"""
import json
import os
import pathlib
import sys
import tempfile

try:
    import numpy  # noqa: F401, what all notebooks need
except ImportError:
    print("test_notebooks.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

MOST_LINES = 60  # of code


def check(notebook):
    """Returns the texts of the code cells. Raises AssertionError for a notebook that is not clean."""
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5), "expected the format 4.5"
    cells = [one for one in notebook["cells"] if one["cell_type"] == "code"]
    assert notebook["cells"][0]["cell_type"] == "markdown", "expected a title first"
    for one in cells:
        assert not one["outputs"] and one["execution_count"] is None, "expected cells without output"
    texts = ["".join(one["source"]) for one in cells]
    lines = sum(1 for text in texts for line in text.splitlines() if line.strip() and not line.strip().startswith("#"))
    assert lines <= MOST_LINES, f"{lines} lines of code, expected {MOST_LINES} at most"
    assert any("assert " in text for text in texts), "expected that it asserts what it claims"
    return texts


def main(path):
    texts = check(json.loads(path.read_text()))
    os.environ["MPLBACKEND"] = "Agg"
    with tempfile.TemporaryDirectory(prefix="ortung-notebook-") as folder:
        tempfile.tempdir = folder  # what cells leave is gone with it
        os.chdir(folder)
        names = {"__name__": "__main__"}
        for number, text in enumerate(texts, 1):
            exec(compile(text, f"{path.name}, code cell {number}", "exec"), names)
    print(f"{path.name}: {len(texts)} cells")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())

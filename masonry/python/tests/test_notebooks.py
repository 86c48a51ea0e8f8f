"""The notebooks run, and have no outputs that could grow old."""

import pathlib

import pytest

REASON = "nbclient is not installed: pip install nbclient nbformat ipykernel matplotlib"
nbclient = pytest.importorskip("nbclient", reason=REASON)
nbformat = pytest.importorskip("nbformat", reason=REASON)
for name in ("ipykernel", "matplotlib"):
    pytest.importorskip(name, reason=REASON)
ROOT = pathlib.Path(__file__).parents[3] / "examples" / "python"
NOTEBOOKS = sorted(ROOT.glob("*.ipynb"))


def test_there_are_notebooks():
    assert len(NOTEBOOKS) >= 6


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    assert all(not cell.get("outputs") for cell in notebook.cells)
    # Cells check their numbers themselves, and an exception of a cell is one here.
    nbclient.NotebookClient(
        notebook, timeout=300, resources={"metadata": {"path": str(ROOT)}}
    ).execute()
    errors = [it for cell in notebook.cells for it in cell.get("outputs", []) if it.output_type == "error"]
    assert not errors and notebook.cells[0].source.startswith("# ")

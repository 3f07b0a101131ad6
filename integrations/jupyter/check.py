"""Runs each notebook in a kernel of its own. It must print what the example prints.

python integrations/jupyter/check.py FOLDER
"""

import contextlib
import io
import runpy
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from notebooks import ROOT, write

IN_REAL_TIME = ("05_servo_loop", "06_own_device")  # they print other numbers each time


def printed(notebook: nbformat.NotebookNode) -> str:
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    return "".join(output.text for output in outputs if output.output_type == "stream" and output.name == "stdout")


def printed_by(program: Path) -> str:
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        runpy.run_path(str(program), run_name="__main__")
    return said.getvalue()


def main(folder: Path) -> None:
    for path in write(folder):
        notebook = nbformat.read(path, 4)
        NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
        example = ROOT / "examples" / "python" / f"{path.stem}.py"
        alike = example.exists() and path.stem not in IN_REAL_TIME
        assert not alike or printed(notebook) == printed_by(example) != "", f"{path.stem}: another output"
        print(f"jupyter: {path.name} ran in a kernel" + (", and printed what the example prints" if alike else ""))


if __name__ == "__main__":
    main(Path(sys.argv[1]))

"""The examples, and the notebooks of the documentation, as files for Jupyter.

python integrations/jupyter/notebooks.py [FOLDER]       by default notebooks/; it needs jupytext
"""

import ast
import sys
from pathlib import Path

import jupytext
import nbformat

ROOT = Path(__file__).resolve().parents[2]
KERNEL = {"name": "python3", "display_name": "Python 3", "language": "python"}


def notebooks() -> dict[str, nbformat.NotebookNode]:
    """By name, from the shortest example to the longest notebook."""
    examples = {path.stem: of_example(path) for path in sorted(ROOT.glob("examples/python/*.py"))}
    pages = {path.stem: jupytext.read(path, fmt="md:myst") for path in sorted(ROOT.glob("docs/notebooks/*.md"))}
    return {**examples, **pages}


def of_example(path: Path) -> nbformat.NotebookNode:
    """A cell for each paragraph of a program; its first words are the text above them."""
    text = path.read_text(encoding="utf-8")
    words = ast.parse(text).body[0]
    program = "\n".join(text.splitlines()[words.end_lineno or 0 :]).lstrip("\n")
    notebook = jupytext.reads(program, fmt="py:light")
    title = f"# {path.stem.replace('_', ' ')}\n\n{ast.get_docstring(ast.parse(text))}"
    notebook.cells.insert(0, nbformat.v4.new_markdown_cell(title))
    return notebook


def write(folder: Path) -> list[Path]:
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, notebook in notebooks().items():
        notebook.metadata = {"kernelspec": KERNEL}
        for k, cell in enumerate(notebook.cells):
            cell.id = f"{name}-{k}"  # the same at each call
        written.append(folder / f"{name}.ipynb")
        nbformat.write(notebook, written[-1])
    return written


if __name__ == "__main__":
    for path in write(Path(sys.argv[1] if len(sys.argv) > 1 else "notebooks")):
        print(path)

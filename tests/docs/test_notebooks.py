"""In the kernel of a notebook, `progress=True` draws a bar."""

import nbformat
from nbclient import NotebookClient

CELL = """
from punctura import progress
progress.PATIENCE_S = 0.0
with progress.reporting(True) as report:
    for k in range(1001):
        report(k / 1000)
"""


def test_true_draws_a_bar_in_the_kernel_of_a_notebook():
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CELL)])
    NotebookClient(notebook, kernel_name="python3").execute()
    [bar] = notebook.cells[0].outputs
    assert bar.output_type == "display_data"
    assert "<progress" in bar.data["text/html"] and "value='100'" in bar.data["text/html"]

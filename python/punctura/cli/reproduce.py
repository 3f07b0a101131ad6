"""`punctura reproduce`: K06's figures and a page that shows them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from punctura.progress import progress_bar

if TYPE_CHECKING:
    from punctura.reproduce import Reproduction


def command(
    out: Annotated[Path, typer.Option("--out", help="Folder to write to.", metavar="FOLDER")] = Path("out/reproduce"),
    as_json: Annotated[bool, typer.Option("--json", help="Print files and measured numbers as JSON.")] = False,
) -> None:
    """Makes Figures 3, 5, 10, 11 and 12 of K06. Writes PNG, SVG, CSV, and a page that shows them."""
    from punctura.reproduce import reproduce  # imported here, because the drawing library takes long to load

    with progress_bar("reproduce") as progress:
        result = reproduce(out, progress)
    typer.echo(json.dumps(result.to_dict(), indent=2) if as_json else _in_words(result))


def _in_words(result: Reproduction) -> str:
    lines = [f"{'':55} {'expected':>9}   {'measured':>9}"]
    for m in result.measured:
        expected = "" if m.expected != m.expected else f"{m.expected:.4g}"
        lines.append(f"{m.figure:9}{m.quantity:46} {expected:>9}   {m.measured:>9.4g} {m.unit}")
    return "\n".join([*lines, "", f"{len(result.files)} files. Open the page: {result.page}"])

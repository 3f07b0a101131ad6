"""Makes all figures, their data and the page: `punctura reproduce`."""

import os
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from punctura.reproduce.experiment import STROKE_DEPTH_MM, k06_scene, operate
from punctura.reproduce.figure_chatter import figure_chatter
from punctura.reproduce.figure_pop import figure_pop
from punctura.reproduce.figures import figure_3, figure_5, figure_10, figure_11, figure_12
from punctura.reproduce.page import versions, write_csv, write_page
from punctura.reproduce.style import DPI, Drawing, Measured, figure_style

PAGE = "index.html"


@dataclass(frozen=True)
class Reproduction:
    """The written files and the measured numbers."""

    folder: Path  # with all files
    files: tuple[str, ...]  # names in the folder, the page first
    measured: tuple[Measured, ...]  # one for each number of a figure

    @property
    def page(self) -> Path:
        """Path of the page with all figures."""
        return self.folder / PAGE

    def to_dict(self) -> dict[str, object]:
        """Data for JSON. A missing expected value is null."""
        return {
            "page": str(self.page),
            "folder": str(self.folder),
            "files": list(self.files),
            "versions": versions(),
            "measured": [
                {**vars(m), "expected": m.expected if m.expected == m.expected else None} for m in self.measured
            ],
        }


def reproduce(folder: str | os.PathLike[str], progress: Callable[[float], None] = lambda share: None) -> Reproduction:
    """Writes K06 Figs. 3, 5, 10, 11, 12, the close-up and the pop as PNG, SVG and CSV, and a page with all of them.

    `progress` is called with the completed share, 0 to 1. All files are first written to a temporary folder, so that a
    failure (OSError) leaves no file.
    """
    target = Path(folder).absolute()
    try:
        return _reproduce(target, progress)
    except OSError as error:
        raise OSError(f"cannot write to {target}: {error.strerror or error}") from error


def _reproduce(target: Path, progress: Callable[[float], None]) -> Reproduction:
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".making-", dir=target) as aside:
        workshop = Path(aside)
        drawings = list[Drawing]()
        with figure_style():
            recipes = _recipes()
            for i, recipe in enumerate(recipes):
                drawing = recipe()
                _save(drawing, workshop)
                drawings.append(drawing)
                progress((i + 1) / (len(recipes) + 1))
        write_page(drawings, workshop, PAGE)
        made = sorted(file.name for file in workshop.iterdir())
        files = [PAGE, *(name for name in made if name != PAGE)]
        for name in reversed(files):  # the page last, so that it never refers to missing files
            shutil.move(workshop / name, target / name)
    progress(1.0)
    return Reproduction(target, tuple(files), tuple(m for drawing in drawings for m in drawing.measured))


def _recipes() -> list[Callable[[], Drawing]]:
    runs = {name: operate(k06_scene(name), depth) for name, depth in STROKE_DEPTH_MM.items()}
    return [
        figure_pop,
        figure_3,
        figure_5,
        lambda: figure_10(runs["k06-fig10"]),
        lambda: figure_chatter(runs["k06-fig10"]),
        lambda: figure_11(runs["k06-fig11"]),
        lambda: figure_12(runs["k06-fig12"]),
    ]


def _save(drawing: Drawing, folder: Path) -> None:
    # Without date and library version, so that a second run writes identical files.
    drawing.figure.savefig(folder / f"{drawing.name}.png", dpi=DPI, metadata={"Software": None})
    drawing.figure.savefig(folder / f"{drawing.name}.svg", metadata={"Date": None, "Creator": None})
    for name, table in drawing.tables.items():
        write_csv(table, folder / f"{name}.csv")

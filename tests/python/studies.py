"""A plan of a small study, and a study that ends before its chunks are joined."""

from pathlib import Path

import pytest
from punctura.study import Plan, run_study
from punctura.study.folder import Folder
from punctura.study.report import write_report

GRID = """
scene = "k06-fig12"
method = "grid"
duration_s = 0.3
results = ["peak", "drop[0]"]
chunk = 2
seed = 5
[motion]
duration_s = 0.2
rest_s = 0.02
[values]
"plant.friction" = 0.1
[[variable]]
path = "membrane[0].friction"
values = [0.1, 0.2, 0.3]
[[variable]]
path = "hand.stiffness"
values = [400, 700]
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "plan.toml"
    path.write_text(text)
    return path


def with_report(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("punctura.study.run.write_report", write_report)


def in_chunks(plan: Plan, out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs a study as far as its chunks, as one that is killed before they are joined."""
    with monkeypatch.context() as stopped:
        stopped.setattr(Folder, "join", lambda *_: None)
        run_study(plan, out)

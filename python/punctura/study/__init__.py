# ruff: noqa: E402
"""Studies: many trials of a scene whose numbers follow a plan file (docs/study.md)."""

from punctura.extras import optional

optional("pyarrow", "study", "punctura.study")  # before the imports below would fail

from punctura.study.plan import Plan, load_plan
from punctura.study.run import StudyError, StudySummary, replay_row, run_study

__all__ = ["Plan", "StudyError", "StudySummary", "load_plan", "replay_row", "run_study"]

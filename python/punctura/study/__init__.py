"""Studies: many trials of a scene whose numbers follow a plan file (docs/study.md)."""

from punctura.study.plan import Plan, load_plan
from punctura.study.replay import replay_row
from punctura.study.run import StudyError, StudySummary, run_study

__all__ = ["Plan", "StudyError", "StudySummary", "load_plan", "replay_row", "run_study"]

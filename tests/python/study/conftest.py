"""Studies without their report."""

import pytest


@pytest.fixture(autouse=True)
def without_report():
    """A study draws no pictures, which take longer than the trials of GRID, unless a test calls with_report."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("punctura.study.run.write_report", lambda *_: ("", 0))
        yield

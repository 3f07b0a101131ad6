"""Lets every test write `from oracles import ...`, and makes hypothesis draw the same cases every time."""

import sys
from pathlib import Path

import pytest
from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))

from oracles import cases

settings.register_profile("punctura", deadline=None, derandomize=True, database=None, max_examples=cases.count(200))
settings.load_profile("punctura")

MADE_ONCE = {"made", "ticks", "walked"}  # fixtures that take seconds


@pytest.hookimpl(tryfirst=True)  # before xdist reads the groups
def pytest_collection_modifyitems(items):
    """Tests that share what takes long to make run in one worker."""
    for item in items:
        if MADE_ONCE & set(item.fixturenames):
            item.add_marker(
                pytest.mark.xdist_group(item.module.__name__ if "made" not in item.fixturenames else "made")
            )

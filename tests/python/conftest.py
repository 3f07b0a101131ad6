"""Lets every test write `from oracles import ...`, and makes hypothesis draw the same cases every time."""

import sys
from pathlib import Path

from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))
sys.path.append(str(Path(__file__).parents[2] / "tools"))  # waiting.py

from oracles import cases

settings.register_profile("punctura", deadline=None, derandomize=True, database=None, max_examples=cases.count(200))
settings.load_profile("punctura")

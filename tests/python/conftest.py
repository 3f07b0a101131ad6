"""Lets every test write `from oracles import ...`, and makes hypothesis draw the same cases every time."""

import os
import sys
from pathlib import Path

from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))

settings.register_profile(
    "punctura", deadline=None, derandomize=True, database=None, max_examples=int(os.environ.get("PUNCTURA_CASES", 200))
)
settings.load_profile("punctura")

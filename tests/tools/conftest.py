"""Makes the tools and the build back-end importable in every test of them."""

import sys
from pathlib import Path

TOOLS = Path(__file__).parents[2] / "tools"
sys.path += [str(TOOLS), str(TOOLS / "build_backend")]

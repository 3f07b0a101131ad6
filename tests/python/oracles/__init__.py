"""Independent implementations of the model, written only from the paper (K06) and its errata.

Nothing here calls or copies the code under test. Everything is vectorised over *lanes* (one lane is one law, or one
membrane of one scene), so that a million random cases are a matter of minutes, and works in whatever float type it
is given: run in `numpy.longdouble` beside `float64` it shows how far rounding alone can move a result.
"""

from pathlib import Path

siconos_relay_path = Path(__file__).parent / "siconos_relay.py"
"""Run by the system's Python, not imported."""

# ruff: noqa: E402
"""Force models of other authors, to fit and to feel beside K06 (docs/rivals.md)."""

from punctura.extras import optional

optional("pyarrow", "identify", "punctura.rivals")  # before the imports below would fail

from punctura._core import Rival, RivalInsertion, rival_experiment
from punctura.rivals.comparison import Row, TraceComparison, compare_trace
from punctura.rivals.fit import RivalFit, fit_rival
from punctura.rivals.kinds import RivalKind, RivalNumber, kinds
from punctura.rivals.layers import Layer, load_layers, resistance, save_layers

__all__ = [
    "Layer",
    "Rival",
    "RivalFit",
    "RivalInsertion",
    "RivalKind",
    "RivalNumber",
    "Row",
    "TraceComparison",
    "compare_trace",
    "fit_rival",
    "kinds",
    "load_layers",
    "resistance",
    "rival_experiment",
    "save_layers",
]

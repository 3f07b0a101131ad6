# ruff: noqa: E402
"""Psychophysics: protocols, sessions, simulated observers, thresholds with intervals (docs/perception.md)."""

from punctura.extras import optional

optional("scipy", "study", "punctura.perception")  # before the imports below would fail
optional("pyarrow", "study", "punctura.perception")

from punctura.perception.analysis import analyse
from punctura.perception.load import load_protocol, protocol_names
from punctura.perception.observer import Observer, Simulation
from punctura.perception.power import Coverage, PowerRow, coverage, power
from punctura.perception.protocol import Protocol
from punctura.perception.report import write_report
from punctura.perception.results import Analysis, Estimate, Person
from punctura.perception.session import DiskFullError, Session, SessionError, delete_participant, read_session, sessions

__all__ = [
    "Analysis", "Coverage", "DiskFullError", "Estimate", "Observer", "Person", "PowerRow", "Protocol", "Session",
    "SessionError", "Simulation", "analyse", "coverage", "delete_participant", "load_protocol", "power",
    "protocol_names", "read_session", "sessions", "write_report",
]  # fmt: skip

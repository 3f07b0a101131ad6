"""Punctura: the force on a needle during insertion into and withdrawal from tissue membranes."""

from punctura._core import (
    Coupling,
    DeviceError,
    DisplaySettings,
    Experiment,
    Fault,
    Hand,
    Insertion,
    Limit,
    Membrane,
    Needle,
    Phase,
    PlacedMembrane,
    Plant,
    Proxy1d,
    Proxy3d,
    PuncturaError,
    RecordedMotion,
    Scene,
    SceneField,
    ServoSettings,
    ServoState,
    Strokes,
    TableLaw,
    Target,
    ThickLaw,
    ThinLaw,
)
from punctura._core import (
    version as _version,
)
from punctura.errors import ConfigurationError, Problem
from punctura.paths import cmake_dir, include_dir
from punctura.scene import load_scene, save_scene, scene_json_schema, scene_names
from punctura.simulation import MotionError, SimulationSummary, simulate
from punctura.ticks import Ticks

__version__ = _version()

__all__ = [
    "ConfigurationError",
    "Coupling",
    "DeviceError",
    "DisplaySettings",
    "Experiment",
    "Fault",
    "Hand",
    "Insertion",
    "Limit",
    "Membrane",
    "MotionError",
    "Needle",
    "Phase",
    "PlacedMembrane",
    "Plant",
    "Problem",
    "Proxy1d",
    "Proxy3d",
    "PuncturaError",
    "RecordedMotion",
    "Scene",
    "SceneField",
    "ServoSettings",
    "ServoState",
    "SimulationSummary",
    "Strokes",
    "TableLaw",
    "Target",
    "ThickLaw",
    "ThinLaw",
    "Ticks",
    "__version__",
    "cmake_dir",
    "include_dir",
    "load_scene",
    "save_scene",
    "scene_json_schema",
    "scene_names",
    "simulate",
]

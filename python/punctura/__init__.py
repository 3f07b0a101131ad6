"""Punctura: the force on a needle during insertion into and withdrawal from tissue membranes.

A program that needs only the physics loads only the physics: the other modules, and the packages that they need, are
imported when one of their names is used.
"""

import importlib
from typing import TYPE_CHECKING, Any

from punctura._core import (
    Coupling,
    Insertion,
    MaxwellBranch,
    Membrane,
    Needle,
    Phase,
    PlacedMembrane,
    ProfileLaw,
    Proxy1d,
    Proxy3d,
    PuncturaError,
    Scene,
    ThickLaw,
    ThinLaw,
    Tissue,
    TissueLaw,
)
from punctura._core import (
    version as _version,
)
from punctura.errors import ConfigurationError
from punctura.extras import MissingPackageError

if TYPE_CHECKING:
    from punctura.batches import batch, grid
    from punctura.scene import load_scene, save_scene, scene_names
    from punctura.simulation import simulate
    from punctura.ticks import Ticks

__version__ = _version()

__all__ = [
    "ConfigurationError",
    "Coupling",
    "Insertion",
    "MaxwellBranch",
    "Membrane",
    "Needle",
    "Phase",
    "PlacedMembrane",
    "ProfileLaw",
    "Proxy1d",
    "Proxy3d",
    "PuncturaError",
    "Scene",
    "ThickLaw",
    "ThinLaw",
    "Ticks",
    "Tissue",
    "TissueLaw",
    "__version__",
    "batch",
    "grid",
    "load_scene",
    "save_scene",
    "scene_names",
    "simulate",
]

# The modules of the names that are imported at their first use.
_LATE = {
    "punctura.batches": ("batch", "grid"),
    "punctura.scene": ("load_scene", "save_scene", "scene_names"),
    "punctura.simulation": ("simulate",),
    "punctura.ticks": ("Ticks",),
}
_MODULE_OF = {name: module for module, names in _LATE.items() for name in names}
# The subjects that `import punctura` also provides: punctura.live, punctura.identify, ...
_SUBJECTS = frozenset(
    [
        "batches",
        "compare",
        "events",
        "exercise",
        "fmu",
        "gym",
        "identify",
        "live",
        "mujoco",
        "paths",
        "poses",
        "record",
        "reproduce",
        "rivals",
        "scene",
        "simulation",
        "studio",
        "study",
        "syringe",
        "trace",
    ]
)
# Where a name stands that one may look for at the top: for the message of an AttributeError.
_ELSEWHERE = {
    "errors": ("Problem",),
    "paths": ("cmake_dir", "include_dir"),
    "batches": ("BatchResult", "LineBatch"),
    "scene": ("DisplaySettings", "SceneField", "ServoSettings", "scene_json_schema"),
    "live": ("DeviceError", "Fault", "Limit", "LiveEstimate", "ServoState"),
    "simulation": (
        "Experiment",
        "Hand",
        "MotionError",
        "Plant",
        "RecordedMotion",
        "SimulationSummary",
        "Strokes",
        "Target",
    ),
    "syringe": ("Outlet", "Plunger", "Syringe", "SyringeSettings", "outlet_at", "tube_resistance"),
}


if not TYPE_CHECKING:  # a type checker must not take every name for one of these

    def __getattr__(name: str) -> Any:
        if name in _MODULE_OF:
            value = getattr(importlib.import_module(_MODULE_OF[name]), name)
            globals()[name] = value
            return value
        if name in _SUBJECTS:
            try:
                return importlib.import_module(f"punctura.{name}")
            except MissingPackageError as error:
                raise AttributeError(str(error)) from error
        there = "".join(f"; it is punctura.{subject}.{name}" for subject in _ELSEWHERE if name in _ELSEWHERE[subject])
        raise AttributeError(f"module 'punctura' has no attribute {name!r}{there}")

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__, *_SUBJECTS})

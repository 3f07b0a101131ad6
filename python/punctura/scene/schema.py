"""The schema of scene files: keys, units, titles and help, for the reader, the writer and the JSON Schema.

A number's key is the field's name in the core and its unit (files/units.py). The bounds are in the core, which checks
the values; the JSON Schema gets the bounds from there (scene/json_schema.py).
"""

from __future__ import annotations

from decimal import Decimal
from typing import Any, Literal

from pydantic import ConfigDict, Field

from punctura._core import Coupling, DisplaySettings, Membrane, PlacedMembrane, ServoSettings, Syringe, SyringeSettings
from punctura.files.fields import Name, Number, NumberOrAutomatic, Numbers, Vector, WholeNumber
from punctura.files.tables import Table
from punctura.files.units import UNITS, from_si

_SERVO, _DISPLAY = ServoSettings(), DisplaySettings()  # for the defaults

# The words of core/punctura/scene/look.hpp. A test compares them.
Look = Literal[
    "plain", "skin", "fat", "muscle", "fascia", "ligament", "ligamentum flavum", "dura", "vein wall", "artery wall"
]
Behind = Literal["tissue", "blood", "fat", "muscle", "epidural space", "cerebrospinal fluid"]

# No default of the core is written twice: what tissue takes, and the coupling of a thumb.
_DENSE = from_si(
    PlacedMembrane("", Membrane.unchecked(1, 0, 1, 0), (0, 0, 0), (0, -1, 0)).outflow.resistance, UNITS["kPa_s_per_mL"]
)
_THUMB: Coupling = SyringeSettings(Syringe.unchecked(1, 1, 0, 0, 1, 1)).thumb


def _field(title: str, help: str, symbol: str = "", default: Any = ..., folded: str = "") -> Any:
    """folded: the heading of the part of a form that holds the field and is closed at first."""
    extra: Any = {"x-symbol": symbol} if symbol else {}
    if folded:
        extra["x-folded"] = folded
    return Field(default, title=title, description=help, json_schema_extra=extra or None)


def _tissue(title: str, help: str, symbol: str = "", default: Any = Decimal(0)) -> Any:
    return _field(title, help, symbol, default, "Measured tissue")


class NeedleTable(Table):
    """The needle: a wedge of one slanted face, then a shaft (K06 Fig. 1)."""

    model_config = ConfigDict(title="Needle")

    diameter_mm: Number | None = _field("Diameter", "Outer diameter of the shaft.", "w", None)
    gauge: WholeNumber | None = _field(
        "Gauge", "The outer diameter as a gauge of ISO 9626, instead of diameter_mm.", "w", None
    )
    tip_angle_rad: Number | None = _field("Tip angle", "Angle between the slanted face and the axis.", "theta", None)
    tip_angle_deg: Number | None = _field("Tip angle", "The tip angle in degrees, instead of radians.", "theta", None)
    direction: Literal["stylus", "motion"] = _field(
        "Direction",
        "Source of the needle's direction at entry: the device's stylus, or the motion of the tip for devices without "
        "orientation.",
        "b",
        "stylus",
    )


class CouplingTable(Table):
    """The virtual spring and damper between device and proxy, one pair per membrane (K06 (21))."""

    model_config = ConfigDict(title="Coupling")

    stiffness_N_per_mm: Number = _field("Stiffness", "Spring of the virtual coupling.", "K")
    damping_Ns_per_mm: Number = _field("Damping", "Damper of the virtual coupling.", "B")
    relaxation_stiffness_N_per_mm: Numbers = _field(
        "Relaxation, stiffness",
        "Springs of the branches whose force decays while the needle rests, at most two. Empty is K06's coupling.",
        "K_m",
        (),
    )
    relaxation_time_constant_s: Numbers = _field("Relaxation, time", "Time constant of each branch.", "tau", ())


class ServoTable(Table):
    """The rate and the method of the force computation."""

    model_config = ConfigDict(title="Servo")

    rate_hz: Number = _field("Rate", "Ticks per second.", "1/T", Decimal(repr(_SERVO.rate)))
    low_pass_hz: Number = _field(
        "Low-pass", "Cut-off of the conditioning low_pass; 0 is off.", "", Decimal(repr(_SERVO.low_pass))
    )
    solver: Literal["exact", "paper"] = _field(
        "Solver", "exact solves K06 (21)-(23); paper takes one step towards it, K06 (33).", "", _SERVO.solver
    )
    conditioning: Literal["low_pass", "line_fit"] = _field(
        "Conditioning",
        "Filter of the positions: low_pass is K06's first-order filter; line_fit is for real devices, whose encoder "
        "steps would shake the force.",
        "",
        _SERVO.conditioning,
    )
    encoder_step_mm: Number = _field(
        "Encoder step",
        "Jump of the tip's measured position per encoder count, for line_fit; 0 is an ideal sensor.",
        "",
        from_si(_SERVO.encoder_step, UNITS["mm"]),
    )
    sub_steps: Number = _field(
        "Sub-steps",
        "Steps of the model in each tick. More steps find the time of a pop better and cost more.",
        "",
        Decimal(repr(_SERVO.sub_steps)),
    )


class DisplayTable(Table):
    """How a device shows forces that it cannot give."""

    model_config = ConfigDict(title="Display")

    force_scale: NumberOrAutomatic = _field(
        "Force scale",
        "How much of the model's force the device gives. automatic: as much as it can give for any time, and at most "
        "all.",
        "",
        Decimal(repr(_DISPLAY.force_scale)),
    )


class SyringeTable(Table):
    """The syringe on the needle. It has no effect on the force on the needle."""

    model_config = ConfigDict(title="Syringe")

    bore_mm: Number = _field("Bore", "Inner diameter of the barrel.", "d")
    liquid_mL: Number = _field("Liquid", "Volume of liquid at the start.", "V_w")
    air_mL: Number = _field("Air", "Volume of air at the start, at the pressure of the atmosphere.", "V_a", Decimal(0))
    friction_N: Number = _field("Friction", "Dry friction of the plunger.", "F")
    compliance_mL_per_kPa: Number = _field("Compliance", "By how much pressure widens barrel and seal.", "C")
    resistance_kPa_s_per_mL: Number = _field("Resistance", "Flow resistance of the cannula for the liquid.", "R_c")
    thumb_stiffness_N_per_mm: Number = _field(
        "Thumb stiffness",
        "Spring of the virtual coupling between thumb and plunger.",
        "K",
        from_si(_THUMB.stiffness, UNITS["N_per_mm"]),
    )
    thumb_damping_Ns_per_mm: Number = _field(
        "Thumb damping", "Damper of this coupling.", "B", from_si(_THUMB.damping, UNITS["Ns_per_mm"])
    )


class MembraneTable(Table):
    """A membrane: a layer that grips the needle with dry friction (K06 section 2)."""

    model_config = ConfigDict(title="Membrane")

    name: Name = _field("Name", "Name of the membrane in plots and tables.")
    stiffness_N_per_mm: Number = _field("Stiffness", "Resistance of the hole to widening.", "kappa")
    precompression_N: Number = _field("Precompression", "Grip of the hole when it is closed.", "c")
    friction: Number = _field("Friction", "Coefficient of dry friction between needle and membrane.", "mu")
    thickness_mm: Number = _field("Thickness", "0 is an infinitely thin membrane.", "H")
    point_mm: Vector = _field("Point", "Any point of the surface that the needle enters.", "a")
    inward_normal: Vector = _field("Inward normal", "Direction into the membrane, of any length but 0.", "n")
    look: Look = _field(
        "Look", "Kind of tissue in the picture; plain is a sheet of glass. It has no effect on the force.", "", "plain"
    )
    behind: Behind = _field(
        "Behind",
        "Content of the space between this membrane and the next. It does not grip the needle. Blood shows in the "
        "needle's hub while the tip is in it.",
        "",
        "tissue",
    )
    outflow_resistance_kPa_s_per_mL: Number = _field(
        "Outflow resistance", "Flow resistance for liquid from the needle, in the membrane.", "R_t", _DENSE
    )
    outflow_pressure_kPa: Number = _field("Outflow pressure", "Pressure in the membrane.", "P_t", Decimal(0))
    behind_resistance_kPa_s_per_mL: Number = _field(
        "Resistance behind", "Flow resistance for liquid from the needle, in the space behind.", "R_t", _DENSE
    )
    behind_pressure_kPa: Number = _field("Pressure behind", "Pressure in the space behind.", "P_t", Decimal(0))
    grip: Literal["linear", "exponential", "table"] = _tissue(
        "Grip",
        "How the wall's grip on the needle grows with the opening of the hole: linear is K06, exponential grows "
        "faster, table is measured.",
        "",
        "linear",
    )
    growth_per_mm: Number = _tissue("Growth", "Of an exponential grip; 0 is linear.", "b")
    grip_opening_mm: Numbers = _tissue("Grip table, openings", "Openings of the hole, ascending.", "y", ())
    grip_force_N: Numbers = _tissue("Grip table, forces", "The grip at each opening.", "G", ())
    tip_length_mm: Number = _tissue(
        "Tip length", "Length of the tip along the needle; 0 is diameter / tan(tip angle).", "X"
    )
    tail_length_mm: Number = _tissue("Tail length", "The shaft's friction falls on this length behind the tip.")
    tail_floor: Number = _tissue(
        "Tail floor", "The part of the shaft's friction that is left behind the tail; 1 is no tail.", "", Decimal(1)
    )
    cutting_N: Number = _tissue(
        "Cutting", "Force on the tip while it cuts the wall for the first time; none on a later pass.", "C"
    )
    set: Number = _tissue("Set", "The part of the grip that a hole has lost once the needle has left it.")
    profile_depth_mm: Numbers = _tissue(
        "Profile, depths",
        "A measured profile of an infinitely thin wall, in place of grip and tail: depths of its knots.",
        "q",
        (),
    )
    profile_lower_N: Numbers = _tissue(
        "Profile, lower", "The force on the way in at each knot, 0 or less.", "phi_I", ()
    )
    profile_upper_N: Numbers = _tissue("Profile, upper", "The force on the way out at each knot.", "phi_O", ())


class SceneFile(Table):
    """A scene: a needle, the coupling that drives it, and the membranes."""

    model_config = ConfigDict(title="Scene file")

    name: Name = _field("Name", "Name of the scene.")
    needle: NeedleTable
    coupling: CouplingTable
    servo: ServoTable = Field(default_factory=ServoTable)
    display: DisplayTable = Field(default_factory=DisplayTable)
    syringe: SyringeTable | None = Field(None, title="Syringe")
    membrane: list[MembraneTable] = _field("Membranes", "In the order in which their forces are added.")


# Lists of a table that have the same length: each place of them is one row of a list in the core. By table: the core's
# list, and the core's name of each key.
ROWS = {
    "coupling": {
        "relaxation": {"relaxation_stiffness_N_per_mm": "stiffness", "relaxation_time_constant_s": "time_constant"},
    },
    "membrane": {
        "grip_table": {"grip_opening_mm": "opening", "grip_force_N": "grip"},
        "profile": {"profile_depth_mm": "depth", "profile_lower_N": "lower", "profile_upper_N": "upper"},
    },
}

# The file gives exactly one key of each pair.
ALTERNATIVES = (("diameter_mm", "gauge"), ("tip_angle_rad", "tip_angle_deg"))

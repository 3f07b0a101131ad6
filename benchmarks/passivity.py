"""Measures how much viscous damping a simulated device needs, and compares it with the bound: docs/passivity.md.

    python benchmarks/passivity.py [SCENE ...] [--json FILE]        two minutes of a processor

A device without dry friction and with an ideal sensor is pushed through all membranes of a scene, then rests in a grip
that is a spring and a mass. `found` is the largest viscous damping, as a share of the bound, with which the tip goes on
at more than 3 mm/s in any of many grips. `45 g` is the greatest speed of a device of that mass with half of the bound,
mm/s rms. The last columns have the Omni's encoder and the dry friction n K step: this friction, N, and that speed.
"""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import punctura as pn
from punctura._core import ForceLimits, force_scale, largest_force, needed_damping
from punctura.live import stroke_ends
from punctura.simulation import Experiment, Hand, Plant, RecordedMotion

SCENES = ("k06-fig10", "k06-fig12", "venipuncture", "epidural")
STEP = Plant().encoder_step
FILTERS = {
    "none": {"conditioning": "low_pass", "low_pass": 0.0},
    "low_pass": {"conditioning": "low_pass"},
    "line_fit": {"conditioning": "line_fit", "encoder_step": STEP},
}
SLOW = 3e-3  # m/s, rms: more than the play of a line fit alone causes
HEAVIEST = 0.5  # kg, device and hand


class Grip(NamedTuple):
    """mass: of device and hand, kg. stiffness: of the hand, N/m."""

    mass: float
    stiffness: float


class Case:
    """A scene behind one of FILTERS."""

    def __init__(self, name: str, filter_name: str) -> None:
        scene = pn.load_scene(name)
        self.scene = scene.replace(servo=scene.servo.replace(**FILTERS[filter_name]))
        self.scale = force_scale(self.scene, ForceLimits())
        self.bound = self.scale * needed_damping(self.scene)
        self.stiffness = self.scale * len(scene.membranes) * scene.coupling.stiffness  # N/m, felt, of all membranes

    def grips(self) -> Iterator[Grip]:
        """Grips that oscillate at 8 to 790 Hz on the coupling, and a tip that has hardly any mass."""
        for stiffness in (100.0, 500.0, 2000.0):
            yield Grip(1e-6, stiffness)
            for frequency in np.geomspace(8, 790, 24):
                mass = (self.stiffness + stiffness) / (2 * np.pi * float(frequency)) ** 2
                if mass <= HEAVIEST:
                    yield Grip(mass, stiffness)

    def speeds(self, damping: float, grip: Grip, friction: float = 0.0, step: float = 0.0) -> tuple[float, float]:
        """The tip's, m/s rms, in the last two halves of a second. damping (N s/m), friction (N): of the device."""
        scene, inwards = self.scene, np.array(self.scene.membranes[0].inward_normal)
        start, end = (np.array(p) for p in stroke_ends(scene))
        weaker = 1 / grip.stiffness - 1 / Hand().stiffness  # than the hand of stroke_ends, m/N
        end += (weaker * self.scale * largest_force(scene) + friction / grip.stiffness) * inwards
        hand = Hand(mass=0.0, damping=damping, stiffness=grip.stiffness, tremor_rms=0.0)
        motion = RecordedMotion([0, 0.3, 1.5, 3.5], [start, start, end, end])
        plant = Plant(mass=grip.mass, friction=friction, encoder_step=step, max_force=1e3)
        ticks = Experiment(scene, motion, plant, hand, axis=inwards).run(3.5)
        if not (ticks.depth[-1] > 0).all():
            raise SystemExit(f"{scene.name}: {grip} did not push the needle through all membranes")
        moved = np.linalg.norm(np.diff(ticks.true_position, axis=0), axis=1) * scene.servo.rate
        before, after = (float(np.sqrt((part**2).mean())) for part in np.split(moved[-(len(moved) // 7) * 2 :], 2))
        return before, after

    def goes_on(self, damping: float, grip: Grip) -> bool:
        before, after = self.speeds(damping, grip)
        return after > SLOW and after > 0.98 * before

    def found(self) -> tuple[float, Grip]:
        """The largest damping with which the tip goes on in any grip, as a share of the bound to 0.01; and the grip."""
        worst, share = Grip(0, 0), 0.5
        for grip in self.grips():
            while share < 1.5 and self.goes_on((share + 0.01) * self.bound, grip):
                worst, share = grip, share + 0.01
        return share, worst

    def fastest(self, share: float, friction: float = 0.0, step: float = 0.0) -> float:
        """The greatest speed of a device as heavy as an Omni in any grip, m/s, with this share of the bound."""
        heavy = [grip for grip in self.grips() if grip.mass >= Plant().mass]
        return max(self.speeds(share * self.bound, grip, friction, step)[1] for grip in heavy)


def row(name: str, filter_name: str) -> dict[str, str | float]:
    case = Case(name, filter_name)
    dry = case.stiffness * STEP
    share, grip = case.found()
    return {
        "scene": name,
        "membranes": len(case.scene.membranes),
        "filter": filter_name,
        "bound_Ns_per_m": case.bound,
        "found_share": share,
        "found_mass_kg": grip.mass,
        "found_grip_N_per_m": grip.stiffness,
        "heavy_mm_per_s": 1e3 * case.fastest(0.5),
        "dry_friction_N": dry,
        "heavy_with_dry_friction_mm_per_s": 1e3 * case.fastest(0.5, dry, STEP),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    parser.add_argument("--json", type=Path, metavar="FILE")
    arguments = parser.parse_args()
    rows = []
    print("| scene | n | filter | bound | found | 45 g | dry friction | 45 g with it |\n" + "|---" * 8 + "|")
    for name in arguments.scenes:
        for filter_name in FILTERS:
            rows.append(r := row(name, filter_name))
            print(
                f"| {name} | {r['membranes']} | {filter_name} | {r['bound_Ns_per_m']:.3g} | {r['found_share']:.2f} | "
                f"{r['heavy_mm_per_s']:.3g} | {r['dry_friction_N']:.2g} | "
                f"{r['heavy_with_dry_friction_mm_per_s']:.2g} |",
                flush=True,
            )
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=2) + "\n")


if __name__ == "__main__":
    main()

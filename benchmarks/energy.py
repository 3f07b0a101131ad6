"""Compares the energy from a device that holds the force during the tick with that of the model: docs/passivity.md.

    python benchmarks/energy.py [--json FILE]

Each row is a simulated operator at a simulated device, who moves in and out of K06's membranes and returns to the
start. `model` sums the work f(k).(x(k) - x(k-1)), which the discrete-time model keeps at or below zero. `held` sums the
work on the hand, f(k).(x(k+1) - x(k)). The difference is the cost of holding. Negative work is dissipated.
"""

import argparse
import json
from pathlib import Path

import numpy as np
import punctura as pn
from punctura.simulation import Experiment, Hand, Plant, Strokes

STROKES = Strokes([0, 5e-3, 0], [0, -10e-3, 0], count=4, variation=0.0)
DEVICES = {
    "Omni": Plant(),
    "Omni, ideal sensor": Plant(encoder_step=0.0),
    "no friction, ideal sensor": Plant(friction=0.0, encoder_step=0.0),
}


def work(trace: pn.Ticks) -> tuple[float, float, float]:
    """(model, held, path length) in J, J, m, over the whole trace, which ends at its start position."""
    x, f = trace.true_position, trace.force
    moved = np.diff(x, axis=0)
    model = float(np.einsum("ij,ij->", f[1:], moved))
    held = float(np.einsum("ij,ij->", f[:-1], moved))
    return model, held, float(np.linalg.norm(moved, axis=1).sum())


def rows() -> list[dict[str, object]]:
    out: list[dict[str, object]] = []
    for scene_name in ("k06-fig10", "k06-fig11", "k06-fig12"):
        for solver in ("exact", "paper"):
            for device_name, plant in DEVICES.items():
                scene = pn.load_scene(scene_name)
                scene = scene.replace(servo=scene.servo.replace(solver=solver))
                experiment = Experiment(scene, STROKES, plant, Hand(tremor_rms=0.0))
                model, held, path = work(experiment.run(experiment.duration + 1))
                out.append(
                    {
                        "scene": scene_name,
                        "solver": solver,
                        "device": device_name,
                        "model_mJ": model * 1e3,
                        "held_mJ": held * 1e3,
                        "surplus_mJ": (held - model) * 1e3,
                        "friction_of_device_mJ": plant.friction * path * 1e3,
                    }
                )
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=Path, metavar="FILE")
    arguments = parser.parse_args()
    table = rows()
    heads = f"{'model mJ':>9} {'held mJ':>9} {'surplus mJ':>11} {'device friction mJ':>19}"
    print(f"{'scene':10} {'solver':6} {'device':26} {heads}")
    for r in table:
        print(
            f"{r['scene']:10} {r['solver']:6} {r['device']:26} {r['model_mJ']:9.3f} {r['held_mJ']:9.3f} "
            f"{r['surplus_mJ']:11.4f} {r['friction_of_device_mJ']:19.2f}"
        )
    if arguments.json:
        arguments.json.write_text(json.dumps(table, indent=2) + "\n")


if __name__ == "__main__":
    main()

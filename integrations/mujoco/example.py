"""A robot pushes a needle into a vein, feels the two pops, stops, and draws back.

    python integrations/mujoco/example.py

The robot knows the place of the skin and its own force sensor. It does not know where the vein is.
"""

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import punctura
import punctura.mujoco

HERE = Path(__file__).parent
ANGLE = np.radians(30)  # of the needle to the skin
ALONG = np.array([np.cos(ANGLE), 0, -np.sin(ANGLE)])  # the direction of the needle, in the world
UPPER, FOREARM, HAND = 0.3, 0.25, 0.11  # m, of robot.xml
SHOULDER = np.array([-0.5, 0, 0.25])
START, DEEPEST, SPEED = -0.012, 0.025, 0.012  # m along the needle from the skin, m/s
DROP = 0.08  # N: a fall of the force by this much, after a rise by this much, is a pop


def joints(tip: np.ndarray) -> np.ndarray:
    """The joint angles that bring the tip there, with the needle along ALONG, rad."""
    x, _, z = tip - HAND * ALONG - SHOULDER
    reach = np.hypot(x, z)
    elbow = np.arccos((reach**2 - UPPER**2 - FOREARM**2) / (2 * UPPER * FOREARM))
    shoulder = -np.arctan2(z, x) - np.arctan2(FOREARM * np.sin(elbow), UPPER + FOREARM * np.cos(elbow))
    return np.array([shoulder, elbow, ANGLE - shoulder - elbow])


class Robot:
    """Advances until the second pop, waits for a second, and draws back."""

    def __init__(self) -> None:
        self.way, self.pops, self.waited, self.felt = START, 0, 0.0, 0.0
        self.rising, self.turn = False, 0.0  # whether the force rises, and its last extreme, N

    def command(self, felt: float, period: float) -> np.ndarray:
        """The wanted joint angles. felt: the force sensor along the needle, N, positive if it holds the needle back."""
        self.felt += 0.1 * (felt - self.felt)  # the sensor also feels the robot's own small vibrations
        self.turn = max(self.turn, self.felt) if self.rising else min(self.turn, self.felt)
        if abs(self.felt - self.turn) > DROP:
            self.pops += self.rising  # it rose, and fell
            self.rising, self.turn = not self.rising, self.felt
        if self.waited == 0 and self.pops < 2 and self.way < DEEPEST:
            self.way += SPEED * period
        elif self.waited < 1:
            self.waited += period
        else:
            self.way -= SPEED * period
        return joints(self.way * ALONG)


def insertion(model: Any, data: Any) -> list[tuple[float, ...]]:
    """Runs the robot until the needle is out again. Rows: time s, way m, felt N, pops, depth in the vein m."""
    attached = punctura.mujoco.attach(model, punctura.load_scene("venipuncture"), needle="tip", tissue="phantom")
    robot, rows = Robot(), []
    data.qpos[:3] = data.ctrl[:3] = joints(START * ALONG)
    while robot.way >= START:
        data.ctrl[:] = robot.command(data.sensor("felt").data[2], model.opt.timestep)
        attached.step(data)
        rows.append((data.time, robot.way, robot.felt, robot.pops, attached.depths(data)[0][1]))
    return rows


def main() -> None:
    """Prints what the robot felt."""
    model = mujoco.MjModel.from_xml_path(str(HERE / "robot.xml"))
    rows = np.array(insertion(model, mujoco.MjData(model)))
    for pop in (1, 2):
        time, way, _, _, depth = rows[np.argmax(rows[:, 3] >= pop)]
        print(
            f"pop {pop} felt at {time:.2f} s, {way * 1e3:.1f} mm along the needle; "
            f"depth behind the front of the vein's wall: {depth * 1e3:.1f} mm"
        )
    print(f"highest force {rows[:, 2].max():.2f} N; deepest {rows[:, 1].max() * 1e3:.1f} mm along the needle")


if __name__ == "__main__":
    main()

"""An OpenIGTLink server: transforms of a needle in, its force out. For 3D Slicer, PLUS and trackers.

    python integrations/openigtlink/server.py SCENE [--port 18944] [--hold-last-pose]

Receives TRANSFORM messages, in mm:
    NeedleToReference   the needle: its tip is at the origin, and it points along --tool-axis
    SceneToReference    the place of the scene; without it the scene's frame is the reference frame
Answers each NeedleToReference with:
    NeedleForce         STRING: fx fy fz, the force on the needle in the reference frame, N
    ForceToReference    TRANSFORM: an arrow of 1 mm along z that is put at the tip, as many times --mm-per-N long as the
                        force has newtons
"""

import argparse
import time
from collections.abc import Callable

import numpy as np
import pyigtl
from punctura import load_scene
from punctura.poses import PosedNeedle

NEEDLE, SCENE, FORCE, ARROW = "NeedleToReference", "SceneToReference", "NeedleForce", "ForceToReference"
_WAIT_S = 0.1  # for a transform. A held pose is this much behind, because a transform on its way may have changed it


class NeedleServer:
    """What the server answers, without the network."""

    def __init__(self, scene: str, tool_axis: list[float], mm_per_newton: float, hold_last_pose: bool = False) -> None:
        self.needle = PosedNeedle(load_scene(scene), hold_last_pose=hold_last_pose, notice=say)
        self.axis = np.asarray(tool_axis, float)
        self.mm_per_newton = mm_per_newton
        self.place = np.eye(4)  # of the scene in the reference frame, m
        self._last: tuple[float, float, np.ndarray] | None = None  # time and clock of the last pose, its tip in mm

    def place_scene(self, matrix: np.ndarray) -> None:
        """matrix (4, 4): SceneToReference, mm. Raises ValueError if it is no rotation with a translation."""
        turn = matrix[:3, :3]
        if not np.allclose(turn @ turn.T, np.eye(3), atol=1e-4) or np.linalg.det(turn) < 0:
            raise ValueError(f"{SCENE} must be a rotation and a translation, without scale or mirror")
        self.place = np.eye(4)
        self.place[:3, :3] = turn
        self.place[:3, 3] = matrix[:3, 3] * 1e-3

    def answer(self, time_s: float, matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The force on the needle in the reference frame, N (3,), and the transform of the arrow, mm (4, 4)."""
        turn = self.place[:3, :3]
        tip = turn.T @ (matrix[:3, 3] * 1e-3 - self.place[:3, 3])
        force = turn @ self.needle.move(time_s, tip, turn.T @ (matrix[:3, :3] @ self.axis))
        self._last = time_s, time.monotonic(), matrix[:3, 3]
        return force, self._arrow(matrix[:3, 3], force)

    def held(self) -> tuple[float, np.ndarray, np.ndarray] | None:
        """The time now, s, and what `answer` gives, at the last pose; None without --hold-last-pose, or without one."""
        if not self.needle.hold_last_pose or self._last is None:
            return None
        stamp, clock, tip = self._last
        now = stamp + time.monotonic() - clock - _WAIT_S
        try:
            force = self.place[:3, :3] @ self.needle.hold(now)
        except ValueError as error:  # this computer slept for more than an hour
            self._last = None
            say(f"the last pose is held no longer: {error}")
            return None
        return now, force, self._arrow(tip, force)

    def _arrow(self, tip: np.ndarray, force: np.ndarray) -> np.ndarray:
        length = max(float(np.linalg.norm(force)), 1e-9)
        z = force / length if length > 1e-9 else np.array([0.0, 0.0, 1.0])
        side = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
        x = side / np.linalg.norm(side)
        arrow = np.eye(4)
        arrow[:3, :3] = np.column_stack([x, np.cross(z, x), z * length * self.mm_per_newton])
        arrow[:3, 3] = tip
        return arrow


def say(text: str) -> None:
    """Also into a pipe at once."""
    print(text, flush=True)


def seconds(message: pyigtl.MessageBase) -> float:
    """The time of a message; the time of its arrival if the sender gave none."""
    return float(message.timestamp) if message.timestamp else time.time()


def serve(server: pyigtl.OpenIGTLinkServer, needle: NeedleServer, running: Callable[[], bool]) -> None:
    """Answers until running() is False. Of several transforms that wait, the newest counts; ticks between are made."""
    while running():
        message = server.wait_for_message(NEEDLE, timeout=_WAIT_S)
        for other in server.get_latest_messages():
            if other.device_name == SCENE:
                try:
                    needle.place_scene(other.matrix)
                except ValueError as error:
                    say(f"this transform is not used: {error}")
            elif other.device_name == NEEDLE:
                message = other
        if message is None:
            if server.is_connected() and (held := needle.held()) is not None:
                send(server, *held)
            continue
        try:
            force, arrow = needle.answer(seconds(message), message.matrix)
        except ValueError as error:
            say(f"this transform is not used: {error}")
            continue
        send(server, message.timestamp, force, arrow)


def send(server: pyigtl.OpenIGTLinkServer, stamp: float, force: np.ndarray, arrow: np.ndarray) -> None:
    text = " ".join(repr(float(f)) for f in force)
    server.send_message(pyigtl.StringMessage(text, timestamp=stamp, device_name=FORCE), wait=False)
    server.send_message(pyigtl.TransformMessage(arrow, timestamp=stamp, device_name=ARROW), wait=False)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", help="a scene file, or the name of a ready scene")
    parser.add_argument("--port", type=int, default=18944)
    parser.add_argument("--tool-axis", type=float, nargs=3, default=[0.0, 0.0, 1.0], metavar=("X", "Y", "Z"))
    parser.add_argument("--mm-per-N", type=float, default=20.0, help="length of the arrow")
    parser.add_argument("--hold-last-pose", action="store_true", help="for senders that send only what changes")
    given = parser.parse_args()
    needle = NeedleServer(given.scene, given.tool_axis, given.mm_per_N, given.hold_last_pose)
    server = pyigtl.OpenIGTLinkServer(port=given.port, local_server=True)
    say(f"OpenIGTLink at 127.0.0.1:{given.port}: {NEEDLE} in, {FORCE} and {ARROW} out. Ctrl-C ends it")
    try:
        serve(server, needle, lambda: True)
    except KeyboardInterrupt:
        server.stop()


if __name__ == "__main__":
    main()

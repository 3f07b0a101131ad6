"""The server's forces are those of the core, also through the network of this machine.

python integrations/openigtlink/check.py REFERENCE
"""

import socket
import sys
import threading
from pathlib import Path

import numpy as np
import punctura as pn
import pyigtl
from server import ARROW, FORCE, NEEDLE, SCENE, NeedleServer, serve


def transform(position: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """NeedleToReference, mm: z is the needle's axis."""
    x = np.cross(axis, [0, 0, 1])
    x = x / np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([x, np.cross(axis, x), axis])
    matrix[:3, 3] = position * 1e3
    return matrix


def check_answers(scene: Path, rows: np.ndarray, rate: float) -> None:
    """A transform a tick, without the network: bit for bit."""
    server = NeedleServer(str(scene), [0.0, 0.0, 1.0], 20)
    axes = rows[:, 3:6] / np.linalg.norm(rows[:, 3:6], axis=1, keepdims=True)
    matrices = [transform(p, a) for p, a in zip(rows[:, :3], axes, strict=True)]
    forces = np.array([server.answer(k / rate, matrix)[0] for k, matrix in enumerate(matrices)])
    tips = np.array([matrix[:3, 3] * 1e-3 for matrix in matrices])
    turned = np.array([matrix[:3, :3] @ [0.0, 0.0, 1.0] for matrix in matrices])
    assert np.array_equal(forces, pn.Insertion(pn.load_scene(scene)).run(tips, turned).force)
    print(f"openigtlink: {len(forces)} forces equal the core's bit for bit")

    # The same motion with the scene at another place.
    place = transform(np.array([0.01, 0.02, -0.03]), np.array([0.6, 0.0, 0.8]))
    moved = NeedleServer(str(scene), [0.0, 0.0, 1.0], 20)
    moved.place_scene(place)
    far = np.array([moved.answer(k / rate, place @ matrix)[0] for k, matrix in enumerate(matrices)])
    assert np.allclose(far @ place[:3, :3], forces, atol=1e-6)


def check_pause(scene: Path, rows: np.ndarray, rate: float) -> None:
    """A sender that sends only what changes: without --hold-last-pose the needle starts anew, with it it goes on."""
    deep = int(np.linalg.norm(rows[:, 6:], axis=1).argmax()) + 1
    forces = {}
    for hold in (False, True):
        needle = NeedleServer(str(scene), [0.0, 0.0, 1.0], 20, hold)
        for k in range(deep):
            before, _ = needle.answer(1000 + k / rate, transform(rows[k, :3], rows[k, 3:6]))
        assert (needle.held() is not None) == hold
        forces[hold], _ = needle.answer(1000.4 + deep / rate, transform(rows[deep - 1, :3], rows[deep - 1, 3:6]))
        assert needle.needle.starts == (1 if hold else 2)
    assert not forces[False].any() and np.allclose(forces[True], before, atol=0.05), (forces, before)
    print("openigtlink: a pause of 0.4 s ends the insertion, with a message, and --hold-last-pose keeps it")


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def check_network(scene: Path, rows: np.ndarray, rate: float) -> None:
    """A client sends a transform each 10 ms of its time and waits for the answer. The protocol has floats."""
    port, running = free_port(), threading.Event()
    running.set()
    server = pyigtl.OpenIGTLinkServer(port=port, local_server=True)
    needle = NeedleServer(str(scene), [0.0, 0.0, 1.0], 20)
    thread = threading.Thread(target=serve, args=(server, needle, running.is_set))
    thread.start()
    client = pyigtl.OpenIGTLinkClient(host="127.0.0.1", port=port)
    offline = NeedleServer(str(scene), [0.0, 0.0, 1.0], 20)
    # A place with a scale is not used, and does not end the server.
    client.send_message(pyigtl.TransformMessage(np.diag([2.0, 2, 2, 1]), device_name=SCENE), wait=True)
    strongest = 0.0
    try:
        for k in range(0, 1200, 16):
            matrix = transform(rows[k, :3], rows[k, 3:6]).astype(np.float32).astype(float)
            time = 1000 + k / rate
            client.send_message(pyigtl.TransformMessage(matrix, timestamp=time, device_name=NEEDLE), wait=True)
            answer = client.wait_for_message(FORCE, timeout=60)
            assert answer is not None, "no answer within 60 s"
            force = np.array([float(f) for f in answer.string.split()])
            expected, _ = offline.answer(time, matrix)
            assert np.allclose(force, expected, atol=1e-6), (k, force, expected)
            strongest = max(strongest, float(np.linalg.norm(force)))
        arrow = client.wait_for_message(ARROW, timeout=60)
        assert arrow is not None and np.isfinite(arrow.matrix).all() and strongest > 0.5
    finally:
        running.clear()
        thread.join()
        client.stop()
        server.stop()
    print(f"openigtlink: through the network the strongest force is {strongest:.3f} N, as without it")


if __name__ == "__main__":
    scene = Path(sys.argv[1]) / "scene.toml"
    rows = np.fromfile(Path(sys.argv[1]) / "motion.f64", "<f8").reshape(-1, 9)
    rate = pn.load_scene(scene).servo.rate
    check_answers(scene, rows, rate)
    check_pause(scene, rows, rate)
    check_network(scene, rows, rate)

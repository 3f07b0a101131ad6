"""Batches of proxies on a line."""

import os
import signal
import threading
from typing import Literal

import numpy as np
import pytest
from numpy.lib.stride_tricks import as_strided
from numpy.typing import NDArray
from punctura import Coupling, Membrane, Needle, ProfileLaw, Proxy1d, ThickLaw, ThinLaw
from punctura._core import simd_instructions
from punctura.batches import LineBatch

PERIOD = 1 / 1600
NEEDLE = Needle(diameter=1.08e-3, tip_angle=0.28)
LAWS: list[ThinLaw | ThickLaw | ProfileLaw] = [
    ThickLaw(NEEDLE, Membrane(stiffness=570, precompression=0.41, friction=0.2, thickness=1e-3)),
    ThinLaw(NEEDLE, Membrane(stiffness=300, precompression=0.1, friction=0.3, thickness=0)),
    ProfileLaw([0, 1e-3, 2e-3], [-0.1, -1, -0.3], [0, 0.2, 0.3]),
]
COUPLINGS = [Coupling(stiffness=k, damping=b) for k, b in ((400, 1), (700, 0.2), (90, 0))]


Array = NDArray[np.float64]
Solver = Literal["paper", "exact"]


def motions(ticks: int = 800) -> Array:
    time = np.arange(ticks) * PERIOD
    return -1e-3 + np.outer(np.sin(2 * np.pi * time) ** 2, [4e-3, 6e-3, 9e-3])


def alone(p: Array, solver: Solver = "exact") -> Array:
    each = zip(LAWS, COUPLINGS, p.T, strict=True)
    return np.array([Proxy1d(law, one, PERIOD, solver).run(depth).force for law, one, depth in each]).T


@pytest.mark.parametrize("solver", ["paper", "exact"])
def test_each_trial_has_the_bits_of_a_proxy(solver: Solver) -> None:
    p = motions()
    batch = LineBatch(LAWS, COUPLINGS, PERIOD, solver)
    assert (batch.trials, batch.period, batch.solver) == (3, PERIOD, solver)
    for instructions in [None, *simd_instructions()]:
        batch.reset()
        first = batch.run(p[:300], threads=1, instructions=instructions)
        rest = batch.run(p[300:], threads=2, block=1, instructions=instructions)
        assert np.concatenate([first, rest]).tobytes() == alone(p, solver).tobytes()


def test_memory_layouts_without_a_copy() -> None:
    p = motions()
    rows = np.ascontiguousarray(p.T)  # (trials, ticks)
    batch = LineBatch(LAWS, COUPLINGS, PERIOD)
    force = batch.run(rows.T)
    assert force.flags.f_contiguous
    assert np.array_equal(force, alone(p))
    wide = np.full((len(p), 6), np.nan)
    batch.reset()
    assert batch.run(p, out=wide[:, ::2]) is not None
    assert np.array_equal(wide[:, ::2], force)
    assert np.isnan(wide[:, 1::2]).all()


def test_one_motion_and_one_law_for_all() -> None:
    p = motions()[:, 0]
    force = LineBatch(LAWS[0], COUPLINGS, PERIOD).run(p)
    for i, coupling in enumerate(COUPLINGS):
        assert np.array_equal(force[:, i], Proxy1d(LAWS[0], coupling, PERIOD).run(p).force)
    assert LineBatch(LAWS[0], COUPLINGS[0], PERIOD, trials=50).run(p).shape == (len(p), 50)


def test_wrong_arguments() -> None:
    batch = LineBatch(LAWS, COUPLINGS, PERIOD)
    p = motions()
    before = batch.run(p[:100])
    bad = p.copy()
    bad[7, 1] = np.inf
    with pytest.raises(ValueError, match=r"p\[7, 1\] is no finite position"):
        batch.run(bad)
    batch.reset()
    assert np.array_equal(batch.run(p[:100]), before)
    with pytest.raises(ValueError, match=r"shape \(ticks,\).*\(ticks, 3\)"):
        batch.run(p[:, :2])
    with pytest.raises(ValueError, match=r"out must be a writable float64 array of shape \(800, 3\)"):
        batch.run(p, out=np.empty((800, 2)))
    with pytest.raises(ValueError, match="choose one of"):
        batch.run(p, instructions="mmx")
    with pytest.raises(ValueError, match="coupling has length 3, and the number of trials is 2"):
        LineBatch(LAWS[:2], COUPLINGS, PERIOD, trials=2)
    with pytest.raises(TypeError, match="law must be a ThinLaw, ThickLaw or ProfileLaw, not NoneType"):
        LineBatch(None, COUPLINGS, PERIOD)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="coupling must be a Coupling, not NoneType"):
        LineBatch(LAWS, None, PERIOD)  # type: ignore[arg-type]


def test_no_silent_wrong_number() -> None:
    p = motions()
    force = LineBatch(LAWS, COUPLINGS, PERIOD).run(p)
    both = np.zeros((len(p) + 1, 3))
    both[:-1] = p
    same = p.copy()
    assert LineBatch(LAWS, COUPLINGS, PERIOD).run(same, out=same) is same and np.array_equal(same, force)
    for message, wrong in {
        "out overlaps p": {"p": both[:-1], "out": both[1:]},
        "out overlaps itself": {"p": p, "out": as_strided(np.zeros(len(p) * 3), p.shape, (0, 8))},
        "out overlaps itself: some": {"p": p, "out": as_strided(np.zeros(len(p) * 3), p.shape, (8, 8))},
        "p must hold real numbers, not complex128": {"p": p + 0j},
        "p has masked elements": {"p": np.ma.array(p, mask=p > 0)},
        "its rows have different lengths": {"p": [[0, 0, 0], [0]]},
        "threads must be a whole number from 0 to 4096, not -1": {"p": p, "threads": -1},
        "block must be a whole number from 1 to 1048576, not 0": {"p": p, "block": 0},
    }.items():
        with pytest.raises((ValueError, TypeError), match=message):
            LineBatch(LAWS, COUPLINGS, PERIOD).run(**wrong)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="trials must be a whole number from 0 to 1000000000, not -1"):
        LineBatch(LAWS[0], COUPLINGS[0], PERIOD, trials=-1)
    with pytest.raises(MemoryError, match=r"100000000000 rows of forces need .* Take fewer ticks"):
        LineBatch(LAWS, COUPLINGS, PERIOD).run(as_strided(np.zeros(1), (10**11,), (0,)))
    assert LineBatch(LAWS, COUPLINGS, PERIOD).run([]).shape == (0, 3)


def test_ctrl_c_and_progress() -> None:
    batch = LineBatch(LAWS[0], COUPLINGS[0], PERIOD, trials=1)
    shares: list[float] = []
    batch.run(motions()[:, 0], progress=shares.append)
    assert shares[-1] == 1
    long = np.broadcast_to(0.0, (400_000_000,))  # many seconds of work, and no memory
    out = np.empty((len(long), 1))  # the system gives the memory when it is written
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        batch.run(long, out=out, threads=1)

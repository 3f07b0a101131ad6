"""Whole scenes, with low-pass and several membranes, against the transcription. K06 (41), Fig. 8, section 4."""

import numpy as np
import pytest
from oracles import cases, core, proxy_3d, random_scenes, signal

TICKS = 150


def filtered(s: random_scenes.Scenes):
    """The positions after the low-pass, (ticks, scenes, 3)."""
    return np.stack(
        [
            signal.low_pass(s.p[:, i], 1 / s.coupling.T[s.members(i)[0]], s.low_pass[i])
            for i in range(s.p.shape[1])
        ],
        axis=1,
    )  # fmt: skip


def by_scene(s: random_scenes.Scenes, states):
    """The force on the device (ticks, scenes, 3): the sum over each scene's membranes."""
    f = np.zeros(s.p.shape, dtype=states[0].f.dtype)
    for lane, scene in enumerate(s.scene):
        f[:, scene] += np.array([state.f[lane] for state in states])
    return f


def transcribed(s: random_scenes.Scenes, solver):
    """The force by the transcription, in the float type of the scenes."""
    p = filtered(s)
    tick = getattr(proxy_3d, solver)
    return by_scene(s, proxy_3d.run(tick, s.plane, s.law, s.coupling, p[:, s.scene], s.axis[:, s.scene]))


def traces(s: random_scenes.Scenes, solver):
    return [
        core.insertion(s, i, solver).run(np.ascontiguousarray(s.p[:, i]), np.ascontiguousarray(s.axis[:, i]))
        for i in range(s.p.shape[1])
    ]


@pytest.fixture(scope="module", params=list(cases.batches(1000, 500)))
def scenes(request):
    return random_scenes.scenes(*request.param, TICKS)


def test_paper_gives_whole_runs_of_random_scenes_wherever_rounding_alone_does_not_move_them(scenes):
    """As in one dimension: too large a gain |dPhi/dq| / g amplifies rounding; two float types show where it has."""
    of_core = np.stack([t.force for t in traces(scenes, "paper")], axis=1)
    mine, longer = transcribed(scenes, "paper"), transcribed(random_scenes.longer(scenes), "paper")
    drift = np.maximum.accumulate(abs(mine - longer).max(axis=2), axis=0)
    apart = abs(of_core - longer).max(axis=2)
    assert apart[drift <= 1e-13].max() <= 1e-10
    assert (drift <= 1e-13).mean() > 0.7 or scenes.p.shape[1] < 200


def test_exact_gives_whole_runs_of_random_scenes():
    s = random_scenes.scenes(51, cases.count(150), TICKS)
    of_core = np.stack([t.force for t in traces(s, "exact")], axis=1)
    apart = abs(of_core - transcribed(s, "exact")).max(axis=(0, 2))
    assert (apart > 1e-10).mean() <= 1e-3, "only a near tie of two roots may be decided by rounding"

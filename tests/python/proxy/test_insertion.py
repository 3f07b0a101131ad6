"""Whole scenes: the low-pass, several membranes, their sum. K06 (41), Fig. 8, section 4."""

import numpy as np
import punctura
import pytest
from oracles import cases, core, proxy_3d, random_scenes, signal
from punctura.scene import ServoSettings

TICKS = 150
SOLVERS = ("exact", "paper")


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


def traces(s: random_scenes.Scenes, solver, direction="stylus"):
    return [
        core.insertion(s, i, solver, direction).run(np.ascontiguousarray(s.p[:, i]), np.ascontiguousarray(s.axis[:, i]))
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


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_force_of_several_membranes_is_the_sum_of_their_forces_alone(solver):
    s = random_scenes.scenes(52, 60, TICKS)
    for i, together in enumerate(traces(s, solver)):
        alone = []
        for lane in s.members(i):
            placed = punctura.PlacedMembrane(
                "alone", core.membrane(s.parameters, lane), s.plane.a[lane].tolist(), s.plane.n[lane].tolist()
            )
            scene = punctura.Scene(
                "one", core.needle(s.parameters, lane),
                punctura.Coupling(float(s.coupling.K[lane]), float(s.coupling.B[lane])), [placed],
                ServoSettings(1 / float(s.coupling.T[lane]), float(s.low_pass[i]), solver),
            )  # fmt: skip
            alone.append(punctura.Insertion(scene).run(s.p[:, i].copy(), s.axis[:, i].copy()))
        for j, one in enumerate(alone):
            for name in ("depth", "axial_force", "lower", "upper", "phase"):
                assert np.array_equal(getattr(one, name)[:, 0], getattr(together, name)[:, j], equal_nan=True), name
        assert abs(sum(one.force for one in alone) - together.force).max() <= 1e-13


@pytest.mark.parametrize("solver", SOLVERS)
def test_turning_the_scene_turns_the_force(solver):
    """Exact: whole runs. Paper: as long as the turned run, by rounding, has not been driven from the other."""
    rng = np.random.default_rng(53)
    R = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    R *= np.linalg.det(R)
    s = random_scenes.scenes(53, cases.count(150), TICKS)
    straight, turned = (np.stack([t.force for t in traces(x, solver)], 1) for x in (s, random_scenes.turned(s, R)))
    apart = abs(straight @ R.T - turned).max(axis=(0, 2))
    if solver == "exact":
        assert (apart > 1e-10).mean() <= 1e-3
    else:
        drift = abs(transcribed(s, "paper") - transcribed(random_scenes.longer(s), "paper")).max(axis=(0, 2))
        assert apart[drift <= 1e-13].max() <= 1e-9
        assert (drift <= 1e-13).mean() > 0.6 or len(drift) < 100


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_axial_force_is_inside_the_bounds_and_outside_there_is_none(solver):
    s = random_scenes.scenes(54, cases.count(150), TICKS)
    touched = 0
    for i, t in enumerate(traces(s, solver)):
        touching = np.isin(t.phase, [1, 2, 3])
        touched += touching.any()
        # On a jump of a membrane of thickness 0 the exact force stands between both sides of the band.
        thick = touching & (s.parameters.thickness[s.members(i)] > 0)
        assert (t.axial_force >= t.lower - 1e-11)[thick].all() and (t.axial_force <= t.upper + 1e-11)[thick].all()
        assert not t.axial_force[~touching].any()
        assert not t.force[~touching.any(axis=1)].any()
    assert touched > 0.4 * s.p.shape[1]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_motion_that_stays_in_front_of_every_membrane_meets_no_force(solver):
    s = random_scenes.scenes(55, 40, TICKS)
    for i in range(40):
        lanes = s.members(i)
        n, a = s.plane.n[lanes], s.plane.a[lanes]
        away = n.sum(axis=0)
        if (n @ away <= 0.1).any():
            continue
        p = s.p[:, i] - random_scenes.unit(away) * 0.2
        assert ((p[:, None] - a) * n).sum(axis=2).max() < 0
        assert not core.insertion(s, i, solver).run(p, s.axis[:, i].copy()).force.any()


def test_the_low_pass_is_the_first_order_filter_with_the_gain_for_a_held_sample():
    """E5: 1 - exp(-2 pi 300 / 1600) = 0.6921, no overshoot. Seen through the force of a proxy that is stuck inside."""
    K, B, rate = 400.0, 1.0, 1600.0
    scene = punctura.Scene(
        "step", punctura.Needle(1.08e-3, 0.28), punctura.Coupling(K, B),
        [punctura.PlacedMembrane("m", punctura.Membrane(570.0, 0.41, 0.2, 1e-3), [0, 0, 0], [0, 0, 1])],
        ServoSettings(rate, 300.0, "exact"),
    )  # fmt: skip
    run = punctura.Insertion(scene)
    z = np.concatenate([np.linspace(-1e-3, 7e-3, 3000), np.linspace(7e-3, 6.3e-3, 600), np.full(400, 6.3e-3)])
    p = np.zeros((len(z), 3))
    p[:, 2] = z
    axis = np.array([0.0, 0.0, 1.0])
    held = run.run(p, axis)
    assert held.phase[-1, 0] == punctura.Phase.sticking.value
    step = p[-1:] + np.array([0, 0, 2e-5]) + np.zeros((40, 1))
    f = run.run(step, axis).force[:, 2]
    gain = 1 - np.exp(-2 * np.pi * 300 / rate)
    moved = 2e-5 * (1 - (1 - gain) ** np.arange(0, 41))
    expected = held.force[-1, 2] - K * moved[1:] - B * np.diff(moved) * rate
    assert abs(f - expected).max() <= 1e-11
    assert gain == pytest.approx(0.692, abs=5e-4)

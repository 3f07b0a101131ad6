"""What a trace shows: its segments, the air before and behind the tissue, and the steps of its sensor."""

import numpy as np
import pytest
from punctura import Membrane
from punctura.identify.start import first_insertion
from punctura.trace import Trace, TraceError, segment
from punctura.trace.air import contact_sample
from punctura.trace.findings import examine
from punctura.trace.numbers import numbers_of
from punctura.trace.steps import rounding
from punctura.trace.turns import noise_of, turning_points
from traces import force_of, motion, trace


def test_a_slow_way_in_before_a_fast_way_back_is_no_rest():
    time = np.arange(0, 272, 0.1)
    depth = np.interp(time, [0, 240, 268, 272], [0, 15e-6, 6e-6, -8e-6])
    force = np.interp(depth, [0, 15e-6], [0, 1e-3])
    assert segment(Trace(depth, force, time)).strokes[0].kind == "in"


def test_contact_and_pop_are_found_where_the_membrane_is():
    found = segment(measured := trace())
    assert measured.depth[found.contact] == pytest.approx(5e-3, abs=0.2e-3)
    assert len(found.pops) == 1
    pop = found.pops[0]
    assert measured.depth[pop.start] == pytest.approx(5e-3 + 1.2e-3 / np.tan(0.4), abs=1e-3)
    assert pop.drop > 0.2 and 0 < pop.width < 2e-3


def test_strokes_of_three_insertions_with_holds():
    found = segment(measured := trace(times=3))
    assert [stroke.kind for stroke in found.strokes] == ["in", "hold", "out"] * 3
    assert [stroke.insertion for stroke in found.strokes] == [0, 0, 0, 1, 1, 1, 2, 2, 2]
    assert found.insertions == 3 and len(found.holds) == 3 and len(found.reversals) == 5
    assert set(measured.strokes.tolist()) == {0, 1, 2}


def test_a_trace_without_time_has_no_holds():
    timed = trace(hold=0)
    found = segment(Trace(timed.depth, timed.force))
    assert [stroke.kind for stroke in found.strokes] == ["in", "out"] and found.holds == ()


def test_turning_points_ignore_turns_below_the_hysteresis():
    curve = np.array([0, 1, 2, 1.9, 3, 2.95, 0, 0.05, -1, 4])
    assert turning_points(curve, 0.5) == [0, 4, 8, 9]
    assert turning_points(np.zeros(7), 0.5) == [0, 6]


def test_noise_is_told_from_the_curve_below_it():
    rng = np.random.default_rng(2)
    curve = np.sin(np.linspace(0, 3, 4000)) + 0.01 * rng.normal(size=4000)
    assert noise_of(curve) == pytest.approx(0.01, rel=0.1)


def test_arrays_that_do_not_fit_together_are_refused():
    depth = np.arange(9.0)
    with pytest.raises(TraceError, match="force must hold one number for each of the 9 depths"):
        Trace(depth, depth[:-1])
    with pytest.raises(TraceError, match="time does not grow at sample 5"):
        Trace(depth, depth, np.array([0, 1, 2, 3, 4, 4, 6, 7, 8.0]))
    with pytest.raises(TraceError, match="NaN or infinite"):
        Trace(depth, depth * np.nan)
    with pytest.raises(TraceError, match="at least 5"):
        Trace(depth[:3], depth[:3])
    with pytest.raises(ValueError, match="read-only"):
        Trace(depth, depth).force[0] = 1


NOISE = 8e-3
SOFT = Membrane(stiffness=250, precompression=0.1, friction=0.3, thickness=0.3e-3)
FIRM = Membrane(stiffness=2500, precompression=0.6, friction=0.3, thickness=0.5e-3)


def layers(seed=1, change=0.0):
    """A soft layer at 2 mm and a firm wall at 9 mm, with time; change: of the zero over the trace, N."""
    time, depth = motion(deepest=18e-3)
    force = force_of(depth, 2e-3, SOFT) + force_of(depth, 9e-3, FIRM)
    force += change * np.linspace(0, 1, len(time)) + NOISE * np.random.default_rng(seed).normal(size=len(time))
    return Trace(depth, force, time)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_contact_is_where_a_soft_layer_begins_and_its_force_is_no_offset(seed):
    made = examine(layers(seed))
    assert not {one.kind for one in made.findings} & {"offset", "drift"}
    found = segment(made)
    assert made.depth[found.contact] == pytest.approx(2e-3, abs=0.4e-3)
    assert made.force[made.depth < 1e-3].mean() == pytest.approx(0, abs=3e-3)
    assert made.depth[found.exit] < 9e-3 and np.abs(made.force[found.exit :]).max() < 5 * NOISE


def test_noise_moves_the_contact_of_a_soft_rise_by_less_than_a_millimetre():
    depth = np.arange(0, 12e-3, 2e-4)
    rise = 0.1 * np.maximum(depth * 1e3 - 4, 0)  # N: 8 samples until it is well beyond the noise of 10 mN
    noise = [np.random.default_rng(seed).normal(0, 0.01, len(depth)) for seed in range(20)]
    found = [depth[contact_sample(depth, rise + one)] for one in noise]
    assert np.abs(np.array(found) - 4e-3).max() < 1e-3


RISES = {
    "ramp": lambda way: 0.2e3 * way,
    "exponential": lambda way: 0.05 * np.expm1(way / 2e-3),
    "step": lambda way: (way > 0) * (0.3 + 50 * way),
    "skin of example 08": lambda way: np.where(way < 2.12e-3, 400 * way, 0.05 * (way > 0)),
    "K06": lambda way: force_of(way, 0.0),
    "K06, soft": lambda way: force_of(way, 0.0, SOFT, 1500.0),
}


@pytest.mark.parametrize("noise", [0.0, 1e-6, 1e-4])
@pytest.mark.parametrize("rise", RISES.values(), ids=RISES.keys())
def test_with_little_noise_or_none_the_contact_is_exact(rise, noise):
    for step in (2e-6, 25e-6):  # m
        depth = np.arange(0, 12e-3, step) - 3.013e-3
        way = np.maximum(depth, 0) if rise not in (RISES["K06"], RISES["K06, soft"]) else depth
        force = rise(way) + noise * np.random.default_rng(1).normal(size=len(depth))
        contact = segment(Trace(depth, force, np.arange(len(depth)) / 200)).contact
        assert depth[contact] == pytest.approx(0, abs=(20e-6 if noise else 5e-6) + step)


def test_steps_of_a_quiet_sensor_do_not_put_the_contact_late():
    depth = np.arange(0, 12e-3, 5e-6)
    force = np.round(100 * np.maximum(depth - 4.1e-3, 0) / 0.02) * 0.02  # one step each 0.2 mm
    assert depth[contact_sample(depth, force)] == pytest.approx(4.1e-3, abs=0.1e-3)


def test_a_hand_that_turns_in_air_has_its_contact_behind_the_last_turn():
    time = np.arange(0, 12, 0.01)
    depth = 6e-3 - 6e-3 * np.cos(2 * np.pi * time / 12) + 0.2e-3 * np.sin(2 * np.pi * 1.1 * time)
    made = Trace(depth, force_of(depth) + 8e-3 * np.random.default_rng(1).normal(size=len(depth)), time)
    assert made.depth[segment(made).contact] == pytest.approx(5e-3, abs=0.2e-3)


def test_turns_of_a_hand_in_air_are_no_insertions():
    once, noise = trace(hold=0.1), np.random.default_rng(1)
    turn = 0.5e-3 * np.sin(np.linspace(0, np.pi, 60))
    depth = np.concatenate((turn, once.depth, turn, once.depth, turn))
    air = [5e-3 * noise.normal(size=60) for _ in range(3)]
    made = Trace(depth, np.concatenate((air[0], once.force, air[1], once.force, air[2])), np.arange(len(depth)) / 200)
    assert set(made.strokes) == {0, 1} and segment(made).insertions == 2
    assert first_insertion(made, segment(made)).depth.max() == once.depth.max()
    assert [one.deepest_m for one in numbers_of(made)] == [once.depth.max()] * 2
    assert [one.peak_N for one in numbers_of(made)] == pytest.approx([once.force.max()] * 2, abs=0.02)


def test_every_tenth_sample_gives_the_same_contact():
    made = layers()
    few = made[::10]
    assert few.depth[segment(few).contact] == pytest.approx(made.depth[segment(made).contact], abs=0.5e-3)


def test_a_zero_that_has_changed_behind_the_tissue_is_a_drift():
    made = examine(layers(change=0.4))
    assert [one.kind for one in made.findings if one.kind == "drift"] == ["drift"]
    assert made.depth[segment(made).contact] < 9.5e-3


@pytest.mark.parametrize("curve", [0.0, 4e3])
def test_a_force_that_rises_from_the_first_sample_on_has_no_contact(curve):
    depth = np.linspace(0, 29e-3, 10_000)
    force = 220 * np.minimum(depth, 5e-3) + curve * np.minimum(depth, 5e-3) ** 2 - 800 * np.clip(depth - 5e-3, 0, 5e-4)
    noise = 0.01 * np.random.default_rng(1).normal(size=len(depth))
    assert segment(Trace(depth, force + noise, np.arange(len(depth)) * 0.01)).contact is None


def test_a_contact_at_the_first_sample_is_said_to_be_none():
    way = np.linspace(5e-6, 3.9e-3, 1500)
    shape = [0.0, 0.02, 0.3, 0.6, 1.2, 1.8, 2.4, 3.0, 3.6, 3.9], [0.0, 0.19, 0.7, 0.94, 1.1, 0.9, 0.53, 0.41, 0.57, 2.2]
    force = np.interp(way * 1e3, *shape)
    made = examine(Trace(np.concatenate((way, way[::-1])), np.concatenate((force, 0.8 * force[::-1]))))
    assert segment(made).contact == 0 and "no_contact" in [one.kind for one in made.findings]


def test_a_needle_that_stays_in_the_tissue_has_no_exit():
    made = layers()
    for end in (5.5, 6.2):  # s: on the way out, but deeper than the firm wall
        assert segment(made[made.time < end]).exit is None


def test_a_spike_in_air_is_no_contact():
    made = layers()
    force = made.force.copy()
    force[20] += 1.0
    contact = segment(Trace(made.depth, force, made.time)).contact
    assert made.depth[contact] == pytest.approx(2e-3, abs=0.4e-3)


SMOOTH = np.sin(np.linspace(0, 3, 400)) + 1e-3 * np.random.default_rng(1).normal(size=400)


@pytest.mark.parametrize("step", [0.02, 0.0075, 1 / 300])
@pytest.mark.parametrize("zero", [0.0, 0.123456])
def test_steps_are_found(step, zero):
    stepped = np.round(np.round(SMOOTH / step) * step, 5) + zero
    assert rounding(stepped) == pytest.approx(step / np.sqrt(12), rel=1e-2)


def test_steps_of_which_one_is_never_seen_alone_are_found():
    assert rounding(0.1 * np.array([0, 2, 5, 7, 9, 12, 14])) == pytest.approx(0.1 / np.sqrt(12))


@pytest.mark.parametrize("values", [SMOOTH, np.zeros(9), np.array([0.0, 1.0, 0.0, 1.0]), SMOOTH[:8]])
def test_values_on_no_grid_have_none(values):
    assert rounding(values) == 0.0


@pytest.mark.parametrize("timed", [False, True])
def test_insertions_after_each_other_without_withdrawals_are_not_taken_for_one_place(timed):
    time, depth = motion(hold=0)
    inward = slice(0, int(np.argmax(depth)) + 1)
    depth, force = np.tile(depth[inward], 3), np.tile(force_of(depth)[inward], 3)
    time = np.arange(len(depth)) / 200 if timed else None
    (found,) = [one for one in examine(Trace(depth, force, time)).findings if one.kind == "stacked"]
    assert found.severe and "jumps back 2 times, first by 15 mm behind sample 600" in found.text
    withdrawn = trace(noise=0.0, times=2)
    assert not [one for one in examine(withdrawn).findings if one.kind == "stacked"]
    if timed:  # while the needle came out, nothing was recorded
        paused = examine(Trace(depth, force, time + 10 * (np.arange(len(depth)) // 600)))
        kinds = {one.kind for one in paused.findings}
        assert "gap" in kinds and "stacked" not in kinds


@pytest.mark.parametrize("pull", [0.05, 0.0])
def test_a_pull_that_does_not_change_is_one_where_the_air_behind_it_reads_more(pull):
    depth = np.concatenate((np.arange(0, 10e-3, 5e-6), np.arange(10e-3, 0, -5e-6)))
    going = np.arange(len(depth)) < 2000
    force = np.where(depth < 3e-3, 0.0, np.where(going, 0.85 * np.minimum((depth - 3e-3) / 2e-3, 1.0), -pull))
    found = {one.kind for one in examine(Trace(depth, force, np.arange(len(depth)) / 200)).findings}
    assert ("no_pull" in found) == (pull == 0)


def test_a_needle_that_begins_in_tissue_keeps_the_sign_of_its_force():
    turns = np.array([0, 2, 0, 2, 0, 12, 0]) * 1e-3
    way = np.concatenate(([0], np.cumsum(np.abs(np.diff(turns)))))
    depth = np.interp(np.arange(0, way[-1], 1e-5), way, turns)
    inward = np.gradient(depth) > 0
    bump = np.interp(depth, [5e-3, 8e-3, 8.1e-3], [0, 0.5, 0]) * inward
    noise = 5e-3 * np.random.default_rng(2).normal(size=len(depth))
    force = np.where(inward, 0.35, -0.35) + bump + noise
    begun = examine(Trace(depth, force, np.arange(len(depth)) / 200))
    found = {finding.kind: finding.text for finding in begun.findings}
    assert "reversed_sign" not in found
    assert "tissue that the needle is in from the beginning" in found["no_air"] and "drift" not in found
    turned = examine(Trace(depth, -force, np.arange(len(depth)) / 200))
    assert "reversed_sign" in {finding.kind for finding in turned.findings}

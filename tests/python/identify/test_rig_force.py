"""Friction of the rig's slide and the pull of a cable: the air shows them, and they are no wall."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from punctura.identify import identify
from punctura.trace import Trace, rig_force
from punctura.trace.findings import examine
from punctura.trace.friction import Slide, friction_of_slide
from punctura.trace.rig_force import without_rig_force
from punctura.trace.slide import slide_of
from traces import MEMBRANE, NEEDLE, RATE, force_of, motion

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
NOISE = 8e-3


def rested(of_rig, sign=1):
    """A trace that rests in air at both ends; of_rig: the force that the rig adds, by depth (m) and speed (m/s)."""
    depth = np.pad(motion(deepest=9e-3, speed=3e-3)[1] + 1e-3, 100, "edge")
    speed = np.gradient(depth) * RATE
    noise = NOISE * np.random.default_rng(3).normal(size=len(depth))
    force = force_of(depth, surface=4e-3) + of_rig(depth, speed) + noise
    return examine(Trace(depth, sign * force, np.arange(len(depth)) / RATE))


def kinds(trace):
    return [finding.kind for finding in trace.findings]


@pytest.mark.parametrize(
    ("of_rig", "kind", "words"),
    [
        (lambda depth, speed: 0.12 * np.tanh(speed / 2e-4), "slide_friction", "by 0.12 N each way"),
        (lambda depth, speed: 18 * depth, "cable_stiffness", "by +0.017 N a mm"),
    ],
)
def test_a_force_of_the_rig_that_the_air_shows_is_named_and_is_no_wall(of_rig, kind, words):
    trace = rested(of_rig)
    (told,) = trace.findings
    assert told.kind == kind and told.repaired and words in told.text
    found = identify(trace, NEEDLE)
    if kind == "cable_stiffness":
        for text in (told.text, " ".join(found.verdicts)):
            assert "soft layer" in text and "in air without tissue" in text
    assert len(found.parameters.membranes) == 1 and found.extensions == () and found.doubts.sentences == ()
    values = {estimate.name: estimate for estimate in found.estimates}
    whole = values[kind]  # its error reaches the intervals of all others
    assert whole.low < whole.value < whole.high and whole.identifiable
    assert whole.value == pytest.approx(0.12 if kind == "slide_friction" else 18, rel=0.02)
    truth = {"stiffness": MEMBRANE.stiffness, "friction": MEMBRANE.friction, "surface": 4e-3}
    assert [values[f"membrane[0].{name}"].value for name in truth] == pytest.approx(list(truth.values()), rel=0.02)


def keeping(depth, speed, first):
    """Friction that a rest keeps: of the last motion, and at first another one (N)."""
    moving = np.sign(np.where(np.abs(speed) > 1e-6, speed, 0))
    last = np.maximum.accumulate(np.where(moving != 0, np.arange(len(depth)), 0))
    return np.where(np.arange(len(depth)) < np.argmax(moving != 0), first, 0.06 * moving[last])


@pytest.mark.parametrize(
    ("of_rig", "words"),
    [
        (lambda depth, speed: np.select([speed > 1e-5, speed < -1e-5], [0.09, -0.03]), "0.092 N on the way in"),
        (lambda depth, speed: keeping(depth, speed, 0.0), "N each way"),
        (lambda depth, speed: keeping(depth, speed, -0.06), "N each way"),
    ],
)
def test_friction_may_differ_by_the_way_and_a_rest_may_keep_it(of_rig, words):
    trace, plain = rested(of_rig), rested(lambda depth, speed: 0 * depth)
    (told,) = (finding for finding in trace.findings if finding.kind != "offset")
    assert told.kind == "slide_friction" and words in told.text
    assert trace.rig_sizes[0] == pytest.approx(0.09 if "way in" in words else 0.06, abs=4e-3)
    zero = np.median(trace.force[:100])
    assert np.sqrt(np.mean((trace.force - zero - plain.force) ** 2)) < NOISE


def slid(depth, over, at_first):
    """Friction of 1 N of a slide that keeps it in a rest; it rises over so many m, and is at_first in the beginning."""
    force, given = np.empty(len(depth)), at_first
    for i, step in enumerate(np.diff(depth, prepend=depth[0])):
        left = np.exp(-abs(step) / over) if over else 0.0
        given = np.sign(step) + (given - np.sign(step)) * left if step else given
        force[i] = given
    return force


@pytest.mark.parametrize(("over", "at_first"), [(1e-6, 0.0), (5e-5, 0.0), (2e-5, -1.0), (2e-4, 0.0)])
def test_friction_that_a_rest_keeps_is_subtracted_and_is_no_wall(over, at_first):
    trace = rested(lambda depth, speed: 0.08 * slid(depth, over, at_first))
    (told,) = trace.findings
    assert told.kind == "slide_friction" and "stays in a rest" in told.text
    assert trace.rig_sizes[0] == pytest.approx(0.08, abs=6e-3)
    found = identify(trace, NEEDLE, membranes=1)
    assert found.doubts.sentences == ()
    assert found.parameters.get("membrane[0].friction") == pytest.approx(MEMBRANE.friction, rel=0.03)


def bounds(found, name):
    """Lower and upper bound of an estimate."""
    return next((one.low, one.high) for one in found.estimates if one.name == name)


@pytest.mark.parametrize("over", [5e-5, 6e-4])
def test_the_way_over_which_friction_rises_is_a_parameter(over):
    trace = rested(lambda depth, speed: 0.08 * slid(depth, over, 0.0))
    assert kinds(trace) == ["slide_friction"]
    found = identify(trace, NEEDLE, membranes=1)
    low, high = bounds(found, "slide_way")
    assert low < over < high and high - low < over
    low, high = bounds(found, "membrane[0].friction")
    assert low < MEMBRANE.friction < high
    low, high = bounds(found, "slide_friction_before")
    assert low - (high - low) / 2 < 0 < high + (high - low) / 2


@pytest.mark.parametrize("seed", [204006, 204007])  # a drift in air hid one, and play of the drive explained the other
def test_the_spring_is_told_from_friction_that_turns_where_it_unloads(seed):
    trace, needle, truth = TOOL["random_trace"](seed, TOOL["Conditions"](machine=True, slide=0.08, presliding=2e-5))
    trace = examine(trace)
    assert kinds(trace) == ["slide_friction"]
    found = identify(trace, needle, membranes=1)
    low, high = bounds(found, "coupling_stiffness")
    assert low < truth["coupling_stiffness"] < high < 1.1 * low
    assert not found.rig


def test_the_shape_of_friction_has_its_derivatives_and_those_of_fewer_samples():
    slide = slide_of(rested(lambda depth, speed: 0 * depth))
    known, over, step = (0.08, -0.03), 4e-5, 1e-9
    low, high = (friction_of_slide(slide, *known, at)[0] for at in (over - step, over + step))
    force, by = friction_of_slide(slide, *known, over)
    assert by[:, :2] @ known == pytest.approx(force)
    assert by[:, 2] == pytest.approx((high - low) / (2 * step), abs=1e-3)
    assert np.array_equal(friction_of_slide(slide[::7], *known, over)[0], force[::7])


def test_friction_that_differs_by_the_way_has_a_parameter_for_each():
    trace = rested(lambda depth, speed: np.select([speed > 1e-5, speed < -1e-5], [0.09, -0.03]))
    found = identify(trace, NEEDLE, membranes=1)
    for name, truth in (("slide_friction", 0.09), ("slide_friction_out", 0.03)):
        low, high = bounds(found, name)
        wide = high - low
        assert low - wide / 2 < truth < high + wide / 2 and wide < 0.02


def uneven(depth, speed):
    """Friction that no form explains, N."""
    return (0.3 + 0.1 * np.sin(depth / 1e-4)) * np.sign(np.round(speed, 6))


def test_a_step_in_air_that_no_friction_explains_is_said_and_the_intervals_do_not_hold():
    trace = rested(uneven)
    assert "air_steps" in kinds(trace) and not any(trace.rig_sizes)
    found = identify(trace, NEEDLE, membranes=1)
    assert any("The intervals do not hold" in str(cause) for cause in found.doubts.causes)
    assert not any("warm up" in text for text in found.verdicts)


@pytest.mark.parametrize("over", [None, 2e-5])
def test_the_sign_is_turned_before_friction_is_looked_for(over):
    def of_rig(depth, speed):
        return 0.08 * (slid(depth, over, 0.0) if over else np.tanh(speed / 2e-4))

    right = rested(of_rig)
    wrong = rested(of_rig, sign=-1)
    assert kinds(wrong) == ["reversed_sign", *kinds(right)] and kinds(right) == ["slide_friction"]
    assert wrong.rig_sizes == right.rig_sizes and np.array_equal(wrong.force, right.force)


def test_a_force_against_the_motion_in_air_is_no_friction():
    for of_rig in (
        lambda depth, speed: -0.08 * np.tanh(speed / 2e-4),
        lambda depth, speed: -0.08 * slid(depth, 2e-5, 0.0),
    ):
        assert "slide_friction" not in kinds(rested(of_rig))


def test_forms_of_friction_are_compared_at_the_same_samples():
    quiet = np.array([0.1, 0.1, np.nan, np.nan])  # it leaves out what it explains badly
    forms = [rig_force._Found(np.zeros(2), np.zeros(2), left) for left in (np.array([0.05, 0.05, 1.0, 1.0]), quiet)]
    assert rig_force._least(forms) == 0


def test_the_shapes_of_friction_are_made_once_for_all_parts_of_air(monkeypatch):
    asked, kept = [], Slide.kept
    monkeypatch.setattr(Slide, "kept", lambda slide, over: asked.append(over) or kept(slide, over))
    assert kinds(rested(uneven)) == ["air_steps"]
    finer = len(rig_force.PARTS) * (2 * rig_force.FINER + 2)
    assert len(rig_force.WAYS) < len(asked) <= len(rig_force.WAYS) + finer


def test_a_trace_without_such_a_force_has_none():
    assert kinds(rested(lambda depth, speed: 0 * depth)) == []


def test_friction_is_found_where_the_trace_ends_at_its_deepest():
    whole = rested(lambda depth, speed: 0 * depth)
    inward = whole[: int(np.argmax(whole.depth))]
    rubbed = replace(inward, force=inward.force + 0.12 * (np.gradient(inward.depth) > 1e-6))
    assert kinds(examine(rubbed))[0] == "slide_friction"
    pulled = replace(inward, force=inward.force + 18 * inward.depth)  # a soft layer looks the same
    assert "cable_stiffness" not in kinds(examine(pulled))


@pytest.mark.parametrize("left", [0.0, 0.6])
def test_a_soft_layer_that_stays_behind_on_the_way_out_is_no_cable(left):
    def of_rig(depth, speed):
        return np.where(np.arange(len(depth)) > np.argmax(depth), left, 1.0) * 6 * (depth - depth[0])

    assert "cable_stiffness" not in kinds(rested(of_rig))


def test_slow_noise_is_no_force_of_the_rig():
    conditions = TOOL["Conditions"](machine=True, drift=0.03)
    traces = [TOOL["random_trace"](seed, conditions)[0] for seed in [*range(20), 243019]]
    assert [without_rig_force(trace)[1] for trace in traces] == [[]] * 21


def test_friction_that_no_turn_in_air_tells_is_a_parameter():
    _, depth = motion(deepest=11e-3, speed=3e-3, hold=0)
    noise = NOISE * np.random.default_rng(3).normal(size=len(depth))
    force = force_of(depth, surface=4e-3) + 0.08 * slid(depth, 0, 1.0) + noise
    trace = examine(Trace(depth, force, np.arange(len(depth)) / RATE))
    assert kinds(trace)[0] == "no_air" and not any(trace.rig_sizes)
    found = identify(trace, NEEDLE)
    assert len(found.parameters.membranes) == 1
    for name, truth in (("slide_friction", 0.08), ("membrane[0].friction", MEMBRANE.friction)):
        low, high = bounds(found, name)
        wide = high - low
        assert low - wide / 2 < truth < high + wide / 2 and wide < 0.02

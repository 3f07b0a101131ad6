"""An exercise with a loss of resistance is passed only if the device could show the loss."""

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, as_a_device_runs_it, goal, hand_run, ideal, judged, motion_of, of_positions
from punctura._core import ForceLimits, ServoLoop, ServoState, SimulatedDevice
from punctura.exercise import Result, cannot_show, expected_losses, load_exercise
from punctura.exercise.losses import needed_drop
from punctura.scene import DisplaySettings
from waiting import wait_until

SCENE = pn.load_scene("venipuncture")
PRESS = HEAD.replace("[space]", "[space]\npress_mm = 9\nsign_is_felt = true")
WAIT = (1.0, 0.0)
INTO_THE_SPACE = (WAIT, (6.0, 47.0), (4.5, 58.3), (5.0, 58.3))


def through(scale=1.0, ceiling=np.inf):
    """A needle through the front wall at 10 mm/s, on a device with this scale and ceiling (N)."""
    columns = ideal(SCENE, (0, 5, 0), (0, -10, 0), stops=1)
    n = len(columns["tick"])
    size = scale * np.linalg.norm(columns["model_force"], axis=1)
    permitted = np.full(n, ceiling) if np.isscalar(ceiling) else ceiling(columns)
    factor = scale * np.minimum(1, permitted / np.where(size > 0, size, 1))
    columns |= {
        "force": columns["model_force"] * factor[:, None],
        "ceiling": permitted,
        "force_scale": np.full(n, scale),
    }
    return columns


def attempt(write, columns, head=PRESS, cuts=160, scene=SCENE):
    return judged(load_exercise(write(goal("reach", whole_tip=True), head=head)), columns, cuts, scene).finish()


def loss_of(result, name="front vein wall"):
    return next(loss for loss in result.metrics.losses if loss.name == name)


@pytest.mark.parametrize("cuts", [29, 100_000])
def test_a_device_that_gives_the_whole_force_shows_the_loss(write, cuts):
    result = attempt(write, through(), cuts=cuts)
    loss = loss_of(result)
    pop = next(event for event in result.events if event.what == "pop" and event.name == "front vein wall")
    assert result.passed and result.verdict == "passed"
    assert loss.drop == pytest.approx(pop.drop, rel=0.15) and loss.drop > loss.needed == 0.1
    assert loss_of(result, "skin").needed is None
    assert Result.model_validate_json(result.model_dump_json()) == result


@pytest.mark.parametrize("cuts", [29, 100_000])
def test_a_peak_limit_that_hides_the_loss_is_no_pass(write, cuts):
    result = attempt(write, through(ceiling=0.3), cuts=cuts)
    assert not result.passed
    assert [one.state for one in result.goals] == ["met"]
    assert result.verdict == (
        "not judged as passed: the device could not show the loss of resistance (none; 0.1 N needed)"
    )
    assert result.reasons[-1] == (
        "Not judged as passed: the device could not show the loss of resistance of the front vein wall "
        "(none; 0.1 N needed). The limits cut the force to 0.30 of "
        f'{loss_of(result).model_before:.2f} N: set force_scale in the scene to "automatic", or use a stronger device.'
    )


def test_a_ceiling_that_falls_before_the_pop_makes_no_loss_of_resistance(write):
    """The force falls by the limit from 0.6 N to 0.3 N: that is not the tissue."""
    falling = lambda columns: np.where(columns["tip"][:, 1] > -7.5e-3, 9.0, 0.3)  # noqa: E731
    result = attempt(write, through(ceiling=falling))
    assert not result.passed and loss_of(result).drop < 0.1


def test_a_force_that_is_turned_off_at_the_pop_makes_no_loss_of_resistance(write):
    columns = through(ceiling=0.3)
    off = columns["time"] >= loss_of(attempt(write, columns)).time
    columns |= {"force": np.where(off[:, None], 0.0, columns["force"])}
    columns |= {"state": np.where(off, ServoState.disarmed.value, ServoState.active.value)}
    result = attempt(write, columns)
    assert not result.passed and loss_of(result).drop == 0
    assert result.reasons[-2].endswith("The force was off: turn it on.")
    assert result.reasons[-1].startswith("The force was off for 0.0 s while the needle was in the tissue")


def test_a_scale_that_is_too_small_is_no_pass(write):
    result = attempt(write, through(scale=0.2))
    assert not result.passed
    assert loss_of(result).drop == pytest.approx(0.2 * (loss_of(result).model_before - loss_of(result).model_after))
    assert result.reasons[-1].endswith("or use a stronger device.") and "larger force_scale" in result.reasons[-1]
    assert result.metrics.peak_felt_force == pytest.approx(0.2 * result.metrics.peak_force)
    assert result.metrics.force_scale == 0.2


@pytest.mark.parametrize("felt", ["sign_is_felt = true", 'sign = "the flash-back"'])
def test_a_force_that_is_off_is_no_pass_whatever_the_sign_is(write, felt):
    head = PRESS.replace('sign = "the flash-back"\n', "").replace("sign_is_felt = true", felt)
    assert attempt(write, through(), head=head).passed
    result = attempt(write, through(ceiling=0.0), head=head)
    assert not result.passed and result.verdict == "not judged as passed: the force was off"
    assert result.reasons[-1].startswith("The force was off for 0.9 s while the needle was in the tissue")


def test_without_another_sign_the_pop_must_be_felt(write):
    head = PRESS.replace("sign_is_felt = true\n", "").replace('sign = "the flash-back"\n', "")
    assert attempt(write, through(), head=head).passed
    assert not attempt(write, through(ceiling=0.3), head=head).passed


def test_only_the_force_since_the_last_entry_counts(write):
    columns = through()
    twice = of_positions(SCENE, np.concatenate([columns["tip"], columns["tip"]]))
    off = np.arange(len(twice["tick"])) < len(columns["tick"])
    twice |= {"state": np.where(off, ServoState.disarmed.value, ServoState.active.value)}
    stay = goal("stay", seconds=30)

    def made(state):
        return judged(load_exercise(write(stay, head=PRESS)), twice | {"state": state}, scene=SCENE).finish().metrics

    assert made(twice["state"]).force_off == 0
    assert made(twice["state"][::-1]).force_off > 0.5


def test_without_the_key_and_without_a_stop_the_loss_is_not_needed(write):
    assert attempt(write, through(ceiling=0.3), head=PRESS.replace("sign_is_felt = true", "")).passed


def test_a_stop_after_the_pop_needs_its_loss_to_be_felt(write):
    goals = goal("reach"), goal("stop_after_pop", membrane="front vein wall", within_mm=9)
    exercise = load_exercise(write(*goals, head=HEAD.replace("[space]", "[space]\npress_mm = 9")))
    assert judged(exercise, through(), scene=SCENE).finish().passed
    assert not judged(exercise, through(ceiling=0.3), scene=SCENE).finish().passed


def test_a_larger_force_needs_a_larger_drop():
    assert [needed_drop(before) for before in (0, 0.8, 1, 2.5)] == pytest.approx([0.1, 0.1, 0.1, 0.25])


def test_a_weak_device_is_known_before_the_attempt():
    exercise = load_exercise("epidural")
    whole = exercise.scene.replace(display=DisplaySettings(1))
    weak = ForceLimits(max_force=0.88)
    assert cannot_show(exercise, whole, ForceLimits()) == ""
    assert cannot_show(exercise, whole, weak).startswith(
        "This device cannot show the loss of resistance of the ligamentum flavum (none; 0.1 N needed), "
    )
    automatic = exercise.scene.replace(display=DisplaySettings("automatic"))
    assert cannot_show(exercise, automatic, weak) == ""
    (loss,) = expected_losses(exercise, automatic, weak)
    assert loss.before < weak.max_force and loss.force_scale < 0.4
    assert "larger force_scale" in cannot_show(exercise, whole.replace(display=DisplaySettings(0.005)), weak)


def test_what_is_expected_is_what_a_hand_gets():
    exercise = load_exercise("epidural")
    scene = as_a_device_runs_it(exercise.scene)
    result = judged(exercise, hand_run("epidural", INTO_THE_SPACE), scene=scene).finish()
    (expected,) = expected_losses(exercise, scene, ForceLimits())
    loss = loss_of(result, "ligamentum flavum")
    assert result.passed, result.reasons
    assert loss.drop == pytest.approx(expected.drop, rel=0.15)


@pytest.mark.parametrize("speed", [4.0, 1.0, 0.4])
def test_no_limit_cuts_a_slow_hand_between_the_pops_of_the_blind_exercise(speed):
    """8 mm to the first membrane's pop, then 9.5 mm at this speed, mm/s, and 3 s of rest."""
    exercise = load_exercise("blind")
    axis, legs = np.asarray(exercise.start_axis), [WAIT, (2.0, 8.0), (9.5 / speed, 17.5), (3.0, 17.5)]
    ticks = round(sum(seconds for seconds, _ in legs) * 1600)
    motion = motion_of(exercise, legs, axis)
    device = SimulatedDevice(motion, real_time=False, ticks=ticks, axis=axis)
    loop = ServoLoop(device, as_a_device_runs_it(exercise.scene))
    listener = loop.listen(ticks)
    loop.arm()
    loop.start()
    wait_until(lambda: device.finished)
    loop.stop()
    made = judged(exercise, dict(listener.read()), ticks, loop.scene, simulated=True).finish()
    assert not made.metrics.force_cut
    assert loss_of(made, "second membrane").drop > 1.5 * loss_of(made, "second membrane").needed

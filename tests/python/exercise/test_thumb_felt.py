"""The plunger's loss of resistance is judged by what a thumb on a second device could feel."""

import sys

import numpy as np
import pytest
from attempts import cuts_near, goal, judged
from plunger_runs import AT_ONCE, HEAD, NAME, SCENE, pushed
from punctura._core import ForceLimits, ServoLoop, SimulatedDevice, Target, ThumbLoop
from punctura.exercise import Attempt, exercise_names, load_exercise, score, thumb_cannot_show
from punctura.record import Recorder
from punctura.scene import DisplaySettings
from waiting import wait_until

EXERCISE = load_exercise(NAME)
OMNI = ForceLimits(3.3, 0.88)


def on_device(scale=1.0, most=3.3, newtons=4.0, late=2, **thumb):
    """The columns with a second device that gives at most this force, and each force some ticks late."""
    columns = pushed(newtons, **thumb)
    given = np.clip(scale * columns["thumb_force"], -most, most)
    felt = np.concatenate([np.zeros(late), given[:-late]])
    return columns | {"thumb_felt": felt, "force_scale": np.full(len(felt), scale)}


def result(columns, cuts=160, exercise=EXERCISE):
    return judged(exercise, columns, cuts, second_device=True).finish()


def test_a_device_that_shows_the_loss_lets_the_attempt_pass():
    made = result(on_device())
    (gave,) = made.metrics.yields
    assert made.passed and not made.withheld, made.reasons
    assert gave.loss.before == pytest.approx(min(3.3, gave.push), abs=0.02)
    assert gave.loss.needed == pytest.approx(0.1 * gave.loss.before) and gave.loss.drop > gave.loss.needed
    assert gave.loss.model_after == pytest.approx(gave.loss.after, abs=0.05)


def test_the_batches_do_not_matter():
    columns = on_device()
    (whole,) = result(columns, 100_000).metrics.yields
    near = cuts_near(whole.time, EXERCISE.scene.servo.rate, len(columns["tick"]))
    assert result(columns, near).metrics.yields == [whole]


@pytest.mark.parametrize(
    ("scale", "most", "newtons", "drop", "why"),
    [
        (
            0.02,
            3.3,
            4.0,
            "0.06 N",
            "Push the plunger harder before it gives way, or set a larger force_scale in the scene.",
        ),
        (1.0, 0.05, 4.0, "none", "Its limits cut the force to 0.05 of 4.0"),
        (1.0, 0.0, 4.0, "none", "The thumb had no force: turn the force on"),
    ],
)
def test_a_loss_that_no_thumb_could_feel_is_not_passed_and_the_reason_is_told(scale, most, newtons, drop, why):
    made = result(on_device(scale, most, newtons))
    assert {each.state for each in made.goals} == {"met"} and not made.passed
    assert made.verdict.startswith(f"not judged as passed: the device could not show the loss of resistance ({drop};")
    (refusal,) = [reason for reason in made.reasons if reason.startswith("Not judged as passed")]
    assert (
        "the second device could not show the loss of resistance of the plunger" in refusal
        and f"({drop};" in refusal
        and why in refusal
    )


def test_a_limit_that_falls_is_no_loss_of_resistance():
    columns = on_device()
    (gave,) = result(columns).metrics.yields
    falling = np.where(columns["time"] < gave.time, -3.3, -0.3)
    felt = np.maximum(columns["thumb_felt"], falling)
    (cut,) = result(columns | {"thumb_felt": felt}).metrics.yields
    assert cut.loss.drop < 0.01 and not cut.loss.felt


def test_a_limit_that_cuts_for_a_while_is_no_loss_of_resistance_either():
    """At first less is given than the model has, and then the model falls to it: the thumb has felt next to nothing."""
    columns = on_device()
    (gave,) = result(columns).metrics.yields
    cuts = (columns["time"] > gave.time - 0.1) & (columns["time"] < gave.time + 0.05)
    least = -columns["thumb_felt"][columns["time"] >= gave.time].max()
    felt = np.where(cuts, np.maximum(columns["thumb_felt"], -(least + 0.03)), columns["thumb_felt"])
    (cut,) = result(columns | {"thumb_felt": felt}).metrics.yields
    assert gave.loss.felt and not cut.loss.felt and cut.loss.before < least + 0.06


def test_a_short_window_of_the_volume_does_not_shorten_that_of_the_thumb(tmp_path):
    file = tmp_path / "short.toml"
    window = goal("stop_plunger", within_mL=2, seconds=0.01)
    file.write_text(HEAD + goal("feel_plunger", at_least_N=2) + window + goal("reach"))
    long, short = (result(on_device(lets_go=0.25), exercise=one) for one in (EXERCISE, load_exercise(file)))
    assert short.metrics.yields[0].loss == long.metrics.yields[0].loss and short.passed, short.reasons


@pytest.mark.parametrize(("scale", "most", "newtons"), [(0.055, 0.08, 3.5), (0.055, 3.3, 2.2), (1.0, 0.3, 4.0)])
def test_a_thumb_that_is_drawn_back_does_not_make_the_loss_that_the_device_could_not_show(scale, most, newtons):
    columns = on_device(scale, most, newtons, lets_go=0.03, draws=50e-3)
    made = result(columns)
    (gave,) = made.metrics.yields
    first = np.searchsorted(columns["time"], gave.time)
    drawn = columns["thumb_felt"][first : first + 450]  # the device pulls the thumb that is drawn back
    assert gave.loss.before - -drawn.max() > gave.loss.needed
    assert {each.state for each in made.goals} == {"met"}
    assert not made.passed and not gave.loss.felt and gave.loss.after > 0, gave.loss


def test_a_thumb_that_is_drawn_back_between_the_wall_and_the_flow_makes_no_loss_either():
    columns = on_device()
    (gave,) = result(columns).metrics.yields
    thumb = columns["thumb"].copy()
    thumb[np.searchsorted(columns["time"], gave.time)] += 2e-3  # the point comes out behind the wall in this tick
    (drawn,) = result(columns | {"thumb": thumb}).metrics.yields
    assert drawn.time == gave.time and drawn.loss.after > gave.loss.after + 0.3


def test_whoever_draws_the_thumb_back_is_told_to_keep_it():
    made = result(on_device(0.055, 3.3, 2.2, lets_go=0.03, draws=50e-3))
    assert "The thumb was drawn back: keep it on the plunger until it gives way." in " ".join(made.reasons)
    assert "drawn back" not in " ".join(result(on_device(0.055, 3.3, 2.2)).reasons)


def test_a_strong_device_shows_the_loss_also_to_a_thumb_that_is_drawn_back():
    assert result(on_device(lets_go=AT_ONCE, draws=50e-3)).passed


def test_a_key_feels_nothing_and_is_judged_by_the_models_force():
    made = judged(EXERCISE, pushed(4.0)).finish()
    assert made.passed and made.metrics.yields[0].loss is None


def test_the_verdict_waits_until_a_thumb_could_react(tmp_path):
    file = tmp_path / "feel.toml"
    file.write_text(HEAD + goal("feel_plunger", at_least_N=2) + goal("reach"))
    exercise, columns = load_exercise(file), on_device()
    (gave,) = result(columns, exercise=exercise).metrics.yields
    now = int(np.searchsorted(columns["time"], gave.time)) + 3
    attempt = judged(exercise, {k: v[:now] for k, v in columns.items()}, second_device=True)
    assert attempt.over and "Not judged" not in attempt.status.instruction  # the loss has only begun
    assert not attempt.passed and "Not judged" in " ".join(attempt.finish().reasons)  # nobody has seen more
    attempt.add({k: v[now:] for k, v in columns.items()})
    assert attempt.passed and "Not judged" not in " ".join(attempt.finish().reasons)


@pytest.mark.parametrize(
    ("scale", "thumb", "expected"),
    [
        (1.0, OMNI, ""),
        (1.0, None, "The thumb is a key here and feels nothing"),
        (1.0, ForceLimits(0.05, 0.05), "The second device cannot show that the plunger gives way (0.00 N at best; 0.1"),
        (0.005, OMNI, "The second device cannot show that the plunger gives way (0.07 N at best; 0.1 N needed)"),
        (0.05, OMNI, "At the force scale of 0.05, push the plunger with clearly more than 2.5 N"),
    ],
)
def test_the_list_says_before_the_start_what_the_thumb_cannot_feel(scale, thumb, expected):
    scene = SCENE.replace(display=DisplaySettings(scale))
    warning = thumb_cannot_show(EXERCISE, scene, OMNI, thumb)
    assert warning.startswith(expected) and bool(warning) == bool(expected), warning


def test_the_push_that_is_named_before_the_start_is_no_more_than_what_is_needed():
    """At a scale of 0.05, 2.5 N are named; the flow into the space needs some pressure, so a thumb needs more."""
    assert not result(on_device(0.05, newtons=2.5)).passed
    assert result(on_device(0.05, newtons=4.0)).passed


@pytest.mark.parametrize("second", [True, False])
def test_a_recording_says_whether_the_thumb_was_on_a_second_device(tmp_path, monkeypatch, second):
    devices = []

    def attempt(exercise, scene, second_device, simulated):
        devices.append((second_device, simulated))
        return Attempt(exercise, scene, second_device, simulated)

    monkeypatch.setattr(sys.modules["punctura.exercise.load"], "Attempt", attempt)
    device = SimulatedDevice(Target([0, 6e-3, 0]))
    thumb = ThumbLoop(SimulatedDevice(Target([0, 0, 0]))) if second else None
    file = tmp_path / "run.parquet"
    with ServoLoop(device, SCENE, thumb=thumb) as loop, Recorder(loop, file, thumb=thumb):
        loop.start()
        wait_until(lambda: len(loop.latest()))
        loop.stop()
    assert not score(file, EXERCISE).passed and devices == [(second, True)]


def test_exercises_without_the_plunger_say_nothing_about_the_thumb():
    for name in set(exercise_names()) - {NAME}:
        exercise = load_exercise(name)
        assert thumb_cannot_show(exercise, exercise.scene, OMNI, None) == ""

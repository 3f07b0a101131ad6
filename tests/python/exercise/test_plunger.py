"""The thumb on the plunger: when it gives way, the two goals that judge it, and what the coach says about it."""

import numpy as np
import pytest
from attempts import cuts_near, goal, hand_run, judged
from plunger_runs import AT_ONCE, HEAD, LEGS, NAME, NEVER, SCENE, SLOWLY, pushed, with_thumb
from punctura import ConfigurationError
from punctura.exercise import load_exercise
from punctura.exercise.results import to_csv

FEEL, STOP, STAY = goal("feel_plunger", at_least_N=2), goal("stop_plunger", within_mL=2), goal("stay", seconds=3)


def attempted(begins_mm=30.0, newtons=4.0, lets_go=AT_ONCE, exercise=NAME, cuts=160):
    return judged(load_exercise(exercise), pushed(newtons, lets_go, begins_mm=begins_mm), cuts)


def states(result):
    return {each.text.split(":")[0].split(" in the ")[0]: each.state for each in result.goals}


def about(remarks):
    return {remark.about: remark for remark in remarks}


def test_a_thumb_that_pushes_and_lets_go_passes():
    result = attempted().finish()
    assert result.passed, result.reasons
    assert set(states(result).values()) == {"met"}
    (gave,) = result.metrics.yields
    assert 3 < gave.push < 4 and 0 < gave.injected < 1e-6 and gave.seconds == 1
    assert any(text.startswith("The plunger gave way under 4.0 N") for text in result.reasons)
    assert about(result.coaching.good)["plunger"].text.startswith(
        "You let the plunger go well: only 1.0 mL after it gave way; 2.0 mL are"
    )


def test_the_plunger_gives_way_when_the_point_comes_into_the_space():
    columns = hand_run("epidural", LEGS)
    (gave,) = attempted().finish().metrics.yields
    past = columns["depth"][:, 4] - SCENE.membranes[4].membrane.thickness
    first = columns["time"][np.flatnonzero((past > 0) & (columns["phase"][:, 4] > 0))[0]]
    assert 0 <= gave.time - first < 5e-3


def test_the_batches_do_not_matter():
    columns = pushed(lets_go=SLOWLY)
    whole = judged(load_exercise(NAME), columns, 100_000).finish()
    near = cuts_near(whole.metrics.yields[0].time, SCENE.servo.rate, len(columns["tick"]))
    other = judged(load_exercise(NAME), columns, near).finish()
    assert other.metrics.yields == whole.metrics.yields != []
    assert other.goals == whole.goals


def test_a_thumb_that_pushes_on_fails_and_is_told_its_force_and_the_volume():
    result = attempted(lets_go=NEVER).finish()
    assert not result.passed and states(result)["Inject no more than 2 mL"] == "missed"
    assert result.reasons[0].startswith("You injected more than 2 mL in the 1 s after the plunger gave way")
    remark = about(result.coaching.change)["plunger"]
    assert remark.text.startswith("You still pushed the plunger with ") and "0.3 s after it gave way" in remark.text
    assert remark.numbers["injected_m3"] > remark.numbers["allowed_m3"] == 2e-6


def test_while_the_plunger_gives_way_the_instruction_is_to_let_it_go_until_the_thumb_rests():
    columns = pushed(lets_go=SLOWLY, draws=0.1)
    (gave,) = judged(load_exercise(NAME), columns).finish().metrics.yields

    def told(seconds):
        until = int(np.searchsorted(columns["time"], gave.time + seconds))
        return judged(load_exercise(NAME), {k: v[:until] for k, v in columns.items()}).status.instruction

    assert told(0.1) == "The plunger gives way: let it go, and stop."
    assert not any("let it go" in told(seconds) for seconds in (-0.1, 0.5))


def test_a_thumb_that_rests_does_not_pass_and_is_told_to_go_back_and_push():
    attempt = attempted(newtons=0.0)
    assert not attempt.over
    beginning = "Draw back into the ligamentum flavum, push the plunger with at least 2 N, and go on."
    assert attempt.status.instruction == beginning
    result = attempt.finish()
    assert "you pushed it with 0.0 N when the point came out behind the ligamentum flavum" in " ".join(result.reasons)
    assert result.metrics.yields == []
    assert "at least 2 N are asked" in about(result.coaching.change)["plunger"].text


def test_a_thumb_that_begins_in_the_space_has_felt_no_loss():
    result = attempted(begins_mm=50.0).finish()
    assert not result.passed and result.metrics.yields == []


def test_a_syringe_that_is_emptied_in_the_air_is_told_at_once_and_at_the_end():
    columns = pushed(lets_go=NEVER, begins_mm=-10.0)
    beginning = "The syringe is empty: end this attempt and try again. Push the plunger only in the tissue in front of"
    before_the_skin = {name: values[:1600] for name, values in columns.items()}
    assert judged(load_exercise(NAME), before_the_skin).status.instruction.startswith(beginning)
    attempt = judged(load_exercise(NAME), columns)
    assert not attempt.over and attempt.status.instruction.startswith(beginning)
    result = attempt.finish()
    assert "The syringe was empty before the plunger could give way behind the ligamentum flavum." in result.reasons
    remark = about(result.coaching.change)["plunger"]
    assert remark.text.startswith("You emptied the syringe before the plunger could give way")
    assert remark.numbers["injected_m3"] == pytest.approx(3.2e-6, rel=0.01)


def test_a_thumb_that_pushes_too_little_is_told_both_forces():
    result = attempted(newtons=1.4).finish()
    assert not result.passed
    remark = about(result.coaching.change)["plunger"]
    assert 1.0 < remark.numbers["push_N"] < 1.4 and remark.numbers["asked_N"] == 2


def test_drawing_back_into_the_flavum_gives_a_second_try():
    legs = (*LEGS[:3], (1.0, 58.3), (3.0, 46.0), (3.0, 58.3), (6.0, 58.3))
    columns = hand_run("epidural", legs)
    half = int(np.searchsorted(columns["time"], 15.5))  # the thumb rests until the needle was drawn back
    first = {k: v[:half] for k, v in columns.items()}
    rest = {k: v[half:] for k, v in columns.items()}
    again = with_thumb(rest, 30.0, 4.0, AT_ONCE)
    joined = {k: np.concatenate([first.get(k, np.zeros(half)), again[k]]) for k in again}
    result = judged(load_exercise(NAME), joined).finish()
    assert result.passed, result.reasons
    assert len(result.metrics.yields) == 1 and result.metrics.yields[0].time > 15.5


def test_a_recording_without_a_thumb_is_not_judged_as_passed():
    result = judged(load_exercise(NAME), hand_run("epidural", LEGS)).finish()
    assert not result.passed and result.metrics.yields == []
    assert "not at all" in " ".join(result.reasons)


def test_the_limit_alone_is_not_measured_if_the_plunger_never_gives_way(tmp_path):
    file = tmp_path / "one.toml"
    file.write_text(HEAD + STOP + STAY)
    result = attempted(newtons=0.0, exercise=file).finish()
    assert not result.passed and result.verdict == "not judged as passed: not everything was measured"
    assert "because the plunger never gave way" in " ".join(result.reasons)


@pytest.mark.parametrize("kind", [FEEL, STOP])
def test_a_scene_without_a_syringe_is_refused(tmp_path, kind):
    file = tmp_path / "dry.toml"
    head = HEAD.replace('scene = "epidural"', 'scene = "venipuncture"').replace("ligamentum flavum", "front vein wall")
    file.write_text(head.replace('"dura"', '"back vein wall"').replace("press_mm = 1.5", "") + kind + STAY)
    with pytest.raises(ConfigurationError, match="needs a scene with a syringe"):
        load_exercise(file)


def test_a_running_scene_without_a_syringe_is_refused():
    with pytest.raises(ConfigurationError, match="has no syringe"):
        judged(load_exercise(NAME), {}, scene=SCENE.replace(syringe=None))


@pytest.mark.parametrize(
    ("wrong", "path", "reason"),
    [
        (goal("stop_plunger", within_mL=1e-9), "within_mL", "must be at least 0.01 mL"),
        (goal("stop_plunger", within_mL=101), "within_mL", "must be at most 100 mL"),
        (goal("stop_plunger", within_ml=1), "within_ml", "unknown key; did you mean within_mL?"),
        (goal("feel_plunger", at_least_N=0.01), "at_least_N", "must be at least 0.1 N"),
        (goal("feel_plunger", at_least_N=15.1), "at_least_N", "must be at most 15 N"),
    ],
)
def test_an_unreasonable_number_or_unit_is_refused(tmp_path, wrong, path, reason):
    file = tmp_path / "wrong.toml"
    file.write_text(HEAD + wrong + STAY)
    with pytest.raises(ConfigurationError) as error:
        load_exercise(file)
    assert reason in {p.reason for p in error.value.problems if p.path == f"goal[0].{path}"}


def test_the_table_of_results_has_the_plunger():
    table = to_csv([attempted().finish()]).splitlines()
    assert table[0].endswith("plunger_push_N,plunger_felt_drop_N,injected_mL")
    push, felt, injected = table[1].rsplit(",", 3)[1:]
    assert 3 < float(push) < 4 and felt == "" and 0 < float(injected) < 1


def with_second_device(scale):
    columns = pushed()
    return columns | {
        "thumb_felt": scale * columns["thumb_force"],
        "force_scale": np.full(len(columns["tick"]), scale),
    }


def test_a_loss_that_the_second_device_shows_is_measured_and_passes():
    result = judged(load_exercise(NAME), with_second_device(0.5), second_device=True).finish()
    assert result.passed, result.reasons
    (gave,) = result.metrics.yields
    assert gave.loss.before == pytest.approx(0.5 * gave.push) and 0.5 < gave.loss.drop < gave.loss.before
    assert gave.loss.needed == pytest.approx(0.1 * gave.loss.before)
    assert float(to_csv([result]).splitlines()[1].rsplit(",", 2)[1]) == pytest.approx(gave.loss.drop, rel=1e-5)


def test_a_loss_that_the_second_device_cannot_show_is_not_passed_and_says_why():
    result = judged(load_exercise(NAME), with_second_device(0.03), second_device=True).finish()
    assert not result.passed and set(states(result).values()) == {"met"}
    (gave,) = result.metrics.yields
    assert 0.02 < gave.loss.drop < 0.1 == gave.loss.needed
    beginning = "Not judged as passed: the second device could not show the loss of resistance of the plunger (0.0"
    assert [reason for reason in result.reasons if reason.startswith(beginning)]
    assert result.verdict.startswith("not judged as passed: the device could not show the loss of resistance (0.0")

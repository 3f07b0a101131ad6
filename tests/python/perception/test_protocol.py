"""Protocol files: what is wrong is said at once, with its place, before a person sits down."""

import re
from pathlib import Path

import numpy as np
import punctura as pn
import pytest
from protocols import ADJUST, COMPARES, RIGHT, SOLVED, YES, written
from punctura import ConfigurationError
from punctura._core import Experiment, Fault, ForceLimits, ServoState, Strokes
from punctura.live import stroke_ends
from punctura.perception import Observer, Simulation, load_protocol, protocol_names
from punctura.perception.analysis import person
from punctura.perception.course import Course
from punctura.perception.load import check_device
from punctura.perception.stimulus import Spoilt, _felt, faulted, simulated
from punctura.ticks import Ticks


def problems(folder: Path, text: str) -> dict[str, str]:
    with pytest.raises(ConfigurationError) as found:
        load_protocol(written(folder, text))
    return {problem.path: problem.reason for problem in found.value.problems}


def test_all_problems_of_a_protocol_at_once(tmp_path: Path) -> None:
    text = (
        COMPARES.replace('"membrane[0].precompression"', '"membrane[0].precompresion"')
        .replace("per_level = 20", "per_level = 2\ncatch = 3")
        .replace("[trials]", '[answers]\nfirst = "a"\nsecond = "A"\n[trials]')
    )
    found = problems(tmp_path, text)
    assert found.keys() == {"answers.second", "trials.per_level", "trials.catch_level", "stimulus.variable"}
    assert "is the key of first, too" in found["answers.second"]
    assert found["trials.per_level"].startswith("12 trials are too few for the fit")
    assert "did you mean membrane[0].precompression?" in found["stimulus.variable"]
    text = SOLVED.replace("0.35]", "2.5]").replace("[stimulus]", 'seed = "x"\n[stimulus]').replace("= 20", "= 2")
    found = problems(tmp_path, text.replace("title", "titel"))  # also beside what the schema refuses
    assert found.keys() == {"seed", "title", "titel", "trials.per_level", "stimulus.levels[2]"}
    text = COMPARES.replace('method = "constant"\ntask = "two_intervals"\nseed = 3', "seed = -1\npicture = 1")
    text = re.sub(r"levels = .*", 'levels = ["x"]\nsolve = "thickness"', text).replace("blocks = 2", "blocks = 0")
    found = problems(tmp_path, text + 'break_s = 0\n[words]\nlast = "{x}"\n[values]\n"needle.x" = 1\n')
    wanted = ["method", "task", "seed", "picture", "trials.blocks", "trials.break_s", "words.last", 'values."needle.x"']
    assert found.keys() == {*wanted, "stimulus.levels", "stimulus.solve"}  # each key by itself
    text = re.sub("levels = .*", "levels = [1, 1]\nreference = 3", YES)  # wrong levels hide no other problem
    assert problems(tmp_path, text).keys() == {"stimulus.levels", "stimulus.reference"}
    text = (
        re.sub("levels = .*", "levels = [1, 1]", YES).replace('"yes_no"', '"rating"').replace('"constant"', '"quest"')
    )
    assert problems(tmp_path, text).keys() >= {"stimulus.levels", "task"}
    text = re.sub(r"\[trials\](\n\w.*)*", "", YES)
    assert problems(tmp_path, "trials = 3\n" + text).keys() == {"trials"}


@pytest.mark.parametrize(
    ("base", "old", "new", "path", "words"),
    [
        (COMPARES, "reference = 0.41", "", "stimulus.reference", "needs a reference"),
        (YES, "[trials]", "reference = 1\n[trials]", "stimulus.reference", "is not for yes_no, of one interval"),
        (COMPARES, '"constant"', '"staircase"', "trials.per_level", "give total"),
        (COMPARES, "blocks = 2", "blocks = 3", "trials.blocks", "must divide per_level"),
        (COMPARES, "[trials]", "[trials]\nbreak_s = nan", "trials.break_s", "more than 0"),
        (RIGHT.replace('"quest"', '"staircase"'), "[trials]", "[trials]\nup = 1", "trials.up", "guessing gives"),
        (COMPARES, "levels = [0.2,", "levels = [0.9,", "stimulus.levels", "larger than the one before"),
        (COMPARES, "levels = [0.2,", "levels = [nan,", "stimulus.levels", "larger than the one before"),
        (YES, "levels = [0.0005,", "levels = [-0.0005,", "stimulus.levels[0]", "must be"),
        (YES, "catch_level = 0.012", "catch_level = -1", "trials.catch_level", "must be"),
        (RIGHT, "[trials]", "[trials]\ncatch = 9\ncatch_level = 0.2", "trials.catch_level", "where the levels are"),
        (YES, '"yes_no"', '"magnitude"\nanswers = {yes = "y"}', "answers.yes", "magnitude: a number is typed"),
        (YES, '"yes_no"', '"rating"', "task", "without catch trials"),
        (YES, "[trials]", '[words]\nrest = "{minutes} min"\n[trials]', "words.rest", "may have {seconds}, and no"),
        (YES, "[trials]", '[words]\nrest = "{seconds.upper} s"\n[trials]', "words.rest", "may have {seconds}, and no"),
        (YES, "[trials]", '[words]\nlast = "Done }"\n[trials]', "words.last", "may have no braces"),
        (YES, "[trials]", '[words]\nwait = " "\n[trials]', "words.wait", "leave it out for English"),
        (YES, "[trials]", '[words]\nno = "yes"\n[trials]', "words.no", "is what yes reads, too"),
        (ADJUST, "reference = 0.41", "reference = 0.1", "stimulus.reference", "between the levels"),
        (ADJUST, 'task = "adjustment"', 'task = "two_intervals"', "method", "both be adjustment"),
        (SOLVED, "0.35]", "2.5]", "stimulus.levels[2]", "no scene gives 2.5 N"),
        (SOLVED, "between = [0.0, 1.5]", "", "stimulus.between", "is missing"),
        (SOLVED, "between = [0.0, 1.5]", "between = [1.5, 0]", "stimulus.between", "the smaller one first"),
        (SOLVED, "between = [0.0, 1.5]", "between = [0, inf]", "stimulus.between", "must be two finite numbers"),
        (SOLVED, "between = [0.0, 1.5]", "between = [nan, 1]", "stimulus.between", "must be two finite numbers"),
        (SOLVED, "between = [0.0, 1.5]", "between = [-3, 1.5]", "stimulus.between", "must be 0 or more"),
        (YES, "catch_level = 0.012", "catch_level = 0.0003", "trials.catch_level", "lack what is asked for"),
        (COMPARES, "Which one fell more?", " ", "question", "must not be empty"),
        (COMPARES, "[stimulus]", 'picture = "yes"\n[stimulus]', "picture", "must be true or false"),
        (COMPARES, "[trials]", 'membrane = "skin"\n[trials]', "stimulus.membrane", "thin membrane"),
        (COMPARES, '"k06-fig10"', '"no-such.toml"', "scene", "no such file"),
        (COMPARES, '"k06-fig10"', '"epidural"', "scene: display.force_scale", "each level has another scale"),
    ],
)  # fmt: skip
def test_a_problem_has_its_place_and_its_remedy(
    tmp_path: Path, base: str, old: str, new: str, path: str, words: str
) -> None:
    found = problems(tmp_path, base.replace(old, new).replace("[trials]\n[trials]", "[trials]"))
    assert words in found[path]


def test_a_variable_that_changes_nothing_is_refused(tmp_path: Path) -> None:
    text = COMPARES.replace("membrane[0].precompression", "membrane[0].point[2]")
    assert "no level changes the drop" in problems(tmp_path, text)["stimulus.levels"]


def test_a_wanted_drop_is_what_a_hand_feels(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, SOLVED))
    for one in protocol.stimuli:
        assert simulated(one.scene, protocol.membrane).drop == pytest.approx(one.level, rel=0.02)


def test_a_device_that_cannot_show_a_level_is_refused(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, COMPARES + '[values]\n"display.force_scale" = 0.8\n'))
    check_device(protocol, ForceLimits())
    with pytest.raises(ConfigurationError, match=r"levels\[5\] = 0\.62: needs 0\.\d\d N, and this device gives"):
        check_device(protocol, ForceLimits(max_force=0.8, continuous_force=0.8))


@pytest.mark.parametrize("name", protocol_names())
def test_the_ready_protocols_run_on_observers(name: str) -> None:
    protocol = load_protocol(name)
    assert protocol.file.source and protocol.file.consent and protocol.file.instruction
    assert len(Course(protocol, 0)) >= 40
    check_device(protocol, ForceLimits())
    simulation = Simulation(protocol, Observer(weber=0.0, noise=0.0008 if name == "chatter" else 0.02))
    found = person(protocol, "", simulation.run(0, 1))
    assert found.reason == "" and found.trials >= 40
    if protocol.rates:
        step = simulation.criterion  # N for one point, between the ends of the scale
        assert found.slope is not None and 0.7 / step < found.slope.value < 1.1 / step
    else:
        truth = simulation.threshold()
        assert found.threshold is not None and found.threshold.value == pytest.approx(truth, rel=0.35)


@pytest.mark.parametrize("fault", Fault)
def test_a_fault_is_told_without_the_reset_that_going_on_does(fault: Fault) -> None:
    assert "reset" not in str(faulted(fault))


def test_a_force_that_goes_off_in_the_tissue_is_not_one_that_was_not_on_yet() -> None:
    scene = pn.load_scene("k06-fig10")
    ticks = Experiment(scene, Strokes(*stroke_ends(scene), count=1, duration=1.0, rest=0.3)).run(1.4)
    inside = np.flatnonzero(ticks.depth[:, 0] > 0)
    for first, word in ((inside[0], "weak"), (inside[100], "off")):
        state = ticks.state.copy()
        state[first : first + 200] = ServoState.waiting.value
        with pytest.raises(Spoilt) as why:
            _felt(Ticks({**ticks, "lost": np.zeros(len(ticks), np.uint32), "state": state}), scene, 0, 0.0)
        assert why.value.word == word

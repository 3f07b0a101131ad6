"""Limits files, and their use by the command line."""

import json
import re
from pathlib import Path

import numpy as np
import punctura as pn
import pytest
from punctura._core import DeviceInfo, FedDevice, ForceLimits, GateLimits, ServoLoop, SimulatedDevice, ThumbLoop
from punctura.live import RunLimits, load_limits, run_live
from punctura.live.summary import strongest
from punctura.simulation import Strokes, Target

ALL = """
max_force_N = 0.5
continuous_force_N = 0.3
continuous_time_s = 7
ramp_time_s = 0.25
warm_motor = 0.7
max_speed_m_per_s = 3.2
stale_ms = 10
deadline_ms = 12.5
axis_tolerance = 0.01
dead_man_buttons = [1, 3]
"""
SCENE = pn.load_scene("k06-fig10")


def limits_of(tmp_path, text):
    path = tmp_path / "limits.toml"
    path.write_text(text)
    return load_limits(path)


def with_buttons(count):
    return FedDevice(rate=1600, info=DeviceInfo(model="a stylus", button_count=count))


def test_a_file_sets_every_limit_in_the_units_of_its_keys(tmp_path):
    limits = limits_of(tmp_path, ALL)
    assert limits.force == ForceLimits(0.5, 0.3, 7, 0.25, 0.7)
    assert limits.gate_on(with_buttons(3)) == GateLimits(3.2, 0.010, 0.0125, 0.01, 0b101)


def test_the_example_in_the_docs_is_a_limits_file(tmp_path):
    text = (Path(__file__).parents[3] / "docs" / "safety.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"^```toml limits.*?\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    limits = limits_of(tmp_path, example)
    assert limits.force == ForceLimits(max_force=0.5, continuous_force=0.3)
    assert limits.gate_on(with_buttons(1)) == GateLimits(dead_man=0b1)


def test_what_a_file_leaves_out_is_what_the_device_has_by_default(tmp_path):
    simulated = SimulatedDevice(Target([0, 5e-3, 0]))
    limits = limits_of(tmp_path, "max_speed_m_per_s = 3.2")
    assert limits.force == ForceLimits()
    assert limits.gate_on(simulated) == GateLimits(max_speed=3.2, stale=1.0, deadline=1.0)
    assert limits.gate_on(with_buttons(0)) == GateLimits(max_speed=3.2)
    assert RunLimits().gate_on(with_buttons(0)) == GateLimits()


def test_all_that_is_wrong_is_told_at_once_by_the_files_own_names(tmp_path):
    with pytest.raises(pn.ConfigurationError) as error:
        limits_of(tmp_path, "max_force_N = -1\nstale_ms = 0\nwarm_motor = 1.0\n")
    wrong = {p.path: p.value for p in error.value.problems}
    assert wrong["max_force_N"] == -1 and wrong["stale_ms"] == 0
    with pytest.raises(pn.ConfigurationError) as error:
        limits_of(tmp_path, 'max_force = 1\nramp_time_s = "long"\ndead_man_buttons = [0]\nwarm_motor = true\n')
    assert [p.path for p in error.value.problems] == ["max_force", "ramp_time_s", "dead_man_buttons", "warm_motor"]
    reasons = [p.reason for p in error.value.problems]
    assert reasons[0] == "unknown key; did you mean max_force_N?" and reasons[1] == "must be a number (s)"
    assert reasons[2:] == ["must be a list of buttons, each 1 to 32", "must be a number"]
    for text, reason in (
        ("max_force_N = ", "is not TOML"),
        ("max_force_N = inf", "finite"),
        ("deadline_ms = nan", "finite"),
    ):
        with pytest.raises(pn.ConfigurationError, match=reason):
            limits_of(tmp_path, text)


def test_what_the_core_refuses_is_told_together_with_what_does_not_fit(tmp_path):
    with pytest.raises(pn.ConfigurationError) as error:
        limits_of(tmp_path, 'max_force_N = nan\nfoo = 1\nramp_time_s = "a"\nstale_ms = -1\n')
    assert {p.path for p in error.value.problems} == {"max_force_N", "foo", "ramp_time_s", "stale_ms"}


def test_a_limit_shorter_than_a_period_of_the_device_is_refused(tmp_path):
    limits = limits_of(tmp_path, "deadline_ms = 0.5\nstale_ms = 0.7")
    with pytest.raises(
        pn.ConfigurationError, match=r"(?s)limits.toml: .*deadline_ms = 0.5: a period of a stylus is longer, 0.625 ms"
    ):
        limits.gate_on(with_buttons(0))


def test_a_dead_man_button_that_the_device_does_not_have_is_refused(tmp_path):
    limits = limits_of(tmp_path, "dead_man_buttons = [3]")
    assert limits.gate_on(with_buttons(3)).dead_man == 0b100
    for device, words in (
        (with_buttons(2), r"dead_man_buttons = \[3\]: a stylus has 2 buttons: it can never be held; state the"),
        (with_buttons(0), "a stylus has no buttons"),
        (with_buttons(1), r"dead_man_buttons = \[3\]: a stylus has 1 button:"),
        (SimulatedDevice(Target([0, 5e-3, 0])), "PHANTOM Omni, simulated has 1 button:"),
    ):
        with pytest.raises(pn.ConfigurationError, match=words):
            limits.gate_on(device)


def test_the_command_line_bounds_the_force(punctura, tmp_path):
    path = tmp_path / "limits.toml"
    path.write_text("max_force_N = 0.6\nramp_time_s = 0.01\n")
    run = (
        "run",
        "k06-fig10",
        "--headless",
        "--device",
        "simulated",
        "--duration",
        "2.5",
        "--json",
        "--limits",
        str(path),
    )
    peaks = {}
    for name, more in {"file": (), "option": ("--max-force-N", "0.4")}.items():
        done = punctura(*run, *more)
        assert done.status == 0, done.stderr
        result = json.loads(done.stdout)
        peaks[name] = result["felt_peak_N"]
        assert result["limited_ticks"] > 0
    assert peaks == {"file": 0.6, "option": 0.4}
    assert ", at most 0.4 N, 0.88 N rms in any 10 s; " in done.stderr


def test_a_force_above_the_devices_rating_is_told_with_both_numbers(tmp_path):
    limits = limits_of(tmp_path, "max_force_N = 5\ncontinuous_force_N = 2.5")
    weak = SimulatedDevice(Target([0, 5e-3, 0]))
    loop = ServoLoop(weak, SCENE, limits.gate_on(weak), limits.force)
    assert loop.limits.max_force == 3.3
    assert limits.notes(loop) == [
        "max_force_N = 5 is above the rating of PHANTOM Omni, simulated: 3.3 N is the limit",
        "continuous_force_N = 2.5 is above the rating of PHANTOM Omni, simulated: 0.88 N is the limit",
    ]
    assert [note.split()[2] for note in RunLimits().at_most(3.5).notes(loop)] == ["3.5"]


def test_a_force_that_was_not_chosen_or_is_within_the_rating_is_not_told():
    weak = FedDevice(rate=1600, info=DeviceInfo(model="a stylus", max_force=1.0))
    loop = ServoLoop(weak, SCENE)
    assert loop.limits.max_force == 1.0
    assert RunLimits().notes(loop) == RunLimits().at_most(1.0).notes(loop) == []


def test_the_long_run_limit_cannot_be_stretched_until_it_limits_nothing(tmp_path):
    with pytest.raises(pn.ConfigurationError, match="at most 60 s"):
        limits_of(tmp_path, "continuous_time_s = 1e6")
    weak = SimulatedDevice(Target([0, 5e-3, 0]))
    longer = limits_of(tmp_path, "continuous_time_s = 30")
    loop = ServoLoop(weak, SCENE, longer.gate_on(weak), longer.force)
    assert any("continuous_time_s = 30 lets strong forces last longer" in note for note in longer.notes(loop))
    shorter = limits_of(tmp_path, "continuous_time_s = 5")
    assert shorter.notes(ServoLoop(weak, SCENE, shorter.gate_on(weak), shorter.force)) == []


def test_a_longer_deadline_than_the_budget_has_room_for_is_told(tmp_path):
    longer, usual = limits_of(tmp_path, "deadline_ms = 50"), limits_of(tmp_path, "deadline_ms = 20")
    mine = FedDevice(rate=1600, info=DeviceInfo(model="a stylus", max_force=1.0))
    notes = [limits.notes(ServoLoop(mine, SCENE, limits.gate_on(mine), limits.force)) for limits in (longer, usual)]
    assert ["deadline_ms = 50 lets the device hold" in note for note in notes[0]] == [True] and notes[1] == []
    simulated = SimulatedDevice(Target([0, 5e-3, 0]))
    loop = ServoLoop(simulated, SCENE, longer.gate_on(simulated), longer.force)
    assert longer.notes(loop) == [] and longer.notes(loop, ThumbLoop(mine)) == notes[0]


def test_a_run_without_any_force_says_why(punctura, tmp_path):
    path = tmp_path / "limits.toml"
    path.write_text("dead_man_buttons = [1]\n")
    done = punctura("run", "--headless", "--device", "simulated", "--duration", "1.5", "--limits", str(path))
    assert done.status == 0
    assert "note: the simulated hand presses no button: with dead_man_buttons it is given no force" in done.stderr
    assert "note: there was no force at any time: the dead-man button was never held, or the tip" in done.stderr
    done = punctura("run", "--headless", "--device", "simulated", "--duration", "1.5", "--json")
    assert json.loads(done.stdout)["force_was_on"] and "no force at any time" not in done.stderr


def test_the_command_line_tells_a_force_above_the_devices_rating(punctura, tmp_path):
    path = tmp_path / "limits.toml"
    path.write_text("max_force_N = 9\n")
    run = ("run", "--headless", "--device", "simulated", "--duration", "0.1")
    for more, asked in ((("--limits", str(path)), "9"), (("--max-force-N", "5"), "5")):
        done = punctura(*run, *more)
        assert done.status == 0
        assert f"note: max_force_N = {asked} is above the rating of PHANTOM Omni, simulated: 3.3 N" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--max-force-N", "0"), "for --max-force-N: must be greater than 0"),
        (("--limits", "nowhere.toml"), "'nowhere.toml' does not exist"),
        (("--limits", "{buttons}"), "it can never be held"),
        (("--port", "8080"), "leave it out with --headless"),
        (("--device", "simulated:another"), "one simulated device only"),
        (("--device", "replay:x.parquet", "--placement", "{buttons}"), "already in the scene's frame"),
    ],
)
def test_limits_that_cannot_be_end_the_command_in_words(punctura, tmp_path, arguments, words):
    path = tmp_path / "limits.toml"
    path.write_text("dead_man_buttons = [2]\n")
    done = punctura("run", "--headless", "--device", "simulated", *(a.format(buttons=path) for a in arguments))
    assert done.status == 2
    assert words in done.stderr and "Traceback" not in done.stderr


def test_the_strongest_force_is_the_ceiling_where_only_rounding_exceeds_it_and_else_as_it_is():
    random = np.random.default_rng(3)
    wanted = random.normal(size=(10_000, 3))
    norm = np.linalg.norm(wanted, axis=1)
    ceiling = np.full(10_000, 0.2)
    force = wanted / norm[:, None] * 0.2  # as the limits do it
    assert np.linalg.norm(force, axis=1).max() > 0.2
    assert strongest(force, ceiling) == 0.2
    assert strongest(force[:1] * 0.5, ceiling[:1]) == pytest.approx(0.1)
    for excess in (1e-14, 1e-6, 1.0):
        assert strongest(force * (1 + excess), ceiling) > 0.2


def test_a_run_keeps_to_a_file_of_limits(tmp_path):
    limits = limits_of(tmp_path, "max_force_N = 0.5")
    strokes = Strokes([0, 5e-3, 0], [0, -10e-3, 0], count=1, duration=1.0, variation=0.0)
    device = SimulatedDevice(strokes, real_time=False, ticks=4000)
    summary = run_live(device, SCENE, gate=limits.gate_on(device), limits=limits.force)
    assert summary.felt_peak_N == pytest.approx(0.5, rel=1e-9)

"""docs/first-hour.md shows what `punctura devices` prints in each state of a device."""

import re

import first_hour
import pytest

STEPS = first_hour.steps(first_hour.PAGE.read_text(encoding="utf-8"))
# Not the service of the Inverse3: other tests would find it at its usual port.
STILL = [step for step in STEPS if step.code.startswith("punctura devices") and step.device != "inverse3"]


@pytest.fixture(scope="module")
def makers(tmp_path_factory):
    folder = tmp_path_factory.mktemp("makers")
    first_hour.build(folder)
    return folder


def test_the_page_has_each_device_in_each_state():
    told = {(step.device, step.state) for step in STEPS}
    each = {(device, state) for device in first_hour.DEVICES for state in first_hour.STATES}
    assert told == each - {("omega", "missing"), ("inverse3", "missing")} | {("touch", s) for s in first_hour.OF_TOUCH}
    assert all(step.printed for step in STEPS)


def test_each_run_on_a_device_has_a_place_a_limit_and_a_force():
    runs = [step for step in STEPS if step.code.startswith("punctura run")]
    assert {run.device for run in runs} == set(first_hour.DEVICES)
    assert {run.state for run in runs if run.device == "touch"} == set(first_hour.WAYS)
    for run in runs:
        limit = 1 if run.state == "strokes" else 0.5
        assert f"--placement placement.toml --max-force-N {limit} " in run.code
        assert 0 < first_hour.strongest_N(run.printed) <= limit


def test_the_force_was_on_when_the_cable_was_pulled():
    [end] = [step.printed for step in STEPS if step.state == "pulled" and step.language == "python"]
    before, after = re.findall(r": ([+-][\d.]+) N", end)
    assert float(before) > 0 and float(after) == 0


@pytest.mark.parametrize("step", STILL, ids=lambda step: f"{step.device}-{step.state}")
def test_the_page_shows_what_the_list_of_devices_prints(step, makers):
    assert first_hour.run(step, makers) == step.printed

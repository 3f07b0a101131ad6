"""docs/first-hour.md shows what `punctura devices` prints in each state of a device."""

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
    assert told >= {(d, s) for d in ("touch", "omega", "inverse3") for s in first_hour.STATES if s != "missing"}
    assert all(step.printed for step in STEPS)


@pytest.mark.parametrize("step", STILL, ids=lambda step: f"{step.device}-{step.state}")
def test_the_page_shows_what_the_list_of_devices_prints(step, makers):
    assert first_hour.run(step, makers) == step.printed

"""A run that has fewer ticks than its duration asks for says why."""

import punctura as pn
import pytest
from punctura.live import SimulatedDevice, run_live
from punctura.live.summary import Ticked
from punctura.simulation import Target

SCENE = pn.load_scene("k06-fig12")
WHOLE = {"duration": 2.0, "rate": 1600.0, "ticks": 3200, "span": 1.999, "late": 0, "longest": 0.7e-3}


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({}, ""),
        ({"ticks": 3180, "span": 1.9875}, ""),
        ({"ticks": 0}, ""),
        ({"ticks": 3000, "late": 40, "longest": 0.03}, "199 were left out because the computer or the device was late "
         "40 times, by up to 0.029 s"),
        ({"ticks": 2000}, "the device ticks at 1001 Hz"),
        ({"ticks": 2880, "span": 1.8}, "for 0.2 s at the beginning or the end the device gave none"),
        ({"ticks": 900, "span": 0.5625, "device_ended": True}, "the device ended after 0.562 s"),
        ({"ticks": 900, "span": 0.5625, "fault": "a jump"}, "the fault ended the run"),
    ],
)  # fmt: skip
def test_the_cause_is_named(changed, said):
    ticked = Ticked(**(WHOLE | changed))
    head = f"{ticked.ticks} ticks came, and 2 s at 1600 Hz are 3200: "
    assert ticked.why_short() == (said and head + said)


def test_a_device_that_ends_before_the_duration_is_named_in_the_summary():
    device = SimulatedDevice(Target([0, 5e-3, 0]), real_time=False, ticks=400)
    summary = run_live(device, SCENE, 2.0)
    assert summary.ticks == 400 and summary.short.startswith("400 ticks came, and 2 s at 1600 Hz are 3200")
    assert "the device ended" in summary.short
    again = SimulatedDevice(Target([0, 5e-3, 0]), real_time=False, ticks=400)
    assert run_live(again, SCENE).short == ""

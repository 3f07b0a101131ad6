"""One base of all exceptions, and what they also are."""

import pytest
from punctura import ConfigurationError, DeviceError, MotionError, Needle, PuncturaError, load_scene
from punctura._core import open_device
from punctura.exercise import ResultsError
from punctura.record import RecordingError, open_recording
from punctura.studio.serve import StudioError


@pytest.mark.parametrize(
    ("own", "usual"),
    [
        (ConfigurationError, ValueError), (MotionError, ValueError), (RecordingError, ValueError),
        (ResultsError, ValueError), (DeviceError, RuntimeError), (StudioError, OSError),
    ],
)  # fmt: skip
def test_each_exception_has_the_base_and_a_usual_one(own, usual):
    assert issubclass(own, PuncturaError) and issubclass(own, usual)


@pytest.mark.parametrize(
    "fails",
    [
        lambda: Needle(-1.0, 0.3),
        lambda: load_scene("k06-fig10").with_values({"needle.diameter": -1.0}),
        lambda: open_device("no such device"),
        lambda: open_recording("/no/such/file.parquet"),
    ],
)
def test_what_goes_wrong_is_caught_by_the_base(fails):
    with pytest.raises(PuncturaError):
        fails()

"""All exceptions have one base class, and each also has a standard base."""

import pickle

import pytest
from punctura import ConfigurationError, Needle, PuncturaError, load_scene
from punctura._core import open_device
from punctura.errors import Problem
from punctura.exercise import ResultsError
from punctura.live import DeviceError
from punctura.record import RecordingError, open_recording
from punctura.simulation import MotionError
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
    "error",
    [
        ConfigurationError([Problem("needle.diameter", -1.0, "must be greater than 0")], "scene.toml"),
        MotionError("in.csv", 7, "is no number"), RecordingError("no file"), ResultsError("no result"),
        DeviceError("no device"), StudioError(98, "in use"),
    ],
    ids=lambda error: type(error).__name__,
)  # fmt: skip
def test_each_survives_pickle_unchanged(error):
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) and vars(again) == vars(error)


@pytest.mark.parametrize(
    "fails",
    [
        lambda: Needle(-1.0, 0.3),
        lambda: load_scene("k06-fig10").with_values({"needle.diameter": -1.0}),
        lambda: open_device("no such device"),
        lambda: open_recording("/no/such/file.parquet"),
    ],
)
def test_the_base_class_catches_every_error(fails):
    with pytest.raises(PuncturaError):
        fails()

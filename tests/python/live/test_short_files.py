"""Limits, placement and exercise files are checked like scene files."""

import os
import sys

import pytest
from punctura import ConfigurationError, load_scene
from punctura.exercise import load_exercise
from punctura.files.toml import MOST_BYTES
from punctura.live import load_limits, load_placement
from punctura.live.limits import RunLimits

READERS = {"limits": load_limits, "placement": load_placement, "exercise": load_exercise, "scene": load_scene}
SOUND = {"limits": "max_force_N = 0.5", "placement": "scale = 0.5"}
FILE_OF = {
    "limits": "a limits file", "placement": "a placement file", "exercise": "an exercise file", "scene": "a scene file"
}  # fmt: skip
every_reader = pytest.mark.parametrize("what", READERS)


@pytest.fixture
def refusal(tmp_path):
    """The error of a reader for a file with this content; it must name the file."""

    def read(what, content, path=None):
        path = path or tmp_path / "file.toml"
        if content is not None:
            path.write_bytes(content)
        with pytest.raises(ConfigurationError) as error:
            READERS[what](path)
        assert str(error.value).startswith(f"{path}: ")
        return str(error.value)

    return read


@every_reader
def test_deep_nesting_is_told_in_words(what, refusal):
    assert "nested more than" in refusal(what, b"a = " + b"[" * 5000 + b"]" * 5000)


@every_reader
def test_a_file_that_is_too_large_is_reported(what, refusal):
    assert f"is larger than 256 KiB: no {what} needs that" in refusal(what, b"#" * (MOST_BYTES + 1))


@every_reader
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no devices and pipes among its files")
def test_a_device_and_a_pipe_are_refused_unread(what, refusal, tmp_path):
    from pathlib import Path

    pipe = tmp_path / "pipe.toml"
    os.mkfifo(pipe)
    for path in (Path("/dev/zero"), pipe):
        assert f"is a device or a pipe, not {FILE_OF[what]}; save its text in a file" in refusal(what, None, path)


@every_reader
def test_a_folder_a_missing_file_and_bytes_that_are_no_text_are_reported(what, refusal, tmp_path):
    assert f"is a folder, not {FILE_OF[what]}" in refusal(what, None, tmp_path)
    assert "there is no such file" in refusal(what, None, tmp_path / "none.toml")
    assert "line 2: is not UTF-8 text; save it as UTF-8" in refusal(what, b"\n\xff")


@pytest.mark.parametrize("what", SOUND)
def test_a_byte_order_mark_is_skipped(what, tmp_path):
    plain, marked = tmp_path / "plain.toml", tmp_path / "marked.toml"
    plain.write_text(SOUND[what])
    marked.write_bytes(b"\xef\xbb\xbf" + SOUND[what].encode())
    sound, skipped = READERS[what](plain), READERS[what](marked)
    if isinstance(sound, RunLimits):
        sound, skipped = sound._replace(source=""), skipped._replace(source="")
    assert skipped == sound != (RunLimits() if what == "limits" else type(sound)())

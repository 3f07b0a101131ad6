"""A recording is its owner's alone, whatever the folder and the umask."""

import os
import stat

import pytest
from punctura.record import export

pytestmark = pytest.mark.skipif(os.name != "posix", reason="other systems have other permissions")


@pytest.mark.parametrize("system", ["unnamed", "named"])
def test_a_recording_in_a_shared_folder_is_its_owners_alone(start, tmp_path, monkeypatch, free_umask, system):
    if system == "named":
        for module in ("record.new_file", "files.whole_file"):
            monkeypatch.setattr(f"punctura.{module}.unnamed_file", lambda *_: None)
    tmp_path.chmod(0o777)
    run = start(ticks=100)
    parts = list(tmp_path.iterdir())
    run.record()
    for ending in ("csv", "parquet"):
        export(run.path, tmp_path / f"export.{ending}")
    assert [path.suffix for path in parts] == [".part"] and len(list(tmp_path.iterdir())) == 3
    run = start(ticks=100, name="second.parquet")
    assert {stat.S_IMODE(path.stat().st_mode) for path in tmp_path.iterdir()} == {0o600}
    run.record()

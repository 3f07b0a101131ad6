"""A file written by whole_file gets its name only when it is complete."""

import errno
import os
import stat

import pytest
from punctura.files.whole_file import sync, whole_file, write_whole


@pytest.fixture(params=["unnamed", "hidden"])
def system(request, monkeypatch):
    """A system with unnamed files, like Linux, and one without."""
    if request.param == "hidden":
        monkeypatch.setattr("punctura.files.whole_file.unnamed_file", lambda *_: None)
    elif not hasattr(os, "O_TMPFILE"):
        pytest.skip("this system has no unnamed files")


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_the_name_appears_at_the_end(system, tmp_path):
    path = tmp_path / "a.txt"
    path.write_bytes(b"before")
    with whole_file(path) as place, open(place, "wb") as file:
        file.write(b"after")
        file.flush()
        assert path.read_bytes() == b"before"
    assert path.read_bytes() == b"after" and names(tmp_path) == ["a.txt"]


def test_the_permissions_of_a_replaced_file_are_kept(system, tmp_path):
    path = tmp_path / "a.txt"
    path.write_bytes(b"before")
    path.chmod(0o600)
    write_whole(path, b"after")
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    write_whole(tmp_path / "b.txt", b"new")
    plain = tmp_path / "c.txt"
    plain.write_bytes(b"")
    assert stat.S_IMODE((tmp_path / "b.txt").stat().st_mode) == stat.S_IMODE(plain.stat().st_mode)


def test_a_private_file_is_its_owners_alone_from_its_first_moment(system, tmp_path, free_umask):
    with whole_file(tmp_path / "a.txt", private=True) as place:
        assert stat.S_IMODE(os.stat(place).st_mode) == 0o600
        write_whole(tmp_path / "b.txt", b"shared")
    assert [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("a.txt", "b.txt")] == [0o600, 0o666]


def test_another_file_is_not_replaced_unless_that_is_asked_for(system, tmp_path):
    path = tmp_path / "a.txt"
    write_whole(path, b"first", replace=False)
    with pytest.raises(FileExistsError):
        write_whole(path, b"second", replace=False)
    assert path.read_bytes() == b"first" and names(tmp_path) == ["a.txt"]


def test_after_an_error_the_former_file_is_there_and_nothing_else(system, tmp_path):
    path = tmp_path / "a.txt"
    path.write_bytes(b"before")
    with pytest.raises(KeyError), whole_file(path) as place, open(place, "wb") as file:
        file.write(b"half")
        raise KeyError
    assert path.read_bytes() == b"before" and names(tmp_path) == ["a.txt"]


def test_a_full_disk_is_told_with_the_files_own_name(system, tmp_path):
    resource = pytest.importorskip("resource")
    path = tmp_path / "a.txt"
    path.write_bytes(b"before")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    try:
        with pytest.raises(OSError) as caught:
            write_whole(path, bytes(100_000))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert caught.value.errno == errno.EFBIG and caught.value.filename == str(path)
    assert path.read_bytes() == b"before" and names(tmp_path) == ["a.txt"]


def test_a_folder_that_is_not_there_is_told_with_the_files_own_name(system, tmp_path):
    path = tmp_path / "none" / "a.txt"
    with pytest.raises(FileNotFoundError) as caught:
        write_whole(path, b"")
    assert caught.value.filename == str(path)


def test_a_folder_whose_file_system_cannot_wait_for_names_is_no_error_and_a_file_is(tmp_path, monkeypatch):
    def refuses(descriptor):
        raise OSError(errno.EINVAL, "Invalid argument")

    file = tmp_path / "a.txt"
    file.touch()
    monkeypatch.setattr(os, "fsync", refuses)
    sync(tmp_path)
    with pytest.raises(OSError, match="Invalid argument"):
        sync(file)

"""The static page changes only files that it made."""

import json
import shutil

import pytest
from made_files import LIST, ForeignFileError, publish


def made(folder, **files):
    for name, text in files.items():
        path = folder / name.replace("__", "/")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def held(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_text()
        for path in folder.rglob("*")
        if path.is_file() and path.name != LIST
    }


@pytest.fixture
def out(tmp_path):
    publish(made(tmp_path / "first", index="1", assets__a="1", assets__b="1", old__c="1"), tmp_path / "out")
    return tmp_path / "out"


def test_the_next_page_replaces_the_files_of_the_one_before(tmp_path, out):
    publish(made(tmp_path / "second", index="2", assets__a="1", d="2"), out)
    assert held(out) == {"index": "2", "assets/a": "1", "d": "2"} and not (out / "old").exists()
    assert set(json.loads((out / LIST).read_text())) == {"index", "assets/a", "d"}


def test_files_of_others_stay(tmp_path, out):
    made(out, thesis="mine", assets__mine="mine", old__mine="mine", studio="mine")
    publish(made(tmp_path / "second", index="2"), out)
    assert held(out) == {
        "index": "2", "thesis": "mine", "assets/mine": "mine", "old/mine": "mine", "studio": "mine",
    }  # fmt: skip


@pytest.mark.parametrize(
    "change, words",
    [
        (lambda out: (out / "d").write_text("mine"), "is not of a static page. Move it away"),
        (lambda out: (out / "index").write_text("mine"), "has been changed. Move it away"),
        (lambda out: (out / "assets" / "b").write_text("mine"), "has been changed"),
        (lambda out: (out / "d").mkdir(), "is not of a static page"),
        (lambda out: (out / "new").write_text("mine"), "is not of a static page"),
        (lambda out: (out / "new").symlink_to(out.parent), "is not of a static page"),
        (lambda out: (out / "d").symlink_to(out.parent / "nothing"), "is not of a static page"),
        (lambda out: (out / LIST).write_text("mine"), "is not the list"),
        (lambda out: (out / LIST).write_text('{"../first/index": []}'), "is not the list"),
    ],
)
def test_a_file_of_somebody_else_in_the_way_is_refused_and_nothing_changes(tmp_path, out, change, words):
    change(out)
    before = held(out)
    with pytest.raises(ForeignFileError, match=words):
        publish(made(tmp_path / "second", index="2", d="2", new__e="2"), out)
    assert held(out) == before and held(tmp_path / "first")["index"] == "1"


def test_a_folder_that_was_not_made_here_keeps_its_files(tmp_path):
    folder = made(tmp_path / "site", index="mine", notes="mine")
    with pytest.raises(ForeignFileError):
        publish(made(tmp_path / "first", index="1"), folder)
    assert held(folder) == {"index": "mine", "notes": "mine"}


def test_after_an_end_half_way_the_next_time_goes_on(tmp_path, out, monkeypatch):
    second = made(tmp_path / "second", index="2", z="2")
    copy = shutil.copyfile

    def copy_until_full(file, to):
        if file.name == "z":
            raise OSError("the disk is full")
        copy(file, to)

    with monkeypatch.context() as patch:
        patch.setattr(shutil, "copyfile", copy_until_full)
        with pytest.raises(OSError, match="full"):
            publish(second, out)
    assert held(out) == {"index": "2"}
    publish(second, out)
    assert held(out) == {"index": "2", "z": "2"}

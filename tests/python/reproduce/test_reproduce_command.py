"""The command reproduce: works from any folder, is repeatable, and reports failures."""

import json
import os
import subprocess
import sys
from pathlib import Path

import punctura.reproduce.run
import pytest
from punctura.reproduce import Reproduction, reproduce

pytestmark = pytest.mark.xdist_group("reproduction")  # in one worker: what they share takes seconds to make


def command(*arguments: str, cwd: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "punctura", "reproduce", *arguments],
        cwd=cwd, env={**os.environ, **environment}, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip


@pytest.mark.statistics
def test_a_second_run_elsewhere_under_other_plot_settings_gives_the_same_files_to_the_byte(
    made: Reproduction, tmp_path: Path
) -> None:
    (tmp_path / "matplotlibrc").write_text("font.size: 30\nlines.linewidth: 9\nbackend: TkAgg\naxes.facecolor: red\n")
    done = command("--out", "here/there", "--json", cwd=tmp_path, MATPLOTLIBRC=str(tmp_path / "matplotlibrc"))
    assert (done.returncode, done.stderr) == (0, "")
    report = json.loads(done.stdout)
    assert report["page"] == str(tmp_path / "here" / "there" / "index.html")
    assert report["files"] == list(made.files)
    assert {row["figure"] for row in report["measured"]} == {
        "Fig. 3",
        "Fig. 5",
        "Fig. 10",
        "Fig. 11",
        "Fig. 12",
        "Close-up",
    }
    for name in made.files:
        assert (tmp_path / "here" / "there" / name).read_bytes() == (made.folder / name).read_bytes(), name


def test_a_folder_that_cannot_be_written_gives_one_sentence_and_exit_status_1(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("a file, not a folder")
    done = command("--out", "taken", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stdout == ""
    assert done.stderr.startswith(f"punctura: cannot write to {tmp_path / 'taken'}: ")
    assert done.stderr.count("\n") == 1


def test_a_disk_that_is_full_halfway_leaves_the_folder_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "index.html").write_text("the page of last week")
    first = punctura.reproduce.run._recipes()[:1]
    monkeypatch.setattr(punctura.reproduce.run, "_recipes", lambda: first)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(punctura.reproduce.run, "write_page", full)
    with pytest.raises(OSError, match=r"cannot write to .*: No space left on device"):
        reproduce(tmp_path)
    assert [file.name for file in tmp_path.iterdir()] == ["index.html"]
    assert (tmp_path / "index.html").read_text() == "the page of last week"


def test_the_share_done_grows_from_figure_to_figure_up_to_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recipes = punctura.reproduce.run._recipes()[:2]
    monkeypatch.setattr(punctura.reproduce.run, "_recipes", lambda: recipes)
    shares: list[float] = []
    reproduce(tmp_path, shares.append)
    assert shares == sorted(shares) and len(shares) == 3 and shares[-1] == 1.0

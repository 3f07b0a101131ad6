"""The command line: verbs, exit statuses, plain sentences on stderr."""

import io
import json
import os
import re
import shlex
import signal
import subprocess
import sys
from importlib.metadata import entry_points, version

import pytest
from heed import heed_signals
from punctura import progress, scene_names
from punctura.cli._status import CALLED_WRONGLY, DONE, FAILED
from waiting import PATIENCE_S, wait_until

HEADER = "time_s,x_m,y_m,z_m\n"


def in_a_process(*arguments, **more):
    """Like the fixture `punctura`, but slow: a process starts."""
    command = [sys.executable, "-m", "punctura", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, **more)


@pytest.fixture(autouse=True)
def plain(monkeypatch):
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "100")


@pytest.fixture
def here(tmp_path, monkeypatch):
    """tmp_path is the current folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def motion(tmp_path):
    path = tmp_path / "motion.csv"
    path.write_text(HEADER + "".join(f"{i / 1600!r},0,{0.001 - i * 1e-5!r},0\n" for i in range(1000)))
    return path


def test_the_version_is_that_of_the_package():
    done = in_a_process("--version")
    assert (done.returncode, done.stdout) == (0, f"punctura {version('punctura')}\n")


def test_without_a_verb_it_lists_the_verbs(punctura):
    done = punctura()
    for verb in ("scenes", "schema", "simulate"):
        assert re.search(rf"^\s+{verb} +\w", done.stdout + done.stderr, re.M)


def test_the_list_of_verbs_cuts_no_text_off(punctura):
    listed = punctura("-h").stdout.partition("Commands:")[2]
    assert len(listed.splitlines()) > 10 and "..." not in listed


def test_each_verb_is_a_file_and_tells_how_it_is_used(punctura):
    for verb in ("scenes", "schema", "simulate"):
        for asks in ("--help", "-h"):
            done = punctura(verb, asks)
            assert done.status == 0 and f"Usage: punctura {verb}" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (["scenes"], DONE),
        (["run", "--headless", "--device", "none-such", "k06-fig10"], CALLED_WRONGLY),
        (["replay", __file__], FAILED),
        (["export", "no-such-file.parquet", "--out", "x.csv"], CALLED_WRONGLY),
        (["place", "--device", "none-such"], CALLED_WRONGLY),
        (["no-such-verb"], CALLED_WRONGLY),
        (["simulate", "k06-fig10"], CALLED_WRONGLY),
        (["run", "no-such-scene", "--headless"], CALLED_WRONGLY),
        (["run", "--headless", "--duration", "soon"], CALLED_WRONGLY),
    ],
    ids=lambda x: " ".join(x) if isinstance(x, list) else "",
)
def test_every_verb_ends_with_a_status_of_the_table(punctura, arguments, status, here):
    done = punctura(*arguments)
    assert done.status == status and "Traceback" not in done.stderr
    assert status == DONE or done.stderr.strip()


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="only Linux has a file that is always full")
@pytest.mark.parametrize(
    ("arguments", "unbuffered"), [(["scenes"], ""), (["--help"], "1"), (["schema"], "1"), (["--version"], "")]
)
def test_a_full_standard_output_is_told_as_such(arguments, unbuffered):
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "punctura", *arguments],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
        )
    sentence = "punctura: standard output cannot be written: No space left on device\n"
    assert (done.returncode, done.stderr) == (1, sentence)


def test_scenes_lists_names_and_membranes(punctura):
    lines = punctura("scenes").stdout.splitlines()
    assert [line.split()[0] for line in lines] == scene_names()
    assert "k06-fig12      K06 Fig. 12: first membrane, second membrane" in lines


def test_scenes_as_json_name_their_files(punctura):
    entries = json.loads(punctura("scenes", "--json").stdout)
    assert [entry["name"] for entry in entries] == scene_names()
    assert entries[1] == {
        "name": "k06-fig10",
        "title": "K06 Fig. 10",
        "membranes": ["thin membrane"],
        "file": entries[1]["file"],
    }
    assert all(os.path.isfile(entry["file"]) for entry in entries)


def test_schema_prints_json_schema(punctura):
    schema = json.loads(punctura("schema").stdout)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert {"needle", "coupling", "membrane", "name"} == set(schema["required"])


def test_simulate_says_in_words_what_it_did(punctura, motion, tmp_path):
    done = punctura("simulate", "k06-fig10", "--motion", motion, "--out", tmp_path / "out.csv")
    assert (done.status, done.stderr) == (0, "")
    first, second = done.stdout.splitlines()
    assert first.startswith(f"{tmp_path / 'out.csv'}: 1000 ticks at 1600 Hz, 0 s to 0.624375 s, strongest force 0.7")
    assert second.startswith("  thin membrane: ")
    assert len((tmp_path / "out.csv").read_text().splitlines()) == 1001


def test_simulate_as_json_is_only_json_on_stdout(punctura, motion, tmp_path):
    done = punctura("simulate", "k06-fig12", "--motion", motion, "--out", tmp_path / "out.parquet", "--json")
    summary = json.loads(done.stdout)
    assert (summary["samples"], summary["ticks"], summary["resampled"]) == (1000, 1000, False)
    assert [m["name"] for m in summary["membranes"]] == ["first membrane", "second membrane"]
    assert done.stderr == ""


def test_a_note_goes_to_stderr_and_into_the_json(punctura, motion, tmp_path):
    motion.write_text(HEADER + "".join(f"{i / 500!r},0,0,0\n" for i in range(50)))
    done = punctura("simulate", "k06-fig10", "--motion", motion, "--out", tmp_path / "out.csv", "--json")
    note = "the motion is sampled at 500 Hz, the servo runs at 1600 Hz: the motion was resampled linearly"
    assert json.loads(done.stdout)["notes"] == [note]
    assert done.stderr == f"punctura: note: {note}\n"


def test_a_bad_motion_fails_with_status_1_and_one_sentence(punctura, motion, tmp_path):
    motion.write_text(HEADER + "0,0,0,0\n0.000625,0,nan,0\n")
    done = punctura("simulate", "k06-fig10", "--motion", motion, "--out", tmp_path / "out.csv")
    assert (done.status, done.stdout) == (1, "")
    what = "y_m is nan; fill the sample in, or cut the motion there"
    assert done.stderr == f"punctura: {motion}, line 3: {what}\n"
    assert [p.name for p in tmp_path.iterdir()] == ["motion.csv"]


def test_a_bad_scene_is_called_wrongly_with_all_its_problems(punctura, motion, here):
    (here / "bad.toml").write_text("name = 3\n")
    done = punctura("simulate", "bad.toml", "--motion", motion, "--out", "out.csv")
    assert (done.status, done.stdout) == (2, "")
    assert done.stderr == (
        "punctura: bad.toml: 4 problems\n"
        "  name = 3: must be text, in quotes\n"
        "  needle: is missing; write a table [needle]\n"
        "  coupling: is missing; write a table [coupling]\n"
        "  membrane: is missing; write a table [[membrane]]\n"
    )


def test_missing_files_and_a_wrong_ending_are_called_wrongly(punctura, here):
    done = punctura("simulate", "k06-fig10", "--motion", "none.csv", "--out", "out.xlsx")
    assert done.status == 2
    assert done.stderr == (
        "punctura: 2 problems\n  motion none.csv: there is no such file\n  out out.xlsx: must end in .csv or .parquet\n"
    )


def test_an_example_file_is_what_the_printed_command_reads(punctura, here):
    for kind, file in (("motion", "motion.csv"), ("trace", "a trace.csv")):
        done = punctura("example", kind, *(["--out", file] if file != f"{kind}.csv" else []))
        assert done.status == 0 and done.stdout.startswith(f"{file}: ")
        program, *command = shlex.split(done.stdout.partition("Next: ")[2])
        assert program == "punctura" and punctura(*command).status == 0
        again = punctura("example", kind, "--out", file)
        assert again.status == CALLED_WRONGLY and "exists already" in again.stderr


READS_A_FILE = {
    "rivals": [],
    "exercise score": ["--exercise", "epidural"],
    "export": ["--out", "o.csv"],
    "export-fmu": ["--out", "o.fmu"],
    "identify": ["--needle", "diameter_mm=1,tip_angle_deg=20"],
    "measure": [],
    "perception check": [],
    "place": [],
    "replay": [],
    "run": ["--headless"],
    "study": [],
}


@pytest.mark.parametrize("verb", READS_A_FILE)
def test_a_missing_file_is_named_and_is_a_usage_error(punctura, verb, here):
    done = punctura(*verb.split(), *READS_A_FILE[verb], "none.toml")
    assert done.status == 2 and "none.toml" in done.stderr and "Errno" not in done.stderr


def writes_in(folder, pid):
    """Whether the process has a result file open: one without a name (Linux), or a hidden one."""
    if not os.path.isdir(f"/proc/{pid}/fd"):
        return any(file.name.startswith(".") for file in folder.iterdir())
    try:
        opened = [os.readlink(f"/proc/{pid}/fd/{number}") for number in os.listdir(f"/proc/{pid}/fd")]
    except OSError:  # a file was closed meanwhile, or the process has ended
        return False
    return any(name.startswith(f"{folder}/") and not name.endswith("slow.csv") for name in opened)


@pytest.mark.skipif(os.name != "posix", reason="sends a signal")
@pytest.mark.parametrize("name", ["SIGINT", "SIGHUP"])
def test_a_signal_leaves_nothing_behind(tmp_path, name):
    slow = tmp_path / "slow.csv"
    slow.write_text(HEADER + "".join(f"{k / 10},0,0,0\n" for k in range(400_000)))  # 64 million ticks
    command = [sys.executable, "-m", "punctura", "simulate", "k06-fig10", "--motion", "slow.csv", "--out", "o.csv"]
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, preexec_fn=heed_signals)
    wait_until(lambda: writes_in(tmp_path, process.pid) or process.poll() is not None)
    assert process.poll() is None
    process.send_signal(getattr(signal, name))
    sentence = "interrupted" if name == "SIGINT" else f"ended by {name}"
    assert process.communicate(timeout=PATIENCE_S)[1] == f"punctura: {sentence}\n"
    assert process.returncode == 128 + getattr(signal, name)
    assert [p.name for p in tmp_path.iterdir()] == ["slow.csv"]


def close_stderr():
    os.close(2)


@pytest.mark.skipif(os.name != "posix", reason="closes a stream as a shell does")
@pytest.mark.parametrize("arguments", [["run", "no-such-scene", "--headless"], ["scenes", "--no-such-option"]])
def test_without_a_standard_error_nothing_is_said_elsewhere_and_the_status_is_right(arguments):
    command = [sys.executable, "-m", "punctura", *arguments]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, preexec_fn=close_stderr)
    assert (done.returncode, done.stdout) == (2, "")


@pytest.mark.skipif(os.name != "posix", reason="deletes the folder that it is in")
def test_a_deleted_working_folder_is_named_as_the_reason(motion, tmp_path):
    def in_a_deleted_folder(*arguments):
        folder = tmp_path / "gone"
        folder.mkdir()
        return in_a_process(*arguments, cwd=folder, preexec_fn=folder.rmdir)

    done = in_a_deleted_folder("simulate", "k06-fig10", "--motion", motion, "--out", "out.csv")
    assert done.returncode == 1 and "started in has been deleted: change to another" in done.stderr
    assert "Traceback" not in done.stderr
    assert in_a_deleted_folder("scenes").returncode == 0


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_bar_shows_itself_on_a_terminal_only_and_after_a_second_only(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    clock = iter([0.0, 0.5, 1.5, 2.0])
    monkeypatch.setattr(progress, "monotonic", lambda: next(clock))
    terminal = Terminal()
    with progress.progress_bar("simulate", terminal) as tell:
        tell(0.2)
        assert terminal.getvalue() == ""
        tell(0.6)
    assert "simulate" in terminal.getvalue()

    monkeypatch.setattr(progress, "monotonic", iter([0.0, 5.0, 9.0]).__next__)
    pipe = io.StringIO()
    with progress.progress_bar("simulate", pipe) as tell:
        tell(0.2)
    assert pipe.getvalue() == ""


AT_ITS_FIRST_IMPORT = """
import os, signal, sys
import punctura_command

class Interrupts:
    def find_spec(self, name, path=None, target=None):
        if name == "numpy":
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupts())
punctura_command.main()
"""


@pytest.mark.skipif(os.name != "posix", reason="sends a signal")
def test_an_interrupt_while_python_still_imports_prints_no_traceback():
    [program] = entry_points(group="console_scripts", name="punctura")
    assert program.value == "punctura_command:main"
    command = [sys.executable, "-c", AT_ITS_FIRST_IMPORT]
    done = subprocess.run(command, capture_output=True, text=True, preexec_fn=heed_signals)
    assert (done.returncode, done.stderr) == (128 + signal.SIGINT, "punctura: interrupted\n")


def test_a_verb_with_tables_does_not_import_pandas(tmp_path):
    """pyarrow would, with its first array. The import takes long, and can swallow the exception of a signal."""
    (tmp_path / "pandas").mkdir()
    (tmp_path / "pandas/__init__.py").write_text("import pathlib; pathlib.Path('imported').touch()")
    motion = "time_s,x_m,y_m,z_m\n" + "".join(f"{k / 1600},0,{0.005 - k * 1e-6},0\n" for k in range(100))
    (tmp_path / "motion.csv").write_text(motion)
    command = ["simulate", "k06-fig10", "--motion", "motion.csv", "--out", "o.csv"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])}
    done = subprocess.run(
        [sys.executable, "-m", "punctura", *command], capture_output=True, text=True, cwd=tmp_path, env=environment
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "o.csv").exists() and not (tmp_path / "imported").exists()

"""With NumPy and pydantic alone the physics runs; what needs another package says which, and how to install it."""

import importlib.metadata
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from punctura import extras
from punctura.cli._app import _verbs

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).resolve().parents[3]
PACKAGE = ROOT / "python/punctura"
BLOCKED = """
import sys
blocked = set(sys.argv.pop(1).split(","))
class Finder:
    @staticmethod
    def find_spec(name, path=None, target=None):
        if name.partition(".")[0] in blocked:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Finder)
"""
PHYSICS = """
import numpy as np, punctura as pn
scene, depth = pn.load_scene("venipuncture"), np.linspace(-1e-3, 9e-3, 200)
alone = pn.simulate(scene, depth)
front, inwards = scene.membranes[0].point, scene.membranes[0].inward_normal
path = np.add(front, np.outer(depth, inwards))
assert pn.batch(scene, path, vary=pn.grid({"membrane[0].friction": [0.1, 0.2]})).peak.shape == (2,)
print(pn.live.ServoLoop, pn.exercise.exercises()[0].name, pn.events.find_events(alone, scene))
print(np.linalg.norm(alone.force, axis=1).max())
"""
# What each verb is called with, the package that it lacks, and the extra that has it.
NOTHING: tuple[str, str] = ("", "")
FILES, IDENTIFY = ("pyarrow", "files"), ("pyarrow", "identify")
CALLS = {
    "rivals any.csv": IDENTIFY,
    "devices": NOTHING,
    "example motion": NOTHING,
    "exercise list": NOTHING,
    "exercise score any.parquet --exercise venipuncture": FILES,
    "exercise export --format csv --results .": NOTHING,
    "export any.parquet --out any.csv": FILES,
    "export-fmu k06-fig10 --out any.fmu": NOTHING,
    "identify any.csv --needle diameter_mm=1,tip_angle_deg=20": IDENTIFY,
    "measure any.csv": FILES,
    "paths": NOTHING,
    "perception check pop-jnd": ("scipy", "study"),
    "perception list": NOTHING,
    "place --device simulated --out placement.toml": NOTHING,
    "replay any.parquet": FILES,
    "reproduce --out out": ("matplotlib", "plots"),
    "run k06-fig10": ("pyarrow", "studio"),
    "run k06-fig10 --headless --duration 0.01": NOTHING,
    "run k06-fig10 --headless --duration 0.01 --rival dahl": NOTHING,
    "run k06-fig10 --headless --duration 0.01 --record any.parquet": FILES,
    "scenes": NOTHING,
    "schema": NOTHING,
    "simulate k06-fig10 --motion any.csv --out o.csv": FILES,
    "study any.toml": ("pyarrow", "study"),
}


def packages_of(extra: str) -> set[str]:
    """The names of an extra's packages in pyproject.toml, those of the extras in it too."""
    found: set[str] = set()
    table = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    for requirement in table[extra]:
        name = re.match(r"[\w-]+", requirement)[0]  # type: ignore[index]
        inner = re.search(r"\[(.*)\]", requirement)
        found |= set().union(*map(packages_of, inner[1].split(","))) if inner and name == "punctura" else {name}
    return found


def without(packages: set[str], program: str, *arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", BLOCKED + program, ",".join(packages), *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, stdin=subprocess.DEVNULL)


def optional_packages() -> set[str]:
    extras_of_users = set(tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"])
    return set().union(*map(packages_of, extras_of_users - {"test", "docs"}))


def test_numpy_and_at_most_one_more_package_are_mandatory() -> None:
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
    assert [one.partition(">")[0] for one in needed if "python_version" not in one] == ["numpy", "pydantic"]


def test_scenes_simulations_and_batches_need_no_optional_package(tmp_path: Path) -> None:
    done = without(optional_packages(), PHYSICS, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout.split()[-1]) > 0.1  # N


@pytest.mark.parametrize("call", CALLS)
def test_a_verb_runs_or_says_which_package_it_lacks(call: str, tmp_path: Path) -> None:
    (tmp_path / "any.csv").write_text("time_s,x_m,y_m,z_m\n0,0,0,0\n")
    program = "from punctura.cli import main; main(sys.argv[1:])"
    package, extra = CALLS[call]
    done = without(optional_packages() - {"typer"}, program, *call.split(), cwd=tmp_path)
    if (package, extra) == NOTHING:
        lacks_a_person = call.startswith("place")  # its pose needs an Enter
        assert (done.returncode, "needs the package" in done.stderr) == (int(lacks_a_person), False), done.stderr
        return
    assert done.returncode == 1, done.stderr
    sentence = rf"punctura: .+ needs the package {package}, of the extra '{extra}'\. Install it: .+ install .+\n"
    assert re.fullmatch(sentence, done.stderr) and sys.executable in done.stderr
    assert package in packages_of(extra)


def test_every_verb_is_called_above() -> None:
    assert {call.split()[0] for call in CALLS} == set(_verbs())


def test_without_the_package_of_the_command_line_it_says_so(tmp_path: Path) -> None:
    done = without({"typer"}, "from punctura.cli import main; main(['scenes'])", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr.startswith("punctura: the command punctura needs the package typer, of the extra 'cli'. Install")


def test_each_call_of_optional_names_an_extra_that_has_the_package() -> None:
    calls = [
        (file.name, *found)
        for file in sorted(PACKAGE.rglob("*.py"))
        for found in re.findall(r"""\boptional\(\s*"([\w.]+)", "(\w+)",""", file.read_text())
    ]
    assert len(calls) > 20
    assert not [call for call in calls if call[1].partition(".")[0] not in packages_of(call[2])]


def test_the_command_installs_the_packages_of_the_extra_as_the_wheel_states_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    stated = [
        "numpy>=1.26",
        'scipy>=1.11; extra == "identify"',
        'punctura[cli,files]; extra == "identify"',
        'typer>=0.15; extra == "cli"',
        'pyarrow>=18; extra == "files"',
        'other; extra == "other"',
    ]
    monkeypatch.setattr(importlib.metadata, "requires", lambda name: stated)
    assert extras.requirements("identify") == ["scipy>=1.11", "typer>=0.15", "pyarrow>=18"]
    text = str(extras.missing("scipy.stats", "identify", "this"))
    assert text.endswith(' "scipy>=1.11" "typer>=0.15" "pyarrow>=18"')
    assert text.startswith("this needs the package scipy, of the extra 'identify'. Install it: ")


@pytest.mark.parametrize(
    ("pipx", "pip", "command"),
    [
        (False, True, "{python} -m pip install tqdm"),
        (False, False, "uv pip install --python {python} tqdm"),
        (True, False, "pipx inject environment tqdm"),
    ],
)
@pytest.mark.parametrize(
    ("executable", "python"),
    [
        ("/home/ann/.venv/bin/python", "/home/ann/.venv/bin/python"),
        ("/home/ann/a clone/python", '"/home/ann/a clone/python"'),
    ],
)
def test_the_command_is_one_that_this_environment_has(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, pipx: bool, pip: bool, command: str, executable: str, python: str
) -> None:
    prefix = tmp_path / "environment"
    prefix.mkdir()
    if pipx:
        (prefix / "pipx_metadata.json").touch()
    monkeypatch.setattr(sys, "prefix", str(prefix))
    monkeypatch.setattr(sys, "executable", executable)
    monkeypatch.setattr(extras, "find_spec", lambda name: pip or None)
    text = str(extras.missing("tqdm", "none", "this"))
    assert text.endswith("Install it: " + command.format(python=python))


def test_a_package_that_an_optional_one_lacks_is_not_mistaken_for_it(tmp_path: Path) -> None:
    (tmp_path / "broken_package.py").write_text("import something_else\n")
    program = f"sys.path.insert(0, {json.dumps(str(tmp_path))}); from punctura.extras import optional; "
    done = without(set(), program + "optional('broken_package', 'files', 'this')", cwd=tmp_path)
    assert done.stderr.rstrip().endswith("ModuleNotFoundError: No module named 'something_else'")

"""`import punctura` gives the physics and loads no other package than NumPy; the rest comes when it is used."""

import ast
import importlib
import json
import subprocess
import sys
from pathlib import Path

import punctura
import pytest

HEAVY = {"matplotlib", "pandas", "pyarrow", "pydantic", "rich", "scipy", "starlette", "typer", "uvicorn"}


def in_a_new_process(code: str) -> list[str]:
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return list(json.loads(ended.stdout))


def test_the_physics_needs_only_numpy() -> None:
    step = "import punctura as pn; pn.Proxy1d(pn.ThickLaw(pn.Needle(1e-3, 0.3), pn.Membrane(570, 0.4, 0.2, 1e-3)), "
    step += "pn.Coupling(400, 1), 1e-3).step(1e-3)"
    loaded = in_a_new_process(f"{step}; import json, sys; print(json.dumps(sorted(sys.modules)))")
    assert HEAVY.isdisjoint(loaded)


def test_import_takes_little_memory_above_numpy() -> None:
    peak = "import json, resource; print(json.dumps([resource.getrusage(resource.RUSAGE_SELF).ru_maxrss]))"
    with_it, without = (int(in_a_new_process(f"import numpy{more}; {peak}")[0]) for more in (", punctura", ""))
    assert with_it - without < 35 * 1024  # KiB


def test_a_type_checker_sees_the_late_names_at_the_same_places() -> None:
    tree = ast.parse(Path(punctura.__file__).read_text())
    block = next(node for node in tree.body if isinstance(node, ast.If))
    seen = {
        line.module: tuple(alias.name for alias in line.names)
        for line in block.body
        if isinstance(line, ast.ImportFrom)
    }
    assert seen == punctura._LATE


@pytest.mark.parametrize("subject", sorted(punctura._SUBJECTS - {"studio"}))
def test_each_subject_lists_its_names(subject: str) -> None:
    assert importlib.import_module(f"punctura.{subject}").__all__


@pytest.mark.parametrize("name", sorted({*punctura.__all__, *punctura._SUBJECTS}))
def test_each_public_name_is_listed_and_can_be_used(name: str) -> None:
    assert name in dir(punctura)
    assert getattr(punctura, name) is not None


def test_a_name_that_does_not_exist_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'punctura' has no attribute 'neddle'"):
        _ = punctura.neddle  # type: ignore[attr-defined]
    assert not hasattr(punctura, "restores")


@pytest.mark.parametrize("subject", sorted(punctura._ELSEWHERE))
def test_a_name_of_a_subject_is_found_by_the_message(subject: str) -> None:
    module = importlib.import_module(f"punctura.{subject}")
    for name in punctura._ELSEWHERE[subject]:
        assert name in module.__all__
        with pytest.raises(AttributeError, match=rf"no attribute '{name}'; it is punctura\.{subject}\.{name}$"):
            getattr(punctura, name)


def test_a_subject_without_its_package_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [n for n in sys.modules if n.startswith("punctura.gym")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr(punctura, "gym", raising=False)
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    with pytest.raises(AttributeError, match=r"punctura\.gym needs the package gymnasium, .* install "):
        _ = punctura.gym

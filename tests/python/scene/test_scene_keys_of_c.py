"""The C library reads the keys of the schema: its generated table is up to date."""

import runpy
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]


def test_the_c_library_has_the_keys_of_the_schema(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["make_scene_keys", "--check"])
    tool = runpy.run_path(str(ROOT / "tools/make_scene_keys.py"))
    assert tool["main"]() == 0, capsys.readouterr().out

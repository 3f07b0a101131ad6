"""The npm package in a bundler's page, in Chromium: the newest Vite, webpack, esbuild and Rollup, without a setting.

    python -m pytest integrations/wasm/test_bundlers.py

Needs punctura.wasm and embedded.mjs (build.sh) and npm's registry.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE)]

from test_page import served  # noqa: E402

PAGE = """<!doctype html>
<meta charset="utf-8" />
<title>A page of a stranger</title>
<pre id="forces"></pre>
<script type="module" src="{}"></script>
"""
# The example in a function: a classic script, such as esbuild's, has no `await` outside one.
FUNCTION = """import {{ load }} from "punctura";
const forces = document.getElementById("forces");
console.log = (line) => forces.append(`${{line}}\n`);
async function example() {{
{}
}}
example().catch((error) => forces.append(String(error)));
"""
# Bundler: its packages, its command, and the script that a page loads from its folder dist.
BUNDLERS = {
    "vite": (["vite"], ["vite", "build"], None),
    "webpack": (["webpack", "webpack-cli"], ["webpack", "--mode", "production"], "main.js"),
    "esbuild": (["esbuild"], ["esbuild", "src/index.js", "--bundle", "--outfile=dist/main.js"], "main.js"),
    "esbuild, modules": (
        ["esbuild"],
        ["esbuild", "src/index.js", "--bundle", "--format=esm", "--outfile=dist/main.js"],
        "main.js",
    ),
    "rollup": (
        ["rollup", "@rollup/plugin-node-resolve"],
        ["rollup", "src/index.js", "--plugin", "node-resolve", "--format", "es", "--dir", "dist"],
        "index.js",
    ),
}
COPIES_NO_FILE = ("esbuild, modules", "rollup")


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package as npm would publish it."""
    folder = tmp_path_factory.mktemp("package")
    name = subprocess.run(
        ["npm", "pack", str(HERE), "--silent"], cwd=folder, check=True, capture_output=True, text=True
    )
    return folder / name.stdout.strip()


def project(folder: Path, package: Path, packages: list[str]) -> None:
    """A project of a stranger: the example, with the package from node_modules."""
    (folder / "src").mkdir()
    (folder / "package.json").write_text(json.dumps({"private": True, "type": "module"}), encoding="utf-8")
    example = re.sub(r"(?m)^import .*$", "", (HERE / "example.mjs").read_text(encoding="utf-8"))
    (folder / "src" / "index.js").write_text(FUNCTION.format(example), encoding="utf-8")
    (folder / "index.html").write_text(PAGE.format("/src/index.js"), encoding="utf-8")
    install = ["npm", "install", "--silent", "--no-audit", "--no-fund", "--prefer-offline", str(package), *packages]
    subprocess.run(install, cwd=folder, check=True)


def greatest_force(browser: Browser, address: str, missed: list[str] | None = None) -> float:
    """The largest number of the example's list, N. missed gets the names of the files that the server did not have."""
    page = browser.new_page()
    lost = [] if missed is None else missed
    page.on("response", lambda answer: None if answer.ok else lost.append(answer.url.rpartition("/")[2]))
    page.goto(address)
    forces = page.locator("#forces")
    expect(forces).to_contain_text("8.0 mm", timeout=60_000)
    text = forces.inner_text()
    page.close()
    return max(float(number) for number in re.findall(r"mm +(-?[\d.]+) N", text))


@pytest.mark.parametrize("bundler", BUNDLERS)
def test_a_page_that_a_bundler_made_has_the_forces(bundler, package, browser, tmp_path):
    packages, command, script = BUNDLERS[bundler]
    project(tmp_path, package, packages)
    made = subprocess.run(["npx", "--no-install", *command], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert "Critical dependency" not in made.stdout + made.stderr  # a warning of webpack
    if script is not None:
        (tmp_path / "dist" / "index.html").write_text(PAGE.format(script), encoding="utf-8")
    with served(tmp_path / "dist") as address:
        missed: list[str] = []
        assert 0.4 < greatest_force(browser, address, missed) < 1
        assert missed == (["punctura.wasm"] if bundler in COPIES_NO_FILE else [])
        if missed:  # what README.md says for such a bundler
            shutil.copy(tmp_path / "node_modules" / "punctura" / "punctura.wasm", tmp_path / "dist")
            missed.clear()
            assert 0.4 < greatest_force(browser, address, missed) < 1
            assert missed == []


def test_vites_server_for_developers_has_the_forces(package, browser, tmp_path):
    project(tmp_path, package, BUNDLERS["vite"][0])
    plain = {**os.environ, "NO_COLOR": "1"}
    command = [str(tmp_path / "node_modules" / ".bin" / "vite"), "--port", "0"]
    server = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True, env=plain)
    try:
        assert server.stdout is not None
        address = next(found[0] for line in server.stdout if (found := re.search(r"http://localhost:\d+/", line)))
        assert 0.4 < greatest_force(browser, address) < 1
    finally:
        server.terminate()
        server.wait()

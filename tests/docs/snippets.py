"""A plug-in of pytest that runs every code block of the documentation, by Sybil.

    python -m pytest -p snippets docs README.md        with tests/docs in PYTHONPATH

The words behind a block's opening fence say what happens to it:

    ```python                        runs; the blocks of a page share their variables
    ```sh                            runs in bash, in the page's own empty folder
    ```cpp                           is compiled
    ```c                             a whole program in C99 for the C library: is compiled
    ```toml scene                    is read as what it is: scene, limits, placement, exercise, plan,
                                     protocol or pyproject
    ```toml scene save=mine.toml     and is saved in the page's folder, for the blocks that follow
    ```text output                   is what the block before it must have printed
    ```text                          is a drawing, a formula or an output that differs from run to run
    ```sh no-run: REASON             does not run, for this reason; its grammar is still checked

What a block needs and the reader does not is put into an invisible block before it,
<!-- invisible-code-block: python ... -->. All other blocks fail: an indented block, one without a language.
"""

import ast
import atexit
import contextlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).parents[2] / "tools"))

from markdown_it import MarkdownIt
from sybil import Document, Example, Region, Sybil
from sybil.evaluators.python import PythonEvaluator
from sybil.region import Lexeme
from warm import warm

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("README.md", "CONTRIBUTING.md", "examples/README.md", "docs/*.md")
INVISIBLE = re.compile(r"<!-- invisible-code-block: (\w+)\n(.*)\n-->", re.S)
PATIENCE_S = 120
running = contextlib.ExitStack()
atexit.register(running.close)


@cache
def punctura_command() -> str:
    """The program `punctura` of the pages, which starts in a moment."""
    folder = running.enter_context(tempfile.TemporaryDirectory())
    words = running.enter_context(warm(Path(folder)))
    return f'#!/bin/sh\nexec {shlex.join(words)} "$@"\n'


def run_python(code: str, example: Example) -> None:
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        PythonEvaluator()(example)
    example.namespace["_printed"] = printed.getvalue()


def run_shell(code: str, example: Example) -> None:
    command = ["bash", "-euo", "pipefail", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, stdin=subprocess.DEVNULL)
    assert done.returncode == 0, f"exit status {done.returncode}\n{done.stdout}{done.stderr}"
    example.namespace["_printed"] = done.stdout


def compile_cpp(code: str, example: Example) -> None:
    """Puts lines with # in front and all others into a function; `before`: the text of the invisible blocks so far."""
    lines = code.splitlines()
    heads = [line for line in lines if line.startswith("#")]
    body = [line for line in lines if not line.startswith("#")]
    text = "\n".join([*heads, *example.namespace.get("before", []), "void page() {", *body, "}", ""])
    command = ["c++", "-std=c++20", "-fsyntax-only", f"-I{ROOT / 'core'}", f"-I{ROOT / 'runtime'}", "-x", "c++", "-"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == 0, done.stderr


def compile_c(code: str, example: Example) -> None:
    command = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{ROOT / 'capi/include'}"]
    done = subprocess.run([*command, "-x", "c", "-"], input=code, capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == 0, done.stderr


def read_toml(code: str, kind: str) -> None:
    from punctura.exercise import load_exercise
    from punctura.files.toml import parse_toml
    from punctura.live import load_limits, load_placement
    from punctura.perception import load_protocol
    from punctura.scene import load_scene
    from punctura.study import load_plan

    readers: dict[str, Callable[[Path], Any]] = {
        "scene": load_scene, "limits": load_limits, "placement": load_placement, "exercise": load_exercise,
        "plan": load_plan, "protocol": load_protocol,
        "pyproject": lambda path: parse_toml(path.read_text(), path),
    }  # fmt: skip
    assert kind in readers, f"behind ```toml stands none of: {', '.join(readers)}"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"{kind}.toml")
        path.write_text(code)
        readers[kind](path)


def only_grammar(language: str, code: str) -> None:
    if language == "python":
        ast.parse(code)
    elif language == "sh":
        subprocess.run(["bash", "-n", "-c", code], check=True, capture_output=True, text=True)


def evaluate(example: Example) -> None:
    """Runs or checks a block as the words after its fence require."""
    words, code = example.region.lexemes["words"], str(example.parsed)
    language, _, rest = words.partition(" ")
    if language == "text":
        if rest == "output":
            assert code.strip() == example.namespace["_printed"].strip()
        return
    if rest.startswith("no-run:"):
        assert rest.removeprefix("no-run:").strip(), "no-run: needs a reason"
        only_grammar(language, code)
        return
    saved = re.search(r"save=(\S+)", rest)
    if saved:
        Path(saved[1]).write_text(code)
    if language == "toml":
        read_toml(code, rest.split(" ")[0])
    elif saved is None:
        runners = {"python": run_python, "sh": run_shell, "cpp": compile_cpp, "c": compile_c}
        assert language in runners, f"```{words}: tests/docs/snippets.py says what may stand behind a fence"
        runners[language](code, example)


def remember(example: Example) -> None:
    """An invisible block: Python and shell run; C++ is put before the next compiled block."""
    language = example.region.lexemes["words"]
    if language == "cpp":
        example.namespace["before"] = [*example.namespace.get("before", []), str(example.parsed)]
    else:
        evaluate(example)


def refuse(example: Example) -> None:
    raise AssertionError("an indented block: write it between fences, with a language")


def blocks(document: Document) -> Iterable[Region]:
    """Every block of a page, found by a Markdown parser."""
    starts = [0]
    for line in document.text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    for token in MarkdownIt().parse(document.text):
        if token.map is None:
            continue
        first, last = starts[token.map[0]], starts[min(token.map[1], len(starts) - 1)]
        if token.type == "fence":
            code = Lexeme(token.content, offset=0, line_offset=0)
            yield Region(first, last, code, evaluate, {"words": token.info.strip()})
        elif token.type == "code_block":
            yield Region(first, last, token.content, refuse)
        elif token.type == "html_block" and "invisible-code-block" in token.content:
            found = INVISIBLE.fullmatch(token.content.strip())
            code = Lexeme(found[2] if found else "", offset=0, line_offset=0)
            yield Region(first, last, code, remember if found else refuse, {"words": found[1] if found else ""})


def own_folder(namespace: dict[str, Any]) -> None:
    """An empty folder for a page, with `punctura` in PATH."""
    folder = Path(tempfile.mkdtemp(prefix="punctura-page-"))
    (folder / "bin").mkdir()
    program = folder / "bin" / "punctura"
    program.write_text(punctura_command())
    program.chmod(0o755)
    (folder / "work").mkdir()
    (folder / "work" / "run").symlink_to(program)  # ./run VERB is punctura VERB
    namespace["_page"] = folder, os.getcwd(), dict(os.environ)
    os.environ.update(PATH=f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}", HOME=str(folder), MPLBACKEND="agg")
    os.chdir(folder / "work")


def leave_folder(namespace: dict[str, Any]) -> None:
    folder, before, environment = namespace["_page"]
    os.chdir(before)
    os.environ.clear()
    os.environ.update(environment)
    shutil.rmtree(folder)


pytest_collect_file = Sybil([blocks], patterns=PAGES, path=str(ROOT), setup=own_folder, teardown=leave_folder).pytest()

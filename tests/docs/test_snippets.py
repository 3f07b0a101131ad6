"""A wrong code block fails, and a correct one passes."""

import subprocess

import pytest
import snippets
from sybil import Document


def run(folder, page):
    path = folder / "page.md"
    path.write_text(page)
    document = Document.parse(str(path), snippets.blocks)
    snippets.own_folder(document.namespace)
    try:
        examples = list(document.examples())
        for example in examples:
            example.evaluate()
        return len(examples)
    finally:
        snippets.leave_folder(document.namespace)


@pytest.mark.parametrize(
    ("page", "blocks"),
    [
        ("```python\nx = 1\n```\n\n```python\nprint(x)\n```\n\n```text output\n1\n```", 3),
        ("<!-- invisible-code-block: python\nx = 1\n-->\n\n```python\nassert x == 1\n```", 2),
        ("```sh\necho 1 > a\n```\n\n```sh\ntest -f a && punctura --version\n```", 2),
        ("<!-- invisible-code-block: cpp\nint x;\n-->\n\n```cpp\n#include <vector>\nx = 1;\n```", 2),
        ("```toml limits save=l.toml\nmax_force_N = 0.5\n```\n\n```sh\ntest -f l.toml\n```", 2),
        ("```sh no-run: it needs a device\npunctura run\n```", 1),
        ("```text\na drawing\n```", 1),
    ],
)
def test_a_block_that_is_what_it_says_passes(tmp_path, page, blocks):
    assert run(tmp_path, page) == blocks


@pytest.mark.parametrize(
    "page",
    [
        "```python\nassert False\n```",
        "```python\nprint(2)\n```\n\n```text output\n1\n```",
        "```sh\nfalse\ntrue\n```",
        "```sh\nfalse | true\n```",
        "```cpp\nint x = undeclared;\n```",
        "```toml limits\nmax_force = 0.5\n```",
        "```toml scene\nname = 'no needle'\n```",
        "```toml\na = 1\n```",
        "```sh no-run:\npunctura run\n```",
        "```python no-run: its grammar is still checked\nif\n```",
        "```sh no-run: its grammar is still checked\nif\n```",
        "```rust\nfn main() {}\n```",
        "```\nno language\n```",
        "words\n\n    an indented block\n",
        "<!-- invisible-code-block: python x = 1 -->\n",
    ],
)
def test_a_block_that_is_not_what_it_says_fails(tmp_path, page):
    with pytest.raises((AssertionError, SyntaxError, ValueError, subprocess.CalledProcessError)):
        run(tmp_path, page)

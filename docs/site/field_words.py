"""The words of a field, for the reference: the comment beside it or above it in its class."""

import ast
import enum
import io
import re
import sys
import tokenize
from pathlib import Path

from punctura._core import Fault, describe
from sphinx.pycode import ModuleAnalyzer

FIELD = re.compile(r"(\w+)(?: *:| = )")


def comments(source: str) -> dict[str, str]:
    """Of the source of a class: name of each field, and the comment behind it or the lines of comment above it."""
    found: dict[str, str] = {}
    above: list[str] = []
    name, depth = "", 0
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        own_line = token.line[: token.start[1]].isspace()
        if token.type == tokenize.COMMENT and own_line and depth == 0:
            above.append(token.string.lstrip("#: "))
        elif token.type == tokenize.COMMENT and name and depth == 0:
            found[name] = " ".join(filter(None, [found.get(name), token.string.lstrip("#: ")]))
        elif token.type == tokenize.NAME and own_line and depth == 0:
            field = FIELD.match(token.line.strip())
            name = field[1] if field and token.start[1] == 4 and field[1] == token.string else ""
            if name and above:
                found[name] = " ".join(above)
            above = []
        elif token.type == tokenize.OP:
            depth += (token.string in "([{") - (token.string in ")]}")
        elif token.type == tokenize.NEWLINE and depth == 0:
            name = ""
    return found


def members(kind: object) -> list[str]:
    """The members of a compiled enumeration with their words, as a list: autodoc shows only their numbers."""
    if not (isinstance(kind, type) and issubclass(kind, enum.Enum)):
        return []
    words = {one.name: describe(one) if isinstance(one, Fault) else one.__doc__ or "" for one in kind}
    return ["", *(f"- `{name}`: {text}" for name, text in words.items())]


def give_words() -> None:
    """Lets autodoc find them, as if they were its own kind of comment."""
    for name, module in list(sys.modules.items()):
        if not name.startswith("punctura") or not (getattr(module, "__file__", None) or "").endswith(".py"):
            continue
        text = Path(module.__file__ or "").read_text(encoding="utf-8")
        analyzer = ModuleAnalyzer.for_module(name)
        analyzer.analyze()
        for node in ast.parse(text).body:
            if isinstance(node, ast.ClassDef):
                source = "\n".join(text.splitlines()[node.lineno - 1 : node.end_lineno]) + "\n"
                for field, words in comments(source).items():
                    analyzer.attr_docs.setdefault((node.name, field), [words, ""])

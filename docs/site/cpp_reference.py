"""The C++ reference: one page for each room, from the public headers and the comments in them.

The headers are parsed as text (tree-sitter), without a compiler and without their includes. A declaration is shown as
it is written. `///` comments stand above what they describe, `///<` comments behind it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import tree_sitter_cpp
from layout import ROOT
from sphinx.domains.cpp import DefinitionError, DefinitionParser
from text import escape_rst, heading
from tree_sitter import Language, Node, Parser

PARSER = Parser(Language(tree_sitter_cpp.language()))
# The rest of runtime/ is not for users: makers' libraries, sockets, the parts of a back-end.
PRIVATE = re.compile(r"runtime/punctura_runtime/(os/(?!os\.hpp)|backends/(force_dimension|haply|openhaptics)/)")
CLASSES = {"class_specifier": "class", "struct_specifier": "struct"}


class Entry(NamedTuple):
    """One declaration: its Sphinx directive, its text, its comment and its members."""

    kind: str
    text: str
    comment: str
    members: tuple[Entry, ...] = ()


def headers() -> list[str]:
    """The public headers, relative to the root."""
    found = [*ROOT.glob("core/punctura/**/*.hpp"), *ROOT.glob("runtime/punctura_runtime/**/*.hpp")]
    return sorted(path for path in (p.relative_to(ROOT).as_posix() for p in found) if not PRIVATE.match(path))


def room(header: str) -> str:
    return Path(header).parent.name if header.startswith("core/") else "runtime-" + Path(header).parent.name


def parse(source: str) -> Node:
    return PARSER.parse(source.encode()).root_node


def squeeze(text: str) -> str:
    return re.sub(r"\s+", " ", re.sub(r"//[^\n]*", "", text)).strip().rstrip(";").strip()


def entries(block: Node, public: bool = True, owner: str = "") -> Iterator[Entry]:
    """The public declarations in a namespace or a class, each with its comment."""
    comment: list[str] = []
    children = block.children
    for place, node in enumerate(children):
        text = (node.text or b"").decode()
        if node.type == "comment":
            if text.startswith("///<"):
                continue
            is_doc = text.startswith("///")
            comment = [*comment, text[3:].removeprefix(" ")] if is_doc else []
            continue
        if node.type == "access_specifier":
            public = text.rstrip(":").strip() == "public"
        elif node.type == "namespace_definition":
            name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
            inner = (name.text or b"").decode().removeprefix("punctura").removeprefix("::") if name else "detail"
            if not inner and body is not None:
                yield from entries(body)
            elif inner != "detail" and body is not None:
                yield Entry("namespace", inner, "\n".join(comment), tuple(entries(body)))
        elif node.type in ("preproc_if", "preproc_ifdef"):
            yield from entries(node, public, owner)
        elif public and node.is_named:
            behind = trailing(children[place + 1 :], node)
            yield from entry(node, "\n".join([*comment, behind]).strip(), owner)
        if node.is_named:
            comment = []


def trailing(after: list[Node], node: Node) -> str:
    """The `///<` comment on the last line of a declaration, with its continuation lines below."""
    lines: list[str] = []
    row = node.end_point.row
    for other in after:
        text = (other.text or b"").decode()
        if other.type in (";", ","):
            row = other.end_point.row
        elif other.type == "comment" and text.startswith("///<") and other.start_point.row in (row, row + len(lines)):
            lines.append(text[4:].strip())
        else:
            break
    return "\n".join(lines)


def entry(node: Node, comment: str, owner: str, prefix: str = "") -> Iterator[Entry]:
    """The entry of one node; `prefix` is the template head in front of it."""
    text = (node.text or b"").decode()
    if node.type == "template_declaration":
        inner = node.children[-1] if node.children[-1].is_named else node.children[-2]
        yield from entry(inner, comment, owner, squeeze(text[: inner.start_byte - node.start_byte]))
    elif node.type in CLASSES:
        body, name = node.child_by_field_name("body"), node.child_by_field_name("name")
        if body is None or name is None:
            return
        head = squeeze(text[: body.start_byte - node.start_byte])
        head = re.sub(r"^(class|struct)\s+", "", head)
        members = tuple(entries(body, node.type == "struct_specifier", (name.text or b"").decode()))
        yield Entry(CLASSES[node.type], f"{prefix} {head}".strip(), comment, members)
    elif node.type == "enum_specifier":
        body = node.child_by_field_name("body")
        if body is None:
            return
        head = re.sub(r"^enum\s+(class\s+|struct\s+)?", "", squeeze(text[: body.start_byte - node.start_byte]))
        values = tuple(
            Entry("enumerator", squeeze((child.text or b"").decode()), trailing(body.children[i + 1 :], child))
            for i, child in enumerate(body.children)
            if child.type == "enumerator"
        )
        yield Entry("enum-class" if "class" in text[:12] else "enum", head, comment, values)
    elif node.type == "concept_definition":
        name = node.child_by_field_name("name")
        yield Entry("concept", f"{prefix} {(name.text if name else b'').decode()}", f"{comment}\n\n::code\n{text}")
    elif node.type == "alias_declaration":
        yield Entry("type", f"{prefix} {squeeze(text).removeprefix('using ')}".strip(), comment)
    elif node.type in ("function_definition", "declaration", "field_declaration"):
        text = re.sub(r"^alignas\(\w+\)\s+", "", text)  # Sphinx does not read it
        yield from declaration(node, text, comment, owner, prefix)


def declaration(node: Node, text: str, comment: str, owner: str, prefix: str) -> Iterator[Entry]:
    body = node.child_by_field_name("body")
    for child in node.children:  # a class or an enumeration that is declared together with nothing
        if child.type in (*CLASSES, "enum_specifier") and child.child_by_field_name("body") is not None:
            yield from entry(child, comment, owner, prefix)
            return
    end = body.start_byte if body is not None else node.end_byte
    for child in node.children:
        if child.type == "field_initializer_list":  # of a constructor
            end = child.start_byte
    head = squeeze(text.encode()[: end - node.start_byte].decode())
    if head.startswith(("friend ", "static_assert")) or re.search(r"= delete$", head):
        return
    if re.match(rf"(explicit )?(?!{owner}\b)\w+\(.*->", head) and not owner:
        return  # a deduction guide
    if node.type == "function_definition" or is_function(node):
        head = re.sub(r"= \[\] \{[^}]*\}", "= {}", head)  # Sphinx cannot parse a lambda
        yield Entry("function", f"{prefix} {head}".strip(), comment)
        return
    if "[](" in head:  # Sphinx cannot parse a lambda: the value of a variable stays in the header
        head = head.split(" =")[0]
    head = re.sub(r"\s*\{.*\}$|\s*=\s*\{.*$|(\[\w*\])\s*=.*$", r"\1", head)
    several = re.fullmatch(r"((?:[\w:]+(?:<.*>)?\s+)+)(\w+(?: = [^,]+)?(?:, \w+(?: = [^,]+)?)+)", head)
    for one in several[2].split(", ") if several else [head]:
        yield Entry("member", f"{prefix} {several[1] if several else ''}{one}".strip(), comment)


def is_function(node: Node) -> bool:
    """Whether a declaration declares a function and not a pointer to a function."""
    found = node.child_by_field_name("declarator")
    while found is not None and found.type != "function_declarator":
        found = found.child_by_field_name("declarator") or next(
            (c for c in found.named_children if c.type.endswith("declarator")), None
        )
    inner = found.child_by_field_name("declarator") if found is not None else None
    return inner is not None and inner.type != "parenthesized_declarator"


class Config:
    """The configuration that Sphinx's parser needs."""

    cpp_id_attributes: tuple[str, ...] = ()
    cpp_paren_attributes: tuple[str, ...] = ()


def sphinx_reads(one: Entry) -> bool:
    if one.kind == "namespace":
        return True
    kinds = {"enum-class": "enum", "struct": "class"}
    try:
        parser = DefinitionParser(one.text, location=None, config=Config())  # type: ignore[arg-type]
        parser.parse_declaration(kinds.get(one.kind, one.kind), one.kind if one.kind != "enum-class" else "enum-class")
        parser.assert_end()
    except DefinitionError:
        return False
    return True


def shown(one: Entry, indent: str = "") -> Iterator[str]:
    """The lines of reStructuredText for one entry."""
    comment, _, listing = one.comment.partition("::code\n")
    if one.kind == "namespace":
        yield from (f"In the namespace ``punctura::{one.text}``:", "", f".. cpp:namespace-push:: {one.text}")
    elif sphinx_reads(one):
        yield f"{indent}.. cpp:{one.kind}:: {one.text}"
        if indent:
            yield f"{indent}   :no-contents-entry:"  # the page's own contents list classes and functions, not members
        indent += "   "
    else:
        yield from (f"{indent}.. code-block:: cpp", "", f"{indent}   {one.text}")
    yield ""
    for line in escape_rst(comment).strip().splitlines():
        yield f"{indent}{line}".rstrip()
    yield ""
    if listing:
        yield from (f"{indent}.. code-block:: cpp", "", *(f"{indent}   {line}" for line in listing.splitlines()), "")
    for member in one.members:
        yield from shown(member, indent)
    if one.kind == "namespace":
        yield from (".. cpp:namespace-pop::", "")


def about(text: str) -> str:
    """The comment at the top of a header."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("//"):
            break
        lines.append(line[2:].strip())
    return escape_rst(" ".join(lines))


def pages() -> Iterator[tuple[str, str]]:
    """(name, text) of every page: an index and one page for each room."""
    rooms: dict[str, list[str]] = {}
    for header in headers():
        rooms.setdefault(room(header), []).append(header)
    index = [
        *heading("C++ reference"),
        "Everything is in the namespace ``punctura``. Each page is one folder of headers.",
        "",
    ]
    yield "index.rst", "\n".join([*index, ".. toctree::", "", *(f"   {name}" for name in rooms), ""])
    for name, files in rooms.items():
        lines = heading(name.replace("runtime-", "runtime: "))
        for header in files:
            text = (ROOT / header).read_text(encoding="utf-8")
            include = header.split("/", 1)[1]
            lines += [f".. _{header}:", "", *heading(include, "-"), about(text), ""]
            lines += ["", ".. code-block:: cpp", "", f'   #include "{include}"', "", ".. cpp:namespace:: punctura", ""]
            for one in entries(parse(text)):
                lines += shown(one)
        yield f"{name}.rst", "\n".join(lines)

"""The generated pages of the reference: Python, the command line, the keys of a scene file."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from typing import Any

from text import heading

PACKAGES = {
    "punctura": "Needle, membranes, laws, proxies, scenes, simulation",
    "punctura.live": "Devices and the servo loop",
    "punctura.record": "Recordings",
    "punctura.events": "Touch, pop, out",
    "punctura.exercise": "Exercises, attempts, results",
    "punctura.scene": "Scene files",
    "punctura.simulation": "From motion file to force file",
    "punctura.reproduce": "The figures of K06",
}


def python_pages() -> Iterator[tuple[str, str]]:
    """(name, text): an index, and one page a public package with what its __all__ names."""
    index = [*heading("Python reference"), ".. toctree::", "", *(f"   {name}" for name in PACKAGES), ""]
    yield "index.rst", "\n".join(index)
    shown: set[int] = set()
    for name, words in PACKAGES.items():
        package = importlib.import_module(name)
        again = [member for member in package.__all__ if id(getattr(package, member)) in shown]
        shown |= {id(getattr(package, member)) for member in package.__all__}
        directive = [f".. automodule:: {name}", *([f"   :exclude-members: {', '.join(again)}"] if again else [])]
        yield f"{name}.rst", "\n".join([*heading(name), f"{words}.", "", *directive, ""])


def command_line_page() -> str:
    """What the program says of its own verbs and options."""
    import typer.cli
    from punctura.cli._app import build_app

    command: Any = typer.main.get_command(build_app())
    text: str = typer.cli.get_docs_for_click(
        obj=command, ctx=typer.Context(command), name="punctura", title="Command line"
    )
    return text


def cell(value: object) -> str:
    return str(value).replace("|", "\\|").replace("\n", " ")


def bounds(schema: dict[str, Any]) -> str:
    """What a value may be: a list of words, or a range."""
    if "enum" in schema or "const" in schema:
        return ", ".join(f"`{value}`" for value in schema.get("enum", [schema.get("const")]))
    signs = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
    return " and ".join(f"{sign} {schema[key]:g}" for key, sign in signs.items() if key in schema)


def table(schema: dict[str, Any]) -> Iterator[str]:
    yield "| key | unit | symbol | allowed | default | meaning |"
    yield "|---|---|---|---|---|---|"
    required = schema.get("required", [])
    for key, value in schema["properties"].items():
        if "$ref" in value or value.get("items", {}).get("$ref"):
            continue
        default = "" if key in required or value.get("default") is None else f"`{value['default']}`"
        columns = (
            value.get("x-unit", ""),
            value.get("x-symbol", ""),
            bounds(value),
            default,
            value.get("description", ""),
        )
        yield f"| `{key}` | " + " | ".join(cell(column) for column in columns) + " |"


def scene_keys_page() -> str:
    """The JSON Schema of scene files as tables."""
    from punctura import scene_json_schema

    schema: dict[str, Any] = scene_json_schema()
    lines = [
        "# Keys of a scene file",
        "",
        "From the JSON Schema that `punctura schema` prints. [Scene files](../docs/scene-file.md) has examples.",
        "",
    ]
    lines += ["## Top level", "", *table(schema), ""]
    for key, value in schema["properties"].items():
        reference = value.get("$ref") or value.get("items", {}).get("$ref")
        if reference:
            part = schema["$defs"][reference.rsplit("/", 1)[1]]
            name = f"[[{key}]]" if "items" in value else f"[{key}]"
            lines += [f"## `{name}`", "", part.get("description", ""), "", *table(part), ""]
    return "\n".join(lines)

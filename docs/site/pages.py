"""The generated pages of the reference: Python, the command line, the keys of a scene file."""

import importlib
import re
from collections.abc import Iterator
from typing import Any

from text import escape_rst, heading

# In the order in which a reader comes to need them.
PACKAGES = [
    "punctura", "punctura.scene", "punctura.simulation", "punctura.batches", "punctura.poses", "punctura.syringe",
    "punctura.live", "punctura.record", "punctura.events", "punctura.compare", "punctura.exercise",
    "punctura.trace", "punctura.identify", "punctura.rivals", "punctura.study", "punctura.perception",
    "punctura.gym", "punctura.mujoco", "punctura.fmu", "punctura.studio.client", "punctura.reproduce",
    "punctura.paths", "punctura.errors",
]  # fmt: skip
# Of modules without __all__.
NAMES = {"punctura.poses": ["PosedNeedle", "PoseWarning"], "punctura.studio.client": ["StudioClient"]}


def python_pages() -> Iterator[tuple[str, str]]:
    """(name, text): an index, and for each public package one page with its names."""
    index = [*heading("Python reference"), ".. toctree::", "   :hidden:", "", *(f"   {name}" for name in PACKAGES), ""]
    index += [f"- :doc:`{name}`: {first_words(name)}" for name in PACKAGES]
    yield "index.rst", "\n".join([*index, ""])
    shown: set[int] = set()
    for name in PACKAGES:
        package = importlib.import_module(name)
        names = NAMES.get(name) or package.__all__
        again = [member for member in names if id(getattr(package, member)) in shown]
        shown |= {id(getattr(package, member)) for member in names}
        directive = [f".. automodule:: {name}"]
        directive += [f"   :exclude-members: {', '.join(again)}"] if again else []
        if name in NAMES:
            directive += ["   :no-members:", "", *(f".. autoclass:: {name}.{member}" for member in names)]
        yield f"{name}.rst", "\n".join([*heading(name), *directive, ""])


def first_words(name: str) -> str:
    """The first paragraph of a package, without the place of its page in the tree."""
    words = (importlib.import_module(name).__doc__ or "").partition("\n\n")[0]
    return escape_rst(re.sub(r" \(docs/[\w-]+\.md\)", "", " ".join(words.split())))


def command_line_page() -> str:
    """The help of the program: its verbs and options."""
    import typer.cli
    from punctura.cli._app import build_app

    command: Any = typer.main.get_command(build_app())
    for verb in [command, *command.commands.values()]:
        for inner in getattr(verb, "commands", {}).values():
            inner.short_help = (inner.help or "").partition("\n\n")[0].replace("\n", " ")  # else it is cut off
    text: str = typer.cli.get_docs_for_click(
        obj=command, ctx=typer.Context(command), name="punctura", title="Command line"
    )
    return text


def cell(value: object) -> str:
    return str(value).replace("|", "\\|").replace("\n", " ")


def bounds(schema: dict[str, Any]) -> str:
    """The allowed values: a list of words, or a range."""
    words = schema.get("enum", [schema["const"]] if "const" in schema else [])
    numbers = all(isinstance(word, int) for word in words)
    if numbers and len(words) > 5 and words == list(range(words[0], words[-1] + 1)):
        return f"{words[0]} to {words[-1]}"
    signs = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
    return ", ".join(f"`{word}`" for word in words) or " and ".join(
        f"{sign} {schema[key]:g}" for key, sign in signs.items() if key in schema
    )


def table(schema: dict[str, Any]) -> Iterator[str]:
    yield "| key | meaning | unit | allowed | default | K06 |"
    yield "|---|---|---|---|---|---|"
    for key, value in schema["properties"].items():
        if "$ref" in value or value.get("items", {}).get("$ref"):
            continue
        given = value.get("default")
        default = "required" if key in schema.get("required", []) else "" if given is None else f"`{given}`"
        columns = (
            value.get("description", ""),
            value.get("x-unit", ""),
            bounds(value),
            default,
            value.get("x-symbol", ""),
        )
        yield f"| `{key}` | " + " | ".join(cell(column) for column in columns) + " |"


def scene_keys_page() -> str:
    """The JSON Schema of scene files as tables."""
    from punctura.scene import scene_json_schema

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

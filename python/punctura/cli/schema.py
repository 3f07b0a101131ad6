"""`punctura schema`: the scene file as JSON Schema."""

import json

import typer

from punctura.scene import scene_json_schema


def command() -> None:
    """Prints the JSON Schema of scene files. It has keys, units, bounds, defaults and help."""
    typer.echo(json.dumps(scene_json_schema(), indent=2))

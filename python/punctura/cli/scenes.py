"""`punctura scenes`: the scenes that come with the package."""

import json
from typing import Annotated

import typer

from punctura.scene import load_scene, scene_names, scene_path


def command(as_json: Annotated[bool, typer.Option("--json", help="Print the list as JSON.")] = False) -> None:
    """Lists the ready scenes by name."""
    scenes = {name: load_scene(name) for name in scene_names()}
    if as_json:
        entries = [
            {
                "name": name,
                "title": scene.name,
                "membranes": [placed.name for placed in scene.membranes],
                "file": str(scene_path(name)),
            }
            for name, scene in scenes.items()
        ]
        typer.echo(json.dumps(entries, indent=2))
        return
    width = max(len(name) for name in scenes)
    for name, scene in scenes.items():
        typer.echo(f"{name:{width}}  {scene.name}: {', '.join(placed.name for placed in scene.membranes)}")

"""`punctura paths`: where the C++ headers and the CMake files are."""

from typing import Annotated

import typer

from punctura.paths import cmake_dir, include_dir


def command(
    include: Annotated[bool, typer.Option("--include", help="Print the folder of the C++ headers only.")] = False,
    cmake: Annotated[bool, typer.Option("--cmake", help="Print the folder of the CMake package only.")] = False,
) -> None:
    """Prints the folders of the C++ headers and the CMake package."""
    if include and cmake:
        raise typer.BadParameter("give --include or --cmake, not both", param_hint="--include")
    if include or cmake:
        typer.echo(include_dir() if include else cmake_dir())
    else:
        typer.echo(f"include  {include_dir()}\ncmake    {cmake_dir()}")

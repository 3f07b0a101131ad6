"""The lines on standard error."""

import typer


def notice(text: str) -> None:
    """Prints `punctura: TEXT` on standard error, so that standard output holds only the result."""
    typer.echo(f"punctura: {text}", err=True)

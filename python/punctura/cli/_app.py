"""Finds the verbs, runs one, and turns errors into a sentence and an exit status.

_status.py has the statuses.
"""

import contextlib
import importlib
import os
import pkgutil
import sys
import threading
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from punctura import __version__
from punctura.cli._status import CALLED_WRONGLY, DEFECT, FAILED
from punctura.cli._streams import (
    StdoutError,
    give_up_stdout,
    leave,
    name_stdout,
    open_closed_streams,
    wait_for_stderr_again,
)
from punctura.defects import PATIENCE_S, explain, is_defect
from punctura.errors import ConfigurationError, IncompleteCallError, NoSuchFileError
from punctura.process.signals import ENDING, Ended, ends_on_signals

_usual_warning = warnings.formatwarning


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"punctura {__version__}")
        raise typer.Exit


def _start(
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """The force of a needle that goes through tissue membranes and comes out again."""


def build_app(verb: str = "") -> typer.Typer:
    """The command line with every verb of this folder, or only with what the first word needs, which starts faster."""
    app = typer.Typer(
        callback=_start,
        no_args_is_help=True,
        context_settings={"help_option_names": ["-h", "--help"]},  # for every verb
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
    )
    names = _verbs()
    if verb == "--version":
        names = []
    elif verb in names:
        names = [verb]
    for name in names:
        command = importlib.import_module(f"punctura.cli.{name.replace('-', '_')}").command
        if isinstance(command, typer.Typer):  # a verb with verbs of its own
            app.add_typer(command, name=name)
        else:
            app.command(name)(command)
    return app


def _verbs() -> list[str]:
    modules = sorted(module.name for module in pkgutil.iter_modules([str(Path(__file__).parent)]))
    return [name.replace("_", "-") for name in modules if not name.startswith("_")]


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the command line; ends the process with its exit status."""
    open_closed_streams()
    name_stdout()
    warnings.formatwarning = _as_sentence
    threading.excepthook = _end_of_thread
    with ends_on_signals(ENDING) as signals:
        try:
            given = list(sys.argv[1:] if arguments is None else arguments)
            if _WITH_TABLES.intersection(given[:2]) and not {"-h", "--help"}.intersection(given):
                _keep_pandas_away()
            with signals.raised():
                build_app(*given[:1])(given, prog_name="punctura")
        except Exception as error:
            words = explain(error, PATIENCE_S)
            if isinstance(error, ConfigurationError | IncompleteCallError | NoSuchFileError):
                _fail(words, CALLED_WRONGLY)
            if isinstance(error, StdoutError):
                give_up_stdout()
            _fail(f"{words}{_where()}", DEFECT if is_defect(error) else FAILED)
        except Ended as end:
            leave(end)
        except SystemExit as done:
            if signals.number and not done.code:  # compiled code has swallowed the exception of the signal
                leave(Ended(signals.number))
            raise
        finally:
            if isinstance(
                sys.exc_info()[1], SystemExit | None
            ):  # else there is a traceback, which must not wait for its reader
                wait_for_stderr_again()


# These verbs make Arrow arrays.
_WITH_TABLES = frozenset({"export", "identify", "measure", "replay", "rivals", "score", "simulate", "study"})


class _NoPandas:
    @staticmethod
    def find_spec(name: str, path: object = None, target: object = None) -> None:
        if name == "pandas":
            raise ModuleNotFoundError(name=name)


def _keep_pandas_away() -> None:
    """With its first array, pyarrow imports pandas to know its classes. No verb needs it, and it takes 0.3 s."""
    with contextlib.suppress(ModuleNotFoundError):
        arrow = importlib.import_module("pyarrow")
        sys.meta_path.insert(0, _NoPandas)
        arrow.array([0])
        sys.meta_path.remove(_NoPandas)


def _as_sentence(
    message: Warning | str, category: type[Warning], filename: str, lineno: int, line: str | None = None
) -> str:
    """A warning as the command line prints it: without a place in Punctura's sources."""
    if category.__module__.startswith("punctura."):
        return f"punctura: warning: {message}\n"
    return _usual_warning(message, category, filename, lineno, line)


def _end_of_thread(end: threading.ExceptHookArgs) -> None:
    if isinstance(end.exc_value, Exception):
        print(f"punctura: {explain(end.exc_value)}", file=sys.stderr)


def _where() -> str:
    """The advice for a missing folder, such as the current folder after its removal."""
    try:
        os.getcwd()
    except OSError:
        return ". The folder that this command was started in has been deleted: change to another one and try again"
    return ""


def _fail(error: object, status: int) -> None:
    print(f"punctura: {error}", file=sys.stderr)
    sys.exit(status)

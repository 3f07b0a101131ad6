"""The options of how to read a trace file, and one message for all that is missing."""

from __future__ import annotations

import math
import shlex
import warnings
from collections.abc import Callable, Sequence
from importlib import import_module
from inspect import Parameter, Signature, signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, get_type_hints

import typer

from punctura import Needle
from punctura.cli._out import notice

if TYPE_CHECKING:
    from punctura.trace import Trace
    from punctura.trace.reading import Reading

Column = Annotated[
    list[str] | None,
    typer.Option("--column", help="A column by name or number: depth=z, force=2.", metavar="ROLE=NAME"),
]
Unit = Annotated[
    list[str] | None, typer.Option("--unit", help="A unit: depth=mm, force=mN, time=ms.", metavar="ROLE=UNIT")
]
Order = Annotated[
    Literal["recorded", "depth"], typer.Option("--order", help="depth: a digitised curve of one insertion.")
]
Point = Annotated[
    Literal["point", "comma"] | None,
    typer.Option("--decimal", help="The decimal mark, where a file can be read in two ways."),
]
Encoding = Annotated[
    str | None, typer.Option("--encoding", help="Encoding of a text file: gbk, shift_jis, utf-16, ...", metavar="NAME")
]
Sheet = Annotated[str | None, typer.Option("--sheet", help="Sheet of a workbook, by name or number.", metavar="NAME")]
Speed = Annotated[
    str | None,
    typer.Option(
        "--speed-mm-per-s",
        help="Speed of the needle, for a file without depth: 4, or 4,0@4,-4@5 (from 4 s on 0, from 5 s on -4).",
        metavar="SPEED",
    ),
]
DepthFile = Annotated[
    Path | None,
    typer.Option("--depth-file", exists=True, help="Another file with depth and time, on the same clock."),
]


def reading_of(
    column: Column = None,
    unit: Unit = None,
    order: Order = "recorded",
    decimal: Point = None,
    encoding: Encoding = None,
    sheet: Sheet = None,
    speed: Speed = None,
    depth_file: DepthFile = None,
) -> Reading:
    """What the options state about a file. Raises typer.BadParameter."""
    from punctura.trace.reading import Reading

    if speed is not None and depth_file is not None:
        raise typer.BadParameter("gives the depth, and --depth-file, too: state one", param_hint="--speed-mm-per-s")
    return Reading(
        pairs(column, "--column", "depth=NAME", empty=True), pairs(unit, "--unit", "depth=mm"), order,
        None if decimal is None else "," if decimal == "comma" else ".", encoding, sheet,
        _speeds(speed), None if depth_file is None else str(depth_file),
    )  # fmt: skip


def with_reading(subject: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """A verb that has the options of reading_of() in the place of its parameter `reading`, and gets a Reading.

    subject: the module of what the verb does. It is imported first, so that it names the extra of a missing package.
    """

    def decorate(command: Callable[..., None]) -> Callable[..., None]:
        def run(**given: Any) -> None:
            import_module(subject)
            command(reading=reading_of(**{name: given.pop(name) for name in options}), **given)

        options = _parameters(reading_of)
        parameters: dict[str, Parameter] = {}
        for name, parameter in _parameters(command).items():
            parameters |= options if name == "reading" else {name: parameter}
        run.__doc__ = command.__doc__
        run.__annotations__ = {name: parameter.annotation for name, parameter in parameters.items()}  # for typer
        run.__signature__ = Signature(list(parameters.values()))  # type: ignore[attr-defined]  # for typer
        return run

    return decorate


def _parameters(function: Callable[..., object]) -> dict[str, Parameter]:
    types = get_type_hints(function, localns={"Reading": object}, include_extras=True)
    return {
        name: Parameter(name, Parameter.KEYWORD_ONLY, default=parameter.default, annotation=types[name])
        for name, parameter in signature(function).parameters.items()
    }


def _speeds(text: str | None) -> tuple[tuple[float, float], ...]:
    """((0, 4e-3), (4, 0)) of `4,0@4`: from which time on (s), how fast (m/s). Raises typer.BadParameter."""
    parts = [part.partition("@") for part in (text or "").split(",") if text]
    try:
        speeds = tuple((float(start or 0), float(speed) * 1e-3) for speed, _, start in parts)
    except ValueError:
        speeds = ((math.nan, 0.0),)
    starts = [start for start, _ in speeds]
    if speeds and (starts[0] != 0 or sorted(set(starts)) != starts or not all(map(math.isfinite, sum(speeds, ())))):
        raise typer.BadParameter(
            "must be as 4 or 4,0@4,-4@5: mm/s, with growing times in s", param_hint="--speed-mm-per-s"
        )
    return speeds


def pairs(given: list[str] | None, option: str, example: str, empty: bool = False) -> dict[str, str]:
    """{"depth": "mm"} of ["depth=mm"]. example: one of this option.

    empty: whether a value may be empty: `time=`, no column is the time.
    """
    found = {}
    for text in given or []:
        role, equals, value = text.partition("=")
        if not equals or not (value or empty):
            raise typer.BadParameter(f"{text!r} must be as {example}", param_hint=option)
        found[role.strip()] = value.strip()
    return found


class MissingNeedle(typer.BadParameter):
    """The needle is not stated."""

    def __init__(self) -> None:
        super().__init__(
            "is missing; state the needle, for example --needle diameter_mm=2,tip_angle_deg=45 (only a recording of "
            "Punctura states its own)",
            param_hint="--needle",
        )


def needle_of(text: str, trace: Path | None = None) -> Needle:
    """The needle of `diameter_mm=2,tip_angle_deg=45`. Without a text that of the trace, if it is a recording."""
    if not text:
        from punctura.trace.read import recorded_needle

        if trace is not None and trace.is_file() and (recorded := recorded_needle(trace)) is not None:
            return recorded
        raise MissingNeedle
    try:
        values = {name.strip(): float(value) for name, _, value in (part.partition("=") for part in text.split(","))}
    except ValueError:
        values = {}
    angles = values.keys() - {"diameter_mm"}
    if values.keys() - angles != {"diameter_mm"} or angles not in ({"tip_angle_deg"}, {"tip_angle_rad"}):
        wanted = "must be diameter_mm=1.2,tip_angle_deg=20 (or tip_angle_rad=0.35), with a decimal point"
        raise typer.BadParameter(wanted, param_hint="--needle")
    try:
        angle = values.get("tip_angle_rad", math.radians(values.get("tip_angle_deg", 0.0)))
        if "tip_angle_deg" in values and not 0 < angle < math.pi / 2:
            raise ValueError(f"tip_angle_deg = {values['tip_angle_deg']:g}: must be between 0 and 90")
        with warnings.catch_warnings(record=True) as unusual:  # its text is about SI units
            warnings.simplefilter("always")
            needle = Needle(values["diameter_mm"] * 1e-3, angle)
    except ValueError as error:
        raise typer.BadParameter(str(error), param_hint="--needle") from None
    if unusual:
        size = f"{needle.diameter * 1e3:g} mm thick, with a tip of {math.degrees(angle):.3g} degrees"
        notice(f"warning: the needle is unusual: {size}. Is that meant?")
    return needle


def read_with_needle(path: Path, reading: Reading, needle: str, context: typer.Context) -> tuple[Trace, Needle]:
    """The trace of a file, and its needle. Raises TraceError that asks at once for all that is not stated."""
    try:
        known = needle_of(needle, path)
    except MissingNeedle as error:
        read_or_ask(path, reading, context, f"--needle {error.message}", "--needle diameter_mm=D,tip_angle_deg=A")
        raise
    return read_or_ask(path, reading, context), known


def read_or_ask(path: Path, reading: Reading, context: typer.Context, text: str = "", option: str = "") -> Trace:
    """The trace of a file. Raises TraceError with the whole command, if something is not stated.

    text, option: what else is not stated, and how to state it; then there is no trace.
    """
    from punctura.trace.read import read_as
    from punctura.trace.trace import IncompleteTraceError, Unstated

    texts, options = [text] if text else [], [option] if option else []
    try:
        trace = read_as(path, reading)
    except Unstated as error:
        texts.append(str(error))
        options += error.options
    if texts:
        raise IncompleteTraceError("\n".join([*texts, f"The whole command: {_command_with(context, options)}"]))
    return trace


def _command_with(context: typer.Context, options: Sequence[str]) -> str:
    """This command with more options, in place of those that state the same."""
    words = ["punctura", str(context.info_name)]
    replaced = {option.split("=")[0] if "=" in option else option.split()[0] for option in options}
    for parameter in context.command.params:
        value = context.params.get(str(parameter.name))
        if parameter.param_type_name == "argument":
            words.append(str(value))
        elif value not in (None, parameter.default, False, []):
            for one in value if isinstance(value, (list, tuple)) else [value]:
                stated = [parameter.opts[0], *([] if one is True else [str(one)])]
                if parameter.opts[0] not in replaced and " ".join(stated).split("=")[0] not in replaced:
                    words += stated
    return " ".join([shlex.join(words), *options])

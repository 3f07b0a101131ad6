"""Says in plain words which argument of a call of the compiled core is wrong."""

from __future__ import annotations

import ast
import difflib
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from punctura import _core


def explained(function: Any, given: Sequence[Any], named: Mapping[str, object], fallback: str) -> str:
    """The message of a TypeError. fallback: nanobind's message, for a signature that cannot be read."""
    signature = _parsed(function.__nb_signature__[-1][0])
    if signature is None:
        return fallback
    parameters, values = _parameters(signature.args), list(given)
    owner, _, name = (function.__qualname__ or signature.name).rpartition(".")
    if not owner and values and next(iter(parameters), "") == "self":  # the setter of a property
        owner = type(values[0]).__name__
    call = owner if name == "__init__" else f"{owner}.{name}" if owner else name
    by_place = len(signature.args.posonlyargs) + len(signature.args.args)
    if next(iter(parameters), "") == "self":
        if owner and (not values or not _fits(owner, values[0])):
            return f"{call}(): needs an object of {owner}, such as made = {owner}(...); made.{name}(...)"
        del parameters["self"]
        values = values[1:]
        by_place -= 1
    faults, got = _assigned(parameters, by_place, values, named)
    if not faults:
        faults = [fault for name, value in got.items() if (fault := _fault(name, parameters[name][0], value))]
    if not faults and not got:
        faults = ["the object has no value: its __init__ has not run, such as that of the base class"]
    if not faults:
        types = ", ".join(f"{name}: {type(value).__name__}" for name, value in got.items())
        faults = [f"an argument has a wrong type or value ({types})"]
    takes = ", ".join(f"{n}: {_plain(text)}{' (optional)' if more else ''}" for n, (text, more) in parameters.items())
    text = "; ".join(faults)
    return f"{call}(): {text}{'' if text.endswith('?') else '.'} It takes ({takes})"


def _parsed(text: str) -> ast.FunctionDef | None:
    try:
        body = ast.parse(re.sub(r"\\\d+", "...", text).replace("def (", "def getter(") + ": ...").body[0]
    except SyntaxError:
        return None
    return body if isinstance(body, ast.FunctionDef) else None


def _parameters(args: ast.arguments) -> dict[str, tuple[str, bool]]:
    """The type of each parameter as text, and whether it is optional."""
    places = [*args.posonlyargs, *args.args]
    required = len(places) - len(args.defaults)
    found = {a.arg: (_text(a), i >= required) for i, a in enumerate(places)}
    return found | {a.arg: (_text(a), d is not None) for a, d in zip(args.kwonlyargs, args.kw_defaults, strict=True)}


def _text(argument: ast.arg) -> str:
    text = ast.unparse(argument.annotation) if argument.annotation else "object"
    return re.sub(r"punctura\._core\.|collections\.abc\.", "", text)


def _assigned(
    parameters: dict[str, tuple[str, bool]], by_place: int, values: list[Any], named: Mapping[str, object]
) -> tuple[list[str], dict[str, object]]:
    """The faults of the names and numbers of the arguments, and the value of each parameter."""
    names = list(parameters)
    faults, unknown = [], []
    if len(values) > by_place:
        rest = f"; name the others: {', '.join(names[by_place:])}" if names[by_place:] else ""
        faults.append(f"takes {by_place} argument{'' if by_place == 1 else 's'} by place, not {len(values)}{rest}")
    got = dict(zip(names[:by_place], values, strict=False))
    for name, value in named.items():
        if name in got:
            faults.append(f"{name} is given twice")
        elif name in parameters:
            got[name] = value
        else:
            unknown.append(name)
    missing = [name for name, (_, more) in parameters.items() if name not in got and name not in named and not more]
    for name in unknown:
        near = difflib.get_close_matches(name, names, 1, 0.5) or (missing if len(missing) == 1 else [])
        faults.append(f"there is no argument {name}" + (f"; did you mean {near[0]}?" if near else ""))
        missing = [other for other in missing if other not in near]
    return faults + [f"{name} is missing" for name in missing], got


def _plain(text: str) -> str:
    """A type as in the documentation of the constructors."""
    text = re.sub(r"typing\.Literal\[([^]]*)\]", lambda found: found[1].replace(", ", " | "), text)
    return re.sub("_Vector|_Numbers", "Sequence[float]", text).replace("numpy.typing.", "")


def _fault(name: str, text: str, value: Any) -> str:
    """What the parameter wants, and what it got; empty if the value may fit."""
    many = re.fullmatch(r"Sequence\[(.+)\]", text)
    if many and (isinstance(value, list | tuple) or getattr(value, "shape", None)):
        return next((fault for i, one in enumerate(value) if (fault := _fault(f"{name}[{i}]", many[1], one))), "")
    if many and _known(many[1]) and (isinstance(value, str | dict) or not hasattr(value, "__getitem__")):
        return f"{name} must be a list of {many[1].removeprefix('tuple')}, not {_shown(value)}"
    kinds = [kind.strip() for kind in text.split(" | ")]
    if all(_known(kind) and not _fits(kind, value) for kind in kinds):
        return f"{name} must be {' or '.join(map(_words, kinds))}, not {_shown(value)}"
    return ""


def _words(kind: str) -> str:
    if kind.startswith("typing.Literal["):
        return _plain(kind).replace(" | ", " or ")
    return _WORDS.get(kind) or (f"a {kind}" if kind.isidentifier() else kind)


_WORDS = {
    "float": "a number",
    "int": "an integer",
    "_Vector": "three numbers",
    "_Numbers": "a list of numbers",
    "tuple[float, float]": "two numbers",
    "tuple[float, float, float]": "three numbers",
    "numpy.typing.ArrayLike": "an array",
    "bytes": "bytes",
    "None": "None",
}
_LENGTHS = {"_Numbers": None, "_Vector": 3, "tuple[float, float]": 2, "tuple[float, float, float]": 3}
_NAMED = {"str": str, "bytes": bytes, "bool": bool, "dict": dict, "None": type(None)}


def _known(kind: str) -> bool:
    return (
        kind in _WORDS
        or kind.split("[")[0] in _NAMED
        or isinstance(getattr(_core, kind, None), type)
        or kind.startswith("typing.Literal[")
    )


def _fits(kind: str, value: Any) -> bool:
    base = kind.split("[")[0]
    if base in _NAMED:
        return isinstance(value, _NAMED[base])
    if kind == "float":
        return _is_number(value)
    if kind == "int":
        return hasattr(type(value), "__index__")
    if kind in _LENGTHS:
        return _are_numbers(value) and _LENGTHS[kind] in (None, len(value))
    if kind == "numpy.typing.ArrayLike":
        return value is not None
    if base == "typing.Literal":
        return isinstance(value, str)
    return any(cls.__name__ == kind for cls in type(value).__mro__)


def _is_number(value: Any) -> bool:
    if isinstance(value, str | bytes | bytearray) or getattr(value, "shape", ()) != ():
        return False
    if np.iscomplexobj(value) or np.ma.is_masked(value):  # float() takes them
        return False
    try:
        float(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def _are_numbers(value: Any) -> bool:
    if isinstance(value, str | bytes | bytearray | dict | set):
        return False
    try:
        return len(value) >= 0 and all(map(_is_number, value))
    except TypeError:
        return False


def _shown(value: Any) -> str:
    name = type(value).__name__
    if getattr(value, "shape", ()) != ():
        what = ", complex" if np.iscomplexobj(value) else ", with masked elements" if np.ma.is_masked(value) else ""
        return f"{name} of shape {tuple(value.shape)}{what}"
    if isinstance(value, list | tuple):
        if len(value) == 3:
            return f"{name} with {', '.join(sorted({type(part).__name__ for part in value}))}"
        return f"{name} of length {len(value)}"
    if isinstance(value, int) and not _is_number(value):
        return "an integer that large"
    return name

"""The kinds of values in a file, as types of a pydantic schema.

They check only the type of a value. The core checks its bounds.
"""

from decimal import Decimal
from typing import Annotated, Any

from pydantic import PlainSerializer, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from punctura._core import longest_name

AUTOMATIC = "automatic"
LONGEST_NAME = longest_name  # characters


def _as_decimal(value: object) -> Decimal | None:
    if isinstance(value, bool) or not isinstance(value, (int, float, Decimal)):
        return None
    return value if isinstance(value, Decimal) else Decimal(repr(value))


def _number(value: object) -> Decimal:
    number = _as_decimal(value)
    if number is None:
        raise PydanticCustomError("number", "must be a number")
    return number


def _number_or_automatic(value: object) -> Decimal | str:
    if value == AUTOMATIC:
        return AUTOMATIC
    number = _as_decimal(value)
    if number is None:
        raise PydanticCustomError("number_or_automatic", 'must be a number or "automatic"')
    return number


def _numbers(value: object, names: str) -> tuple[Decimal, ...]:
    """names: names of the numbers, such as "x, y, z"."""
    given = [_as_decimal(v) for v in value] if isinstance(value, (list, tuple)) else []
    numbers = tuple(n for n in given if n is not None)
    count = names.count(",") + 1
    if len(given) != count or len(numbers) != count:
        words = {3: "three", 4: "four"}[count]
        raise PydanticCustomError("vector", f"must be {words} numbers, [{names}]")
    return numbers


def _number_list(value: object) -> tuple[Decimal, ...]:
    given = [_as_decimal(v) for v in value] if isinstance(value, (list, tuple)) else [None]
    numbers = tuple(n for n in given if n is not None)
    if len(numbers) != len(given):
        raise PydanticCustomError("numbers", "must be a list of numbers, as [0, 0.5, 1]")
    return numbers


def _vector(value: object) -> tuple[Decimal, ...]:
    return _numbers(value, "x, y, z")


def _quaternion(value: object) -> tuple[Decimal, ...]:
    return _numbers(value, "w, x, y, z")


def _buttons(value: object) -> list[int]:
    given = value if isinstance(value, list) else []
    numbers = [n for n in given if isinstance(n, int) and not isinstance(n, bool) and 1 <= n <= 32]
    if not isinstance(value, list) or len(numbers) != len(given):
        raise PydanticCustomError("buttons", "must be a list of buttons, each 1 to 32")
    return numbers


def _whole_number(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise PydanticCustomError("whole_number", "must be a whole number")
    return value


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise PydanticCustomError("text", "must be text, in quotes")
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, str):
        return value
    return [float(v) for v in value] if isinstance(value, tuple) else float(value)


_VECTOR_SCHEMA = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}

# Numbers stay decimals, exactly as written, until they are converted to SI (files/units.py).
_AS_FLOAT = PlainSerializer(_plain, when_used="json")
Number = Annotated[Decimal, PlainValidator(_number), _AS_FLOAT, WithJsonSchema({"type": "number"})]
NumberOrAutomatic = Annotated[
    Decimal | str,
    PlainValidator(_number_or_automatic),
    _AS_FLOAT,
    WithJsonSchema({"anyOf": [{"type": "number"}, {"const": AUTOMATIC}]}),
]
Vector = Annotated[tuple[Decimal, Decimal, Decimal], PlainValidator(_vector), _AS_FLOAT, WithJsonSchema(_VECTOR_SCHEMA)]
Numbers = Annotated[
    tuple[Decimal, ...],
    PlainValidator(_number_list),
    _AS_FLOAT,
    WithJsonSchema({"type": "array", "items": {"type": "number"}}),
]
Quaternion = Annotated[tuple[Decimal, Decimal, Decimal, Decimal], PlainValidator(_quaternion)]
Buttons = Annotated[list[int], PlainValidator(_buttons)]
WholeNumber = Annotated[int, PlainValidator(_whole_number), WithJsonSchema({"type": "integer"})]
Text = Annotated[str, PlainValidator(_text), WithJsonSchema({"type": "string"})]
Name = Annotated[str, PlainValidator(_text), WithJsonSchema({"type": "string", "maxLength": LONGEST_NAME})]

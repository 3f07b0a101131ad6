"""The kinds of value a scene file holds, as types of the schema.

They check only what the value is; which values are admissible is the core's to say (punctura._core.fields).
"""

from __future__ import annotations

from decimal import Decimal
from typing import Annotated, Any

from pydantic import PlainSerializer, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError


def _as_decimal(value: object) -> Decimal | None:
    if isinstance(value, bool) or not isinstance(value, (int, float, Decimal)):
        return None
    return value if isinstance(value, Decimal) else Decimal(repr(value))


def _number(value: object) -> Decimal:
    number = _as_decimal(value)
    if number is None:
        raise PydanticCustomError("number", "must be a number")
    return number


def _vector(value: object) -> tuple[Decimal, Decimal, Decimal]:
    numbers = [_as_decimal(v) for v in value] if isinstance(value, (list, tuple)) else []
    if len(numbers) != 3 or any(n is None for n in numbers):
        raise PydanticCustomError("vector", "must be three numbers, [x, y, z]")
    x, y, z = (n for n in numbers if n is not None)
    return x, y, z


def _whole_number(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise PydanticCustomError("whole_number", "must be a whole number")
    return value


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise PydanticCustomError("text", "must be text, in quotes")
    return value


def _plain(value: Any) -> Any:
    return [float(v) for v in value] if isinstance(value, tuple) else float(value)


_VECTOR_SCHEMA = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}

# Numbers are decimals, as they were written, until they are converted to SI (scene/units.py).
_AS_FLOAT = PlainSerializer(_plain, when_used="json")
Number = Annotated[Decimal, PlainValidator(_number), _AS_FLOAT, WithJsonSchema({"type": "number"})]
Vector = Annotated[tuple[Decimal, Decimal, Decimal], PlainValidator(_vector), _AS_FLOAT, WithJsonSchema(_VECTOR_SCHEMA)]
WholeNumber = Annotated[int, PlainValidator(_whole_number), WithJsonSchema({"type": "integer"})]
Text = Annotated[str, PlainValidator(_text), WithJsonSchema({"type": "string"})]

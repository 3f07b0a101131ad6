"""Checks the wire format on the data of tools/make_contract.py, which web/tests/wire/contract.test.ts also reads."""

import base64
import json

import make_contract
import numpy as np
import pytest
from punctura._core import Limit
from punctura.live.force_words import LIMIT_WORDS
from punctura.studio.wire import FrameError, decode_ticks, encode_ticks, parse_request
from punctura.studio.wire.frames import NUMBERS, WORDS
from punctura.studio.wire.messages import Message
from punctura.studio.wire_schema import wire_schema
from punctura.ticks import Ticks
from punctura.ticks.fields import shape_of
from pydantic import TypeAdapter, ValidationError

FRAMES, MESSAGES = make_contract.frames(), make_contract.messages()
MESSAGE = TypeAdapter(Message)


def numbers(values):
    return np.array([np.nan if v is None else v for v in values], np.float32)


@pytest.mark.parametrize("frame", FRAMES, ids=[f["what"] for f in FRAMES])
def test_a_frame_of_the_contract_reads_as_it_says(frame):
    data = base64.b64decode(frame["bytes"])
    if "holds" not in frame:
        with pytest.raises(FrameError):
            decode_ticks(data)
        return
    ticks, head = decode_ticks(data), frame["head"]
    assert [ticks.first_tick, ticks.first_time, ticks.run, ticks.lost, ticks.membranes, len(ticks)] == list(
        head.values()
    )
    assert set(ticks.ticks) == set(frame["holds"])
    for name, values in frame["holds"].items():
        assert np.array_equal(ticks.ticks[name].ravel().astype(np.float32), numbers(values), equal_nan=True), name


@pytest.mark.parametrize("message", MESSAGES["messages"], ids=[m["kind"] for m in MESSAGES["messages"]])
def test_a_message_of_the_contract_comes_back_as_it_was(message):
    assert json.loads(MESSAGE.validate_json(json.dumps(message)).model_dump_json()) == message


@pytest.mark.parametrize("request_", MESSAGES["requests"], ids=[r["do"] for r in MESSAGES["requests"]])
def test_a_request_of_the_contract_is_understood(request_):
    assert parse_request(json.dumps(request_)).model_dump(mode="json", exclude_unset=True) == request_


@pytest.mark.parametrize("request_", MESSAGES["refused"], ids=[str(i) for i in range(len(MESSAGES["refused"]))])
def test_what_is_no_request_is_refused(request_):
    with pytest.raises(ValidationError):
        parse_request(json.dumps(request_))


def test_the_contract_has_one_of_everything():
    schema = wire_schema()["properties"]
    for what, key, found in (("message", "kind", MESSAGES["messages"]), ("request", "do", MESSAGES["requests"])):
        names = {ref["$ref"].rsplit("/", 1)[1] for ref in schema[what]["oneOf"]}
        tags = {wire_schema()["$defs"][name]["properties"][key]["const"] for name in names}
        assert tags == {entry[key] for entry in found}


@pytest.mark.parametrize("seed", range(5))
def test_any_ticks_come_back_as_f32(seed):
    rng = np.random.default_rng(seed)
    n, m = int(rng.integers(1, 40)), int(rng.integers(0, 7))
    first = int(rng.integers(0, 2**40))
    time = 100.0 + np.cumsum(rng.uniform(5e-4, 8e-4, n))
    columns = {field.name: rng.normal(size=shape_of(field, n, m)) for field in NUMBERS}
    columns |= {field.name: rng.integers(0, 5 if field.per_membrane else 255, shape_of(field, n, m)) for field in WORDS}
    columns |= {"tick": np.arange(first, first + n, dtype=np.uint64), "time": time}
    for name in ("plunger", "thumb_force", "pressure", "injected"):  # as in a scene without a syringe
        columns[name] = columns[name] * (np.nan if seed == 0 else 1.0)
    other = rng.normal(size=(n, 3)) if seed % 2 else None
    ticks = decode_ticks(encode_ticks(Ticks(columns), 3, 9, other))
    assert (ticks.first_tick, ticks.run, ticks.lost, ticks.membranes) == (first, 3, 9, m)
    assert np.allclose(ticks.first_time + ticks.ticks.time, time, atol=1e-8)
    for name, column in columns.items():
        if name not in ("tick", "time"):
            assert np.array_equal(ticks.ticks[name].astype(np.float32), column.astype(np.float32), equal_nan=True), name


def test_a_frame_holds_no_gap_and_no_nothing():
    columns = {"tick": np.array([1, 3]), "depth": np.empty((2, 1)), "time": np.zeros(2)}
    with pytest.raises(FrameError):
        encode_ticks(Ticks(columns), 0)
    with pytest.raises(FrameError):
        encode_ticks(Ticks(columns)[:0], 0)


def test_the_page_has_the_words_of_every_limit():
    codes = sorted((limit for limit in Limit.__members__.values()), key=int)
    assert list(LIMIT_WORDS) == [limit.name for limit in codes] and [int(limit) for limit in codes] == [*range(5)]

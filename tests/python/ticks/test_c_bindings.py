"""The declarations of punctura.h in other languages: they are current, and their layout and words are right."""

import ctypes
from pathlib import Path

import make_c_bindings
import pytest
from punctura.ticks import FIELDS

ROOT = Path(__file__).resolve().parents[3]
TYPES = {
    "double": ctypes.c_double, "int32_t": ctypes.c_int32, "uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64,
    "char": ctypes.c_char, "size_t": ctypes.c_size_t,
}  # fmt: skip


@pytest.fixture(scope="module")
def text():
    return (ROOT / "capi/include/punctura.h").read_text(encoding="utf-8")


def test_the_files_are_those_that_the_tool_makes(capsys):
    assert make_c_bindings.main(["--check"]) == 0, capsys.readouterr().out


def test_offsets_are_those_of_the_compiler(text):
    structs = make_c_bindings.Header(text).structs
    assert {s.name for s in structs} >= {"setup", "membrane", "membrane_tick", "limits", "sample", "record", "field"}
    for struct in structs:
        fields = []
        for field in struct.fields:
            kind = ctypes.c_void_p if field.pointers else TYPES[field.kind]
            fields.append((field.name, kind * field.length if field.length else kind))
        real = type(struct.name, (ctypes.Structure,), {"_fields_": fields})
        offsets = [getattr(real, field.name).offset for field in struct.fields]
        assert make_c_bindings.layout(struct, ctypes.sizeof(ctypes.c_void_p)) == (ctypes.sizeof(real), offsets), (
            struct.name
        )


def test_the_words_are_those_of_the_core(text):
    enums = make_c_bindings.Header(text).enums
    for name, field in (("Phase", "phase"), ("ServoState", "state"), ("Limit", "limit")):
        assert enums[name] == list(FIELDS[field].words), name


@pytest.mark.parametrize("line", ["typedef int32_t punctura_new;", "PUNCTURA_API void punctura_f(int (*g)(void));"])
def test_no_declaration_is_left_out_in_silence(text, line):
    with pytest.raises(SystemExit, match="cannot read"):
        make_c_bindings.Header(text.replace("typedef struct punctura_servo", f"{line}\ntypedef struct punctura_servo"))

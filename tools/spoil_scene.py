"""Makes broken and unusual scene files for tools/fuzz_scenes.py."""

import random
import re
from collections.abc import Callable
from pathlib import Path

from punctura.scene.ready import scene_path

WIDE = (Path(__file__).resolve().parents[1] / "tests/python/scene/wide.toml").read_text(encoding="utf-8")
# Valid scenes in different TOML notations.
SEEDS = (
    scene_path("k06-fig12").read_text(encoding="utf-8"),
    """
name = 'dotted and inline, \\ with "quotes"'
needle.gauge = 19
needle.tip_angle_deg = 16  # a comment
"coupling".stiffness_N_per_mm = 4_0.0e-2
coupling."damping_Ns_per_mm" = +0.001
servo = { rate_hz = 0x640, solver = "paper", low_pass_hz = 0 }
membrane = [
  { name = "skin \\u00e9\\t", stiffness_N_per_mm = 57e-2, precompression_N = 0.41, friction = 0.2, \
    thickness_mm = 1.0, point_mm = [0, 0, 0], inward_normal = [0, -1, 0] },
  { name = '''wall''', stiffness_N_per_mm = 0.57, precompression_N = 0.41, friction = 0.2, \
    thickness_mm = 0.5, point_mm = [
      0,  # x
      -4, 0,
    ], inward_normal = [0, -2, 0] },
]
""",
    WIDE,
    WIDE.replace('"exponential"', '"table"').replace(
        "growth_per_mm = 0.9", "grip_opening_mm = [0, 0.5, 1]\ngrip_force_N = [0.4, 0.7, 1.6]"
    ),
)

VALUES = (
    *("nan", "-nan", "inf", "-inf", "+inf", "0", "-0", "-0.0", "-1", "1e400", "-1e400", "1e-400", "5e-324", "1e308"),
    *("1e999999", "1e1000000", "1e999999999", "1e-999999999", "1e99999999999999999999", "-1e99999999999999999999"),
    *("1e-99999999999999999999", "0e99999999999999999999", "1.7976931348623159e308", "9223372036854775808"),
    *("9" * 999, "-" + "9" * 999, "9" * 5000, "0x" + "f" * 998, "0x" + "f" * 9000, "0b" + "1" * 20000, "0o7", "1_000"),
    *("0." + "1" * 900, "0." + "3" * 9000, "1" * 900 + "e" + "9" * 900, "01", "1__0", "+ 1", "1.", ".5", "1e", "--1"),
    *("true", "false", "1979-05-27", "1979-13-45", "1979-05-27T07:32:00Z", "07:32:00.999999", "9999-12-31 23:59:60"),
    *('""', "''", '"x"', '"\\u0000"', '"\\ud800"', '"\\U0010ffff"', '"\\e"', '"motion"', '"paper"', '"""', "'''"),
    *('"""a""""', '"""\\', "[]", "{}", "[[]]", "[{}]", "{a = 1}", "[1]", "[1, 2]", "[1, 2, 3]", "[1, 2, 3, 4]"),
    *("[0, 0, 0]", "[nan, 0, 0]", "[0, inf, 0]", "[1e308, 1e308, 1e308]", "[5e-324, 0, 0]", "[1e400, 0, 0]"),
    *('[0, "0", 0]', "[true, 0, 0]", "[[0], 0, 0]", "[0, 1979-05-27, 0]", "[9223372036854775808, 0, 1e-999999999]"),
)
KEYS = (
    *("name", "needle", "coupling", "servo", "membrane", "diameter_mm", "gauge", "tip_angle_rad", "tip_angle_deg"),
    *("direction", "stiffness_N_per_mm", "damping_Ns_per_mm", "rate_hz", "low_pass_hz", "solver", "conditioning"),
    *("encoder_step_mm", "precompression_N", "friction", "thickness_mm", "point_mm", "inward_normal"),
    *("a", "1", "-", '""', '"."', '"a.b"', '"membrane.x"', '"membrane[0]"', '"membrane[0].friction"', '"needle.gauge"'),
    *('"needle[x]"', '"\\u00b2"', '"\\n"', '"\\u0000"', '"\\u001b[2J"', "é", "a.b", "needle.gauge.x", "membrane.x"),
    *("needle.direction", "thickness", "thicknes_mm", "x" * 999, "x" * 5000, '"' + "y" * 20000 + '"', "__class__"),
)
HEADS = (
    *("[needle]", "[servo]", "[coupling]", "[[membrane]]", "[membrane]", "[[needle]]", "[]", "[[]]", "[a.b]"),
    *("[needle.x]", "[[membrane.x]]", "[membrane.x]", '["membrane.x"]', "[", "]", "[[membrane]", "[ needle ]", '[""]'),
)

_VALUE = re.compile(r"(?<== )(?:\"[^\"\n]*\"|'[^'\n]*'|\[[^\[\]\n]*\]|[^\s,{}\[\]\"']+)")
_KEY = re.compile(r"(?<![\w\".])[\w\".]+(?= = )")  # only at the start of a word: long words are scanned once
_HEAD = re.compile(r"^\[.*\]$", re.MULTILINE)

Way = Callable[[str, random.Random], str]


def _instead(of: re.Pattern[str], text: str, new: str, chance: random.Random) -> str:
    places = list(of.finditer(text))
    if not places:
        return text + new
    start, end = chance.choice(places).span()
    return text[:start] + new + text[end:]


def _other_value(text: str, chance: random.Random) -> str:
    return _instead(_VALUE, text, chance.choice(VALUES), chance)


def _other_key(text: str, chance: random.Random) -> str:
    return _instead(_KEY, text, chance.choice(KEYS), chance)


def _one_more(text: str, chance: random.Random) -> str:
    return _lines(text, chance, lambda lines, i: lines.insert(i, f"{chance.choice(KEYS)} = {chance.choice(VALUES)}"))


def _other_head(text: str, chance: random.Random) -> str:
    return _instead(_HEAD, text, chance.choice(HEADS), chance)


def _lines(text: str, chance: random.Random, change: Callable[[list[str], int], object]) -> str:
    lines = text.split("\n")
    change(lines, chance.randrange(len(lines)))
    return "\n".join(lines)


def _gone(text: str, chance: random.Random) -> str:
    return _lines(text, chance, lambda lines, i: lines.pop(i))


def _twice(text: str, chance: random.Random) -> str:
    return _lines(text, chance, lambda lines, i: lines.insert(chance.randrange(len(lines)), lines[i]))


def _shuffled(text: str, chance: random.Random) -> str:
    return _lines(text, chance, lambda lines, i: lines.append(lines.pop(i)))


def _many(chance: random.Random) -> int:
    """A number from 1 to 100,000, with all orders of magnitude equally likely."""
    return round(10 ** chance.uniform(0, 5))


def _deep(text: str, chance: random.Random) -> str:
    n = _many(chance)
    nested = chance.choice(
        ("[" * n + "1" + "]" * n, "[" * n, "{a=" * n + "1" + "}" * n, "[{a=" * n, "[\n" * n + "]\n" * n)
    )
    if chance.random() < 0.5:
        return _instead(_VALUE, text, nested, chance)
    key = chance.choice((".".join("a" * n), ".".join(['"a.b"'] * n), ". " * n))
    return _instead(*chance.choice(((_KEY, text, key), (_HEAD, text, f"[{key}]"), (_HEAD, text, f"[[{key}]]"))), chance)


def _wide(text: str, chance: random.Random) -> str:
    n = _many(chance)
    value = chance.choice(VALUES[:24])
    wide = (
        lambda: _instead(_VALUE, text, "[" + ", ".join([value] * n) + "]", chance),
        lambda: _instead(_VALUE, text, "[" + "{}, " * n + "]", chance),
        lambda: _instead(_VALUE, text, '"' + chance.choice(("x", "\\n", "\\u00e9", "é")) * n + '"', chance),
        lambda: text + "[[membrane]]\n" * n,
        lambda: text + "".join(f"k{i} = {value}\n" for i in range(n)),
        lambda: "".join(f"friction{i} = {value}\n" for i in range(n)) + text,
        lambda: text + "".join(f"[t{i}]\n" for i in range(n)),
        lambda: text + text[text.find("[[membrane]]") :] * min(n, 400),
        lambda: text + chance.choice(("#", " ", "\n", "\r\n", "\t", "\ufeff", "\x00", '"', "'", "\\")) * n,
    )
    return chance.choice(wide)()


def _spliced(text: str, chance: random.Random) -> str:
    other = chance.choice(SEEDS)
    return text[: chance.randrange(len(text) + 1)] + other[chance.randrange(len(other)) :]


_WAYS: tuple[Way, ...] = (
    *(_other_value,) * 6, *(_other_key,) * 3, *(_one_more,) * 3,
    _other_head, _gone, _twice, _shuffled, _deep, _wide, _spliced
)  # fmt: skip


def _other_bytes(data: bytearray, chance: random.Random) -> None:
    for _ in range(chance.choice((1, 1, 2, 8, 64))):
        place, kind = chance.randrange(len(data) + 1), chance.randrange(4)
        if kind == 0 and place < len(data):
            data[place] ^= 1 << chance.randrange(8)
        elif kind == 1:
            data[place:place] = chance.choice(
                (b"\xff", b"\x00", b"\xed\xa0\x80", b"\xc0\x80", b"\xf0", b"\r", b"\\", b'"')
            )
        elif kind == 2:
            del data[place : place + chance.randrange(1, 40)]
        else:
            data[place : place + 1] = chance.randbytes(1)


def spoilt(chance: random.Random) -> bytes:
    """A scene file with errors, slight or heavy."""
    text = chance.choice(SEEDS)
    for _ in range(chance.choice((0, 1, 1, 1, 2, 3, 6))):
        text = chance.choice(_WAYS)(text, chance)
    data = bytearray(text.encode())
    if chance.random() < 0.2:
        _other_bytes(data, chance)
    if chance.random() < 0.05:
        del data[chance.randrange(len(data) + 1) :]
    return bytes(data)

# ruff: noqa: RUF001  # names in other letters
"""Units as they stand in files of testing machines, and their size in SI units."""

import re
import unicodedata

# Size of a unit in SI units, by its usual symbol.
UNITS: dict[str, dict[str, float]] = {
    "depth": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "in": 0.0254, "mil": 2.54e-5, "ft": 0.3048},
    "force": {
        "N": 1.0, "kN": 1e3, "daN": 10.0, "cN": 1e-2, "mN": 1e-3, "uN": 1e-6, "nN": 1e-9, "dyn": 1e-5,
        "gf": 9.80665e-3, "kgf": 9.80665, "mgf": 9.80665e-6, "lbf": 4.4482216152605, "ozf": 0.27801385095378125,
    },
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0},
}  # fmt: skip

# Other spellings. A force is often stated as a mass.
_SPELLINGS = {
    "m": "meter meters metre metres metro metros metri mètre mètres 米 メートル",
    "cm": "centimeter centimeters centimetre centimetres zentimeter 厘米 センチ",
    "mm": "millimeter millimeters millimetre millimetres millimètre millimètres milímetro milímetros milimetros "
          "millimetri 毫米 ミリ ミリメートル 밀리미터 мм",
    "um": "micrometer micrometers micrometre micrometres micron microns mikrometer 微米 ミクロン",
    "nm": "nanometer nanometers nanometre nanometres 纳米",
    "in": "inch inches zoll pouce pouces pulgada pulgadas pollici 英寸 \"",
    "mil": "mils thou",
    "ft": "foot feet",
    "N": "newton newtons 牛 牛顿 牛頓 ニュートン 뉴턴 н",
    "kN": "kilonewton kilonewtons 千牛 кн",
    "mN": "millinewton millinewtons 毫牛",
    "uN": "micronewton micronewtons 微牛",
    "dyn": "dyne dynes",
    "gf": "g gram grams gramm gramme grammes gramos grammi gram-force grams-force pond 克 克力",
    "kgf": "kg kp kilogram kilograms kilogram-force kilograms-force 千克 公斤 公斤力",
    "mgf": "mg",
    "lbf": "lb lbs pound pounds pound-force pounds-force 磅",
    "ozf": "oz ounce ounces ounce-force",
    "s": "sec secs second seconds sek sekunde sekunden seconde secondes seg segundo segundos secondo secondi 秒 초 с",
    "ms": "msec msecs millis millisecond milliseconds millisekunden millisecondes milisegundos millisecondi "
          "毫秒 ミリ秒",
    "us": "usec usecs micros microsecond microseconds mikrosekunden 微秒",
    "ns": "nsec nsecs nanosecond nanoseconds nanosekunden 纳秒",
    "min": "mins minute minutes minuten minuto minutos minuti 分 分钟",
    "h": "hr hrs hour hours stunden 小时",
}  # fmt: skip

_EXACT = {unit: unit for units in UNITS.values() for unit in units} | {
    unicodedata.normalize("NFKC", text): unit for unit, texts in _SPELLINGS.items() for text in texts.split()
}
_ANY_CASE = {text.casefold(): unit for text, unit in _EXACT.items()}
_TWO_MEANINGS = {"MN", "Nm", "NM", "Mg", "MG"}  # also meganewtons, a torque, a mass

# Units of something else: a column in one of them is no depth, force or time.
_OTHERS = (
    "V mV A mA W Pa kPa MPa GPa bar psi % deg ° °C K C rad Hz kHz rpm counts - mm/s mm/min m/s N/mm N/m Nm N.m J mJ"
)
_OTHER_UNITS = set(_OTHERS.split())


def unit_of(text: str) -> str:
    """The usual symbol of a unit that is written in any way; empty if it is unknown or has two meanings (`MN`)."""
    plain = unicodedata.normalize("NFKC", text).strip().strip("()[]{}<>").strip().rstrip(".").replace("\u03bc", "u")
    known = _EXACT.get(plain)
    if known is None and plain not in _TWO_MEANINGS:
        known = _ANY_CASE.get(plain.casefold())
    return known or ""


_WITH_UNIT = re.compile(r"\s*([+-]?[.,]?\d[\d.,'\u2019\s]*(?:[eE][+-]?\d+)?)\s*([^\d\s.,'\u2019+-].*)")


def split_cell(cell: str) -> tuple[str, str]:
    """A number and its unit by the usual symbol: `0.35 N`. Another cell as it stands, and an empty unit."""
    found = _WITH_UNIT.fullmatch(cell)
    unit = unit_of(found[2]) if found else ""
    return (found[1], unit) if found and unit else (cell, "")


def role_of(unit: str) -> str:
    """Which column has this unit, by its usual symbol: depth, force or time; empty if it is none of them."""
    return next((role for role, units in UNITS.items() if unit in units), "")


def is_unit(text: str) -> bool:
    """Whether a cell of a row of units can be one, of any quantity: `mm`, `(mm)`, `[MPa]`."""
    return bool(unit_of(text)) or text.strip().strip("()[]{}<>").strip() in _OTHER_UNITS


def split_name(name: str) -> tuple[str, str]:
    """A column's name without its unit, and the unit: `depth_mm`, `Depth (mm)`, `depth [mm]`, `Depth/mm`, `forceN`.

    The unit is the usual symbol; an unknown one in brackets is given as it stands. A name that is only a unit is empty.
    """
    text = re.sub(r"(?<=[\])}>]) \d+$", "", unicodedata.normalize("NFKC", name).strip())  # of a repeated name
    if unit_of(text) and len(text) > 1:
        return "", unit_of(text)
    bracket = re.fullmatch(r"(.*?)\s*[\[({<]\s*([^\[\](){}<>]*?)\s*[\])}>]\W*", text)
    if bracket and bracket[1]:
        return re.sub(r"\s*[\s_,/]in$|[\s_,/]+$", "", bracket[1]), unit_of(bracket[2]) or bracket[2]
    for pattern in (r"(.+?)[\s_/,:|.-]+([^\s_/,:|.-]+)", r"(.+[a-z])([A-Z][A-Za-z]*)"):
        ending = re.fullmatch(pattern, text, re.DOTALL)
        if ending and (unit_of(ending[2]) or (len(ending[2]) > 1 and is_unit(ending[2]))):  # "A" may be a specimen
            return re.sub(r"[\s_,/]+in$", "", ending[1]), unit_of(ending[2]) or ending[2]
    return text, ""

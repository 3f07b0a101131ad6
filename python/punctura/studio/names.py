"""User-given names as file names: valid on every system, and never outside a folder."""

import unicodedata

LONGEST = 80  # characters
MOST_BYTES = 200  # of UTF-8; with an ending a name stays below what file systems take
_FORBIDDEN = set('/\\:*?"<>|')
_RESERVED = {"con", "prn", "aux", "nul", *(f"{word}{i}" for word in ("com", "lpt") for i in range(10))}


class BadName(ValueError):
    """A name that cannot be a file name; the text says why."""


def safe_name(name: str) -> str:
    """The name in Unicode's composed form (NFC). Raises BadName."""
    name = unicodedata.normalize("NFC", name)
    if not name or len(name) > LONGEST or len(name.encode("utf-8", "replace")) > MOST_BYTES:
        raise BadName(f"a name has 1 to {LONGEST} characters")
    if any(c in _FORBIDDEN or unicodedata.category(c)[0] == "C" for c in name):
        raise BadName('a name has no / \\ : * ? " < > | and no control characters')
    if name != name.strip() or name.strip(".") != name:
        raise BadName("a name begins and ends with neither a space nor a full stop")
    if name.split(".")[0].lower() in _RESERVED:
        raise BadName(f"{name} is a name of the operating system")
    return name

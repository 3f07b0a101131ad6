"""The lines of the keys in a TOML text, which its reader does not tell."""

from __future__ import annotations

from punctura.files.tables import Location
from punctura.files.toml_bounds import TOKEN


def key_lines(text: str) -> dict[Location, int]:
    """The line of each key and each table head of a valid TOML text, by its place, as ("membrane", 1, "friction").

    Keys inside inline tables are not among them.
    """
    lines: dict[Location, int] = {}
    counts: dict[Location, int] = {}  # tables of each list
    table: Location = ()
    line, nested, brackets, in_value = 1, 0, 0, False
    names: list[str] = []
    for found in TOKEN.finditer(text):
        token = found[0]
        if token == "\n":
            if nested == 0:
                if brackets:
                    table = _place(names, counts, brackets == 2)
                    lines.setdefault(table, line)
                names, brackets, in_value = [], 0, False
            line += 1
        elif token[0] == "#":
            continue
        elif in_value:
            nested += (token in "[{") - (token in "]}")
            line += token.count("\n")
        elif token == "[":
            brackets += 1
        elif token == "=":
            lines.setdefault((*table, *names), line)
            in_value = True
        elif token not in "].,":
            names.append(token[1:-1] if token[0] in "\"'" else token)
    return lines


def _place(names: list[str], counts: dict[Location, int], in_list: bool) -> Location:
    """The place of a table head, with the number of the last table in each list on the way."""
    place: Location = ()
    for i, name in enumerate(names):
        place = (*place, name)
        if in_list and i == len(names) - 1:
            counts[place] = counts.get(place, 0) + 1
        if place in counts:
            place = (*place, counts[place] - 1)
    return place

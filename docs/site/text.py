"""Plain text as reStructuredText."""

import re

CODE = re.compile(r"(``[^`]+``|`[^`]+`)")


def escape_rst(text: str) -> str:
    """Converts plain text with `code` in backticks. All other characters are literal."""
    parts = CODE.split(text)
    parts[::2] = [re.sub(r"([\\*_|])", r"\\\1", part) for part in parts[::2]]
    parts[1::2] = [f"``{part.strip('`')}``" for part in parts[1::2]]
    return "".join(parts)


def docstring_rst(lines: list[str]) -> list[str]:
    """Converts a docstring. Indented lines after an empty line are code."""
    out: list[str] = []
    in_code = False
    for line in lines:
        indented = line.startswith("    ")
        if indented and not in_code and out and not out[-1]:
            out += ["::", ""]
            in_code = True
        elif line and not indented:
            in_code = False
        out.append(line if in_code else escape_rst(line))
    return out


def heading(words: str, line: str = "=") -> list[str]:
    return [words, line * len(words), ""]

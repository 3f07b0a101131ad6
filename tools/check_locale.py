"""Checks that C++ code converts decimal numbers only with decimal.hpp: the functions of C follow the locale."""

import re
import sys
from pathlib import Path

from sources import CPP_SUFFIXES, Finding, report, sources

PLACES = ("core/", "runtime/", "capi/", "python/bindings/", "integrations/fmi/")
DECIMAL = "core/punctura/model/decimal.hpp"
FOLLOWS = re.compile(r"%[-+#0]*[\d*]*(\.[\d*]+)?[aefgAEFG]\b|\b(strto[df]|sto[df]|ato?f|sscanf)\b")


def findings(root: Path) -> list[Finding]:
    return [
        Finding(path, number, f"{found[0]} follows the locale: use {Path(DECIMAL).name}")
        for path in sources(root, CPP_SUFFIXES)
        if path.startswith(PLACES) and path != DECIMAL
        for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1)
        if (found := FOLLOWS.search(line.partition("//")[0]))
    ]


if __name__ == "__main__":
    sys.exit(report("locale", findings, sys.argv))

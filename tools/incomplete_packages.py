"""Removes the records of packages that lack files, so that the next installation installs these packages again.

uv writes the record of a package before its files. If it is interrupted, or the disk is full, uv and pip would later
take such a package for an installed one.
"""

from __future__ import annotations

import csv
import shutil
import sys
import sysconfig
from importlib.metadata import Distribution
from pathlib import Path


def is_complete(package: Distribution) -> bool:
    """True if the record can be read, and each file in it exists in its full size."""
    if not all(package.read_text(name) for name in ("METADATA", "RECORD", "INSTALLER")):
        return False
    # Distribution.files would do, but leaves out missing files from Python 3.12 on.
    for row in filter(None, csv.reader((package.read_text("RECORD") or "").splitlines())):
        if len(row) != 3:
            return False  # the record itself ends in the middle
        name, _, size = row
        path = Path(str(package.locate_file(name)))
        if path.suffix != ".pyc" and (not path.is_file() or path.stat().st_size < int(size or 0)):
            return False
    return True


def remove_incomplete(folder: Path) -> list[str]:
    """Removes the records in a folder of packages, and returns their names."""
    removed = []
    for record in sorted(folder.glob("*.dist-info")):
        if not is_complete(Distribution.at(record)):
            shutil.rmtree(record)
            removed.append(record.name)
    return removed


if __name__ == "__main__":
    for name in remove_incomplete(Path(sys.argv[1] if len(sys.argv) > 1 else sysconfig.get_path("purelib"))):
        print(f"{name} is incomplete and will be installed again.")

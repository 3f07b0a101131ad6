"""Names of files as text."""

from __future__ import annotations

import os
import re

# The endings of trace files in a folder and in the studio; any other file is read as text if it is named alone.
TRACE_ENDINGS = (
    ".csv", ".tsv", ".txt", ".tra", ".lvm", ".json", ".jsonl", ".parquet", ".mat", ".xlsx", ".xlsm", ".tdms", ".bag",
)  # fmt: skip


def as_text(path: str | os.PathLike[str]) -> str:
    """A path as text that can be written anywhere: bytes that are no UTF-8 and control characters become marks."""
    return re.sub(r"[\x00-\x1f\x7f-\x9f]", "?", os.fsencode(path).decode("utf-8", "replace"))

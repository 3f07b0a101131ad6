"""Resident memory of a process, for soak tests and fuzzers."""

from pathlib import Path


def resident_mb(process: int | str = "self") -> float:
    """Present (not peak) resident memory, MB; NaN if the system does not report it. process: its id."""
    try:
        for line in Path(f"/proc/{process}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1024
    except OSError:
        pass
    return float("nan")

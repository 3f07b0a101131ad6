"""The ticks before the last fault, as a file."""

from __future__ import annotations

import io

from punctura.ticks import Ticks
from punctura.ticks.files import CsvOutput


class KeptTicks:
    """The worker writes, any thread reads. They stay until the next fault, also after a reset and in other runs."""

    def __init__(self) -> None:
        self._ticks: Ticks | None = None

    def keep(self, ticks: Ticks) -> int:
        """Returns the number of ticks. No ticks leave the earlier ones."""
        if len(ticks):
            self._ticks = ticks
        return len(ticks)

    def csv(self) -> tuple[str, bytes] | None:
        """A name for the file, and its bytes; None if there was no fault."""
        ticks = self._ticks
        if ticks is None:
            return None
        table, out = ticks.to_arrow(), io.BytesIO()
        CsvOutput(out, table.schema).write(table)
        return f"fault-at-tick-{int(ticks.tick[-1])}.csv", out.getvalue()

"""Keeps the run alive when a step that only shows something fails."""

from __future__ import annotations

from collections.abc import Callable

from punctura.defects import explain
from punctura.studio.pump import Publisher
from punctura.studio.wire.messages import Notice


class Defects:
    """Tells each defect once, not sixty times a second."""

    def __init__(self, out: Publisher) -> None:
        self._out = out
        self._last = ""

    def guard(self, step: Callable[[], object]) -> None:
        """Calls `step`; if it raises, the pages get a notice."""
        try:
            step()
        except Exception as error:
            text = explain(error)
            if text != self._last:
                self._last = text
                self._out.send(Notice(text=text))

"""A participant of a session in the studio, without a browser."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from protocols import written
from punctura._core import ForceLimits
from punctura.live import RunLimits
from punctura.perception import load_protocol, read_session
from punctura.perception.course import Line
from punctura.results import JsonObject
from punctura.studio.client import StudioClient
from punctura.studio.loaded import from_name
from punctura.studio.run import Settings
from punctura.studio.serve import StudioServer
from punctura.studio.sitting import PerceptionSitting
from waiting import LATE_ALLOWED

TOLD: list[str] = []  # at the terminal
SCALED = '[values]\n"display.force_scale" = 0.8\n'


class Person:
    """Reads the page, answers, and moves the needle."""

    def __init__(self, page: StudioClient) -> None:
        self.page = page

    @property
    def _last(self) -> JsonObject:
        return (self.page.of("sitting") or [{"sentence": ""}])[-1]

    def reads(self, words: str) -> None:
        self.page.wait(lambda: words in self._last["sentence"])
        self.now = self._last

    def answers(self, name: str, **more: int) -> None:
        assert self.page.ask(**{"do": "respond", "question": self.now["question"], "answer": name, **more})["ok"]
        self.page.wait(lambda: self._last["question"] > self.now["question"])

    def goes_through(self, words: str = "push the needle", depth: float = 0.012) -> None:
        """Through the membrane, if it is thinner than that, and out again."""
        self.reads(words)
        membrane = self.page.of("scene")[-1]["scene"]["membranes"][0]
        point, inward = np.array(membrane["point"]), np.array(membrane["inward_normal"])
        for place, what in ((depth, "pop" if depth > 0.01 else "touch"), (-0.005, "out")):
            before = len(self.page.of("event"))
            self.page.target((point + place * inward).tolist(), inward.tolist())
            self.page.wait(lambda n=before, what=what: what in [event["what"] for event in self.page.of("event")[n:]])


@contextmanager
def sat(folder: Path, text: str, limits: ForceLimits | None = None) -> Iterator[tuple[Person, StudioServer]]:
    protocol = load_protocol(written(folder, text + SCALED))
    base = from_name(protocol.scene_name)
    settings = Settings("simulated", limits=RunLimits(limits or ForceLimits(), LATE_ALLOWED))
    server = StudioServer(base, settings, page=folder, folder=folder / "out")
    try:
        server.session.sitting = sitting = PerceptionSitting(server.session, protocol, base, "P01", TOLD.append)
        server.session.call(sitting.start)
        server.start()
        with StudioClient(server.address.url) as page:
            yield Person(page), server
    finally:
        server.stop()


def saved(folder: Path) -> list[Line]:
    return read_session(folder / "out" / "P01.jsonl")[1]

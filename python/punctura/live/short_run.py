"""Why a run has fewer ticks than its duration asks for."""

from __future__ import annotations

from dataclasses import dataclass

ENOUGH = 0.99  # of the ticks that were asked for: fewer are worth a word


@dataclass(frozen=True)
class Ticked:
    """How a run of a given duration ticked, in numbers. SI."""

    duration: float  # s, that was asked for
    rate: float  # Hz, that the device states
    ticks: int
    span: float  # s, from the first tick to the last one
    late: int  # ticks that came late
    longest: float  # s, from one tick to the next
    device_ended: bool = False  # such as a replay whose recording is over
    fault: str = ""  # in words, if one ended the run

    def why_short(self) -> str:
        """A sentence; empty for a run that has its ticks."""
        wanted = round(self.duration * self.rate)
        if self.ticks == 0 or self.ticks >= ENOUGH * wanted - 1:
            return ""
        head = f"{self.ticks} ticks came, and {self.duration:g} s at {self.rate:g} Hz are {wanted}: "
        if self.fault or self.device_ended:
            return head + ("the fault ended the run" if self.fault else f"the device ended after {self.span:.3g} s")
        causes = []
        left_out = round(self.span * self.rate) + 1 - self.ticks
        if left_out > (1 - ENOUGH) / 2 * wanted:
            slow = f"the device ticks at {self.ticks / self.span:.4g} Hz"
            busy = f"{left_out} were left out because the computer or the device was late {self.late} times, by up to "
            busy += f"{max(0.0, self.longest - 1 / self.rate):.2g} s"
            causes.append(busy if self.late else slow)
        if self.duration - self.span > (1 - ENOUGH) / 2 * self.duration:
            causes.append(f"for {self.duration - self.span:.2g} s at the beginning or the end the device gave none")
        return head + " and ".join(causes)

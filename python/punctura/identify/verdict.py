"""What a trace cannot tell, and which experiment would tell it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from punctura.identify.fit import Fit
from punctura.identify.intervals import Estimate
from punctura.identify.parameters import kind_of
from punctura.trace import Segments, Trace

_EXPERIMENTS = {
    "surface": "begin well before contact and go on until the pop is over",
    "stiffness": "insert until the tip is through, and withdraw",
    "precompression": "insert slowly through the first millimetre, with more samples there",
    "friction": "record the withdrawal too: it shows the friction without the tip",
    "thickness": "insert more slowly, or sample faster: the pop is sharper than the samples",
    "tip_length": "begin well before contact and go on until the pop is over",
    "growth": "go on until the pop: only the last part of the rise shows how the grip grows",
    "tail_length": "go on by two tip lengths behind the pop",
    "tail_floor": "go on by two tip lengths behind the pop",
    "cutting": "insert a second time at the same place",
    "set": "record the withdrawal, and a second insertion at the same place",
    "coupling_stiffness": "reverse inside the tissue: the unloading shows the spring",
    "relaxation_1_stiffness": "rest for 10 s inside the tissue",
    "relaxation_1_time": "rest for 10 s inside the tissue",
    "relaxation_2_stiffness": "rest for a minute inside the tissue",
    "relaxation_2_time": "rest for a minute inside the tissue",
    "offset": "begin before contact",
    "drift": "begin before contact and end outside the tissue",
}  # fmt: skip


SEEN = 0.002  # of the greatest force: a smaller drift does not matter
DRIFTING = 1.5  # times the other noise: with more slow noise, the interval of a surface is too narrow


def verdicts(estimates: Sequence[Estimate], trace: Trace, segments: Segments, fit: Fit) -> tuple[str, ...]:
    """One sentence for each thing that the trace cannot tell, with the experiment that would.

    fit: of all samples, or of the thinned ones, for the noise.
    """
    return (*_not_identifiable(estimates), *_not_seen(trace, segments), *_drifting(fit))


def _drifting(fit: Fit) -> Iterator[str]:
    slow, other = fit.noise.slow_and_white()
    if slow > DRIFTING * other and slow > SEEN * float(np.max(np.abs(fit.misfit.trace.force))):
        yield (
            f"The measured force drifts slowly about the model, by {slow:.2g} N, beside a noise of {other:.2g} N. The "
            "interval of a surface is then too narrow. If the model is right (see punctura rivals), this is a drift "
            "of the sensor: let it warm up, record a second before contact, and repeat the insertion."
        )


def _not_identifiable(estimates: Sequence[Estimate]) -> Iterator[str]:
    for estimate in estimates:
        if not estimate.identifiable:
            advice = _EXPERIMENTS.get(kind_of(estimate.name), "repeat the insertion")
            yield f"{estimate.name} is not identifiable from this trace: {advice}."


def _not_seen(trace: Trace, segments: Segments) -> Iterator[str]:
    if segments.insertions < 2:
        yield "cutting is not identifiable from one insertion: insert a second time at the same place."
    if trace.time is None:
        yield "damping and relaxation are not identifiable without time: record it."
    elif not segments.holds:
        yield "relaxation is not identifiable without a hold: rest for 10 s inside the tissue."
    if not any(stroke.kind == "out" for stroke in segments.strokes):
        yield "friction on the way out and set are not identifiable without a withdrawal: record it."

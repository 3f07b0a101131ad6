"""What a trace cannot tell, and which experiment would tell it."""

from collections.abc import Iterator, Sequence

from punctura._core import tip_length
from punctura.identify.air_noise import AirNoise
from punctura.identify.drifting import slow_words
from punctura.identify.fit import Fit
from punctura.identify.intervals import Estimate
from punctura.identify.parameters import kind_of
from punctura.trace import Segments, Trace

# What shows a parameter: (what the trace must lack for this advice, advice). The first one that fits is given.
THROUGH = ("pop", "insert until the tip is through")
DEEP = 2.0  # lengths of the tip in the wall: there the tip is through, whether the force has dropped or not
NEVER = (
    "with the fitted spring, the tip went {:.2g} times its length into the wall, and the force never dropped. If the "
    "wall is not as thick as that, it has another law: compare punctura rivals, or give the wall a measured profile "
    "(docs/measured-tissue.md)"
)
WITHDRAWAL = ("withdrawal", "record the withdrawal too: it shows the friction without the tip")
BEFORE = ("air", "begin well before contact")
BEHIND = ("air behind", "end outside the tissue")
TURN = ("", "turn a second time inside the tissue, at another speed")
AGAIN = ("second", "insert a second time at the same place")
REST = ("hold", "rest for 10 s inside the tissue")
DEEPER = ("", "go on by two tip lengths behind the pop")
QUICK = ("", "turn and stop quickly inside the tissue: the start of each motion shows it")
SLOWER = ("", "insert more slowly, or sample faster: the pop is sharper than the samples")
MORE = ("", "repeat the insertion with less noise or more samples: this trace has each part that shows it")
_EXPERIMENTS: dict[str, tuple[tuple[str, str], ...]] = {
    "surface": (BEFORE, THROUGH),
    "stiffness": (THROUGH, WITHDRAWAL),
    "precompression": (BEFORE, ("", "insert slowly through the first millimetre, with more samples there")),
    "friction": (THROUGH, WITHDRAWAL, DEEPER),
    "thickness": (THROUGH, SLOWER),
    "tip_length": (BEFORE, THROUGH, SLOWER),
    "growth": (("pop", "go on until the pop: only the last part of the rise shows how the grip grows"),),
    "tail_length": (DEEPER,),
    "tail_floor": (DEEPER,),
    "cutting": (AGAIN,),
    "set": (WITHDRAWAL, AGAIN),
    "coupling_stiffness": (
        ("withdrawal", "withdraw, or reverse inside the tissue: the unloading shows the spring"),
        ("", "reverse inside the tissue, half way: the unloading shows the spring"),
    ),
    "relaxation_1_stiffness": (REST,),
    "relaxation_1_time": (REST,),
    "relaxation_2_stiffness": (("long hold", "rest for a minute inside the tissue"),),
    "relaxation_2_time": (("long hold", "rest for a minute inside the tissue"),),
    "offset": (BEFORE,),
    "lag": (QUICK,),
    "delay": (QUICK,),
    "play": (TURN,),
    "slack": (TURN,),
    "slide_friction": (BEFORE,),
    "slide_friction_out": (BEHIND,),
    "slide_friction_before": (BEFORE,),
    "slide_way": (("", "turn in air, slowly"),),
    "cable_stiffness": (BEFORE,),
    "drift": (BEFORE, BEHIND),
}
LONG, VERY_LONG = 10.0, 60.0  # s, of a hold


def verdicts(
    estimates: Sequence[Estimate], trace: Trace, segments: Segments, fit: Fit, air: AirNoise, explained: bool = True,
    whitened: bool = False,
) -> tuple[str, ...]:  # fmt: skip
    """One sentence for each thing that the trace cannot tell, with the experiment that would.

    fit: of all samples, or of the thinned ones, for the noise; air: of the same samples. explained: False if it is said
    that it is not. whitened: slow noise is part of the last fit.
    """
    unknown = _not_identifiable(estimates, trace, segments, fit) if explained else _no_bounds(estimates)
    return (
        *_springs(fit),
        *_cable(trace),
        *unknown,
        *_not_seen(trace, segments),
        *slow_words(fit, air, explained, whitened),
    )


def _springs(fit: Fit) -> Iterator[str]:
    """What several walls cannot tell: whether they give way one by one, or the rig does, for all of them."""
    walls, spring = len(fit.parameters.membranes), fit.parameters.get("coupling_stiffness")
    if walls > 1:
        yield (
            f"The model gives each of the {walls} walls a spring of its own, of {spring:.3g} N/m. If holder, needle or "
            f"sensor give way, the walls share one spring, of up to {walls * spring:.3g} N/m: number, places and "
            "values of the walls are then not those of the fit. To tell: turn back between two walls and behind the "
            "last one; a shared spring unloads equally steeply."
        )


def _cable(trace: Trace) -> Iterator[str]:
    """What the air does not tell of a force that grows with the depth."""
    if any(finding.kind == "cable_stiffness" for finding in trace.findings):
        yield (
            "The values hold if the force that grows with the depth in air is that of a cable, and goes on so in the "
            "tissue. A soft layer that springs back looks the same in air, and deeper in it may not go on so: then the "
            "intervals do not hold. To tell: move over the same depths in air without tissue."
        )


def _not_identifiable(estimates: Sequence[Estimate], trace: Trace, segments: Segments, fit: Fit) -> Iterator[str]:
    has = _parts(trace, segments, sum(kind_of(estimate.name) == "surface" for estimate in estimates))
    begin = trace.depth[0 if segments.contact is None else segments.contact]
    given_way = (trace.force - fit.parameters.get("offset")) / fit.parameters.get("coupling_stiffness")
    deepest = float((trace.depth - given_way).max())  # of the tip itself, behind the spring
    lengths = (deepest - begin) / tip_length(fit.parameters.needle)
    for estimate in estimates:
        if not estimate.identifiable:
            known = _EXPERIMENTS.get(kind_of(estimate.name), ())
            asked, advice = next((lacking, text) for lacking, text in (*known, MORE) if lacking not in has)
            if asked == "pop" and lengths >= DEEP:
                others = ((lacking, text) for lacking, text in (*known, MORE) if lacking not in (*has, "pop"))
                advice = next(others)[1] if segments.pops else NEVER.format(lengths)
            yield f"{estimate.name} is not identifiable from this trace: {advice}."


def _no_bounds(estimates: Sequence[Estimate]) -> Iterator[str]:
    """Without a model that is right, nothing says which experiment would tell a parameter."""
    if names := [estimate.name for estimate in estimates if not estimate.identifiable]:
        listed = ", ".join(names)
        yield f"Not identifiable, as far as this model goes: {listed}. A model that explains the trace comes first."


def _parts(trace: Trace, segments: Segments, walls: int) -> frozenset[str]:
    """What a trace of this number of walls has already: no experiment for it is advised."""
    time = trace.time
    rests = [] if time is None else [float(time[one.end - 1] - time[one.start]) for one in segments.holds]
    out = [stroke for stroke in segments.strokes if stroke.kind == "out"]
    contact = None if segments.contact is None else trace.depth[segments.contact]
    has = {
        "pop": len(segments.pops) >= max(walls, 1),
        "withdrawal": bool(out),
        "air": contact is not None,
        "air behind": bool(out) and contact is not None and bool(trace.depth[-1] < contact),
        "second": segments.insertions > 1,
        "hold": max(rests, default=0.0) >= LONG,
        "long hold": max(rests, default=0.0) >= VERY_LONG,
    }
    return frozenset(name for name, there in has.items() if there)


def _not_seen(trace: Trace, segments: Segments) -> Iterator[str]:
    if segments.insertions < 2:
        yield "cutting is not identifiable from one insertion: insert a second time at the same place."
    if trace.time is None:
        yield "damping and relaxation are not identifiable without time: record it."
    elif not segments.holds:
        yield "relaxation is not identifiable without a hold: rest for 10 s inside the tissue."
    if not any(stroke.kind == "out" for stroke in segments.strokes):
        yield "friction on the way out and set are not identifiable without a withdrawal: record it."

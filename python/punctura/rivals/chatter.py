"""How much a force model shakes at rest: on a dithering encoder, and in a hand that trembles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura._core import (
    Coupling,
    Membrane,
    Needle,
    PlacedMembrane,
    RecordedMotion,
    RivalInsertion,
    Scene,
    ServoSettings,
    rival_experiment,
)
from punctura.rivals.layers import Layer
from punctura.ticks import Ticks

Array = NDArray[np.float64]
SERVO = ServoSettings(conditioning="line_fit")  # K06 section 4: its rate, and the encoders of a PHANTOM Omni
RATE, COUNT = SERVO.rate, SERVO.encoder_step  # Hz, m
SPEED = 20e-3  # m/s
LEAD = 5e-3  # m in front of the first surface
HELD_S, COUNTED_S = 2.0, 1.5
DOWN = (0.0, -1.0, 0.0)


@dataclass(frozen=True)
class Chatter:
    """Root mean square of f(k) - f(k-1), N, at the place where it is larger: half way to the pop, or behind it."""

    rest: float  # the needle rests, the encoder shows n - 1, n or n + 1 at random
    hand: float  # a simulated hand with tremor holds the needle at a simulated Omni


Run = Callable[[Array], Ticks]  # of positions (n, 3), m
Held = Callable[[RecordedMotion, float], Ticks]  # of a motion and its duration, s


def chatter(run: Run, held: Held, places: list[float]) -> Chatter:
    """The chatter of a model at depths below the first surface, m."""
    at_rest = [_tick_to_tick(run(_dithered(place)).force) for place in places]
    in_hand = []
    for place in places:
        way = (place + LEAD) / SPEED
        motion = RecordedMotion([0.0, 0.2, 0.2 + way], [_point(-LEAD), _point(-LEAD), _point(place)])
        in_hand.append(_tick_to_tick(held(motion, 0.2 + way + HELD_S).model_force))
    return Chatter(max(at_rest), max(in_hand))


def rival_chatter(layers: tuple[Layer, ...], places: list[float]) -> Chatter:
    """The chatter of rivals behind the line fit that docs/conditioning.md recommends for devices."""
    scene = scene_of(layers)
    rivals = [layer.rival for layer in layers]
    return chatter(
        lambda p: RivalInsertion(scene, rivals).run(p, DOWN),
        lambda motion, duration: rival_experiment(scene, rivals, motion, duration),
        places,
    )


def scene_of(layers: tuple[Layer, ...], name: str = "rivals") -> Scene:
    """A scene with a membrane at each surface, at the place of the first. The membranes' own numbers are not used."""
    first = layers[0].surface
    unused = Membrane(500.0, 0.1, 0.2, 1e-3)
    placed = [
        PlacedMembrane(f"layer {i + 1}", unused, _point(layer.surface - first), DOWN) for i, layer in enumerate(layers)
    ]
    return Scene(name, Needle(1.2e-3, 0.28), Coupling(400.0, 1.0), placed, SERVO)


def places_of(surface: float, pop: float | None, deepest: float) -> list[float]:
    """Where chatter is measured, m below the first surface: half way to the first pop, and behind the last one."""
    reach = (pop if pop is not None else deepest) - surface
    return [0.5 * reach] if pop is None else [0.5 * reach, max(1.05 * reach, deepest - surface - 1e-3)]


def _point(depth: float) -> tuple[float, float, float]:
    return (0.0, -depth, 0.0)


def _dithered(place: float, seed: int = 3) -> Array:
    """The needle goes to a place, draws back by 0.5 mm so that friction sticks, and rests while the encoder dithers."""
    rng = np.random.default_rng(seed)
    turn = min(0.5e-3, 0.2 * place)
    inwards = np.arange(-LEAD, place + turn, SPEED / RATE)
    outwards = np.arange(place + turn, place, -5e-3 / RATE)
    moving = np.rint(np.concatenate([inwards, outwards]) / COUNT)
    still = np.full(int(0.25 * RATE), moving[-1])
    rest = moving[-1] + rng.integers(-1, 2, int(HELD_S * RATE))
    depth = np.concatenate([moving, still, rest]) * COUNT
    return np.outer(depth, DOWN)


def _tick_to_tick(force: Array) -> float:
    """Root mean square of the change of the force from tick to tick over the last COUNTED_S, N."""
    steps = np.linalg.norm(np.diff(force[-int(COUNTED_S * RATE) :], axis=0), axis=1)
    return float(np.sqrt(np.mean(steps**2)))

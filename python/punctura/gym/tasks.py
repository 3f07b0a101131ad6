"""The ready tasks. The spread of their populations is illustrative, except where a source is named."""

from __future__ import annotations

from math import inf, radians
from types import MappingProxyType

from punctura.gym.population import Vary
from punctura.gym.task import Task

_MM = 1e-3


def _firmness(*membranes: int) -> tuple[Vary, ...]:
    """Stiffness and precompression of each membrane vary together; its friction alone."""
    return tuple(
        vary
        for i in membranes
        for vary in (
            Vary([f"membrane[{i}].stiffness", f"membrane[{i}].precompression"], 0.8, 1.25),
            Vary([f"membrane[{i}].friction"], 0.9, 1.1),
        )
    )


TASKS = MappingProxyType(
    {
        # The depth of veins of the elbow fold spreads by more than a millimetre (venipuncture.toml names the source of
        # the mean). Along the needle, at 30 degrees, that is twice as much; the space for the whole tip has 1.9 mm.
        "Venipuncture": Task(
            scene="venipuncture", wall=1, whole_tip=True, next_wall=2, room=inf, angle=radians(30),
            distance=(4 * _MM, 8 * _MM),
            vary=(
                Vary(["membrane[1].point[1]", "membrane[2].point[1]"], -1.5 * _MM, 1.5 * _MM, "shift"),
                *_firmness(0, 1, 2),
            ),
        ),
        # The skin is a few millimetres nearer to the ligament in one person than in another: the ligament in front of
        # the flavum takes up the difference, so that no gap opens.
        "Epidural": Task(
            scene="epidural", wall=4, whole_tip=False, next_wall=5, room=inf, angle=radians(90),
            distance=(4 * _MM, 8 * _MM), time_limit=30,
            vary=(
                Vary({"membrane[3].thickness": 1, "membrane[4].point[1]": -1, "membrane[5].point[1]": -1},
                     -5 * _MM, 5 * _MM, "shift"),
                *_firmness(0, 1, 2, 3, 4, 5),
            ),
        ),
        "StopAfterPop": Task(
            scene="k06-fig10", wall=0, whole_tip=True, next_wall=None, room=2.5 * _MM, angle=radians(90),
            distance=(2 * _MM, 12 * _MM), vary=_firmness(0),
        ),
    }
)  # fmt: skip

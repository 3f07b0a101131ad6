"""Runs of the ready epidural with a thumb on the plunger of its syringe."""

from functools import cache

import numpy as np
import punctura as pn
from attempts import hand_run
from punctura._core import tip_length
from punctura.syringe import Plunger, outlet_at

NAME = "epidural-plunger"
SCENE = pn.load_scene("epidural")
# The skin at 6 mm, the flavum at 47.6 to 51, the dura at 56.
LEGS = ((1.0, 0.0), (6.0, 47.0), (4.5, 58.3), (6.0, 58.3))
AT_ONCE, SLOWLY, NEVER = 0.15, 0.3, 99.0  # s until the thumb lets go
HEAD = """
title = "Test"
description = "A test."
instruction = "Do it."
scene = "epidural"
[start]
position_mm = [0, 6, 0]
[space]
name = "the epidural space"
behind = "ligamentum flavum"
in_front_of = "dura"
press_mm = 1.5
"""


@cache
def pushed(newtons=4.0, lets_go=AT_ONCE, draws=0.0, begins_mm=30.0):
    """The columns of LEGS with a thumb. Nobody may change them."""
    return with_thumb(hand_run("epidural", LEGS), begins_mm, newtons, lets_go, draws)


def with_thumb(columns, begins_mm, newtons, lets_go, draws=0.0):
    """The columns of a run with a thumb that pushes with this force from a depth below the skin on.

    lets_go: s after the plunger gave way, until the thumb's force is 0. draws: m/s, how fast it is drawn back then.
    """
    settings, period = SCENE.syringe, 1 / SCENE.servo.rate
    plunger, opening = Plunger(settings.syringe, settings.thumb, period), tip_length(SCENE.needle)
    paths = [placed.membrane.thickness for placed in SCENE.membranes]
    outlets = [(placed.outflow, placed.outflow_behind) for placed in SCENE.membranes]
    n = len(columns["tick"])
    force, injected, thumb, until, was = np.zeros(n), np.zeros(n), 0.0, np.inf, 0.0
    depth_of = {"thumb": np.zeros(n), "plunger": np.zeros(n)}
    inside = columns["phase"] > 0
    for k in range(n):
        depths = np.where(inside[k], columns["depth"][k], 0.0)
        layers = [(d, u, *out) for d, u, out in zip(depths, paths, outlets, strict=True)]
        wanted = newtons if columns["depth"][k, 0] * 1e3 > begins_mm and k * period < until else 0.0
        thumb += 10e-3 * max(0.0, wanted + plunger.force) * period
        thumb = thumb if k * period < until else max(0.0, thumb - draws * period)
        plunger.step(thumb, outlet_at(layers, opening))
        force[k], injected[k] = plunger.force, plunger.left
        depth_of["thumb"][k], depth_of["plunger"][k] = thumb, plunger.position
        if injected[k] - was > 0.1e-6 * period and columns["depth"][k, 4] > 3.38e-3 and until == np.inf:
            until = k * period + lets_go
        was = injected[k]
    return columns | depth_of | {"thumb_force": force, "injected": injected}

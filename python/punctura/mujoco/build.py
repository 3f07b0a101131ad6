"""Finds sites and bodies in a MuJoCo model and attaches needles to them."""

import weakref
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from punctura import ConfigurationError, Insertion, Scene
from punctura._core import DisplaySettings, ServoSettings
from punctura.extras import missing, optional
from punctura.mujoco.attachment import Attachment
from punctura.mujoco.kinematics import Link

_OLDEST = 4  # version of MuJoCo
_attached: weakref.WeakValueDictionary[int, Attachment] = weakref.WeakValueDictionary()


class NeedleInTissue(NamedTuple):
    """A needle of a MuJoCo model and the membranes that it can meet."""

    scene: Scene  # needle, coupling and membranes; points and normals in the frame of the tissue's body
    needle: str  # a site at the tip, whose z axis is the direction of the needle
    tissue: str | Mapping[str, str]  # the body that carries the membranes, or {name of a membrane: body} for all


def attach(
    model: Any, scene: Scene, needle: str, tissue: str | Mapping[str, str], *, implicit: bool = True
) -> Attachment:
    """Attaches one needle to a MuJoCo model. `attach_needles` has the details."""
    return attach_needles(model, [NeedleInTissue(scene, needle, tissue)], implicit=implicit)


def attach_needles(model: Any, needles: Sequence[NeedleInTissue], *, implicit: bool = True) -> Attachment:
    """Attaches needles to a MuJoCo model (mujoco.MjModel).

    Points and normals of the membranes are in the frame of the body that carries them ("world" is a body, too). The
    rate is that of model.opt.timestep; conditioning, rate, display and syringe of the scene are not used, because a
    simulation has no encoder noise, no motors and no thumb.

    implicit: the force is the one at the end of the step, which the force itself changes (docs/mujoco.md); otherwise
    the one at its start, with a StabilityWarning for a needle that is too light for that.

    Raises ModuleNotFoundError without MuJoCo 4; TypeError if a scene is no Scene; ValueError for an unknown site, body
    or membrane, a model that has an Attachment already, or a time step that no scene can have.
    """
    mujoco = optional("mujoco", "mujoco", "punctura.mujoco")
    if int(mujoco.__version__.partition(".")[0]) < _OLDEST:  # its functions have other parameters
        raise missing("mujoco", "mujoco", f"punctura.mujoco (here is MuJoCo {mujoco.__version__}, too old)")
    if model._address in _attached:
        raise ValueError(
            "this model has an Attachment already, and the needles would act twice. Use that one, or call its "
            "detach() first. To attach several needles, give them all to attach_needles()"
        )
    links = [link for given in needles for link in _links(mujoco, model, given)]
    if not links:
        raise ValueError("needles is empty: give at least one NeedleInTissue")
    attachment = Attachment(model, links, implicit=implicit, forget=_forget)
    _attached[model._address] = attachment
    return attachment


def _forget(model: Any) -> None:
    _attached.pop(model._address, None)


def _links(mujoco: Any, model: Any, given: NeedleInTissue) -> list[Link]:
    """One link for each body that carries membranes of the needle."""
    if not isinstance(given.scene, Scene):
        raise TypeError(f"scene is {given.scene!r}, not a punctura.Scene: give punctura.load_scene(...)")
    site = _number(mujoco, model, "site", given.needle)
    holder = int(model.site_bodyid[site])
    body_of = given.tissue
    if isinstance(body_of, str):
        body_of = dict.fromkeys((m.name for m in given.scene.membranes), body_of)
    names = [membrane.name for membrane in given.scene.membranes]
    for name in sorted(set(names) ^ set(body_of)):
        problem = "has no body in `tissue`" if name in names else f"is none of the scene's membranes {names}"
        raise ValueError(f"membrane {name!r} {problem}")
    links = []
    for body_name in dict.fromkeys(body_of.values()):
        body = _number(mujoco, model, "body", body_name)
        if body == holder:
            raise ValueError(
                f"site {given.needle!r} belongs to body {body_name!r}, which also carries the membranes: a body "
                "cannot be pushed into itself"
            )
        carried = [membrane for membrane in given.scene.membranes if body_of[membrane.name] == body_name]
        insertion = Insertion(_at_the_rate_of(model, given.scene, carried))
        links.append(Link(given.needle, body_name, site, holder, body, insertion))
    return links


def _at_the_rate_of(model: Any, scene: Scene, membranes: Sequence[Any]) -> Scene:
    try:
        servo = ServoSettings(rate=1 / model.opt.timestep, low_pass=0, solver=scene.servo.solver)
    except (ConfigurationError, ZeroDivisionError):
        raise ValueError(
            f"model.opt.timestep is {model.opt.timestep:g} s: needles need a time step from 0.01 ms to 10 ms"
        ) from None
    return scene.replace(membranes=membranes, servo=servo, display=DisplaySettings(), syringe=None)


def _number(mujoco: Any, model: Any, kind: str, name: str) -> int:
    """The number of a site or a body."""
    number: int = mujoco.mj_name2id(model, getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), name)
    if number >= 0:
        return number
    count = getattr(model, f"n{kind}")
    known = ", ".join(repr(getattr(model, kind)(i).name) for i in range(min(count, 20))) or "none"
    raise ValueError(f"the model has no {kind} {name!r}; it has {known}{', ...' if count > 20 else ''}")

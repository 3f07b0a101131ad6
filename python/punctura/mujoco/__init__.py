"""Needles in MuJoCo models: `attach` adds the force of K06 between a site of the model and a body with membranes.

Needs MuJoCo: the extra mujoco.
"""

from punctura.mujoco.attachment import Attachment
from punctura.mujoco.build import NeedleInTissue, attach, attach_needles
from punctura.mujoco.implicit import StabilityWarning, smallest_mass
from punctura.mujoco.needles import Tick

__all__ = ["Attachment", "NeedleInTissue", "StabilityWarning", "Tick", "attach", "attach_needles", "smallest_mass"]

"""The names of the environments for gymnasium.make and gymnasium.make_vec."""

from __future__ import annotations

import gymnasium

from punctura.gym.tasks import TASKS


def register() -> None:
    """Registers punctura/NAME-v0 for each task. Does nothing for a name that is registered."""
    for name in TASKS:
        if f"punctura/{name}-v0" not in gymnasium.registry:
            gymnasium.register(
                f"punctura/{name}-v0",
                entry_point="punctura.gym.env:NeedleEnv",
                vector_entry_point="punctura.gym.vector:NeedleVectorEnv",
                kwargs={"task": name},
            )

"""The names of the two forces and of the limits, for the terminal, results and files.

The page has the same names of the forces (web/src/state/scale.ts).
"""

MODEL_FORCE = "model force"


def scale_text(scale: float) -> str:
    """A force scale with two decimals, or two digits if it is below 0.1: "0.30", "0.066"."""
    return f"{scale:.2f}" if scale >= 0.0995 else f"{scale:.2g}"


def felt_force(scale: float) -> str:
    """The name of the force on the hand, with the scale if the device gives less than the model's force."""
    return "felt force" if scale == 1 else f"felt force (x {scale_text(scale)})"


# By the names of punctura._core.Limit, in the order of their codes.
LIMIT_WORDS = {
    "none": "",
    "ramp": "growing after it was turned on",
    "peak": "peak limit",
    "continuous": "long-run limit",
    "temperature": "warm motors",
}
CUTS = ("peak", "continuous", "temperature")  # they cut the force; a force that grows after arming is no news

"""One rival in each layer of the tissue: the force on the needle is the sum."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura._core import Rival
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml import read_text
from punctura.files.whole_file import write_whole
from punctura.rivals.path import Path

Array = NDArray[np.float64]
FORMAT = "punctura rival 1"


@dataclass(frozen=True)
class Layer:
    """A rival behind a surface. surface: its depth, m, on the depth axis of the trace."""

    surface: float
    rival: Rival

    def resistance(self, path: Path) -> Array:
        """The force against the insertion (n,), N."""
        return self.rival.resistance(path.depth - self.surface, path.velocity, path.period)


def resistance(layers: tuple[Layer, ...], path: Path) -> Array:
    """The force of all layers against the insertion (n,), N."""
    total = np.zeros(len(path.depth))
    for layer in layers:
        total += layer.resistance(path)
    return total


def save_layers(file: str | os.PathLike[str], layers: tuple[Layer, ...]) -> None:
    """Writes layers as JSON, for `punctura simulate --rival`. Raises OSError."""
    found = [{"surface_m": one.surface, "rival": one.rival.name, "numbers": one.rival.numbers} for one in layers]
    write_whole(FilePath(file), (json.dumps({"format": FORMAT, "layers": found}, indent=2) + "\n").encode())


def load_layers(file: str | os.PathLike[str]) -> tuple[Layer, ...]:
    """Reads layers from a file of save_layers(). Raises ConfigurationError."""
    try:
        held: Any = json.loads(read_text(FilePath(file), "rival"))
        if not isinstance(held, Mapping) or held.get("format") != FORMAT:
            raise _wrong(file, f'is no file of punctura rivals --out: it must have "format": "{FORMAT}"')
        return tuple(Layer(float(one["surface_m"]), Rival(one["rival"], one["numbers"])) for one in held["layers"])
    except ConfigurationError:
        raise
    except json.JSONDecodeError as error:
        raise _wrong(file, f"is no JSON, as punctura rivals --out writes it: {error}") from None
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise _wrong(file, f"each layer needs surface_m, rival and numbers ({error!r})") from None


def _wrong(file: str | os.PathLike[str], reason: str) -> ConfigurationError:
    return ConfigurationError([Problem("", MISSING, reason)], os.fspath(file))

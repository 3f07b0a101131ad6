"""The ready protocols of `punctura perception`. Their list needs no other package: SciPy takes long to import."""

from pathlib import Path


def protocol_files() -> dict[str, Path]:
    """The files of the ready protocols, by name."""
    return {path.stem: path for path in sorted(Path(__file__).parent.glob("*.toml"))}

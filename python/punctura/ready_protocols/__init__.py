"""The ready protocols of `punctura perception`. Their list needs no other package: SciPy takes long to import."""

from pathlib import Path

from punctura.files.toml import read_tables


def protocol_files() -> dict[str, Path]:
    """The files of the ready protocols, by name."""
    return {path.stem: path for path in sorted(Path(__file__).parent.glob("*.toml"))}


def protocol_titles() -> dict[str, str]:
    """What each ready protocol asks, by name."""
    return {name: str(read_tables(path, "protocol")["title"]) for name, path in protocol_files().items()}

"""Where the installed package keeps its C++ headers and CMake files."""

from pathlib import Path

__all__ = ["cmake_dir", "include_dir"]

_PREFIX = Path(__file__).parent


def include_dir() -> Path:
    """The folder to give to a C++ compiler with -I. Raises FileNotFoundError if pip did not install the package."""
    return _installed(_PREFIX / "include")


def cmake_dir() -> Path:
    """The folder of punctura-config.cmake, for -Dpunctura_DIR. Raises FileNotFoundError as include_dir() does."""
    return _installed(_PREFIX / "lib" / "cmake" / "punctura")


def _installed(folder: Path) -> Path:
    if not folder.is_dir():
        raise FileNotFoundError(
            f"{folder} does not exist: this copy of punctura was not installed by pip. "
            "Run `pip install .` in its source folder"
        )
    return folder

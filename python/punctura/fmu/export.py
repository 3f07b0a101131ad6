"""Writes an FMU: a zip file with the model description, the binary of this system and the scene."""

import io
import os
import platform
import re
import sys
import zipfile
from pathlib import Path

from punctura._core import Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.whole_file import write_whole
from punctura.fmu.description import model_description, scene_file_text, variables
from punctura.scene import load_scene

_SUFFIX = {"linux": ".so", "darwin": ".dylib", "win32": ".dll"}
_BUILT = {"linux": ".so", "darwin": ".so", "win32": ".dll"}  # by CMake, for a module
_FOLDERS_2 = {("linux", "x86_64"): "linux64", ("win32", "amd64"): "win64"}
_SYSTEM_3 = {"linux": "linux", "darwin": "darwin", "win32": "windows"}
_PROCESSOR_3 = {"amd64": "x86_64", "x86_64": "x86_64", "arm64": "aarch64", "aarch64": "aarch64"}


def export_fmu(scene: Scene | str | os.PathLike[str], out: str | os.PathLike[str], *, version: int = 3) -> Path:
    """Writes an FMU for co-simulation that computes the force of a scene. Returns its path.

    scene: a Scene, a scene file or the name of a ready scene. out: FILE.fmu. version: of FMI, 2 or 3. The FMU runs on
    this operating system and processor. Raises ConfigurationError with the problem of the name or all of
    the scene, ValueError, OSError.
    """
    path = Path(out)
    if path.suffix != ".fmu":
        raise ConfigurationError([Problem(f"out {path}", MISSING, "must end in .fmu")])
    if version not in (2, 3):
        raise ValueError(f"FMI version {version} is unknown: give 2 or 3")
    if not isinstance(scene, Scene):
        scene = load_scene(scene)
    binary = _binary()
    identifier = _identifier(path.stem)
    found = variables(scene)
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        _add(archive, "modelDescription.xml", model_description(scene, found, version, identifier))
        _add(archive, f"binaries/{_folder(version)}/{identifier}{_SUFFIX[sys.platform]}", binary.read_bytes())
        _add(archive, "resources/scene.txt", scene_file_text(scene).encode())
    write_whole(path, data.getvalue())
    return path


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    """Without the time, so that the same scene gives the same file."""
    info = zipfile.ZipInfo(name)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
    archive.writestr(info, content)


def _identifier(name: str) -> str:
    """A C identifier, as FMI requires it."""
    text = re.sub(r"\W", "_", name, flags=re.ASCII)
    return text if re.match(r"[A-Za-z_]", text) else f"_{text}"


def _binary() -> Path:
    path = Path(__file__).parent / f"punctura_fmu{_BUILT.get(sys.platform, '.so')}"
    if not path.is_file():
        raise FileNotFoundError(
            f"{path} does not exist: this copy of punctura was not installed by pip. Run `pip install .` in its source "
            "folder"
        )
    return path


def _folder(version: int) -> str:
    machine = platform.machine().lower()
    if version == 2 and sys.platform == "darwin":
        return "darwin64"
    if version == 2:
        if (sys.platform, machine) not in _FOLDERS_2:
            raise ValueError(f"FMI 2.0 has no name for {machine} on {sys.platform}: use FMI 3.0")
        return _FOLDERS_2[sys.platform, machine]
    if sys.platform not in _SYSTEM_3 or machine not in _PROCESSOR_3:
        raise ValueError(f"an FMU cannot name {machine} on {sys.platform}")
    return f"{_PROCESSOR_3[machine]}-{_SYSTEM_3[sys.platform]}"

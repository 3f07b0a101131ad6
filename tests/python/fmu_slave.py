"""An FMU's binary through ctypes, as a simulator calls it: the same calls for FMI 2 and 3."""

import ctypes
import tempfile
import zipfile
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from pathlib import Path
from typing import ClassVar

import punctura as pn
from punctura.fmu import export_fmu
from punctura.fmu.description import scene_file_text, variables

SCENE = "k06-fig12"
INPUTS, FORCE = range(1, 7), range(7, 10)
OK, ERROR = 0, 3


class _Callbacks(ctypes.Structure):
    _fields_ = [(name, c_void_p) for name in ("logger", "allocate", "free", "finished", "environment")]


class Slave:
    """An instance. Each call returns its status; `log` has the texts of the errors (FMI 3) or "" for each (FMI 2)."""

    made: ClassVar[dict[tuple[int, str], Path]] = {}  # the folders of the FMUs, by version and scene

    def __init__(self, folder: Path, version: int = 3, scene: object = SCENE) -> None:
        given = pn.load_scene(scene) if isinstance(scene, str) else scene
        key = (version, scene_file_text(given))
        if key not in Slave.made:
            Slave.made[key] = here = Path(tempfile.mkdtemp(dir=folder))
            with zipfile.ZipFile(export_fmu(given, here / "needle.fmu", version=version)) as archive:
                archive.extractall(here)
        here = Slave.made[key]
        (binary,) = (here / "binaries").rglob("*.*")
        resources = str(here / "resources").encode()
        self.version, self.library, self.log = version, ctypes.CDLL(str(binary)), []
        if version == 2:  # the text is a variable argument, which a callback cannot read on every system
            kept = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)(lambda *_: self.log.append(""))
            callbacks = _Callbacks(logger=ctypes.cast(kept, c_void_p))
            self.library.fmi2Instantiate.restype = c_void_p
            made = self.library.fmi2Instantiate(b"", 1, b"", b"file://" + resources, byref(callbacks), 0, 0)
            self._kept = (kept, callbacks)
        else:
            kept = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)(
                lambda _environment, _status, _category, text: self.log.append(text.decode())
            )
            self.library.fmi3InstantiateCoSimulation.restype = c_void_p
            no = c_bool(False)
            made = self.library.fmi3InstantiateCoSimulation(
                b"", b"", resources, no, no, no, no, None, c_size_t(0), None, kept, None
            )
            self._kept = kept
        assert made
        self._made = c_void_p(made)

    def __call__(self, name: str, *arguments: object) -> int:
        """Calls fmi2... or fmi3..."""
        return getattr(self.library, f"fmi{self.version}{name}")(self._made, *arguments)

    def enter(self, start: float = 0.0, stop: float | None = None) -> int:
        times = (c_double(start), c_bool(stop is not None), c_double(stop or 0))
        if self.version == 3:
            return self("EnterInitializationMode", c_bool(False), c_double(0), *times)
        return self("SetupExperiment", 0, c_double(0), *times) or self("EnterInitializationMode")

    def leave(self) -> int:
        return self("ExitInitializationMode")

    def started(self, start: float = 0.0, stop: float | None = None) -> "Slave":
        assert self.enter(start, stop) == OK and self.leave() == OK
        return self

    def _variables(self, verb: str, kind: str, references: object, values: ctypes.Array) -> int:
        names = {"Float64": "Real", "Int32": "Integer", "Boolean": "Boolean"}
        asked = (c_uint32 * len(values))(*references)
        count = (c_size_t(len(values)),)
        name = verb + (kind if self.version == 3 else names[kind])
        return self(name, asked, *count, values, *(count if self.version == 3 else ()))

    def set(self, references: object, numbers: object, kind: str = "Float64") -> int:
        of = {"Float64": c_double, "Int32": c_int, "Boolean": c_bool if self.version == 3 else c_int}[kind]
        return self._variables("Set", kind, references, (of * len(list(numbers)))(*numbers))

    def get(self, references: object, kind: str = "Float64") -> tuple[int, list[float]]:
        of = {"Float64": c_double, "Int32": c_int, "Boolean": c_bool if self.version == 3 else c_int}[kind]
        values = (of * len(references))()
        return self._variables("Get", kind, references, values), list(values)

    def step(self, time: float, duration: float) -> int:
        flags = [c_bool() for _ in range(3)]
        more = (*map(byref, flags), byref(c_double())) if self.version == 3 else ()
        return self("DoStep", c_double(time), c_double(duration), c_bool(False), *more)

    def force(self) -> list[float]:
        status, force = self.get(FORCE)
        assert status == OK
        return force

    def save(self) -> bytes:
        """The serialized state."""
        name = "FMUstate" if self.version == 2 else "FMUState"
        state, size = c_void_p(), c_size_t()
        assert self("Get" + name, byref(state)) == OK
        assert self("Serialized" + name + "Size", state, byref(size)) == OK
        data = (ctypes.c_ubyte * size.value)()
        assert self("Serialize" + name, state, data, size) == OK
        self("Free" + name, byref(state))
        return bytes(data)

    def restore(self, data: bytes) -> int:
        name, deserialize = ("FMUstate", "DeSerialize") if self.version == 2 else ("FMUState", "Deserialize")
        state = c_void_p()
        return self(deserialize + name, data, c_size_t(len(data)), byref(state)) or self("Set" + name, state)


def parameter(path: str, scene: str = SCENE) -> int:
    """The value reference of a number of the scene."""
    return next(one.reference for one in variables(pn.load_scene(scene)) if one.name == path)

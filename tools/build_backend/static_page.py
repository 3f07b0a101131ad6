"""Builds the studio's page without a server: one folder of files for any web server.

    python tools/build_backend/static_page.py FOLDER

The core runs in the page as WebAssembly. Needs Node, punctura in this Python, and the tools of integrations/wasm.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from made_files import ForeignFileError, publish
from studio_page import ROOT, PageError, build_static

PACKAGE = ROOT / "integrations" / "wasm"
FIRST = "venipuncture"  # as in `punctura run`
DATA = "studio.json"


class StaticPageError(Exception):
    """The folder cannot be made. The message says why and what to do."""


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("folder", type=Path, help="files in it that this program has not made stay as they are")
    parser.add_argument("--keep-wasm", action="store_true", help="use integrations/wasm/punctura.wasm as it is")
    chosen = parser.parse_args(arguments)
    try:
        make(chosen.folder, build_wasm=not chosen.keep_wasm)
    except (StaticPageError, ForeignFileError, PageError, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    size = sum(file.stat().st_size for file in chosen.folder.rglob("*") if file.is_file())
    print(f"{chosen.folder}: {size / 1e6:.1f} MB. To look at it: python -m http.server -d {chosen.folder}")
    return 0


def make(folder: Path, build_wasm: bool = True) -> None:
    """Raises StaticPageError, ForeignFileError, PageError, OSError."""
    if build_wasm and subprocess.run(["bash", str(PACKAGE / "build.sh")], check=False).returncode:
        raise StaticPageError("The core cannot be compiled to WebAssembly: integrations/wasm/README.md has the tools")
    files = json.loads((PACKAGE / "package.json").read_text(encoding="utf-8"))["files"]
    missing = [name for name in files if not (PACKAGE / name).is_file()]
    if missing:
        raise StaticPageError(f"{', '.join(missing)} is missing in {PACKAGE}: leave out --keep-wasm")
    with tempfile.TemporaryDirectory(prefix="punctura-") as place:
        page = Path(place).resolve() / "page"
        build_static(page)
        library = page / "punctura"
        library.mkdir()
        for name in files:
            shutil.copy(PACKAGE / name, library)
        write_data(page)
        publish(page, folder)


def write_data(folder: Path) -> None:
    """What the studio's server would tell the page: scenes, the schema of scenes, and the words of faults."""
    from punctura import __version__
    from punctura._core import Fault
    from punctura.scene import scene_json_schema, scene_names
    from punctura.studio.health import STILL_OFF, fault_words
    from punctura.studio.loaded import from_name
    from punctura.studio.wire.messages import PROTOCOL

    scenes = [(name, from_name(name)) for name in scene_names()]
    data = {
        "version": __version__,
        "protocol": PROTOCOL,
        "first": FIRST,
        "scenes": [{"name": n, "title": loaded.scene.name, "tables": loaded.tables()} for n, loaded in scenes],
        "faults": {fault.name: fault_words(fault) for fault in Fault if fault is not Fault.none},
        "still_off": STILL_OFF,
    }
    (folder / DATA).write_text(json.dumps(data), encoding="utf-8")
    (folder / "schema.json").write_text(json.dumps(scene_json_schema()), encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())

"""Adds a number to the tissue of a membrane, in a copy of the tree, and checks where it appears.

    python tools/try_scene_field.py [FOLDER]    default: build/try-scene; takes some minutes, because it builds the copy

The new number must appear in scene files, the JSON Schema, the editor's form, Python's structs, the C ABI, the docs and
the force, after at most 8 changed lines in 6 files.
"""

import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST_LINES, MOST_FILES = 8, 6

# By file: what stands there, and what replaces it.
CHANGES = {
    "core/punctura/model/tissue.hpp": (
        ("  Scalar cutting{};", "  Scalar sleeve{1};  ///< the shaft's part of the grip\n  Scalar cutting{};"),
        (
            '    FieldOf<T, Scalar>{{"cutting"',
            '    FieldOf<T, Scalar>{{"sleeve", "", "-", {0, 2, false, false, "must be from 0 to 2"},\n'
            '      "A number that only this tool adds."}, &T::sleeve},\n'
            '    FieldOf<T, Scalar>{{"cutting"',
        ),
        ("t.tail_floor == 1 &&", "t.tail_floor == 1 && t.sleeve == 1 &&"),
    ),
    "core/punctura/model/grip.hpp": (
        ("const Scalar shaft = factor.shaft * full,", "const Scalar shaft = factor.shaft * full * tissue.sleeve,"),
    ),
}  # fmt: skip

CHECK = """
import ctypes, json, pickle, subprocess, sys
import punctura as pn
from punctura.scene import scene_json_schema, scene_text
sys.path.insert(0, "docs/site")
from pages import scene_keys_page

plain = pn.load_scene("k06-fig12")
path = "membrane[0].sleeve"
half = plain.with_values({path: 0.5})
open("half.toml", "w").write(scene_text(half))
field = next(field for field in plain.fields() if field.path == path)
struct = pn.Tissue(sleeve=0.5)
entry = scene_json_schema()["$defs"]["MembraneTable"]["properties"]["sleeve"]
force = [pn.Insertion(scene).run([[0, -0.02 * i / 2000, 0] for i in range(2000)], [0, -1, 0]).force[-1, 1]
         for scene in (plain, half)]
try:
    plain.with_values({path: 3})
    refused = ""
except pn.ConfigurationError as error:
    refused = str(error)

json.dump(scene_json_schema(), open("web/tests/sleeve.json", "w"))
open("web/tests/sleeve.test.ts", "w").write('''
import { expect, test } from "vitest";
import { sceneForm } from "../src/controls/editor/fields.ts";
import schema from "./sleeve.json";
test("the form has the number", () => {
  const field = sceneForm(schema).tables.flatMap((table) => table.fields).find(({ key }) => key === "sleeve");
  expect(field).toMatchObject({ title: "Sleeve", kind: "number", standard: 1, most: { value: 2, open: false } });
  expect(field).toMatchObject({ folded: "Measured tissue", help: "A number that only this tool adds." });
});
''')
subprocess.run([sys.executable, "tools/build_backend/studio_page.py", "--modules"], check=True)
form = subprocess.run(["npm", "--prefix", "web", "test", "--", "tests/sleeve.test.ts"], capture_output=True)

sources = [f"capi/src/{name}.cpp" for name in "errors scene toml values proxy insertion servo".split()]
subprocess.run(["g++", "-std=c++20", "-O0", "-shared", "-fPIC", "-Icore", "-Icapi/include", "-DPUNCTURA_C_TOML",
                "-DPUNCTURA_VERSION=\\"0\\"", *sources, "-o", "libpunctura.so"], check=True)
c, scene, value = ctypes.CDLL("./libpunctura.so"), ctypes.c_void_p(), ctypes.c_double()
text = open("half.toml", "rb").read()
read = c.punctura_scene_from_toml(text, ctypes.c_size_t(len(text)), ctypes.byref(scene))
got = c.punctura_scene_get(scene, path.encode(), ctypes.byref(value))
holds = {
    "TOML": "sleeve = 0.5" in scene_text(half) and pn.load_scene("half.toml") == half,
    "default": field.value == 1 and "sleeve" not in scene_text(plain),
    "bounds": (field.min, field.max) == (0, 2) and "must be from 0 to 2" in refused,
    "JSON Schema": entry["maximum"] == 2 and entry["default"] == 1 and entry["x-folded"] == "Measured tissue",
    "editor's form": form.returncode == 0,
    "Python": struct.sleeve == 0.5 and "sleeve=0.5" in repr(struct) and pickle.loads(pickle.dumps(struct)) == struct,
    "replace": half.membranes[0].tissue.replace(sleeve=1) == pn.Tissue(),
    "C": (read, got, value.value) == (0, 0, 0.5),
    "docs": "| `sleeve` |" in scene_keys_page(),
    "force": 0 < abs(force[1]) < abs(force[0]),
}
for where, there in holds.items():
    print(f"  {where:14} {'yes' if there else 'NO'}")
sys.exit(not all(holds.values()))
"""


def main() -> int:
    copy = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "try-scene").resolve()
    shutil.rmtree(copy, ignore_errors=True)
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(copy)], check=True)
    for name, changes in CHANGES.items():
        text = (copy / name).read_text(encoding="utf-8")
        for old, new in changes:
            if text.count(old) != 1:
                print(f"{name} has {text.count(old)} places with: {old}", file=sys.stderr)
                return 1
            text = text.replace(old, new)
        (copy / name).write_text(text, encoding="utf-8")
    diff = ["git", "-C", str(copy), "diff", "--numstat"]
    numbers = subprocess.run(diff, check=True, capture_output=True, text=True).stdout.splitlines()
    lines = sum(int(row.split()[0]) for row in numbers)
    print(f"  {lines} lines in {len(numbers)} files")
    subprocess.run([str(copy / "test"), "tree"], check=True, cwd=copy)
    done = subprocess.run([str(copy / ".venv/bin/python"), "-c", CHECK], cwd=copy, check=False)
    return done.returncode or int(lines > MOST_LINES or len(numbers) > MOST_FILES)


if __name__ == "__main__":
    sys.exit(main())

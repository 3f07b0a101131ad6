"""Wire data that server and page must read in the same way. Prints the frames, for the page's tests: npm run types.

frames: frames of ticks, as base64, with their content (null is NaN). Frames without `holds` must be rejected.
messages: a valid example of each message and request, and invalid requests.
"""

import base64
import json
import struct
from typing import Any

import numpy as np
from punctura.studio.wire.frames import HEAD, NUMBERS, WORDS, encode_ticks
from punctura.ticks import Ticks
from punctura.ticks.fields import shape_of

PLAIN = ("take_control", "arm", "pause", "reset", "stop_recording", "end_exercise", "trip_fault")
TRIPLE = [0.25, -1.5, 3.0]
SPREAD = {"p50": 1e-6, "p99": 2e-6, "p99_9": 3e-6, "largest": 4e-6, "edges": [0.0, 1e-6, 2e-6], "counts": [5, 6]}
LAW = {
    "name": "skin", "obliquity": 0.5, "far_face": 0.001, "through": 0.005, "depth": [-0.001, 0.0, 0.001],
    "lower": [0.0, -0.5, -0.25], "upper": [0.0, 0.25, 0.125],
}  # fmt: skip
TABLES = {
    "name": "one",
    "needle": {"gauge": 21, "tip_angle_deg": 11, "direction": "stylus"},
    "membrane": [{"name": "skin", "point_mm": [0, 0, 0]}],
}
VIEW = {
    "number": 1, "name": "one", "diameter": 0.0008, "tip_length": 0.004, "direction": "stylus", "solver": "exact",
    "rate": 1600.0, "force_scale": 0.5, "laws": [LAW], "tables": TABLES, "lumen": [0, 1],
    "syringe": {"bore": 0.012, "volume": 5e-06},
    "membranes": [
        {"name": "skin", "point": TRIPLE, "inward_normal": [0.0, -1.0, 0.0], "thickness": 0.001, "look": "skin",
         "behind": "fat"},
    ],
}  # fmt: skip


def columns(n: int, m: int, first: int, nan: bool) -> dict[str, Any]:
    """Numbers that float32 holds exactly, each different from its neighbours."""
    made: dict[str, Any] = {"tick": np.arange(first, first + n, dtype=np.uint64)}
    for at, field in enumerate(NUMBERS):
        shape = shape_of(field, n, m)
        made[field.name] = (np.arange(int(np.prod(shape)), dtype=float).reshape(shape) + 1) / 64 - at
    made["time"] = 2.5 + np.arange(n) / 1024
    for at, field in enumerate(WORDS):
        each = field.per_membrane
        made[field.name] = (np.arange(n * (m if each else 1)).reshape((n, m) if each else (n,)) + at) % 5
    if nan:
        made["depth"][0, 0] = made["position"][1, 2] = made["ceiling"][2] = np.nan
    return made


def plain(values: Any) -> list[float | None]:
    return [None if np.isnan(v) else float(v) for v in np.asarray(values, float).ravel()]


def sound_frame(what: str, m: int, other: bool, nan: bool, first: int = 7) -> dict[str, Any]:
    n = 3
    made = columns(n, m, first, nan)
    force = np.full((n, 3), np.nan) if other and nan else np.arange(n * 3).reshape(n, 3) / 8 if other else None
    data = encode_ticks(Ticks(made), 2, 5, force)
    made["time"] = made["time"] - 2.5
    names = [field.name for field in (*NUMBERS, *WORDS)]
    holds = {name: plain(made[name]) for name in names} | ({"other_force": plain(force)} if other else {})
    head = {"first_tick": first, "first_time": 2.5, "run": 2, "lost": 5, "membranes": m, "count": n}
    return {"what": what, "bytes": base64.b64encode(data).decode(), "head": head, "holds": holds}


def frames() -> list[dict[str, Any]]:
    sound = [
        sound_frame("one membrane", 1, False, False),
        sound_frame("three membranes", 3, False, False),
        sound_frame("one membrane, both solvers", 1, True, False),
        sound_frame("three membranes, both solvers, cells that are NaN", 3, True, True),
        sound_frame("a tick beyond 32 bits", 1, False, False, 2**40 + 1),
    ]
    whole = base64.b64decode(sound[1]["bytes"])
    head = list(HEAD.unpack_from(whole))

    def with_head(at: int, value: int) -> bytes:
        changed = [*head[:at], value, *head[at + 1 :]]
        return HEAD.pack(*changed) + whole[HEAD.size :]

    bad = {
        "nothing": b"",
        "half a head": whole[:20],
        "another magic": with_head(0, 0x31544E50),
        "cut off": whole[:-1],
        "cut off within a column": whole[: HEAD.size + 10],
        "too long": whole + b"\0",
        "one tick more than there is": with_head(1, head[1] + 1),
        "one tick less than there is": with_head(1, head[1] - 1),
        "one membrane more than there is": with_head(2, head[2] + 1),
        "more ticks than memory could hold": with_head(1, 2**32 - 1),
        "more membranes than memory could hold": with_head(2, 2**32 - 1),
        "another solver that is not there": with_head(3, 1),
        "random": struct.pack("<40B", *range(40)),
    }
    return sound + [{"what": what, "bytes": base64.b64encode(data).decode()} for what, data in bad.items()]


def messages() -> dict[str, Any]:
    device = {
        "backend": "simulated",
        "model": "M",
        "simulated": True,
        "has_orientation": True,
        "max_force": 3.3,
        "rate": 1600.0,
    }
    limits = {
        "max_force": 3.3, "continuous_force": 0.88, "continuous_time": 10.0, "ramp_time": 0.5, "warm_motor": 0.8,
        "max_speed": 8.0, "stale": 0.015, "deadline": 0.02, "axis_tolerance": 0.001, "dead_man_buttons": [1, 3],
    }  # fmt: skip
    choice = {"name": "a", "title": "A"}
    problem = {"path": "membrane[0].friction", "value": "3.9", "reason": "is too much"}
    goals = [{"text": "a goal", "state": state} for state in ("open", "met", "missed", "not measured")]
    sent = [
        {"kind": "hello", "protocol": 1, "version": "0.1.0", "viewer": 1, "device": device,
         "second_device": "a thumb", "limits": limits,
         "scenes": [choice], "exercises": [choice], "figures": True},
        {"kind": "scene", "scene": VIEW, "new_run": True, "run": 3},
        {"kind": "laws", "laws": [LAW]},
        {"kind": "control", "holder": 1, "you": True, "hand": {"position": TRIPLE, "axis": [0.0, -1.0, 0.0]}},
        {"kind": "status", "ticks": 1, "late": 0, "lost": 0, "period": SPREAD, "compute": SPREAD, "viewers": 1,
         "dropped": 0, "armed": True, "hand": "strokes", "compare": False, "statements": ["s"],
         "second": {"ticks": 1, "rate": 1000.0, "max_force": 3.25, "continuous_force": 0.875, "continuous_time": 10.0}},
        {"kind": "fault", "fault": "clock", "reason": "r", "remedy": "m", "trouble": "", "tick": 7, "kept": 1000},
        {"kind": "event", "what": "pop", "membrane": 0, "name": "skin", "tick": 7, "time": 0.5, "depth": 0.004,
         "force_before": 0.75, "force_after": 0.5, "drop": 0.25},
        {"kind": "estimate", "on": True, "phase": "rise", "slope": {"value": 200.0, "half": 12.5}, "plateau": None,
         "punctures": 1, "drop": 0.25, "ignored": 0, "found": [{"tick": 7, "depth": 0.004}]},
        {"kind": "recording", "name": "r", "rows": 1, "lost": 0, "seconds": 0.5, "trouble": ""},
        {"kind": "exercise", "exercise": "venipuncture", "running": True, "instruction": "Push.", "goals": goals,
         "result": "", "blind": False, "held": 1.5, "hold": 3.0, "time": 12.5, "time_limit": 60.0},
        {"kind": "sitting", "question": 4, "sentence": "Did it pop?", "answers": [{"name": "yes", "key": "y"}],
         "typed": "", "covered": True, "noise": True,
         "force_off": "Force off (Esc)", "sound": "Press a key.", "gone": "Not connected."},
        {"kind": "reply", "id": 1, "ok": False, "text": "1 problem", "problems": [problem], "data": {}},
        {"kind": "notice", "text": "Größe"},
    ]  # fmt: skip
    asked = [
        *({"id": 1, "do": do} for do in PLAIN),
        {"do": "awake"}, {"do": "took"},
        {"do": "target", "run": 3, "position": TRIPLE, "axis": [0.0, -1.0, 0.0], "buttons": 1},
        {"id": 2, "do": "strokes", "period": 2.0},
        {"id": 22, "do": "push_plunger", "force": 3.5},
        {"id": 3, "do": "play_motion", "recording": "r"},
        {"id": 4, "do": "edit", "tables": TABLES},
        {"id": 5, "do": "load", "scene": "venipuncture"},
        {"id": 6, "do": "load_text", "toml": "name = 'x'"},
        {"id": 7, "do": "compare", "on": True}, {"id": 8, "do": "estimate", "on": True},
        {"id": 8, "do": "start_recording", "name": None},
        {"id": 9, "do": "start_exercise", "exercise": "venipuncture", "person": "Ada", "group": "9b"},
        {"id": 13, "do": "check_exercise", "tables": {"title": "Mine"}},
        {"id": 14, "do": "try_exercise", "tables": {"title": "Mine"}, "person": "Ada", "group": ""},
        {"id": 15, "do": "save_exercise", "name": "mine", "tables": {"title": "Mine"}, "replace": False},
        {"id": 23, "do": "open_exercise", "name": "mine", "file": "dGl0bGU=", "replace": False},
        {"id": 16, "do": "delete_exercise", "name": "mine"},
        {"id": 24, "do": "respond", "question": 4, "answer": "yes"}, {"id": 25, "do": "sound", "plays": True},
        {"id": 12, "do": "set_expert", "exercise": "venipuncture", "recording": "r"},
    ]  # fmt: skip
    refused = [
        {"id": 1}, {"do": "arm"}, {"id": 1, "do": "fly"}, {"id": "1", "do": "arm"}, {"id": 1.5, "do": "arm"},
        {"id": -1, "do": "arm"}, {"id": 1, "do": "arm", "more": 1}, {"id": 1, "do": "compare", "on": "yes"},
        {"do": "target", "run": 0, "position": [0.0, 0.0], "axis": TRIPLE},
        {"do": "target", "run": 0, "position": TRIPLE, "axis": None},
        {"do": "target", "position": TRIPLE, "axis": TRIPLE},
        {"id": 1, "do": "strokes", "period": 0.1}, {"id": 1, "do": "push_plunger", "force": 16},
        {"id": 1, "do": "load", "scene": ""}, [], "arm", 7, None,
    ]  # fmt: skip
    return {"messages": sent, "requests": asked, "refused": refused}


if __name__ == "__main__":
    print(json.dumps(frames()))

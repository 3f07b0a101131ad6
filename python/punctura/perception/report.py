"""The report of an experiment: one page with a picture of each function, and all trials as one tidy table."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from punctura import __version__
from punctura.files.whole_file import write_whole
from punctura.perception.analysis import END, RATE, Answers, analyse, answers_of, belief_of, felt_level
from punctura.perception.course import Line, counted
from punctura.perception.drift import sentences
from punctura.perception.protocol import Protocol
from punctura.perception.results import LEVEL, SHARES, Analysis, Detection, Person, no_mean, words
from punctura.perception.session import (
    SUFFIX,
    TABLES,
    WRITTEN,
    Header,
    SessionError,
    check_alike,
    check_header,
    check_recordings,
    read_session,
    replayed,
    sessions,
)
from punctura.ticks.files import save

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_PANELS = 12
ABREAST = 3  # people beside each other in a table of d'
STYLE = (
    "@page{size:A4;margin:10mm}body{font:8pt/1.3 system-ui,sans-serif;max-width:190mm;margin:auto}"
    "h1{font-size:13pt}h2{font-size:10pt}table{border-collapse:collapse}svg{width:100%;height:auto;max-height:120mm}"
    "td,th{padding:0 5px;border-bottom:.5pt solid #ccc;text-align:left;font-weight:normal}tr{break-inside:avoid}"
)
NO_FORCE = "; no hand felt a force, because a mouse, a finger or keys moved the needle"
UNFINISHED = (
    "Not finished: {names}. What is there is analysed, and counts in the mean; blocks, levels and orders are not yet "
    "balanced."
)
SAME_ORDER = (
    "{names} have the same number, {number}, and so the same order of trials: its effects are not balanced over them. "
    "If all begin in one folder, each has a number of its own."
)
OTHER_VERSION = "{names} began with Punctura {version}, and this is {here}: what was felt is as {version} computed it."
OPEN_END = (
    '"At least" and "at most": all answers of a kind were alike, so one end is open. About '
    f"{-np.log(1 - LEVEL) / (RATE - END):.0f} times as many such trials would most likely close it, or fewer with "
    "levels nearer to the threshold."
)
TELL_SHAPE = 64  # answers at a level, docs/perception.md
SHAPES = (
    "The function has one of three shapes, and {each} answers at a level do not tell which: thresholds of observers "
    f"were 3 % too large with 24 answers, and 2 % with {TELL_SHAPE}."
)
CAPTIONS = {
    "": "Circles: the answers at a level, larger the more there are. Line and band: the function and its "
    f"{LEVEL:.0%} interval. Bar: that of the threshold.",
    "rates": "Circles: the mean at a level. Line: least squares; the interval of its slope is in the table.",
    "adjusts": "Circles: the settings, one after the other. Line: their mean; its interval is in the table.",
}
OF_LEVELS = "UNIT"  # of the protocol's variable, once there is one
# Column, type, unit, meaning. "comparison" is the interval that has the level of the trial.
DICTIONARY: tuple[tuple[str, pa.DataType, str, str], ...] = (
    ("participant", pa.string(), "", "pseudonym"),
    ("participant_number", pa.int64(), "", "from 0, decides the order of the trials"),
    ("device", pa.string(), "", "its model; empty for observers"),
    ("device_simulated", pa.bool_(), "", "whether no hand felt a force; empty for observers"),
    ("trial", pa.int64(), "", "number of the trial in the session, from 0, practice included"),
    ("block", pa.int64(), "", "from 0"),
    ("kind", pa.string(), "", "practice, trial or catch; practice is in no fit"),
    ("level", pa.float64(), OF_LEVELS, "planned level of the comparison"),
    ("felt_level", pa.float64(), OF_LEVELS, "the level as it was felt, if the variable is in newtons"),
    ("position", pa.int64(), "", "interval of the comparison, from 0"),
    ("answer", pa.string(), "", "as the task names it"),
    ("counted", pa.bool_(), "", "whether the answer is yes, the comparison or right; empty for numbers and settings"),
    ("drop_N", pa.float64(), "N", "felt drop at the pop of the judged membrane, in the comparison"),
    ("peak_N", pa.float64(), "N", "largest felt force of the comparison"),
    ("roughness_N", pa.float64(), "N", "rms of what changes faster than 20 ms before the pop, in the comparison"),
    ("speed_m_per_s", pa.float64(), "m/s", "mean speed of the needle inwards, in the comparison"),
    ("force_scale", pa.float64(), "", "how much of the model's force the device gave"),
    ("reference_drop_N", pa.float64(), "N", "felt drop, mean of the other intervals; empty without them"),
    ("reference_peak_N", pa.float64(), "N", "largest felt force, mean of the other intervals; empty without them"),
    ("recordings", pa.string(), "", "file of the trial, with all its intervals"),
    ("time", pa.string(), "", "of the answer, ISO 8601, UTC"),
)  # fmt: skip
_OF_FELT = {"drop_N": "drop", "peak_N": "peak", "roughness_N": "roughness", "speed_m_per_s": "speed"}


def write_report(protocol: Protocol, folder: Path) -> Analysis:
    """Analyses all sessions of a folder; writes the report, its picture, results.json and the tables beside them.

    Raises SessionError if there is none, or one of another protocol, or one that was changed by hand.
    """
    found, headers, unfinished = dict[str, list[Line]](), dict[str, Header](), dict[str, int]()
    for path in sessions(folder):
        header, lines = read_session(path)
        if header:
            check_header(header, protocol, path)
            if replayed(protocol, header, lines, path).next() is not None:
                unfinished[path.stem] = protocol.file.scored
            check_recordings(header, lines, folder)
            found[path.stem], headers[path.stem] = lines, header
    if not found:
        raise SessionError(f"{folder} has no session; punctura perception run makes one")
    check_alike(headers.values(), next(iter(headers.values())).simulated)
    analysis = analyse(protocol, found)
    rows = list[dict[str, object]]()
    for one in analysis.people:
        header = headers[one.participant]
        one.number, one.device, one.device_simulated = header.number, header.device, header.device_simulated
        one.version = header.version
        one.planned = unfinished.get(one.participant, 0)
        rows += [_row(protocol, header, line) for line in found[one.participant] if not one.copy_of]
    table = pa.Table.from_pylist(rows, pa.schema([pa.field(name, kind) for name, kind, *_ in DICTIONARY]))
    units = [[str(cell).replace(OF_LEVELS, protocol.unit) for cell in row] for row in DICTIONARY]
    about = [dict(zip(("column", "type", "unit", "meaning"), row, strict=True)) for row in units]
    _check_kept(folder, found)
    for name, content in zip(TABLES, (table, table, pa.Table.from_pylist(about)), strict=True):
        save(content, folder / name, private=True)
    write_whole(folder / "results.json", f"{analysis.model_dump_json(indent=1)}\n".encode(), private=True)
    if picture := _draw(protocol, analysis, found):
        write_whole(folder / "functions.svg", picture, private=True)
    text = _text(protocol, analysis, bool(picture))
    write_whole(folder / "report.md", text.encode(), private=True)
    write_whole(folder / "report.html", _page(text, (picture or b"").decode()).encode(), private=True)
    _check_kept(folder, found)
    return analysis


def _check_kept(folder: Path, participants: Iterable[str]) -> None:
    """Raises SessionError if a participant was deleted meanwhile; then nothing that was computed from it is left."""
    if gone := [name for name in participants if not (folder / f"{name}{SUFFIX}").is_file()]:
        for name in WRITTEN:
            (folder / name).unlink(missing_ok=True)
        raise SessionError(f"{', '.join(gone)} was deleted during the analysis: run it again")


def _safe(text: str) -> str:
    """A text that is not ours, for Markdown and HTML: on one line, without their signs."""
    return escape(" ".join(text.split()), quote=False).replace("](", "]&#40;").replace("|", "&#124;")


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    return [f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows)] + [""]


def _cells(one: Detection | None) -> tuple[str, ...]:
    return (str(one.trials), words(one.dprime), words(one.criterion)) if one else ("-",) * 3


def _text(protocol: Protocol, found: Analysis, drawn: bool) -> str:
    file, unit = protocol.file, f", {found.unit}" if found.unit else ""
    keys = {"threshold": f"threshold{unit}"}
    if protocol.rates:
        keys = {"slope": "exponent" if file.task == "magnitude" else f"points for each {found.unit or 'unit'}"}
    if protocol.reference is not None:
        keys |= {"jnd": f"JND{unit}", "weber": "Weber fraction"}
    if not (protocol.rates or protocol.adjusts):
        keys |= {"lapse": "lapses"} | ({"first": '"first" if equal'} if file.task == "two_intervals" else {})
    shares = "right answers" if protocol.compares else _counted(protocol)
    what = "the felt quantity" if found.felt else "the planned level"
    whose = ", for people who seldom lapse" * ("lapse" in keys)
    form, rows = ".3g" if protocol.rates or protocol.adjusts else ".0%", []
    for one in found.people:
        cells = [words(getattr(one, key)) for key in keys]
        if one.reason:
            cells = [one.reason, *[""] * (len(keys) - 1)]
        blocks = ", ".join("-" if share is None else format(share, form) for share in one.by_block)
        trials = f"{one.trials} of {one.planned}" if one.planned else str(one.trials)
        rows.append([one.participant, trials, *cells, blocks])
    if not found.reason:
        known, counted = sum(not one.reason for one in found.people), sum(not one.copy_of for one in found.people)
        means = [words(getattr(found, key)) if hasattr(found, key) else "" for key in keys]
        rows.append([f"**mean of {known} of {counted} people**", "", *means, ""])
    lines = [
        f"# {_safe(file.title)}", "", f"*{_safe(file.question)}*", "",
        f"Scene {_safe(file.scene)}, {file.method}, {file.task}, variable {file.stimulus.variable}{unit}, fitted "
        f"against {what}. Intervals are {LEVEL:.0%} intervals{whose}. Source of the protocol: "
        f"{_safe(file.source) or 'not given'}.", "",
        *_table(["participant", "trials", *keys.values(), f"{shares} in each block"], rows),
    ]  # fmt: skip
    lines += [line for text in no_mean(found, keys) for line in (text, "")]
    if part := [one.participant for one in found.people if one.planned]:
        lines += [UNFINISHED.format(names=" and ".join(part)), ""]
    lines += [line for text in sentences(protocol, found) for line in (text, "")]
    for device, simulated in sorted({(one.device, one.device_simulated) for one in found.people if one.device}):
        names = ", ".join(one.participant for one in found.people if one.device == device)
        lines += [f"Device of {names}: {_safe(device)}{NO_FORCE * simulated}.", ""]
    for version in sorted({one.version for one in found.people} - {__version__}):
        names = " and ".join(one.participant for one in found.people if one.version == version)
        lines += [OTHER_VERSION.format(names=names, version=_safe(version), here=__version__), ""]
    numbered = [(one.number, one.participant) for one in found.people if not one.copy_of]
    for number in sorted({number for number, _ in numbered if number is not None}):
        alike = [name for other, name in numbered if other == number]
        lines += [SAME_ORDER.format(names=" and ".join(alike), number=number), ""] * (len(alike) > 1)
    detected = [one for one in found.people if one.detection]
    lines += ["## d'", ""] * bool(detected)
    for i in range(0, len(detected), ABREAST):
        some = {one.participant: {each.level: each for each in one.detection} for one in detected[i : i + ABREAST]}
        head = [f"level{unit}", *(f"{name}, {what}" for name in some for what in ("trials", "d'", "criterion"))]
        rows = [
            [f"{level:.4g}", *(cell for each in some.values() for cell in _cells(each.get(level)))]
            for level in sorted({level for each in some.values() for level in each})
        ]
        lines += _table(head, rows)
    if any(np.isinf([*each.dprime, *each.criterion]).any() for one in detected for each in one.detection):
        lines += [OPEN_END, ""]
    told = [one.trials for one in found.people if one.lapse and protocol.shape.bends and protocol.shape.one_sided]
    if told:
        each = min(told) // len(protocol.levels)
        lines += [SHAPES.format(each=each), ""] * (each < TELL_SHAPE)
    caught = [one for one in found.people if one.catch_trials]
    if caught:
        what = "yes (false alarms)" if file.task == "yes_no" else "right"
        parts = (f"{one.participant} {one.catch_counted} of {one.catch_trials}" for one in caught)
        lines += [f"Catch trials, {what}: {', '.join(parts)}.", ""]
    kind = "rates" if protocol.rates else "adjusts" if protocol.adjusts else ""
    lines += ["![The psychometric functions](functions.svg)", "", CAPTIONS[kind], ""] if drawn else []
    return "\n".join(lines)


def _page(text: str, picture: str) -> str:
    """The same report as one file to look at and to print."""
    parts = [f"<!doctype html><html lang=en><meta charset=utf-8><title>Report</title><style>{STYLE}</style>"]
    for block in re.split(r"\n\n+", text.strip()):
        row = block.partition(" ")
        if row[0] == "|":
            rows = [line[2:-2].split(" | ") for line in block.splitlines() if not line.startswith("| ---")]
            parts += [
                "<table>",
                *(
                    "<tr>" + "".join(f"<{'td' if i else 'th'}>{cell.strip('*')}" for cell in one)
                    for i, one in enumerate(rows)
                ),
                "</table>",
            ]
        elif row[0] in ("#", "##"):
            parts.append(f"<h{len(row[0])}>{row[2]}</h{len(row[0])}>")
        else:
            parts.append(picture[picture.find("<svg") :] if block.startswith("![") else f"<p>{block.strip('*')}</p>")
    return "\n".join(parts)


def _draw(protocol: Protocol, found: Analysis, sessions: Mapping[str, Sequence[Line]]) -> bytes | None:
    """The first people with a result: the mean answer at each level, and the function with its 95 % band."""
    from matplotlib.figure import Figure

    from punctura.reproduce.style import figure_style

    people = [one for one in found.people if not one.reason][:MOST_PANELS]
    if not people:
        return None
    across = min(3, len(people))
    down = -(-len(people) // across)
    with figure_style():
        figure = Figure(figsize=(2.6 * across, 2.3 * down), layout="constrained")
        for number, one in enumerate(people, 1):
            panel = figure.add_subplot(down, across, number)
            _panel(panel, protocol, one, *answers_of(protocol, sessions[one.participant]))
            panel.set_title(one.participant)
        texts = [_label(protocol), "share of " * (not (protocol.rates or protocol.adjusts)) + _counted(protocol)]
        figure.supxlabel(texts[protocol.adjusts], size="medium")
        figure.supylabel(texts[not protocol.adjusts], size="medium")
        data = io.BytesIO()
        figure.savefig(data, format="svg", metadata={"Date": None})
    return data.getvalue()


def _panel(panel: Axes, protocol: Protocol, one: Person, answers: Answers, catch: Answers) -> None:
    if protocol.unit == "m":
        axis = panel.yaxis if protocol.adjusts else panel.xaxis
        axis.set_major_formatter(lambda value, _: f"{1e3 * value:g}")
    if protocol.adjusts:
        panel.plot(np.arange(len(answers.x)) + 1, answers.x, "o", ms=4, color="0.2", mfc="none")
        panel.axhline(answers.x.mean(), color="0.2", lw=1.2)
        return
    curve = np.linspace(protocol.levels[0], protocol.levels[-1], 121)
    for level in np.unique(answers.level):
        here = answers.level == level
        size = 2 + np.sqrt(here.sum()) / 2
        panel.plot(answers.x[here].mean(), answers.counted[here].mean(), "o", ms=size, color="0.2", mfc="none")
    if protocol.rates:
        log = protocol.file.task == "magnitude"
        x, y = (np.log(one[answers.x > 0]) if log else one for one in (answers.x, answers.counted))
        line = np.polyval(np.polyfit(x, y, 1), np.log(curve) if log else curve)
        panel.plot(curve, np.exp(line) if log else line, color="0.2", lw=1.2)
        return
    belief = belief_of(protocol, answers, catch)
    p = belief.grid.probability(curve)
    band = np.array([belief.quantiles(row, SHARES) for row in p])
    panel.fill_between(curve, band[:, 0], band[:, 1], color="0.85", lw=0)
    panel.plot(curve, p @ belief.weight, color="0.2", lw=1.2)
    panel.set_ylim(-0.03, 1.03)
    if one.threshold is not None:
        ends, half = np.array(one.threshold[1:]), 0.5
        if protocol.shape.one_sided:
            ends, half = protocol.shape.reference + ends * (-1) ** protocol.shape.below, (1 + protocol.shape.guess) / 2
        panel.plot(ends, [half, half], color="0.2", lw=2.5, solid_capstyle="butt")


def _label(protocol: Protocol) -> str:
    """Of the variable: with the name of its membrane, and lengths in mm."""
    name = protocol.file.stimulus.variable
    if protocol.in_newtons:
        return f"felt {protocol.quantity}, N"
    if found := re.fullmatch(r"membrane\[(\d+)\]\.(\w+)", name):
        membrane = protocol.stimuli[0].scene.membranes[int(found[1])].name
        name = f"{found[2]} of the {membrane}".replace("$", r"\$")  # else a formula is between two of them
    return name + {"m": ", mm", "": ""}.get(protocol.unit, f", {protocol.unit}")


def _counted(protocol: Protocol) -> str:
    """What the function gives: the share of these answers, or the mean of these points."""
    if protocol.rates or protocol.adjusts:
        return "points" if protocol.rates else "setting"
    return "yes" if protocol.file.task == "yes_no" else '"the comparison"' if protocol.compares else "right answers"


def _row(protocol: Protocol, header: Header, line: Line) -> dict[str, object]:
    lacks = protocol.rates or protocol.adjusts
    felt = list(line.felt)
    mine = felt.pop(line.position)
    row = line.model_dump(include={"trial", "block", "kind", "level", "position", "answer", "time"})
    row |= {
        "participant": header.participant,
        "participant_number": header.number,
        "device": header.device,
        "device_simulated": header.device_simulated if header.device else None,
        "felt_level": felt_level(protocol, line)[0] if protocol.in_newtons else None,
        "counted": None if lacks else bool(counted(protocol, line.position, line.answer)),
        "force_scale": mine.scale,
        "recordings": ";".join(line.recordings),
    }
    row |= {name: getattr(mine, key) for name, key in _OF_FELT.items()}
    for name in ("drop", "peak"):
        row[f"reference_{name}_N"] = float(np.mean([getattr(one, name) for one in felt])) if felt else None
    return row

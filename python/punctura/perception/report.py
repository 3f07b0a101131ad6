"""The report of an experiment: one page, report.md, with a picture of each psychometric function."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from punctura.files.whole_file import private_folder, write_whole
from punctura.perception.analysis import LEVEL, Analysis, Estimate, analyse, answers_of, belief_of
from punctura.perception.protocol import Protocol
from punctura.perception.session import SessionError, check_header, delete_participant, read_session, sessions
from punctura.perception.table import TABLES, save_tables
from punctura.results import JsonObject

MOST_PANELS = 12
COUNTED = {(True, False): "yes", (False, True): "comparison", (False, False): "right"}  # yes_no, compares
WRITTEN = ("report.md", "functions.svg", "results.json", *TABLES)


def write_report(protocol: Protocol, sessions: Mapping[str, Sequence[JsonObject]], folder: Path) -> Analysis:
    """Writes report.md, its picture, results.json and the tables. sessions: lines by pseudonym, the header first."""
    private_folder(folder)
    found = analyse(protocol, {name: lines[1:] for name, lines in sessions.items()})
    save_tables(protocol, sessions, folder)
    write_whole(folder / "results.json", (json.dumps(asdict(found), indent=1) + "\n").encode(), private=True)
    picture = _draw(protocol, found, sessions)
    if picture:
        write_whole(folder / "functions.svg", picture, private=True)
    write_whole(folder / "report.md", _text(protocol, found, bool(picture)).encode(), private=True)
    return found


def report_of_folder(protocol: Protocol, folder: Path) -> Analysis:
    """Analyses all sessions of a folder. Raises SessionError if there is none, or one of another protocol."""
    found = {}
    for path in sessions(folder):
        lines = read_session(path)
        if lines:  # a kill may have left a file without its first line
            check_header(lines[0], protocol, path)
            found[path.stem] = lines
    if not found:
        raise SessionError(f"{folder} has no session; punctura perception run makes one")
    return write_report(protocol, found, folder)


def forget(folder: Path, participant: str) -> list[Path]:
    """Deletes a participant's session, recordings, and all that was computed from them. Raises SessionError."""
    deleted = delete_participant(folder, participant)
    computed = [path for name in WRITTEN if (path := folder / name).exists()]
    for path in computed:
        path.unlink()
    return deleted + computed


def words(one: Estimate | None, digits: int = 3) -> str:
    """The number and its interval."""
    return "-" if one is None else f"{one.value:.{digits}g} ({one.low:.{digits}g} to {one.high:.{digits}g})"


def _text(protocol: Protocol, found: Analysis, drawn: bool) -> str:
    file, unit = protocol.file, found.unit
    keys = {"slope": f"points for each {unit}"}
    if not protocol.rates:
        keys = {"threshold": f"threshold, {unit}", "jnd": f"JND, {unit}", "weber": "Weber fraction", "lapse": "lapses"}
    what = "the felt quantity" if found.felt else "the planned level"
    lines = [
        f"# {file.title}", "", f"*{file.question}*", "",
        f"Scene {file.scene}, {file.method}, {file.task}, variable {file.stimulus.variable} in {unit}, fitted against "
        f"{what}. Intervals are {LEVEL:.0%} intervals. Source of the protocol: {file.source or 'not given'}.", "",
        f"| participant | trials | {' | '.join(keys.values())} | right in each block |",
        f"|---|---|{'---|' * len(keys)}---|",
    ]  # fmt: skip
    for one in found.people:
        blocks = ", ".join("-" if share is None else f"{share:.0%}" for share in one.right_by_block)
        cells = [words(getattr(one, key)) for key in keys]
        if one.reason:
            cells = [one.reason, *[""] * (len(keys) - 1)]
        lines.append(f"| {one.participant} | {one.trials} | {' | '.join(cells)} | {blocks} |")
    if not found.reason:
        means = " | ".join(words(getattr(found, key, None)) for key in keys)
        known = sum(not one.reason for one in found.people)
        lines.append(f"| **mean of {known} of {len(found.people)} people** | | {means} | |")
    lines.append("")
    lines += [f"No mean: {found.reason}.", ""] if found.reason else []
    detected = [(one.participant, each) for one in found.people for each in one.detection]
    if detected:
        lines += [f"## d'\n\n| participant | level, {unit} | trials | d' | criterion |", "|---|---|---|---|---|"]
        for name, each in detected:
            lines.append(
                f"| {name} | {each.level:.4g} | {each.trials} | {words(each.dprime)} | {words(each.criterion)} |"
            )
        lines.append("")
    caught = [one for one in found.people if one.catch_trials]
    if caught:
        what = "yes (false alarms)" if file.task == "yes_no" else "right"
        parts = (f"{one.participant} {one.catch_counted} of {one.catch_trials}" for one in caught)
        lines += [f"Catch trials, {what}: {', '.join(parts)}.", ""]
    return "\n".join(lines + (["![The psychometric functions](functions.svg)", ""] if drawn else []))


def _draw(protocol: Protocol, found: Analysis, sessions: Mapping[str, Sequence[JsonObject]]) -> bytes | None:
    """The first people with a threshold: shares at the levels, the mean function and its 95 % band."""
    from matplotlib.figure import Figure

    from punctura.reproduce.style import figure_style

    people = [one for one in found.people if one.threshold is not None][:MOST_PANELS]
    if not people:
        return None
    across = min(3, len(people))
    down = -(-len(people) // across)
    levels = np.asarray(protocol.levels)
    curve = np.linspace(levels[0], levels[-1], 121)
    with figure_style():
        figure = Figure(figsize=(2.6 * across, 2.3 * down), layout="constrained")
        for number, one in enumerate(people, 1):
            answers = answers_of(protocol, sessions[one.participant][1:])
            belief = belief_of(protocol, answers)
            p = belief.grid.probability(curve)
            mean = p @ belief.weight
            band = np.array([belief.quantiles(row, (0.025, 0.975)) for row in p])
            panel = figure.add_subplot(down, across, number)
            panel.fill_between(curve, band[:, 0], band[:, 1], color="0.85", lw=0)
            panel.plot(curve, mean, color="0.2", lw=1.2)
            for level in np.unique(answers.level):
                here = answers.counted[answers.level == level]
                panel.plot(level, here.mean(), "o", ms=2 + np.sqrt(len(here)) / 2, color="0.2", mfc="none")
            panel.set_ylim(-0.03, 1.03)
            panel.set_title(one.participant)
            panel.set_xlabel(f"{protocol.file.stimulus.variable}, {protocol.unit}")
            panel.set_ylabel(COUNTED[protocol.file.task == "yes_no", protocol.compares])
        data = io.BytesIO()
        figure.savefig(data, format="svg", metadata={"Date": None})
    return data.getvalue()

"""Reads and checks protocol files: all problems at once, each with its place, its value and what is right."""

import os
import re
from collections.abc import Callable, Collection, Iterator
from decimal import Decimal
from functools import cache, partial
from pathlib import Path

from punctura import Scene
from punctura._core import ForceLimits
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.tables import path_of
from punctura.files.toml import Tables, read_tables
from punctura.perception.protocol import ANSWERS, KEYS, ONE_INTERVAL, SCHEMA, Protocol, ProtocolFile, Stimulus
from punctura.perception.stimulus import QUANTITIES, cut_by_limits, simulated, solved
from punctura.perception.words import problems_of
from punctura.ready_protocols import protocol_files
from punctura.study.plan import nearest, scene_of

LEAST = {"constant": 40, "staircase": 40, "quest": 20, "adjustment": 6}  # scored trials for a fit
MOST_TRIALS = 10_000


def protocol_names() -> list[str]:
    """Names of the ready protocols, for load_protocol."""
    return list(protocol_files())


def load_protocol(name_or_path: str | os.PathLike[str]) -> Protocol:
    """Loads a ready protocol by its name, or a file. Raises ConfigurationError with all problems."""
    path = protocol_files().get(str(name_or_path), Path(name_or_path))
    if not path.suffix and not path.exists():
        reason = f"no file and no ready protocol has this name; ready protocols: {', '.join(protocol_names())}"
        raise ConfigurationError([Problem("", MISSING, reason)], str(path))
    tables = read_tables(path, "protocol")
    file, problems = SCHEMA.checked(tables)
    wrong = {problem.path for problem in problems}
    if file is None:
        file, _ = SCHEMA.checked(_sound(tables, wrong))
    scene, found = scene_of(tables, path)
    problems += found
    if file:
        rows, found = list(_paths(file, scene) if scene else ()), list(problems_of(file.words, KEYS))
        found += _answers(file) if "task" not in wrong else ()
        if not wrong & {"method", "task"}:  # without them the others mean nothing
            rows += [*(_trials(file) if "trials" not in wrong else ()), *_intervals(file)]
            if not wrong & {"stimulus", "stimulus.levels", "trials"}:
                rows += [*_amounts(file), *_among_levels(file)]
        found += [Problem(key, _plain(value), reason) for bad, key, value, reason in rows if bad]
        problems += [problem for problem in found if problem.path not in wrong]
    protocol = None
    if file and scene and not any(re.match("stimulus|values|scene", problem.path) for problem in problems):
        protocol = _shown(path, file, scene, problems)
    if protocol is None or problems:
        raise ConfigurationError(problems, str(path))
    return protocol


def _sound(tables: Tables, wrong: Collection[str]) -> Tables:
    """The tables with something else for each wrong key that is needed: the other keys are checked, too."""
    sound = Tables(title="-", question="-", scene="-", method="constant", task="yes_no")
    stimulus = {"variable": "", "levels": [1, 2, 3]}
    sound["stimulus"] = stimulus
    for key, value in tables.items():
        if key in wrong:
            continue
        if isinstance(value, dict):
            kept = {inner: one for inner, one in value.items() if path_of((key, inner)) not in wrong}
            sound[key] = {**stimulus, **kept} if key == "stimulus" else kept
        else:
            sound[key] = value
    return sound


def check_device(protocol: Protocol, limits: ForceLimits) -> None:
    """Raises ConfigurationError with each level that a device with these limits cannot show."""
    asked = [(f"stimulus.levels[{i}]", one) for i, one in enumerate(protocol.stimuli)]
    asked += [("stimulus.reference", one) for one in protocol.references[:1]]
    asked += [("trials.catch_level", protocol.catch)] if protocol.catch else []
    problems = [Problem(key, one.level, reason) for key, one in asked if (reason := cut_by_limits(one.scene, limits))]
    if problems:
        raise ConfigurationError(problems, str(protocol.path))


def _plain(value: object) -> object:
    """As it is written in a message."""
    return float(value) if isinstance(value, Decimal) else [*map(_plain, value)] if isinstance(value, tuple) else value


def _answers(file: ProtocolFile) -> Iterator[Problem]:
    wanted = ANSWERS[file.task]
    if not file.question.strip():
        yield Problem("question", file.question, "must not be empty: it is asked after each trial")
    used: dict[str, str] = {}
    for name, key in file.answers.items():
        if name not in wanted:
            what = ", ".join(wanted) or "a number is typed"
            yield Problem(f"answers.{name}", key, f"is no answer of {file.task}: {what}")
        elif len(key) != 1 or not key.isprintable() or key.isspace():
            yield Problem(f"answers.{name}", key, "must be one key, as a letter or a digit")
        elif key.casefold() in used:
            yield Problem(f"answers.{name}", key, f"is the key of {used[key.casefold()]}, too; give each its own")
        used.setdefault(key.casefold(), name)
    missing = [name for name in wanted if name not in file.answers]
    if file.answers and missing:
        yield Problem(f"answers.{missing[0]}", MISSING, "is missing; give all answers a key, or none")


# The following give rows: whether this is wrong, the key, its value, and what is right.
Row = tuple[bool, str, object, str]


def _count(file: ProtocolFile) -> tuple[str, str]:
    """The key for the number of trials, and the one that other methods have."""
    return ("per_level", "total") if file.method == "constant" else ("total", "per_level")


def _amounts(file: ProtocolFile) -> Iterator[Row]:
    """How many trials there are."""
    key, _ = _count(file)
    count, scored, least, blocks = getattr(file.trials, key), file.scored, LEAST[file.method], file.trials.blocks
    few = f"{scored} trials are too few for the fit" if scored < least else f"are {scored} trials"
    counts = least <= scored <= MOST_TRIALS
    reason = f"{few}: {file.method} needs from {least} to {MOST_TRIALS} without practice and catch"
    yield count is not None and not counts, f"trials.{key}", count, reason
    yield (
        counts and count % blocks > 0,
        "trials.blocks",
        blocks,
        f"must divide {key}, {count}, so that all blocks are alike",
    )


def _trials(file: ProtocolFile) -> Iterator[Row]:
    given, method = file.trials, file.method
    wanted, other = _count(file)
    extra = getattr(given, other)
    yield extra is not None, f"trials.{other}", extra, f"is not for {method}; give {wanted}"
    yield getattr(given, wanted) is None, f"trials.{wanted}", MISSING, f"is missing; {method} needs it"
    adjusts = method == "adjustment", file.task == "adjustment"
    yield adjusts[0] != adjusts[1], "method", method, "and task must both be adjustment, or none of them"
    reason = "and catch are not for adjustment; leave both out"
    yield all(adjusts) and given.practice + given.catch > 0, "trials.practice", given.practice, reason
    key = "catch_level" if given.catch_level is None else "catch"
    reason = "is missing: give both catch and catch_level, or none of them"
    yield (given.catch > 0) != (given.catch_level is not None), f"trials.{key}", MISSING, reason
    kept = given.up / (given.up + given.down)
    guess = 0.0 if file.task == "yes_no" else 1 / max(len(ANSWERS[file.task]), 1)
    reason = f"with down = {given.down} it seeks {kept:.0%} right answers, which guessing gives; give a larger up"
    yield method == "staircase" and kept <= guess, "trials.up", given.up, reason


def _intervals(file: ProtocolFile) -> Iterator[Row]:
    """What the task asks of the method and of the other intervals."""
    given, task, reference = file.stimulus, file.task, file.stimulus.reference
    plain = file.method == "constant" and not file.trials.catch
    reason = "is for constant stimuli without catch trials: change method or catch"
    yield task in ("rating", "magnitude") and not plain, "task", task, reason
    if task in ONE_INTERVAL:
        for key in ("reference", "reference_solver"):
            value = getattr(given, key)
            yield value is not None, f"stimulus.{key}", value, f"is not for {task}, of one interval"
        return
    by_solver = given.reference_solver is not None
    reason = f"{task} needs a reference, a level, or a reference_solver, and not both"
    missing = reference is None
    yield missing != by_solver, "stimulus.reference", MISSING if missing else reference, reason
    catch = file.trials.catch_level
    reason = "is not for reference_solver: the other intervals would have another level; leave catch out"
    yield by_solver and catch is not None, "trials.catch_level", catch, reason


def _among_levels(file: ProtocolFile) -> Iterator[Row]:
    """Where the reference and the level of catch trials lie."""
    task, levels, where = file.task, file.levels, "stimulus.reference"
    reason = "must be more than 0 for magnitude, whose result is an exponent"
    yield task == "magnitude" and min(levels) <= 0, "stimulus.levels", levels, reason
    given = file.stimulus.reference, file.trials.catch_level
    reference, catch = (None if one is None else float(one) for one in given)
    if reference is None or task in ONE_INTERVAL:
        return
    one_sided = not min(levels) < reference < max(levels)
    yield one_sided and task == "adjustment", where, reference, "must lie between the levels for adjustment"
    reason = f"must lie at an end of the levels for {file.method} with {task}, which score right answers"
    right = file.method == "staircase" or task == "three_intervals"
    yield not one_sided and right, where, reference, reason
    reason = "is one of the levels, at which no answer is right; leave it out of levels"
    yield one_sided and reference in levels, where, reference, reason
    if catch is not None:
        reason = "is the reference, at which no answer is right"
        yield catch == reference, "trials.catch_level", catch, reason
        other = one_sided and catch != reference and (catch > reference) != (max(levels) > reference)
        reason = f"must lie on that side of the reference, {reference:g}, where the levels are"
        yield other, "trials.catch_level", catch, reason


def _paths(file: ProtocolFile, scene: Scene) -> Iterator[Row]:
    given, known = file.stimulus, [one.path for one in scene.fields()]
    quantity = given.variable in QUANTITIES
    asked: list[tuple[str, str, object]] = [(path_of(("values", path)), path, v) for path, v in file.values.items()]
    key, path = ("solve", given.solve or "") if quantity else ("variable", given.variable)
    asked.append((f"stimulus.{key}", path, path))
    for key, path, value in asked:
        words = f" or one of {', '.join(QUANTITIES)}" if key == "stimulus.variable" else ""
        yield path not in ("", *known), key, value, f"is not a number of the scene{words}{nearest(path, known)}"
    for key in ("solve", "between"):
        value = getattr(given, key)
        reason = f"is missing; {given.variable} solves a number of the scene"
        yield quantity and value is None, f"stimulus.{key}", MISSING, reason
        yield not quantity and value is not None, f"stimulus.{key}", value, f"is for {' and '.join(QUANTITIES)} alone"
    names = [placed.name for placed in scene.membranes]
    reason = f"must be one of the scene's membranes: {', '.join(names)}"
    yield given.membrane is not None and names.count(given.membrane) != 1, "stimulus.membrane", given.membrane, reason
    reason = "is the variable; leave it out here"
    yield given.variable in file.values, path_of(("values", given.variable)), file.values.get(given.variable), reason


def _shown(path: Path, file: ProtocolFile, scene: Scene, problems: list[Problem]) -> Protocol | None:
    """The protocol with its stimuli; None, and more problems, if no scene can give them."""
    given, levels, before = file.stimulus, file.levels, len(problems)
    names = [placed.name for placed in scene.membranes]
    membrane = 0 if given.membrane is None else names.index(given.membrane)

    def made(key: str, value: object, make: Callable[[], Scene]) -> Scene | None:
        try:
            return make()
        except ConfigurationError as bad:
            reason = "; ".join(problem.reason for problem in bad.problems)
        except ValueError as bad:
            reason = str(bad)
        problems.append(Problem(key, value, reason))
        return None

    if scene.display.force_scale == "automatic":
        reason = 'must not be "automatic", else each level has another scale: give a number in the scene file'
        problems.append(Problem("scene: display.force_scale", scene.display.force_scale, reason))
    values = {key: float(value) for key, value in file.values.items()}
    fixed = made("values", MISSING, partial(scene.with_values, values))
    ends = [float(end) for end in given.between or ()]
    if fixed:
        for end in ends:
            made("stimulus.between", end, partial(fixed.with_values, {str(given.solve): end}))
    if fixed is None or len(problems) > before:
        return None

    @cache
    def stimulus(key: str, level: float, solver: str | None) -> list[Stimulus]:
        base = fixed if solver is None else fixed.replace(servo=fixed.servo.replace(solver=solver))
        make = partial(base.with_values, {given.variable: level})
        if given.variable in QUANTITIES:
            make = partial(solved, base, given.variable, level, str(given.solve), (ends[0], ends[1]), membrane)
        found = made(key, level, make)
        return [Stimulus(level, found, simulated(found, membrane))] if found else []

    def each(solver: str | None) -> list[Stimulus]:
        return [one for i, level in enumerate(levels) for one in stimulus(f"stimulus.levels[{i}]", level, solver)]

    stimuli, references, catch = each(given.solver), list[Stimulus](), None
    if given.reference is not None:
        references = stimulus("stimulus.reference", float(given.reference), given.solver) * len(levels)
    elif given.reference_solver is not None:
        references = each(given.reference_solver)
    if file.trials.catch_level is not None:
        catch = next(iter(stimulus("trials.catch_level", float(file.trials.catch_level), given.solver)), None)
    if len(problems) > before:
        return None
    unit = next((one.unit.strip("-") for one in scene.fields() if one.path == given.variable), "N")
    protocol = Protocol(path, file, tuple(stimuli), tuple(references), catch, membrane, unit)
    if not any(protocol.difference(i) > 0 for i in range(len(levels))):
        reason = f"no level changes the {given.judged} that is judged; choose another variable or judged"
        problems.append(Problem("stimulus.levels", levels, reason))
    if catch and file.task == "yes_no":
        most, least = protocol.judged(catch), min(map(protocol.judged, stimuli))
        if most > least:
            reason = f"must lack what is asked for: its {given.judged} is {most:.3g}, that of a level {least:.3g}"
            problems.append(Problem("trials.catch_level", catch.level, reason))
    return protocol

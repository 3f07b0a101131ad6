"""Looks at a trace file or identifies it, in a process of its own at low priority, for the studio.

`python -m punctura.studio.trace_worker` reads one job as JSON from standard input and writes the lines of
wire/identified.py.
"""

import math
import re
import sys
import warnings
from collections.abc import Callable
from contextlib import suppress
from typing import Literal

from punctura import ConfigurationError, Needle, PuncturaError
from punctura.compare.background import step_back
from punctura.defects import PATIENCE_S, explain
from punctura.identify import Identification, identify
from punctura.rivals import compare_trace
from punctura.studio.trace_lines import file_line, fit_line, rivals_line, trace_line
from punctura.studio.wire.identified import ErrorLine, IdentifyLine, ReportLine, RivalsLine, StepLine, TraceJob
from punctura.trace import Trace, read_trace
from punctura.trace.columns import ColumnError
from punctura.trace.look import look_at

MOST_MEMBRANES = 12
_OPTION = re.compile(r" \(--[^)]*\)")  # a hint for the command line
Send = Callable[[IdentifyLine], None]


class FieldError(ValueError):
    """A value that the page must ask for again."""

    def __init__(self, field: str, text: str) -> None:
        super().__init__(text)
        self.field = field


def do(job: TraceJob, send: Send) -> None:
    """Does a job. Raises FieldError, TraceError, OSError, ModuleNotFoundError."""
    if job.task == "look":
        send(file_line(job.file, look_at(job.file)))
        with suppress(PuncturaError):  # then the page must ask first
            send(trace_line(read_trace(job.file)))
        return
    if job.order not in ("recorded", "depth"):
        raise FieldError("order", "the order is recorded or depth")
    needle, membranes = _needle(job), _membranes(job.membranes)
    read = read_trace(job.file, job.columns, job.units, order="depth" if job.order == "depth" else "recorded")
    send(trace_line(read))
    _refuse_severe(read)
    found = identify(read, needle, membranes, lambda words: send(StepLine(words=words, share=None)))
    send(fit_line(found))
    _compare(found, send)
    _report(found, send)


def _needle(job: TraceJob) -> Needle:
    diameter = _number("diameter_mm", job.diameter_mm)
    angle = _number("tip_angle_deg", job.tip_angle_deg)
    try:
        return Needle(diameter * 1e-3, math.radians(angle))
    except ConfigurationError as error:
        of_angle = any("angle" in problem.path for problem in error.problems)
        reasons = "; ".join(problem.reason for problem in error.problems)
        raise FieldError("tip_angle_deg" if of_angle else "diameter_mm", reasons) from None


def _number(field: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise FieldError(field, "must be a number")
    return value


def _membranes(text: str) -> int | Literal["auto"]:
    if text == "auto":
        return "auto"
    if not re.fullmatch("[0-9]{1,2}", text) or not 1 <= int(text) <= MOST_MEMBRANES:
        raise FieldError("membranes", f"must be a number from 1 to {MOST_MEMBRANES}, or auto")
    return int(text)


def _refuse_severe(trace: Trace) -> None:
    for finding in trace.findings:
        if finding.severe:
            role = "depth" if "depth" in finding.text else "force"
            raise FieldError(f"column.{role}" if finding.kind == "constant" else "", str(finding))


def _compare(found: Identification, send: Send) -> None:
    """The other models, as an addition: without them, the fit is still a result."""

    def progress(share: float) -> None:
        send(StepLine(words="other models", share=share))

    needle = found.parameters.needle
    try:
        compared = compare_trace(found.trace, needle=needle, identified=found, progress=progress)
        send(rivals_line(compared, found))
    except PuncturaError as error:
        send(RivalsLine(rows=[], notes=[words_of(f"the other models could not be fitted: {error}")]))


def _report(found: Identification, send: Send) -> None:
    send(StepLine(words="report", share=None))
    from punctura.identify.report import report_html  # matplotlib takes long to import

    send(ReportLine(html=report_html(found).decode()))


def words_of(text: str, file: str = "") -> str:
    """A message as a sentence, without hints for the command line and without the name of the file at its start."""
    sentence = _OPTION.sub("", text).removeprefix(f"{file}: ").strip()
    return sentence[:1].upper() + sentence[1:] + ("" if sentence.endswith((".", "!", "?")) else ".")


def main() -> None:
    """Does the job on standard input."""
    step_back()
    warnings.simplefilter("ignore")  # of the libraries that read files; what matters is in the findings

    def send(line: IdentifyLine) -> None:
        print(line.model_dump_json(), flush=True)

    def fail(error: Exception, field: str = "") -> None:
        send(ErrorLine(text=words_of(explain(error, PATIENCE_S), job.file), field=field))

    job = TraceJob.model_validate_json(sys.stdin.read())
    try:
        do(job, send)
    except FieldError as error:
        fail(error, error.field)
    except ColumnError as error:
        fail(error, error.field)
    except Exception as error:
        fail(error, "file" if job.task == "look" else "")


if __name__ == "__main__":
    main()

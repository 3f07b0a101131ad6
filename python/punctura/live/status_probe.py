"""Asks the packages of devices for their status, each in a process of its own.

So a status() that hangs, prints, or ends its process does not disturb the caller, and is not left in a run.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

STATUS_S = 10.0  # for the import of all packages and their status(), which may search a bus

# The answer goes to the standard output of the process. What the package prints there goes to standard error.
_PROGRAM = """
import json, os, sys
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)
name, value, group, sys.path[:] = json.loads(sys.argv[1])
from importlib.metadata import EntryPoint
MOST = 2000  # characters of a text
try:
    package = EntryPoint(name, value, group).load()
    status = package.status()
    if not callable(getattr(package, "open", None)):
        status = {"error": "it has no function open(rate, device)"}
    elif isinstance(status, dict) and not isinstance(status.get("detail", ""), str):
        status = {"error": "detail of status() must be a text"}
    elif isinstance(status, dict):
        devices = status.get("devices", [])
        status = {"state": status.get("state"), "detail": status.get("detail", "")[:MOST],
                "devices": devices if isinstance(devices, str) else [str(device)[:MOST] for device in devices]}
    else:
        status = {"returned": repr(status)[:MOST]}
    answer = json.dumps(status)
except BaseException as error:  # also SystemExit and CancelledError
    try:
        answer = json.dumps({"error": f"{type(error).__name__}: {error}"})
    except BaseException:  # its __str__ raises
        answer = json.dumps({"error": type(error).__name__})
answers.write(answer)
answers.close()
try:
    sys.stdout.flush()
finally:
    os._exit(0)  # threads of the package do not hold up the end
"""


def probe(packages: Sequence[EntryPoint]) -> list[dict[str, object]]:
    """What each status() returned: its keys, `returned` if that is no dict, or `error`.

    All are asked at the same time, for STATUS_S at most.
    """
    with contextlib.ExitStack() as stack:
        asked = [stack.enter_context(_process(package)) for package in packages]
        ends_at = time.monotonic() + STATUS_S
        return [_answer(process, ends_at) for process in asked]


@contextlib.contextmanager
def _process(package: EntryPoint) -> Iterator[subprocess.Popen[bytes]]:
    """The process that asks a package. It ends with the block at the latest."""
    query = json.dumps([package.name, package.value, package.group, [str(folder) for folder in sys.path]])
    process = subprocess.Popen(
        [sys.executable, "-c", _PROGRAM, query],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            with contextlib.suppress(OSError):
                if os.name == "posix":
                    os.killpg(process.pid, signal.SIGKILL)  # also what status() has started
                else:
                    process.kill()
        if process.stdout:
            process.stdout.close()
        process.wait()


def _answer(process: subprocess.Popen[bytes], ends_at: float) -> dict[str, object]:
    try:
        output, _ = process.communicate(timeout=max(0.0, ends_at - time.monotonic()))
    except subprocess.TimeoutExpired:
        return {"error": f"no answer from status() within {STATUS_S:g} s"}
    try:
        answer = json.loads(output)
    except ValueError:
        return {"error": f"status() ended its process, with status {process.returncode}"}
    return answer if isinstance(answer, dict) else {"error": f"status() answered {answer!r}"}

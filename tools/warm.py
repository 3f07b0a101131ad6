"""`punctura` that starts in a moment: a process that has imported it makes a copy of itself for each command.

    python warm.py SOCKET                 that process
    python -S -E warm.py SOCKET WORD...   `punctura WORD...` in a copy, which ends at the latest with this program

The tests of the page and of the documentation start some hundred commands; to import their packages takes a second.
"""

import atexit
import gc
import importlib
import json
import os
import select
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

PROGRAM = str(Path(__file__).resolve())


@contextmanager
def warm(folder: Path, *options: str) -> Iterator[tuple[str, ...]]:
    """A command that is `punctura`, as long as the context lasts. options: of the interpreter."""
    path = str(folder / "warm")
    command, pipe = [sys.executable, PROGRAM, path, *options], subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe) as process:
        try:
            assert process.stdout and process.stdout.readline() == b"ready\n"
            yield sys.executable, "-S", "-E", PROGRAM, path
        finally:
            process.terminate()


def ask(path: str, words: list[str]) -> int:
    """Runs the command in a copy, with this program's files, folder and environment. Returns its exit status."""
    with socket.socket(socket.AF_UNIX) as connection:
        connection.connect(path)
        order = json.dumps([words, os.getcwd(), dict(os.environ)]).encode()
        socket.send_fds(connection, [len(order).to_bytes(4, "big")], [0, 1, 2])
        connection.sendall(order)
        pid = int(connection.recv(20))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, lambda number, _: os.kill(pid, number))
        return int(connection.recv(20) or 1)


def serve(path: str) -> None:
    """Returns in each copy, ready to run `punctura`."""
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(path)
        listener.listen(100)
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody waits for the guards
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a script's background ignores it
        print("ready", flush=True)
        while True:
            if sys.stdin in select.select([listener, sys.stdin], [], [])[0]:
                sys.exit()  # the tests have gone
            connection, _ = listener.accept()
            if os.fork() == 0:
                break
            connection.close()
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    size, files, _, _ = socket.recv_fds(connection, 4, 3)
    words, folder, environment = json.loads(connection.recv(int.from_bytes(size, "big"), socket.MSG_WAITALL))
    pid = os.fork()
    if pid:
        guard(connection, pid)
    connection.close()
    for number, file in enumerate(files):
        os.dup2(file, number)
        os.close(file)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = ["punctura", *words]


def guard(connection: socket.socket, pid: int) -> None:
    """Waits for a copy, and ends it if the program that asked for it has ended."""

    def watch() -> None:
        with suppress(OSError):
            if not connection.recv(1):
                os.kill(pid, signal.SIGKILL)

    connection.send(str(pid).encode())
    threading.Thread(target=watch, daemon=True).start()
    status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    with suppress(OSError):  # it has gone
        connection.send(str(status if status >= 0 else 128 - status).encode())
    os._exit(0)


PACKAGES = ("matplotlib.pyplot", "scipy.stats", "punctura.identify", "punctura.study", "punctura.studio.serve")


def main(path: str, *options: str) -> None:
    os.environ["MPLBACKEND"] = "agg"
    for package in PACKAGES:
        importlib.import_module(package)
    from punctura.cli import main as punctura
    from punctura.studio import session

    if "seldom" in options:
        # Ticks go to the pages 12 times a second and not 60: a browser that draws in software has more time for the
        # tests then. No tick is left out.
        session.PUMP_S = 1 / 12
    gc.freeze()  # a copy does not look at what all have
    serve(path)
    status = 1
    try:
        punctura()
        status = 0
    except SystemExit as end:
        status = int(end.code or 0)
    except BaseException:
        sys.excepthook(*sys.exc_info())
    finally:  # without taking the interpreter apart, which would copy all that it has
        threading._shutdown()
        atexit._run_exitfuncs()
        sys.stdout.flush()
        os._exit(status)


if __name__ == "__main__":
    if sys.flags.no_site:
        sys.exit(ask(sys.argv[1], sys.argv[2:]))
    main(*sys.argv[1:])

"""A copy of a warm process reacts as `punctura` in a terminal does."""

import signal
import subprocess

from warm import warm


def test_a_copy_is_interrupted_also_where_the_tests_run_in_the_background(tmp_path):
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # so a script starts what it runs in the background
    try:
        with warm(tmp_path) as program:
            command = [*program, "run", "k06-fig10", "--headless", "--device", "simulated"]
            with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as running:
                assert running.stderr is not None
                while "Ctrl-C ends it" not in running.stderr.readline():
                    assert running.poll() is None
                running.send_signal(signal.SIGINT)
                try:
                    assert running.wait(60) == 130
                finally:
                    running.kill()
    finally:
        signal.signal(signal.SIGINT, before)

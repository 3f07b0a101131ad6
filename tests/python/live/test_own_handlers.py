"""If the caller installs a signal handler during a run, that handler gets the signal, and the run continues."""

import signal

import punctura as pn
import pytest
from punctura.live import SimulatedDevice, run_live
from punctura.process.signals import Signals, ends_on_signals
from punctura.simulation import Target

SCENE = pn.load_scene("k06-fig10")


@pytest.fixture
def calls():
    """Of a handler for SIGTERM, which `install` installs."""
    before, numbers = signal.getsignal(signal.SIGTERM), []
    yield numbers
    signal.signal(signal.SIGTERM, before)


def install(calls):
    def handle(number, _frame):
        calls.append(number)
        if len(calls) > 20 and Signals._innermost:
            Signals._innermost.number = number  # it is sent without end: let the test fail instead of hang

    signal.signal(signal.SIGTERM, handle)


def test_a_run_goes_on_to_its_end_when_the_caller_takes_a_signal_for_itself(calls):
    ended = []

    def prepare(_loop):
        install(calls)
        signal.raise_signal(signal.SIGTERM)
        return lambda: ended.append("finished")

    run_live(SimulatedDevice(Target([0, 5e-3, 0])), SCENE, 0.2, prepare=prepare)
    assert calls == [signal.SIGTERM] and ended == ["finished"]


def test_a_signal_is_not_sent_to_a_handler_that_the_caller_has_installed_after_it_came(calls, monkeypatch):
    monkeypatch.setattr("punctura.process.signals.RETRY_S", 1e-3)
    with ends_on_signals() as signals:
        signal.set_wakeup_fd(-1)
        # As the system does, just before Python's handler runs
        signals._wake_socket._sender.send(bytes([signal.SIGTERM]))
        assert signals.wait(1.0)
        install(calls)
        signals.resend()
        assert calls == []


def test_a_main_thread_that_takes_no_signal_is_not_waited_for_without_end(monkeypatch):
    sent = []

    def kill(_thread, number):
        sent.append(number)
        assert len(sent) < 1000

    monkeypatch.setattr("punctura.process.signals.RETRY_S", 0.0)
    monkeypatch.setattr("punctura.process.signals.signal.pthread_kill", kill)
    with ends_on_signals() as signals:
        signals._wake_socket._sender.send(bytes([signal.SIGTERM]))
        assert signals.wait(1.0)
        signals.resend()
    assert sent == [signal.SIGTERM] * 100

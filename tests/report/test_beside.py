"""Work done by a second process: its result and its errors are those of work done here, whatever becomes of it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
from typing import Any

import pytest

from rodwell.report.folders.beside import beside


def number_of_process(add: int) -> tuple[int, int]:
    return os.getpid(), add + 1


def test_result_comes_from_the_second_process() -> None:
    with beside(lambda: number_of_process) as start:
        process, answer = start(41)()
    assert answer == 42
    forks = sys.platform == "linux" and (os.cpu_count() or 1) > 1 and threading.active_count() == 1
    assert (process != os.getpid()) == forks


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_what_it_raises_is_raised_here(error: BaseException) -> None:
    def fails() -> None:
        raise error

    with pytest.raises(type(error)), beside(lambda: fails) as start:
        start()()


def test_a_second_process_that_is_lost_is_made_up_for() -> None:
    here = os.getpid()

    def lost() -> str:
        if os.getpid() != here:
            os.kill(os.getpid(), signal.SIGKILL)
        return "done here"

    with beside(lambda: lost) as start:
        assert start()() == "done here"


def test_results_go_to_those_who_asked_whoever_waits_first() -> None:
    with beside(lambda: number_of_process) as start:
        first, second, third = start(1), start(10), start(100)
        assert [third()[1], first()[1], second()[1], first()[1]] == [101, 2, 11, 2]


def test_an_error_ends_its_own_work_only() -> None:
    with beside(lambda: lambda number: 1 // number) as start:
        fails, works = start(0), start(1)
        assert works() == 1
        with pytest.raises(ZeroDivisionError):
            fails()


def test_more_than_a_pipe_holds_is_sent_before_it_is_ready() -> None:
    go = threading.Event()  # never set in the copy
    many = list(range(200_000))

    def slowly() -> Any:
        go.wait(0.2)
        return sum

    with beside(slowly) as start:
        assert start(many)() == sum(many)


def test_what_cannot_be_sent_is_worked_on_here() -> None:
    with beside(lambda: lambda function: (os.getpid(), function(1))) as start:
        assert start(lambda number: number + 1)() == (os.getpid(), 2)


def test_nothing_is_left_where_no_work_comes() -> None:
    with beside(lambda: number_of_process):
        pass
    assert multiprocessing.active_children() == []


def test_the_second_process_may_start_a_third() -> None:
    def halves(add: int) -> list[tuple[int, int]]:
        with beside(lambda: number_of_process) as start:
            other = start(add)
            return [number_of_process(add), other()]

    with beside(lambda: halves) as start:
        processes, answers = zip(*start(41)(), strict=True)
    assert answers == (42, 42)
    if sys.platform == "linux" and (os.cpu_count() or 1) > 1 and threading.active_count() == 1:
        assert len({*processes, os.getpid()}) == 3
    assert multiprocessing.active_children() == []


def test_with_threads_it_is_done_here() -> None:
    wait = threading.Event()
    thread = threading.Thread(target=wait.wait)
    thread.start()
    try:
        with beside(lambda: number_of_process) as start:
            assert start(1)() == (os.getpid(), 2)
    finally:
        wait.set()
        thread.join()


def test_a_signal_at_the_fork_does_not_unwind_the_stack_of_its_parent_in_the_copy() -> None:
    """The parent's handler raises; the copy, which inherits it, must not come out of the block that made it."""
    program = """
import os, signal, sys
from rodwell.report.folders.beside import beside
first = os.getpid()
def raised(*_): raise KeyboardInterrupt
signal.signal(signal.SIGTERM, raised)
os.register_at_fork(after_in_child=lambda: os.kill(os.getpid(), signal.SIGTERM))
try:
    with beside(lambda: abs) as start:
        start(-1)()
except KeyboardInterrupt:
    pass
print("out", os.getpid() == first)
"""
    done = subprocess.run([sys.executable, "-c", program], check=False, capture_output=True, text=True, timeout=120)
    assert done.stdout.split("\n") == ["out True", ""]
    assert done.stderr == ""


def test_a_second_process_that_heeds_no_signal_keeps_nobody_waiting() -> None:
    """SIGTERM that comes right after the fork meets the handlers of the first process, and may be lost."""

    def deaf() -> Any:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        return number_of_process

    with beside(deaf):
        pass
    assert multiprocessing.active_children() == []

"""Work done by a second process: its result and its errors are those of work done here, whatever becomes of it."""

from __future__ import annotations

import os
import signal
import sys
import threading

import pytest

from rodwell.report.folders.beside import done_beside


def number_of_process(add: int) -> tuple[int, int]:
    return os.getpid(), add + 1


def test_result_comes_from_the_second_process() -> None:
    with done_beside(number_of_process, 41) as result:
        process, answer = result()
    assert answer == 42
    forks = sys.platform == "linux" and (os.cpu_count() or 1) > 1 and threading.active_count() == 1
    assert (process != os.getpid()) == forks


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_what_it_raises_is_raised_here(error: BaseException) -> None:
    def fails() -> None:
        raise error

    with pytest.raises(type(error)), done_beside(fails) as result:
        result()


def test_a_second_process_that_is_lost_is_made_up_for() -> None:
    here = os.getpid()

    def lost() -> str:
        if os.getpid() != here:
            os.kill(os.getpid(), signal.SIGKILL)
        return "done here"

    with done_beside(lost) as result:
        assert result() == "done here"


def test_with_threads_it_is_done_here() -> None:
    wait = threading.Event()
    thread = threading.Thread(target=wait.wait)
    thread.start()
    try:
        with done_beside(number_of_process, 1) as result:
            assert result() == (os.getpid(), 2)
    finally:
        wait.set()
        thread.join()

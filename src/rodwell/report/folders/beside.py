"""Drawn drawn by a second process while this one computes and writes data: half the wait with two processors."""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Any

from rodwell.analysis.branch.branch import states_to_lift_off

if TYPE_CHECKING:
    from rodwell.analysis.branch.solution import Solution
    from rodwell.answers.result.answer import Answer

Work = Callable[..., Any]
Start = Callable[..., Callable[[], Any]]
"""Starts the work with its arguments, and returns what waits for its result. Work that is started while other work goes
on is done after it."""

GRACE = 1.0
"""How long the second process has to end by itself, in seconds."""

ENDING = {signal.SIGTERM, signal.SIGINT}
"""Signals that the first process turns into exceptions, which in its copy would unwind the same stack once more."""

CASE, BEYOND = "case", "beyond"
"""What is drawn."""


@contextmanager
def beside(ready: Callable[[], Work]) -> Iterator[Start]:
    """Start a second process for work whose arguments are known later; it calls ``ready``, which returns the work.

    So it can import what the work needs while the arguments are computed here. It is a copy of this process (a fork),
    and starts in milliseconds. Where that cannot be (another system than Linux, one processor, threads, which a copy
    would not have, arguments that cannot be sent) the work is done here when its result is asked for. What it raises
    is raised here. If the second process is lost, the work is done here too.
    """
    if sys.platform != "linux" or (os.cpu_count() or 1) < 2 or threading.active_count() > 1:
        yield lambda *arguments: lambda: ready()(*arguments)
        return
    for stream in (sys.stdout, sys.stderr):
        stream.flush()  # the copy would write again what still waits
    context = get_context("fork")
    # arguments go by a file in memory: a pipe would keep this process until the other one is ready to read
    with os.fdopen(os.memfd_create("arguments"), "w+b") as file:
        here, there = context.Pipe()
        process = context.Process(target=_serve, args=(ready, here, there, file.fileno()))
        with warnings.catch_warnings(), _held_back():
            warnings.simplefilter("ignore", DeprecationWarning)  # of forks with threads of compiled libraries
            process.start()
        there.close()
        results = _Results(here)

        def start(*arguments: Any) -> Callable[[], Any]:
            try:
                sent = pickle.dumps(arguments, pickle.HIGHEST_PROTOCOL)
            except (pickle.PicklingError, AttributeError, TypeError):  # a function of somebody's own in it
                return lambda: ready()(*arguments)
            place = file.tell()
            file.write(sent)
            file.flush()
            with suppress(OSError):  # it is lost, as will be seen
                here.send((place, len(sent)))
            number = results.expected()
            return lambda: results.received(number, lambda: ready()(*arguments))

        try:
            yield start
        finally:
            here.close()  # where it waits for work, it ends: a signal may have come before it could be heeded
            process.terminate()
            process.join(GRACE)
            if process.is_alive():
                process.kill()
                process.join()


class Drawing:
    """Draws the pictures of an answer in a second process; what is computed for them stays in this one.

    The states that they show take kernels, and here these have been read from the disk.
    """

    def __init__(self, start: Start) -> None:
        self._start = start
        self._case: Callable[[], Any] | None = None

    def case(self, answer: Answer) -> Callable[[], Any]:
        """Draw what is on the wall, once: returns what waits for the pictures."""
        if self._case is None:
            self._case = self._start(CASE, answer, states_to_lift_off(answer.first))
        return self._case

    def beyond(self, answer: Answer) -> Callable[[], Any]:
        """Draw what happens beyond lift-off, which has been followed."""
        return self._start(BEYOND, answer.case, answer.beyond)


@contextmanager
def drawing_beside() -> Iterator[Drawing]:
    """Start a second process that draws the pictures of an answer, known later."""
    with beside(drawing) as start:
        yield Drawing(start)


def drawing() -> Work:
    """Ready to draw pictures, those of a case half in a third process: what that needs is imported."""
    from rodwell.report.folders.pictures import draw_beyond, draw_branches, draw_rod  # noqa: PLC0415 - Matplotlib

    def draw_case(answer: Answer, states: list[Solution]) -> dict[str, dict[str, bytes]]:
        with beside(lambda: draw_rod) as start:
            others = start(answer)
            return {**draw_branches(answer, states), **others()}

    works: dict[str, Work] = {CASE: draw_case, BEYOND: draw_beyond}
    return lambda which, *arguments: works[which](*arguments)


class _Results:
    """What comes back through a pipe, in the order in which it was asked for, whichever is wanted first."""

    def __init__(self, pipe: Connection) -> None:
        self._pipe = pipe
        self._asked = 0
        self._come: list[tuple[bool, Any] | None] = []

    def expected(self) -> int:
        """The number of one more result."""
        self._asked += 1
        return self._asked - 1

    def received(self, number: int, otherwise: Callable[[], Any]) -> Any:
        """Wait for a result, and return it or raise what the work raised; ``otherwise`` where the process was lost."""
        while len(self._come) <= number:
            try:
                self._come.append(self._pipe.recv())
            except (EOFError, OSError):  # it was ended from outside
                self._come.append(None)
        come = self._come[number]
        if come is None:
            return otherwise()
        well, out = come
        if not well:
            raise out
        return out


@contextmanager
def _held_back() -> Iterator[None]:
    """Keep signals that end a program waiting: a copy made meanwhile lets them in when it has handlers of its own."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(ready: Callable[[], Work], here: Connection, there: Connection, file: int) -> None:
    """In the second process: get ready, and as long as work comes do it, and send its result or what it raised."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the first process ends this one
    signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDING)
    here.close()  # so that the end of the first process can be told
    try:
        work = ready()
    except BaseException as error:
        work = partial(_raised, error)
    while True:
        try:
            place, size = there.recv()
        except EOFError:  # nothing more to do
            return
        try:
            out = (True, work(*pickle.loads(os.pread(file, size, place))))
        except BaseException as error:
            out = (False, error)
        try:
            there.send(out)
        except OSError:  # the first process has ended
            return


def _raised(error: BaseException, *_: Any) -> Any:
    raise error

"""Pictures drawn by a second process while this one computes and writes data: half the wait with two processors."""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import IO, TYPE_CHECKING, Any

from rodwell.analysis.branch.branch import states_to_lift_off

if TYPE_CHECKING:
    from rodwell.analysis.branch.solution import Solution
    from rodwell.answers.result.answer import Answer

Work = Callable[..., Any]
Start = Callable[..., Callable[[], Any]]
"""Starts the work with its arguments, and returns what waits for its result."""

GRACE = 1.0
"""How long the second process has to end by itself, in seconds."""


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
        process = context.Process(target=_serve, args=(ready, here, there, file))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of forks with threads of compiled libraries
            process.start()
        there.close()

        def start(*arguments: Any) -> Callable[[], Any]:
            try:
                sent = pickle.dumps(arguments, pickle.HIGHEST_PROTOCOL)
            except (pickle.PicklingError, AttributeError, TypeError):  # a function of somebody's own in it
                return lambda: ready()(*arguments)
            file.write(sent)
            file.flush()
            with suppress(OSError):  # it is lost, as will be seen
                here.send(True)
            return lambda: _received(here, ready, arguments)

        try:
            yield start
        finally:
            here.close()  # where it waits for work, it ends: a signal may have come before it could be heeded
            process.terminate()
            process.join(GRACE)
            if process.is_alive():
                process.kill()
                process.join()


@contextmanager
def drawing_beside() -> Iterator[Callable[[Answer], Callable[[], Any]]]:
    """Start a second process that draws the pictures of an answer, known later; what is computed for them stays here.

    The states that they show take kernels, and here these have been read from the disk.
    """
    with beside(drawing) as start:
        yield lambda answer: start(answer, states_to_lift_off(answer.first))


def drawing() -> Work:
    """Ready to draw the pictures of a case, half of them in a third process: what that needs is imported."""
    from rodwell.report.folders.pictures import draw_branches, draw_rod  # noqa: PLC0415 - imports Matplotlib

    def draw(answer: Answer, states: list[Solution]) -> dict[str, dict[str, bytes]]:
        with beside(lambda: draw_rod) as start:
            others = start(answer)
            return {**draw_branches(answer, states), **others()}

    return draw


def _serve(ready: Callable[[], Work], here: Connection, there: Connection, file: IO[bytes]) -> None:
    """In the second process: get ready, wait for the arguments, do the work, send its result or what it raised."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the first process ends this one
    here.close()  # so that the end of the first process can be told
    try:
        work = ready()
        there.recv()
        file.seek(0)
        out = (True, work(*pickle.load(file)))
    except EOFError:  # nothing to do
        return
    except BaseException as error:
        out = (False, error)
    with suppress(OSError):  # the first process has ended
        there.send(out)


def _received(pipe: Connection, ready: Callable[[], Work], arguments: tuple[Any, ...]) -> Any:
    try:
        well, out = pipe.recv()
    except EOFError:  # it was ended from outside
        return ready()(*arguments)
    if not well:
        raise out
    return out

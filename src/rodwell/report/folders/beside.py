"""Pictures drawn by a second process while this one writes data: half the wait where there are two processors."""

from __future__ import annotations

import os
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any


@contextmanager
def done_beside(work: Callable[..., Any], *arguments: Any) -> Iterator[Callable[[], Any]]:
    """Do ``work`` in a second process meanwhile; what is given back waits for its result.

    The second process is a copy of this one (a fork), so nothing is sent to it, and it starts in milliseconds. Where
    that cannot be (another system than Linux, one processor, threads, which a copy would not have) the work is done
    here when its result is asked for. What it raises is raised here. If the second process is lost, the work is done
    here too.
    """
    if sys.platform != "linux" or (os.cpu_count() or 1) < 2 or threading.active_count() > 1:
        yield lambda: work(*arguments)
        return
    for stream in (sys.stdout, sys.stderr):
        stream.flush()  # the copy would write again what still waits
    context = get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_send, args=(there, work, *arguments), daemon=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of forks in a process with threads of compiled libraries
        process.start()
    there.close()
    try:
        yield lambda: _received(here, work, arguments)
    finally:
        process.terminate()
        process.join()
        here.close()


def _send(pipe: Connection, work: Callable[..., Any], *arguments: Any) -> None:
    """Do the work, and send its result or what it raised."""
    try:
        out = (True, work(*arguments))
    except BaseException as error:
        out = (False, error)
    pipe.send(out)


def _received(pipe: Connection, work: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    try:
        well, out = pipe.recv()
    except EOFError:  # it was ended from outside
        return work(*arguments)
    if not well:
        raise out
    return out

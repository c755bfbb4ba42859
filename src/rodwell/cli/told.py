"""An answer is not lost where its files cannot be written: it is told before the error is."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rodwell.errors import RodwellError

Tell = Callable[[bool], None]
"""Prints an answer; called with whether its files are there."""


@contextmanager
def told() -> Iterator[Callable[[Tell], None]]:
    """Compute an answer in the block, hand over what prints it, and write its files: it is printed at the end.

    What is yielded takes the function that prints, once there is an answer. Where writing fails (a full disk, a folder
    that is gone) the answer is printed all the same, without saying where files are, and the error goes on. Nothing is
    printed before there is an answer.
    """
    ready: list[Tell] = []
    try:
        yield ready.append
    except (RodwellError, OSError, MemoryError):
        for tell in ready:
            tell(False)
        raise
    for tell in ready:
        tell(True)

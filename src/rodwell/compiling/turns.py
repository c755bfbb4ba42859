"""Processes that start at a time do not all compile the same kernel: one does, the others wait for its machine code.

A kernel takes seconds to compile and milliseconds to read. Who compiles one holds a lock on a file beside its place on
disk, which the system lets go with the process. Waiting is a courtesy and never needed: where there are no locks, or
the other takes too long, a kernel is compiled twice and the results are the same.
"""

from __future__ import annotations

import os
import sys
import time
from contextlib import suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl

LONGEST_WAIT = 120.0
"""Seconds for which a process waits for another one: several times what the largest kernel takes on a busy machine."""

PAUSE = 0.02
"""Seconds between two looks at the lock."""

_held: dict[Path, int] = {}


def take(path: Path) -> bool:
    """Take the turn to compile what will lie at ``path``; True if another process had it: look there once more."""
    if sys.platform == "win32" or path in _held:
        return False
    waited = False
    until = time.monotonic() + LONGEST_WAIT
    while time.monotonic() < until:
        try:
            lock = os.open(_lock_of(path), os.O_CREAT | os.O_RDWR, 0o666)
        except OSError:  # the folder is not there yet, or cannot be written
            return waited
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(lock)
            waited = True
            time.sleep(PAUSE)
        else:
            _held[path] = lock
            break
    return waited


def give_back(path: Path) -> None:
    """Let others have the turn, if this process has it."""
    if (lock := _held.pop(path, None)) is not None:
        # Whoever has just opened this file locks one that nobody else sees: it finds the machine code all the same.
        with suppress(OSError):
            _lock_of(path).unlink(missing_ok=True)
        os.close(lock)


def _lock_of(path: Path) -> Path:
    return path.with_name(f"{path.name}.turn")

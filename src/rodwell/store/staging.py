"""Hidden folders in which results wait until they are whole, and what becomes of those that a killed run left behind.

A hidden folder ``.rodwell-NAME-xxxx`` holds ``new``, the results; ``lock``, which says where they are to go and is
locked while its run lives; and, from the moment when results are put in place, ``plan.json``, which says how. The
operating system frees the lock when a run ends in whatever way, so that a folder whose lock can be had is nobody's.
Where it has no such locks (Windows), folders that were left behind stay.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import IO, Any

if sys.platform != "win32":
    import fcntl

PREFIX = ".rodwell-"
LOCK, NEW, OLD, PLAN = "lock", "new", "old", "plan.json"
PART = f"{LOCK}.part"
"""Name of the lock before it is locked."""

LONGEST_NAME = 40
"""Characters of the target's name in that of its hidden folder."""

LEVELS = 4
"""Folders, from the target up, in which something may have been left behind."""

LONGEST_WAIT = 10.0
"""Seconds for which a run waits for others that put results in place."""

DAY = 86400.0
"""Seconds after which a hidden folder in which nothing was begun, and nothing is, counts as left behind."""


@contextmanager
def staged(target: Path, home: Path, undisturbed: Callable[[], AbstractContextManager[None]]) -> Iterator[Path]:
    """Yield an empty folder ``new`` in a hidden folder of ``home``, for the results that are to become ``target``.

    The hidden folder is removed in the end, ``undisturbed``, and so are those of killed runs to the same target.
    """
    finish_leftovers(target)
    place = Path(tempfile.mkdtemp(prefix=_prefix(target), dir=home))
    lock = None
    try:
        lock = _owned(place, target)
        (place / NEW).mkdir()
        yield place / NEW
    finally:
        with undisturbed():
            with one_at_a_time(target):
                _finish(place, target)
            _remove(place)
            if lock is not None:
                lock.close()


@contextmanager
def one_at_a_time(target: Path) -> Iterator[None]:
    """Let one run at a time put results in place at ``target``: the folder above it is locked for that moment.

    A run that waits longer than any of them takes goes on all the same, and so does one without locks (Windows, some
    network disks): then whoever is last wins, as among any programs.
    """
    folder = None
    if sys.platform != "win32":
        with suppress(OSError):
            folder = os.open(next(place for place in target.parents if place.is_dir()), os.O_RDONLY)
    until = time.monotonic() + LONGEST_WAIT
    try:
        while folder is not None and not _lock(folder) and time.monotonic() < until:
            time.sleep(0.005)
        yield
    finally:
        if folder is not None:
            os.close(folder)


def write_plan(place: Path, kind: str, names: list[str]) -> None:
    """Say, before the first move, how results are put in place: "swap" of two folders, or "files" one by one."""
    part = place / f"{PLAN}.part"
    part.write_text(json.dumps({"kind": kind, "results": names}), encoding="utf-8")
    part.replace(place / PLAN)


def finish_leftovers(target: Path) -> None:
    """Finish or remove what killed runs to ``target`` left behind; what a living one still needs is not touched."""
    for folder in (target, *target.parents[:LEVELS]):
        with suppress(OSError):
            places = [Path(entry) for entry in os.scandir(folder) if entry.name.startswith(PREFIX)]
            for place in places:
                _finish_leftover(place, target)


def _finish_leftover(place: Path, target: Path) -> None:
    try:
        lock = (place / LOCK).open("r+", encoding="utf-8")
    except OSError:  # killed before it began, or in its last step
        with suppress(OSError):
            if time.time() - place.stat().st_mtime > DAY and {file.name for file in place.iterdir()} <= {PART}:
                shutil.rmtree(place)
        return
    with lock:
        if not _lock(lock) or lock.read() != str(target):
            return
        with one_at_a_time(target):
            _finish(place, target)
        _remove(place)


def _finish(place: Path, target: Path) -> None:
    """Complete moves that were begun, so that ``target`` has the results before or those after and loses no other file.

    The plan goes when nothing is left that anyone misses; if that fails, it stays, with the hidden folder.
    """
    plan = _plan(place)
    if plan is None:
        return
    names = set(plan["results"])
    with suppress(OSError):
        if plan["kind"] == "files":  # forwards: the new results are whole
            for name in names:
                if os.path.lexists(place / NEW / name):
                    (place / NEW / name).replace(target / name)
        else:
            if not target.exists() and (place / OLD).exists():  # back: the new folder did not arrive
                (place / OLD).rename(target)
            for folder in (place / NEW, place / OLD):  # one of them may be the folder before
                others = [entry for entry in folder.iterdir() if entry.name not in names] if folder.is_dir() else []
                for entry in others:
                    if not os.path.lexists(target / entry.name):
                        entry.rename(target / entry.name)
        (place / PLAN).unlink()


def _remove(place: Path) -> None:
    """Remove a hidden folder, unless a plan in it says that it is still needed; the lock last, which makes it ours."""
    if (place / PLAN).exists():
        return
    for folder in (place / NEW, place / OLD):
        shutil.rmtree(folder, ignore_errors=True)
    with suppress(OSError):
        for file in sorted(place.iterdir(), key=lambda file: file.name == LOCK):
            file.unlink()
        place.rmdir()


def _plan(place: Path) -> dict[str, Any] | None:
    try:
        plan = json.loads((place / PLAN).read_text(encoding="utf-8"))
        return plan if plan["kind"] in ("files", "swap") and isinstance(plan["results"], list) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _prefix(target: Path) -> str:
    return f"{PREFIX}{target.name[:LONGEST_NAME]}-"


def _owned(place: Path, target: Path) -> IO[str] | None:
    """The lock of a hidden folder, held; None where locks do not work: nobody then takes the folder for left behind.

    It gets its name when it is locked, so that nobody else can have it before.
    """
    part = place / PART
    lock = part.open("w+", encoding="utf-8")
    lock.write(str(target))
    lock.flush()
    if _lock(lock):
        part.rename(place / LOCK)
        return lock
    lock.close()
    part.unlink()
    return None


def _lock(file: IO[str] | int) -> bool:
    """Whether the lock of a file, or of an open folder, could be had."""
    if sys.platform == "win32":
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True

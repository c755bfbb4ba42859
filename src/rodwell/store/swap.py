"""Putting results in place: one folder for another in a single step where the file system can do it.

Where the target does not exist, the new folder gets its name. Where it exists, the other files in it get a second name
in the new folder (hard links), and the two folders change places: in one step where the system has one (renameat2 of
Linux, renamex_np of macOS), else in two, of which the next run takes back the first if the second did not come. Folders
that must stay what they are (that in which the program runs, those that hold folders or many files of the user's, or
belong to somebody else, or have another disk mounted on them) get the results file by file; if the program is killed
between two of them, the next run to the same place moves the rest.
"""

from __future__ import annotations

import ctypes
import os
import shutil
import sys
from pathlib import Path

from rodwell.store.staging import OLD, write_plan

MOST_OTHERS = 200
"""Files of the user's that get a second name; where there are more, results are moved one by one."""

_AT_FDCWD, _EXCHANGE, _SWAP = -100, 2, 2
"""Constants of the two systems: paths as they are, exchange of two names."""


def put_in_place(new: Path, target: Path) -> None:
    """Make the files in ``new``, a staged folder, those of ``target``; other files there are kept.

    Raises
    ------
    OSError
        If they cannot be moved.
    """
    place, names = new.parent, sorted(file.name for file in new.iterdir())
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        new.rename(target)
    elif len(names) < 2 or not _swapped(new, target, names):
        write_plan(place, "files", names)
        for name in names:
            (new / name).replace(target / name)


def _swapped(new: Path, target: Path, names: list[str]) -> bool:
    """Whether the two folders could change places."""
    others = [entry for entry in os.scandir(target) if entry.name not in names]
    if not _may_be_replaced(new, target, others):
        return False
    try:
        for entry in others:
            os.link(entry.path, new / entry.name, follow_symlinks=False)
        shutil.copymode(target, new)
        write_plan(new.parent, "swap", names)
        if not _exchanged(new, target):
            target.rename(new.parent / OLD)
            try:
                new.rename(target)
            except OSError:
                (new.parent / OLD).rename(target)
                raise
    except OSError:
        return False
    return True


def _may_be_replaced(new: Path, target: Path, others: list[os.DirEntry[str]]) -> bool:
    """Whether nobody misses the folder itself if another one with the same files takes its place."""
    ours, theirs = new.stat(), target.stat()
    return (
        new.parent.parent == target.parent
        and (ours.st_uid, ours.st_gid) == (theirs.st_uid, theirs.st_gid)
        and not os.path.ismount(target)
        and len(others) <= MOST_OTHERS
        and all(entry.is_file(follow_symlinks=False) for entry in others)
    )


def _exchanged(one: Path, other: Path) -> bool:
    """Whether two folders changed places in one step; False where the system or the file system has none."""
    names = (os.fsencode(one), os.fsencode(other))
    try:
        library = ctypes.CDLL(None, use_errno=True)
        if sys.platform == "linux":
            return int(library.renameat2(_AT_FDCWD, names[0], _AT_FDCWD, names[1], _EXCHANGE)) == 0
        if sys.platform == "darwin":
            return int(library.renamex_np(*names, _SWAP)) == 0
    except (AttributeError, OSError, TypeError):
        pass
    return False

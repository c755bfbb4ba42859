"""Result folders that are written whole or not at all."""

from __future__ import annotations

import errno
import os
import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rodwell.errors import InputError
from rodwell.store.staging import PREFIX, finish_leftovers, one_at_a_time, staged
from rodwell.store.swap import put_in_place


def check_writable(out: Path, option: str = "--out") -> None:
    """Raise before any work is done if results could not be written to ``out``, which ``option`` named.

    What a killed run left behind for ``out`` is tidied away.
    """
    try:
        target = out.resolve()
        home = _home(out, target, option)
        with tempfile.TemporaryDirectory(dir=home, prefix=PREFIX):
            pass
        if target.exists() and not os.access(target, os.W_OK | os.X_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    except OSError as error:
        raise _unwritable(out, error, option) from None
    finish_leftovers(out.resolve())


@contextmanager
def whole_folder(out: Path, option: str = "--out") -> Iterator[Path]:
    """Yield a temporary folder whose files become those of ``out`` when the block ends well.

    If the block raises, or is interrupted, ``out`` stays as it was (and is not made). Other files in ``out`` are kept.
    A folder takes the place of another in one step where that can be, see :mod:`rodwell.store.swap`: who reads ``out``
    sees the results before or those after, also if the program is killed.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    out = out.absolute()
    try:
        target = out.resolve()
        with staged(target, _home(out, target, option), _undisturbed) as new:
            yield new
            with _undisturbed(), one_at_a_time(target):
                _check_free(new, out, option)
                _open_to_others(new)
                put_in_place(new, target)
                _in_place.append(out)
    except OSError as error:
        raise _unwritable(out, error, option) from None


_in_place: list[Path] = []


def in_place() -> tuple[Path, ...]:
    """Folders that this process has put results in, each once, from the first on: told where nothing else can be."""
    return tuple(dict.fromkeys(_in_place))


@contextmanager
def appearing(out: Path, option: str = "--out", home: Path | None = None) -> Iterator[Path]:
    """Yield a temporary folder that becomes ``out``, which is not there yet, or empty, when the block ends well.

    Where another run was first, its folder stays. ``home`` is where the folder waits; beside ``out`` if not given.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    out = out.absolute()
    try:
        target = out.resolve()
        place = _nearest_folder(out.parent, option) if home is None else home
        with staged(target, place, _undisturbed) as new:
            yield new
            with _undisturbed():
                new.chmod(0o777 & ~_mask())
                target.parent.mkdir(parents=True, exist_ok=True)
                try:
                    new.rename(target)
                except OSError as error:
                    if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
                        raise
    except OSError as error:
        raise _unwritable(out, error, option) from None


def _home(out: Path, target: Path, option: str) -> Path:
    """Where results are kept until they are whole: beside ``out``, so that one folder can replace another, or in it."""
    nearest = _nearest_folder(out, option)
    if not target.exists() or Path.cwd().is_relative_to(target):
        return nearest
    beside = target.parent
    same_disk = beside.stat().st_dev == target.stat().st_dev
    return beside if same_disk and os.access(beside, os.W_OK | os.X_OK) else nearest


def _nearest_folder(out: Path, option: str) -> Path:
    """``out`` itself if it exists, else the nearest folder above it that does."""
    place = out.absolute()
    while not place.exists():
        place = place.parent
    if not place.is_dir():
        what = "is a file; name a folder" if place == out.absolute() else f"cannot be made: {str(place)!r} is a file"
        raise InputError(option, str(out), what)
    return place


def _check_free(new: Path, out: Path, option: str) -> None:
    """Raise if a folder of the user's stands where a result is to be."""
    for file in new.iterdir():
        if (out / file.name).is_dir():
            raise InputError(option, str(out), f"holds a folder {file.name!r}, which stands in the way of a result")


def _open_to_others(new: Path) -> None:
    """Give result files the permissions of ordinary new files."""
    mask = _mask()
    for file in new.iterdir():
        file.chmod(0o666 & ~mask)


def _mask() -> int:
    """What this process takes from the permissions of new files."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Hold back Ctrl-C and requests to end for the moment in which files are moved or removed."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    before = {number: signal.signal(number, signal.SIG_IGN) for number in numbers}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _unwritable(out: Path, error: OSError, option: str) -> InputError:
    return InputError(option, str(out), f"cannot be written ({error.strerror}); name another folder, or make room")

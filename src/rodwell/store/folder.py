"""Result folders that are written whole or not at all."""

from __future__ import annotations

import os
import shutil
import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rodwell.errors import InputError


def check_writable(out: Path, option: str = "--out") -> None:
    """Raise before any work is done if results could not be written to ``out``, which ``option`` named."""
    try:
        home = _nearest_folder(out, option)
        with tempfile.TemporaryDirectory(dir=home):
            pass
    except OSError as error:
        raise _unwritable(out, error, option) from None


@contextmanager
def whole_folder(out: Path, option: str = "--out") -> Iterator[Path]:
    """Yield a temporary folder whose files move to ``out`` when the block ends well.

    If the block raises, or is interrupted, ``out`` stays as it was (and is not made). Other files in ``out``
    are kept.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    out = out.absolute()
    try:
        temporary = Path(tempfile.mkdtemp(prefix=f".{out.name[:40]}-", dir=_nearest_folder(out, option)))
    except OSError as error:
        raise _unwritable(out, error, option) from None
    try:
        yield temporary
        with _undisturbed():
            _move(temporary, out, option)
    except OSError as error:
        raise _unwritable(out, error, option) from None
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _nearest_folder(out: Path, option: str) -> Path:
    """``out`` itself if it exists, else the nearest folder above it that does."""
    place = out.absolute()
    while not place.exists():
        place = place.parent
    if not place.is_dir():
        what = "is a file; name a folder" if place == out.absolute() else f"cannot be made: {str(place)!r} is a file"
        raise InputError(option, str(out), what)
    return place


def _move(temporary: Path, out: Path, option: str) -> None:
    """Move all files; nothing is touched if something stands in the way of one."""
    files = list(temporary.iterdir())
    for file in files:
        if (out / file.name).is_dir():
            raise InputError(option, str(out), f"holds a folder {file.name!r}, which stands in the way of a result")
    out.mkdir(parents=True, exist_ok=True)
    for file in files:
        file.replace(out / file.name)
    _open_to_others(out, [file.name for file in files])


def _open_to_others(out: Path, names: list[str]) -> None:
    """Give result files the permissions of ordinary new files."""
    mask = os.umask(0)
    os.umask(mask)
    for name in names:
        (out / name).chmod(0o666 & ~mask)


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Hold back Ctrl-C for the moment in which files are moved."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _unwritable(out: Path, error: OSError, option: str) -> InputError:
    return InputError(option, str(out), f"cannot be written ({error.strerror}); name another folder, or make room")

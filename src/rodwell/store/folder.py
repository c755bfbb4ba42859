"""Result folders that are written whole or not at all."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rodwell.errors import InputError


def check_writable(out: Path) -> None:
    """Raise before any work is done if results could not be written to ``out``."""
    if out.exists() and not out.is_dir():
        raise InputError("--out", str(out), "is a file; name a folder")
    existing = out
    while not existing.exists():
        existing = existing.parent
    if not existing.is_dir():
        raise InputError("--out", str(out), f"cannot be made: {str(existing)!r} is a file")
    try:
        with tempfile.TemporaryFile(dir=existing):
            pass
    except OSError as problem:
        raise InputError("--out", str(out), f"cannot be written ({problem.strerror}); name another folder") from None


@contextmanager
def whole_folder(out: Path) -> Iterator[Path]:
    """Yield a temporary folder whose files move to ``out`` when the block ends well.

    If the block raises, or is interrupted, ``out`` stays as it was. Other files in ``out`` are kept.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    out = out.absolute()
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        temporary = Path(tempfile.mkdtemp(prefix=f".{out.name}-", dir=out.parent))
    except OSError as problem:
        raise InputError("--out", str(out), f"cannot be written ({problem.strerror}); name another folder") from None
    try:
        yield temporary
        try:
            out.mkdir(exist_ok=True)
            for file in temporary.iterdir():
                file.replace(out / file.name)
        except OSError as problem:
            raise InputError("--out", str(out), f"cannot be written ({problem.strerror})") from None
    finally:
        shutil.rmtree(temporary, ignore_errors=True)

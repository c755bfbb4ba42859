"""Text files, and data as JSON text files."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

from rodwell.errors import InputError
from rodwell.quantities.as_json import as_json


def write_json(data: dict[str, Any], path: Path) -> None:
    """Write data as JSON, indented; what is not finite is null, and named under "not_finite"."""
    path.write_text(as_json(data, reasons=True, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


def write_whole(text: str, path: Path) -> None:
    """Write a text file whole or not at all: what stood there stays until the new file is complete.

    Raises
    ------
    InputError
        If it cannot be written there.
    """
    temporary: Path | None = None
    try:
        handle, name = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.absolute().parent)
        temporary = Path(name)
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        mask = os.umask(0)
        os.umask(mask)
        temporary.chmod(0o666 & ~mask)
        temporary.replace(path)
    except OSError as error:
        what = f"cannot be written ({error.strerror or error}); name another file, or make its folder"
        raise InputError("file", str(path), what) from None
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)

"""Case files as TOML, read whole, with errors that say what to do."""

from __future__ import annotations

import difflib
import tomllib
from pathlib import Path
from typing import Any

from rodwell.errors import InputError


def read_toml(file: Path) -> tuple[dict[str, Any], str]:
    """Return the content of a case file, and its text.

    Raises
    ------
    InputError
        If there is no such file, it cannot be read, or it is not TOML in UTF-8.
    """
    try:
        text = file.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        near = difflib.get_close_matches(file.name, _siblings(file), n=1)
        hint = f"; did you mean {str(file.with_name(near[0]))!r}?" if near else ""
        raise InputError("case file", str(file), f"does not exist{hint}") from None
    except IsADirectoryError:
        raise InputError("case file", str(file), "is a folder; name a TOML file in it") from None
    except UnicodeDecodeError:
        raise InputError("case file", str(file), "is not text in UTF-8; case files are TOML") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError("case file", str(file), f"cannot be read: {reason}") from None
    try:
        return tomllib.loads(text), text
    except tomllib.TOMLDecodeError as error:
        hint = '; quantities and text stand in quotes, for example length = "30 m"'
        raise InputError("case file", str(file), f"is not valid TOML: {error}{hint}") from None
    except (ValueError, RecursionError):
        raise InputError("case file", str(file), "is not valid TOML: a number or a nesting too large") from None


def _siblings(file: Path) -> list[str]:
    try:
        return [p.name for p in file.parent.iterdir() if p.suffix == ".toml"]
    except OSError:
        return []

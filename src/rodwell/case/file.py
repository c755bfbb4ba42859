"""Case files and catalogues as TOML: read once, from a file or a pipe, whole and bounded, with errors that help."""

from __future__ import annotations

import difflib
import itertools
import re
import sys
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import blake2b
from pathlib import Path
from typing import Any, BinaryIO

from rodwell.errors import InputError, printable

LARGEST_CASE, LARGEST_CATALOGUE = 200_000, 1_000_000
"""Bytes that are read of a case file and of a catalogue; those that people write hold a few thousand."""

STANDARD_INPUT = "-"
"""Name that stands for standard input."""

FILE_KEYS = (("hole", "survey"), ("hole", "centerline"), ("catalogue", "files"))
"""Section and key of a case that name files on which its numbers depend: not the logo of its report."""

MOST_PARTS = 20
"""Parts that a dotted key may have: the time that the parser takes grows with their square."""

DEEPEST = 6
"""Levels of a file below which no text is ever shown."""

_PART = r"""(?:[\w-]++|"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')"""
_LONG_KEY = re.compile(rf"(?<![\w\\-]){_PART}(?:[ \t]*+\.[ \t]*+{_PART}){{{MOST_PARTS}}}", re.ASCII)


@dataclass(frozen=True)
class CaseText:
    """A case file as it was read.

    Attributes
    ----------
    data
        Its content; what cannot be printed is replaced, see :func:`rodwell.errors.printable`.
    text
        The file as it was read.
    source
        Its name for messages and reports: the file's, or "standard input", "pipe".
    name
        Its name for the folder of results: the file's without suffix, or "case" where there is none.
    folder
        From which catalogue files are sought: the file's, or the current one.
    """

    data: dict[str, Any]
    text: str
    source: str
    name: str
    folder: Path


def read_case(path: str | Path) -> CaseText:
    """Read a case file, once: a file, a pipe such as /dev/stdin, or "-" for standard input.

    Raises
    ------
    InputError
        If there is no such file, it cannot be read, is too large, or is not TOML in UTF-8.
    """
    file = Path(path)
    raw = _case_bytes(file)
    text = decoded(raw, "case file", str(path), "case files are TOML")
    data = parsed(text, "case file", str(path), '; quantities and text stand in quotes, for example length = "30 m"')
    source, name, folder = _names(file)
    return CaseText(data, text, source, name, folder)


def _names(file: Path) -> tuple[str, str, Path]:
    """Source, name and folder of a case; what stands in /dev or is no file has no name that means anything."""
    if str(file) == STANDARD_INPUT or file == Path("/dev/stdin"):
        return "standard input", "case", Path()
    if file.parts[:2] in (("/", "dev"), ("/", "proc")) or not file.is_file():
        return "pipe", "case", Path()
    return printable(file.name), file.stem, file.parent


def _case_bytes(file: Path) -> bytes:
    """The first bytes of a case file, one more than it may have."""
    try:
        if str(file) == STANDARD_INPUT:
            return first_bytes(sys.stdin.buffer, LARGEST_CASE)
        with file.open("rb") as opened:
            return first_bytes(opened, LARGEST_CASE)
    except FileNotFoundError:
        near = difflib.get_close_matches(file.name, _siblings(file), n=1)
        hint = f"; did you mean {str(file.with_name(near[0]))!r}?" if near else ""
        raise InputError("case file", str(file), f"does not exist{hint}") from None
    except IsADirectoryError:
        raise InputError("case file", str(file), "is a folder; name a TOML file in it") from None
    except (OSError, ValueError, AttributeError) as error:  # the last: no standard input
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError("case file", str(file), f"cannot be read: {reason}") from None


def named_files(data: Mapping[str, Any], folder: Path) -> dict[str, str]:
    """Files that the numbers of a case depend on, as it names them, and digests of what is in them.

    Files that are not there are left out: whoever reads the case says so.
    """
    values = [data[section].get(key) for section, key in FILE_KEYS if isinstance(data.get(section), Mapping)]
    names = itertools.chain.from_iterable(value if isinstance(value, list | tuple) else [value] for value in values)
    files = {name: folder / name for name in names if isinstance(name, str)}
    return {
        name: blake2b(file.read_bytes(), digest_size=8).hexdigest() for name, file in files.items() if file.is_file()
    }


def first_bytes(opened: BinaryIO, most: int) -> bytes:
    """As many bytes of an open file as may be, and one more where there are more: /dev/zero never ends."""
    return opened.read(most + 1)


def decoded(raw: bytes, field: str, name: str, what: str, most: int = LARGEST_CASE) -> str:
    """Return the text of a file, its line ends as one character; ``what`` says what such files are.

    Raises
    ------
    InputError
        For ``field`` if there are more than ``most`` bytes, or they are not text in UTF-8.
    """
    if len(raw) > most:
        raise InputError(field, name, f"is larger than {most // 1000} kB, which no file of its kind is; {what}")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(field, name, f"is not text in UTF-8; {what}") from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def parsed(text: str, field: str, name: str, hint: str = "") -> dict[str, Any]:
    """Return the content of a TOML text, in a time that grows as its length; ``hint`` ends a message on its syntax.

    Raises
    ------
    InputError
        For ``field`` if it is not valid TOML.
    """
    if _LONG_KEY.search(text):
        raise InputError(field, name, f"is not valid TOML: a key of more than {MOST_PARTS} parts")
    try:
        data: dict[str, Any] = printable_data(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise InputError(field, name, f"is not valid TOML: {error}{hint}") from None
    except (ValueError, RecursionError):
        raise InputError(field, name, "is not valid TOML: a number or a nesting too large") from None
    return data


def printable_data(data: Any, depth: int = 0) -> Any:
    """Return data with every text in it, keys too, as :func:`rodwell.errors.printable` has it."""
    if isinstance(data, str):
        return printable(data)
    if depth < DEEPEST and isinstance(data, Mapping):
        return {printable_data(key): printable_data(value, depth + 1) for key, value in data.items()}
    if depth < DEEPEST and isinstance(data, list | tuple):
        values = [printable_data(value, depth + 1) for value in data]
        return values if isinstance(data, list) else tuple(values)
    return data


def _siblings(file: Path) -> list[str]:
    try:
        return [p.name for p in file.parent.iterdir() if p.suffix == ".toml"]
    except OSError:
        return []

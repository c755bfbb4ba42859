"""What a file holds, as text: bounded in size, in whatever encoding.

The encoding is not guessed from statistics of letters. A byte order mark decides, then noughts at every second byte
(UTF-16), then whether the bytes are UTF-8; what is left is taken for cp1252 (Western Windows). Numbers and separators
are the same in all of them, and a degree sign too.
"""

from __future__ import annotations

import codecs
from pathlib import Path

from rodwell.errors import InputError

LARGEST_FILE = 50_000_000
MOST_LINES = 500_000

MARKS = (
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
"""Byte order marks, the longer ones first: that of UTF-32 begins with that of UTF-16."""

ZIP, OLE = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"


def read_bytes(path: Path) -> bytes:
    """All bytes of a file, a pipe or a device, but no more than :data:`LARGEST_FILE`.

    Raises
    ------
    InputError
        If there is no such file, it cannot be read, or it is larger.
    """
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_FILE + 1)
    except FileNotFoundError:
        raise InputError("survey", str(path), "does not exist; name a CSV, XLSX, LAS or text file") from None
    except IsADirectoryError:
        raise InputError("survey", str(path), "is a folder; name a CSV, XLSX, LAS or text file in it") from None
    except (OSError, ValueError) as error:
        raise InputError("survey", str(path), f"cannot be read: {getattr(error, 'strerror', error)}") from None
    if len(data) > LARGEST_FILE:
        raise InputError("survey", str(path), f"is larger than {LARGEST_FILE // 1_000_000} MB; a survey is not")
    if data.startswith(OLE):
        raise InputError("survey", str(path), "is a workbook of the old kind (XLS); save it as XLSX or CSV")
    return data


def text_of(data: bytes, name: str) -> str:
    """The text that the bytes are.

    Raises
    ------
    InputError
        If they are no text in UTF-8, UTF-16, UTF-32 or cp1252, or too many lines.
    """
    encoding = next((encoding for mark, encoding in MARKS if data.startswith(mark)), None) or _without_mark(data)
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise InputError("survey", name, "is not text in UTF-8, UTF-16 or cp1252; export the survey as CSV in UTF-8")
    if text.count("\n") + text.count("\r") > 2 * MOST_LINES:
        raise InputError("survey", name, f"has more than {MOST_LINES} lines; a survey has not")
    return text


def _without_mark(data: bytes) -> str:
    """Encoding of bytes without a byte order mark."""
    start = data[:4000]
    even, odd = start[::2].count(0), start[1::2].count(0)
    if 10 * max(even, odd) > len(start) and min(even, odd) * 10 <= max(even, odd):
        return "utf-16-be" if even > odd else "utf-16-le"
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return "cp1252"
    return "utf-8"

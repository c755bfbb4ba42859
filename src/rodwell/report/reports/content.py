"""What a report says, apart from how it looks: the page (HTML) and the PDF are made of the same content.

A report has a front, which fits on one sheet and says what decides, and sections made of words, lists, tables and
pictures. All of it is text that is ready to be read; a picture is named, its file goes beside the content.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, ClassVar

from rodwell.answers.words.advice import Status
from rodwell.quantities.text import SEPARATOR


@dataclass(frozen=True)
class Words:
    """A paragraph; ``style`` is "plain", "small" (remarks) or "warning"."""

    kind: ClassVar[str] = "words"
    text: str
    style: str = "plain"


@dataclass(frozen=True)
class Items:
    """A list of sentences."""

    kind: ClassVar[str] = "items"
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Grid:
    """A table of texts: ``numeric`` columns stand to the right, ``marked`` rows stand out (both counted from 0)."""

    kind: ClassVar[str] = "grid"
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    numeric: tuple[int, ...] = ()
    marked: tuple[int, ...] = ()
    caption: str = ""


@dataclass(frozen=True)
class Picture:
    """A picture by name; ``alternative`` says what it shows to those who cannot see it."""

    kind: ClassVar[str] = "picture"
    name: str
    alternative: str
    caption: str


Block = Words | Items | Grid | Picture


@dataclass(frozen=True)
class ReportSection:
    """A heading and what stands below it."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Number:
    """A number that decides, for the front: value with its unit, and a remark.

    ``spread`` is the uncertainty that comes from the inputs, "± 1.2 kN", nothing where they are taken as exact;
    numerical errors stand in the tables.
    """

    label: str
    value: str
    spread: str = ""
    note: str = ""


@dataclass(frozen=True)
class Front:
    """The first sheet: inputs in words beside a picture, verdict, statuses, numbers, what limits, what to do next.

    ``inputs`` are pairs of what and how much, ``limits`` says what gives first and by how much.
    """

    verdict: str
    statuses: tuple[Status, ...]
    numbers: tuple[Number, ...]
    picture: Picture
    assumptions: str
    steps: tuple[str, ...]
    next_title: str = "What to do next"
    inputs: tuple[tuple[str, str], ...] = ()
    limits: str = ""


@dataclass(frozen=True)
class Linked:
    """A file beside the report: its name, and what it holds."""

    name: str
    holds: str


@dataclass(frozen=True)
class Report:
    """A whole report; ``paper`` is the sheet of the PDF, "a4" or "us-letter".

    ``about`` says for whom it is and by whom, as pairs; ``logo`` names the picture of it, "" for none; ``files`` are
    those beside it.
    """

    title: str
    subtitle: str
    front: Front
    sections: tuple[ReportSection, ...]
    footer: str
    paper: str = "a4"
    about: tuple[tuple[str, str], ...] = ()
    logo: str = ""
    files: tuple[Linked, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain data, for templates: each block says of which kind it is."""
        out = asdict(self)
        out["front"]["picture"]["kind"] = Picture.kind
        count = 0
        for section, plain in zip(self.sections, out["sections"], strict=True):
            plain["blocks"] = [{"kind": block.kind, **_plain(block)} for block in section.blocks]
            for block in plain["blocks"]:
                if block["kind"] == Picture.kind:
                    count += 1
                    block["number"] = count
        return dict(unbroken(out))


def _plain(block: Block) -> dict[str, Any]:
    out = asdict(block)
    if isinstance(block, Grid):
        out["rows"] = aligned(block.rows, block.numeric)
    return out


_NUMBER = re.compile(rf"([−+]?[\d{SEPARATOR}]+)(\.\d+)?(.*)", re.DOTALL)
FIGURE, POINT = "\u2007", "\u2008"
"""Spaces as wide as a digit and as a decimal point."""


def aligned(rows: Sequence[Sequence[str]], numeric: Sequence[int]) -> list[list[str]]:
    """The rows of a table with the decimal points of a column below each other, where all its cells have one unit."""
    out = [list(row) for row in rows]
    for column in (i for i in numeric if all(i < len(row) for row in rows)):
        parts = [_NUMBER.fullmatch(row[column]) for row in rows]
        found = [part for part in parts if part is not None]
        places = [len(part[2] or "") for part in found]
        if not found or len({part[3] for part in found}) != 1 or len(set(places)) == 1 or "10" in found[0][3]:
            continue
        for row, part in zip(out, parts, strict=True):
            if part is not None:
                short = max(places) - len(part[2] or "")
                pad = POINT + FIGURE * (short - 1) if not part[2] else FIGURE * short
                row[column] = f"{part[1]}{part[2] or ''}{pad if short else ''}{part[3]}"
    return out


_KEPT_TOGETHER = re.compile(
    r"(?<=\bs) (?==)|(?<=\bs =) (?=\d)|(?<=\bB) (?==)|(?<=\bB =) (?=L)"
    r"|(?<=\bL) (?==)|(?<=\bL =) (?=\d)|(?<=±) (?=error|\d)"
    r"|(?<=\d) (?=(?:[GMkmµnp]?(?:N|Pa|J|m)\b|lbf|ft|in\b|psi|%|B/L|× 10))"
    r"|(?<=×) (?=10)"
)
"""Spaces at which no line may end: in s = 1, s/L = 0.5, B = L = 1, ± error, and between a number and its unit."""


def unbroken(item: Any) -> Any:
    """Return the same plain data with spaces that hold together what belongs together."""
    if isinstance(item, str):
        return _KEPT_TOGETHER.sub("\u00a0", item)
    if isinstance(item, dict):
        return {key: unbroken(value) for key, value in item.items()}
    return [unbroken(value) for value in item] if isinstance(item, list | tuple) else item

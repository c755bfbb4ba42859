"""What a report says, apart from how it looks: the page (HTML) and the PDF are made of the same content.

A report has a front, which fits on one sheet and says what decides, and sections made of words, lists, tables and
pictures. All of it is text that is ready to be read; a picture is named, its file goes beside the content.
"""

from __future__ import annotations

import re
from dataclasses import asdict, dataclass
from typing import Any, ClassVar

from rodwell.answers.words.advice import Status


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
    """A number that decides, for the front: value and error with their unit, and a remark."""

    label: str
    value: str
    error: str
    note: str = ""


@dataclass(frozen=True)
class Front:
    """The first sheet: verdict, statuses, numbers, one picture, assumptions, what to do next."""

    verdict: str
    statuses: tuple[Status, ...]
    numbers: tuple[Number, ...]
    picture: Picture
    assumptions: str
    steps: tuple[str, ...]
    next_title: str = "What to do next"


@dataclass(frozen=True)
class Report:
    """A whole report; ``paper`` is the sheet of the PDF, "a4" or "us-letter"."""

    title: str
    subtitle: str
    front: Front
    sections: tuple[ReportSection, ...]
    footer: str
    paper: str = "a4"

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain data, for templates: each block says of which kind it is."""
        out = asdict(self)
        out["front"]["picture"]["kind"] = Picture.kind
        for section, plain in zip(self.sections, out["sections"], strict=True):
            plain["blocks"] = [{"kind": block.kind, **asdict(block)} for block in section.blocks]
        return dict(unbroken(out))


_KEPT_TOGETHER = re.compile(
    r"(?<=\bs) (?==)|(?<=\bs =) (?=\d)|(?<=\bB) (?==)|(?<=\bB =) (?=L)"
    r"|(?<=\bL) (?==)|(?<=\bL =) (?=\d)|(?<=±) (?=error)"
)
"""Spaces at which no line may end: in s = 1, s/L = 0.5, B = L = 1 and ± error."""


def unbroken(item: Any) -> Any:
    """Return the same plain data with spaces that hold together what belongs together."""
    if isinstance(item, str):
        return _KEPT_TOGETHER.sub("\u00a0", item)
    if isinstance(item, dict):
        return {key: unbroken(value) for key, value in item.items()}
    return [unbroken(value) for value in item] if isinstance(item, list | tuple) else item

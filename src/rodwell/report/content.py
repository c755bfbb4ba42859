"""What a section of a report says, apart from how it looks: words, tables and pictures.

All of it is text that is ready to be read; a picture is named, its file goes beside the content.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar


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
class Section:
    """A heading and what stands below it."""

    title: str
    blocks: tuple[Block, ...]

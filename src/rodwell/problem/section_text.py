"""Sections of a rod as they are written in a line: ``0.6:1:1,0.4:1/0.3:1/0.5``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rodwell.errors import InputError
from rodwell.problem.profile import Ratio


def sections_from(text: str, name: str = "sections") -> list[list[float | list[float]]]:
    """Numbers of sections, ``length:stiffness:weight:clearance:torsion`` of each, parted by commas; a taper's by /.

    What they must be is checked with the problem that they make.

    Raises
    ------
    InputError
        Naming the section that cannot be read; ``name`` is what the text is called.
    """
    found = []
    for number, section in enumerate(text.split(","), 1):
        try:
            parts = [[float(one) for one in part.split("/")] for part in section.split(":")]
        except ValueError:
            what = "must be length:stiffness[:weight[:clearance[:torsion]]], numbers, a taper's parted by /, sections "
            what += "parted by commas"
            raise InputError(f"{name}, section {number}", section, what) from None
        found.append([part if len(part) > 1 else part[0] for part in parts])
    return found


def sections_text(sections: Iterable[Sequence[Ratio]]) -> str:
    """Sections in a line, as :func:`sections_from` reads them: ratios of 1 at the end are left out."""
    lines = []
    for length, *ratios in sections:
        while len(ratios) > 1 and ratios[-1] == 1.0:
            ratios.pop()
        lines.append(":".join(_ratio_text(one) for one in (length, *ratios)))
    return ",".join(lines)


def _ratio_text(ratio: Ratio) -> str:
    values = ratio if isinstance(ratio, tuple) else (ratio,)
    return "/".join(f"{number!r}".removesuffix(".0") for number in values)

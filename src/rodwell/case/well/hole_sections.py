"""[[hole.section]] of a case file: diameter and friction of a hole by measured depth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from pydantic import ConfigDict, Field

from rodwell.case.kinds import InnerLength, Length, Name, Number, SectionInput
from rodwell.errors import InputError

LARGEST_FRICTION = 1.0
"""Friction factors above are no friction of pipe on a wall; those of practice are 0.1 to 0.5."""

ALLOWED_FRICTION = f"from 0 to {LARGEST_FRICTION:g}; those of practice are 0.1 to 0.5"

SAME_DEPTH = 1e-6
"""Depths that differ by less, in m, are the same: feet become metres by rounding."""


class HolePart(SectionInput):
    """[[hole.section]]: a part of the hole between two measured depths."""

    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)

    name: Name | None = Field(None, description="what it is called in tables", examples=["9 5/8 in casing"])
    from_: InnerLength | None = Field(
        None, alias="from", description="measured depth where it begins; that where the one before ends if not given",
        examples=["0 m"],
    )  # fmt: skip
    to: Length | None = Field(
        None, description="measured depth where it ends; the last may leave it out", examples=["1200 m"]
    )
    diameter: Length | None = Field(
        None, description="inner diameter; that of [hole] if not given", examples=["8.5 in"]
    )
    friction: Number | None = Field(
        None, description="friction factor of the string on its wall; that of [hole] if not given", examples=[0.25],
        json_schema_extra={"allowed": ALLOWED_FRICTION},
    )  # fmt: skip


@dataclass(frozen=True)
class HoleSection:
    """A part of a hole: name, measured depths from and to (``inf``: to the end), inner diameter in m, friction."""

    name: str
    start: float
    end: float
    diameter: float
    friction: float


def key_of_hole(number: int, key: str) -> str:
    """How a key of a part is called in messages, counted from 1 at the top."""
    return f"[[hole.section]] {number + 1}, {key}"


def checked_friction(field: str, value: float) -> float:
    """Return a friction factor, or raise an InputError for ``field``."""
    if not math.isfinite(value) or not 0.0 <= value <= LARGEST_FRICTION:
        raise InputError(field, value, f"must be {ALLOWED_FRICTION}")
    return value


def hole_sections(parts: Sequence[HolePart], diameter: float | None, friction: float | None) -> tuple[HoleSection, ...]:
    """Return the sections of a hole, from the top down, without gaps or overlaps.

    Parameters
    ----------
    parts
        As they were read; none: the hole is one.
    diameter, friction
        Of [hole], for sections that do not say; in m.

    Raises
    ------
    InputError
        Naming the section (from 1 at the top) and the key: missing, out of range, or not where the one before ends.
    """
    given = list(parts) or [HolePart.model_validate({})]
    one = not parts
    out: list[HoleSection] = []
    for i, part in enumerate(given):
        before = out[-1].end if out else 0.0
        start = before if part.from_ is None else part.from_
        _check_start(i, start, before)
        end = math.inf if part.to is None else part.to
        if part.to is None and i < len(given) - 1:
            raise InputError(key_of_hole(i, "to"), None, "is missing: only the last section may leave it out")
        if not end > before + SAME_DEPTH:
            raise InputError(
                key_of_hole(i, "to"), f"{end:g} m", f"must be below where the section begins, {before:g} m"
            )
        width = part.diameter or diameter
        if width is None:
            raise InputError(_key(one, i, "diameter"), None, "is missing: give it here or in [hole]")
        factor = friction if part.friction is None else part.friction
        if factor is None:
            raise InputError(
                _key(one, i, "friction"), None, "is missing: give it here or in [hole], 0 for a smooth hole"
            )
        out.append(HoleSection(part.name or f"section {i + 1}", before, end, width,
                               checked_friction(_key(one, i, "friction"), factor)))  # fmt: skip
    return tuple(out)


def _key(one: bool, number: int, name: str) -> str:
    """How a key is called where the hole is one, or in a section."""
    return f"hole.{name}" if one else key_of_hole(number, name)


def _check_start(number: int, start: float, before: float) -> None:
    if abs(start - before) <= SAME_DEPTH:
        return
    where = "the surface, 0 m" if number == 0 else f"where the section before ends, {before:g} m"
    what = "leaves a gap below" if start > before else "overlaps what lies above: it must begin at"
    raise InputError(key_of_hole(number, "from"), f"{start:g} m", f"{what} {where}; sections go from the top down, "
                     "each from where the one before ends")  # fmt: skip

"""Inputs of a file that vary in a parameter study: lists and ranges, and the values that they stand for."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rodwell.errors import InputError
from rodwell.quantities.text import plain
from rodwell.quantities.written import number_and_rest
from rodwell.studies.labels import shown_unit
from rodwell.studies.ranges import LONGEST_RANGE, in_unit, read_range, tidy

MOST_POINTS = 400
"""Points that one study may have."""

ALLOWED = 'write a list, ["30 deg", "45 deg"] or [10, 20], or a range, "30..90 deg in 13" or "10..40 in 7"'

_RANGE_LIKE = re.compile(r"(?:\.\.|…).*\sin\s+\S+\s*$|^\s*[+-]?\.?\d.*?\.\.\s*[+-]?\.?\d")
"""What is meant as a range, well written or not; a path such as "../pipes.toml" is not."""


@dataclass(frozen=True)
class Place:
    """Where a value stands in a file.

    Attributes
    ----------
    path
        Sections, numbers of tables in double brackets from 0, and key.
    name
        The key in messages.
    called
        What it is called by people.
    """

    path: tuple[str | int, ...]
    name: str
    called: str

    def put(self, data: dict[str, Any], value: Any) -> None:
        """Set the value in the content of a file, in place."""
        target: Any = data
        for part in self.path[:-1]:
            target = target[part]
        target[self.path[-1]] = value


@dataclass(frozen=True)
class Varied:
    """An input that varies.

    Attributes
    ----------
    place
        Where it stands in the file.
    written
        What was written there.
    values
        What the file would hold for each single point.
    unit
        Unit that all values share; "" for plain numbers and text.
    numbers
        The values as numbers in that unit, or None where they are no numbers (end conditions).
    """

    place: Place
    written: Any
    values: tuple[Any, ...]
    unit: str
    numbers: tuple[float, ...] | None

    @property
    def name(self) -> str:
        """The key, as it is named in messages."""
        return self.place.name

    @property
    def called(self) -> str:
        """What it is called by people."""
        return self.place.called

    def text(self, i: int) -> str:
        """Value number ``i`` for reading."""
        if self.numbers is None:
            return str(self.values[i])
        unit = shown_unit(self.unit)
        return f"{plain(self.numbers[i], 6)}{'' if unit in ('', '°') else ' '}{unit}"

    @property
    def label(self) -> str:
        """What it is called, with its unit in brackets: "inclination from the vertical [°]"."""
        return self.called + (f" [{shown_unit(self.unit)}]" if self.unit else "")


_THREE_DOTS = re.compile(r"\s*[+-]?(?:\d[^.…]*(?:\.\d[^.…]*)?)?(?:\.{3}|…).*")
"""Three dots where a range has two, unless the first number begins with its point: ".1...3" is from .1 to .3."""


def is_varied(value: object) -> bool:
    """Whether a value of a case file is a list or looks like a range."""
    if isinstance(value, str):
        return len(value) <= LONGEST_RANGE and _RANGE_LIKE.search(value) is not None
    return isinstance(value, list | tuple)


def varied_range(place: Place, text: str, allowed: str = ALLOWED, signed: bool = False) -> Varied:
    """Read a range "30..90 deg in 13": both ends included, evenly spaced; or raise an InputError.

    ``allowed`` says what may stand there where it is none. ``signed``: it is a load, which must say so where it pulls.
    """
    name = place.name
    if _THREE_DOTS.fullmatch(text):
        meant = re.sub(r"\s*(?:\.{3}|…)\s*", "..", text, count=1)
        what = f'has three dots; a range has two: write "{meant}", or a nought before a decimal point, "0..0.5 m in 3"'
        raise InputError(name, text, what)
    read = read_range(name, text, text, MOST_POINTS, allowed, ALLOWED)
    first, last, count, unit = read.first, read.last, read.count, read.unit
    numbers = tuple(tidy(first + (last - first) * i / (count - 1)) for i in range(count))
    turns = signed and min(numbers) < 0.0  # a range from compression to tension says that both are meant
    values = tuple(
        f"{number!r} {unit}{' tension' if turns and number > 0.0 else ''}" if unit else number for number in numbers
    )
    return Varied(place, text, values, unit, numbers)


def varied_list(place: Place, given: list[Any] | tuple[Any, ...]) -> Varied:
    """Read a list of values as the file would have them one by one, or raise an InputError."""
    name = place.name
    if len(given) < 2:
        raise InputError(name, given, f"must hold at least two values; {ALLOWED}")
    if any(isinstance(value, list | tuple | Mapping | bool) or is_varied(value) for value in given):
        raise InputError(name, given, f"must hold single values; {ALLOWED}")
    if any(isinstance(value, int) and abs(value) > sys.float_info.max for value in given):
        raise InputError(name, given, "must hold numbers that are not larger than any computer's")
    if all(isinstance(value, int | float) for value in given):
        return Varied(place, list(given), tuple(given), "", tuple(float(value) for value in given))
    short = [value if isinstance(value, str) and len(value) <= LONGEST_RANGE else None for value in given]
    parsed = [None if value is None else number_and_rest(value) for value in short]
    if any("±" in str(value) or "+/-" in str(value) or "+-" in str(value) for value in given):
        raise InputError(name, given, 'cannot hold values with "±"')
    numbers: tuple[float, ...] | None = None
    unit = parsed[0][1] if parsed[0] else ""
    if all(part is not None for part in parsed):
        try:
            numbers = tuple(in_unit(part[1], unit, part[0]) for part in parsed if part)
        except ValueError:  # names that begin with a number; a wrong unit is explained where the case is made
            unit, numbers = "", None
    return Varied(place, list(given), tuple(given), unit if numbers else "", numbers)


def checked(varied: Sequence[Varied]) -> tuple[Varied, ...]:
    """Return one or two inputs that vary; raise an InputError where there are more, or too many points."""
    if len(varied) > 2:
        names = ", ".join(one.name for one in varied)
        raise InputError(
            varied[2].name, None, f"is the third input that varies ({names}); one or two can vary at a time"
        )
    count = math.prod(len(one.values) for one in varied)
    if count > MOST_POINTS:
        sizes = " × ".join(str(len(one.values)) for one in varied)
        raise InputError(
            varied[-1].name, None, f"makes {sizes} = {count} points; at most {MOST_POINTS}: use fewer values"
        )
    return tuple(varied)

"""Lists and ranges in case files: which inputs vary, and the values that they take."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from rodwell.case.checks.explain import LIST, TAPER, TAPERED
from rodwell.case.sections import check_beside
from rodwell.errors import InputError
from rodwell.quantities.text import plain
from rodwell.quantities.written import number_and_rest
from rodwell.studies.ranges import LONGEST_RANGE, in_unit, read_range, tidy
from rodwell.studies.sweep.labels import label, shown_unit

MOST_POINTS = 400
"""Points that one study may have."""

LISTS = ("catalogue", "load.applied")
"""Sections and keys in which a list is a list, not an input that varies; a range of ``load.applied`` varies."""

FIXED = {
    "analysis": "cannot vary: it says how the cases are computed",
    "load.until": "cannot vary: a study ends at lift-off",
}
"""Sections and keys that cannot vary, and why."""

ALLOWED = 'write a list, ["30 deg", "45 deg"] or [10, 20], or a range, "30..90 deg in 13" or "10..40 in 7"'

ALLOWED_LOAD = 'write a range, "-100..-20 kN in 5", which varies, or a list of loads that act, ["-20 kN", "-40 kN"]'

_RANGE_LIKE = re.compile(r"(?:\.\.|…).*\sin\s+\S+\s*$|^\s*[+-]?\.?\d.*?\.\.\s*[+-]?\.?\d")
"""What is meant as a range, well written or not; a path such as "../pipes.toml" is not."""


@dataclass(frozen=True)
class Varied:
    """An input that varies.

    Attributes
    ----------
    section, key
        Where it stands in the case file.
    written
        What was written there.
    values
        What the case file would hold for each single case.
    unit
        Unit that all values share; "" for plain numbers and text.
    numbers
        The values as numbers in that unit, or None where they are no numbers (end conditions).
    """

    section: str
    key: str
    written: Any
    values: tuple[Any, ...]
    unit: str
    numbers: tuple[float, ...] | None

    @property
    def name(self) -> str:
        """Section and key."""
        return f"{self.section}.{self.key}"

    def text(self, i: int) -> str:
        """Value number ``i`` for reading."""
        if self.numbers is None:
            return str(self.values[i])
        unit = shown_unit(self.unit)
        return f"{plain(self.numbers[i], 6)}{'' if unit in ('', '°') else ' '}{unit}"

    @property
    def label(self) -> str:
        """What it is called, with its unit in brackets: "inclination from the vertical [°]"."""
        return label(self.name) + (f" [{shown_unit(self.unit)}]" if self.unit else "")


_THREE_DOTS = re.compile(r"\s*[+-]?(?:\d[^.…]*(?:\.\d[^.…]*)?)?(?:\.{3}|…).*")
"""Three dots where a range has two, unless the first number begins with its point: ".1...3" is from .1 to .3."""


def is_varied(value: object) -> bool:
    """Whether a value of a case file is a list or looks like a range."""
    if isinstance(value, str):
        return len(value) <= LONGEST_RANGE and _RANGE_LIKE.search(value) is not None
    return isinstance(value, list | tuple)


def may_vary(name: str, value: object) -> bool:
    """Whether the value of a key, "section.key", is one that varies: a list of loads that act is none, a range is."""
    return is_varied(value) and (name not in LISTS or isinstance(value, str))


def check_declared(data: Mapping[str, Any]) -> None:
    """Refuse lists of values in a case file that does not say that it is a study.

    Raises
    ------
    InputError
        For the first such list: it may as well be meant as a taper, or as loads that act.
    """
    if data.get("study") is True:
        return
    for section, values in data.items():
        for key, value in values.items() if isinstance(values, Mapping) and section not in LISTS else ():
            name = f"{section}.{key}"
            if not isinstance(value, str) and may_vary(name, value) and not (FIXED.get(section) or FIXED.get(name)):
                what = "is a list" + LIST + (TAPER if section == "rod" and key in TAPERED else "")
                raise InputError(name, value, what)


def varied_inputs(data: Mapping[str, Any]) -> tuple[Varied, ...]:
    """Return the inputs that vary, in the order of the file.

    Raises
    ------
    InputError
        For a list or range that cannot be read, one where nothing may vary, more than two, or too many points.
    """
    out = []
    for section, values in data.items():
        if section == "string":
            check_beside(data.get("rod", {}), values)
            for number, name, value in _ranges_of(values):
                what = "cannot vary: a study goes over keys of [rod], [hole], [mud] and [load]; give one value"
                raise InputError(f"string {number}.{name}", value, what)
            continue
        if not isinstance(values, Mapping):
            if isinstance(values, list):
                raise InputError(section, values, "cannot vary")
            continue
        for key, value in values.items():
            name = f"{section}.{key}"
            if section in LISTS or not may_vary(name, value):
                continue
            why = FIXED.get(section) or FIXED.get(name)
            if why is not None:
                raise InputError(name, value, why)
            out.append(_range(section, key, value) if isinstance(value, str) else _list(section, key, value))
    if len(out) > 2:
        names = ", ".join(varied.name for varied in out)
        raise InputError(out[2].name, None, f"is the third input that varies ({names}); one or two can vary at a time")
    count = math.prod(len(varied.values) for varied in out)
    if count > MOST_POINTS:
        sizes = " × ".join(str(len(varied.values)) for varied in out)
        raise InputError(out[-1].name, None, f"makes {sizes} = {count} points; at most {MOST_POINTS}: use fewer values")
    return tuple(out)


def _ranges_of(sections: list[Any]) -> Iterator[tuple[int, str, object]]:
    """Ranges in the sections of a string: number, key and what was written."""
    for number, section in enumerate(sections, 1):
        for name, value in section.items() if isinstance(section, Mapping) else ():
            if is_varied(value):
                yield number, name, value


def _range(section: str, key: str, text: str) -> Varied:
    """A range "30..90 deg in 13": both ends included, evenly spaced."""
    name = f"{section}.{key}"
    if _THREE_DOTS.fullmatch(text):
        meant = re.sub(r"\s*(?:\.{3}|…)\s*", "..", text, count=1)
        what = f'has three dots; a range has two: write "{meant}", or a nought before a decimal point, "0..0.5 m in 3"'
        raise InputError(name, text, what)
    read = read_range(name, text, text, MOST_POINTS, ALLOWED_LOAD if name in LISTS else ALLOWED, ALLOWED)
    first, last, count, unit = read.first, read.last, read.count, read.unit
    numbers = tuple(tidy(first + (last - first) * i / (count - 1)) for i in range(count))
    turns = name in LISTS and min(numbers) < 0.0  # a range from compression to tension says that both are meant
    values = tuple(
        f"{number!r} {unit}{' tension' if turns and number > 0.0 else ''}" if unit else number for number in numbers
    )
    return Varied(section, key, text, values, unit, numbers)


def _list(section: str, key: str, given: list[Any] | tuple[Any, ...]) -> Varied:
    """A list of values as the case file would have them one by one."""
    name = f"{section}.{key}"
    if len(given) < 2:
        raise InputError(name, given, f"must hold at least two values; {ALLOWED}")
    if any(isinstance(value, list | tuple | Mapping | bool) or is_varied(value) for value in given):
        raise InputError(name, given, f"must hold single values; {ALLOWED}")
    if any(isinstance(value, int) and abs(value) > sys.float_info.max for value in given):
        raise InputError(name, given, "must hold numbers that are not larger than any computer's")
    if all(isinstance(value, int | float) for value in given):
        return Varied(section, key, list(given), tuple(given), "", tuple(float(value) for value in given))
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
    return Varied(section, key, list(given), tuple(given), unit if numbers else "", numbers)

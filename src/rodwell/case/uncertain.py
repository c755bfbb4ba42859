"""Uncertain inputs: "30 m ± 0.1 m" in a case file, and the case with each of them moved either way."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rodwell.errors import InputError
from rodwell.problem.problem import Problem
from rodwell.quantities.scales import Scales
from rodwell.quantities.units import in_unit_of
from rodwell.quantities.written import number_and_rest, remedy

LONGEST = 150
"""Characters that a quantity and its uncertainty may have: the expression below takes their number to the third."""

_PLUS_MINUS = re.compile(r"\s*(.+?)\s*(?:±|\+/-|\+-)\s*(.+?)\s*")

Moved = tuple[Problem, Scales | None]


@dataclass(frozen=True)
class UncertainInput:
    """An input that was given with "±": key, what was written, and the case with it moved down and up.

    ``down`` or ``up`` is None where the moved value is not allowed (an angle beyond 90°): the other side then serves.
    """

    key: str
    written: str
    down: Moved | None
    up: Moved | None


def split(data: Mapping[str, Any]) -> tuple[dict[str, Any], dict[tuple[str, str], tuple[str, str]]]:
    """Return the data without "±", and for each uncertain key its text at the value less and plus the uncertainty.

    Raises
    ------
    InputError
        If an uncertainty cannot be read.
    """
    clean: dict[str, Any] = {}
    moved: dict[tuple[str, str], tuple[str, str]] = {}
    for section, values in data.items():
        clean[section] = values
        if not isinstance(values, Mapping) or section == "report":  # which holds words only
            continue
        clean[section] = dict(values)
        for key, text in values.items():
            short = isinstance(text, str) and len(text) <= LONGEST
            parts = _PLUS_MINUS.fullmatch(text.replace("−", "-")) if short else None
            if parts is None:
                continue
            nominal, moved[section, key] = _moved(f"{section}.{key}", text, parts[1], parts[2])
            clean[section][key] = nominal
    return clean, moved


def _moved(key: str, written: str, nominal: str, spread: str) -> tuple[Any, Any]:
    """The nominal value, and the pair of values moved down and up, as the case file would have them without "±"."""
    value, by = number_and_rest(nominal), number_and_rest(spread)
    allowed = 'must be like "30 m ± 0.1 m", "30 ± 0.1 m" or "30 m ± 2 %"'
    if value is None or by is None:
        how = remedy(nominal if value is None else spread)
        raise InputError(key, written, f"{allowed}; write {how.rstrip('; ,')}" if how else allowed)
    middle, unit = value
    size, of = by
    if of == "%":
        size *= abs(middle) / 100.0
    elif not unit:
        unit = of
    elif of and of != unit:
        try:
            size = in_unit_of(size, of, unit)
        except ValueError as error:
            raise InputError(key, written, f"{error}; it {allowed}") from None
    if not 0.0 < size < math.inf:
        raise InputError(key, written, "must have an uncertainty above 0")
    if size >= abs(middle) > 0.0 and not key.startswith("hole.angle"):
        what = f"has an uncertainty of {100.0 * size / abs(middle):.3g} % of its value, which says nothing of it: "
        raise InputError(key, written, what + "give one below 100 %, or a range of values to vary")
    if not unit:
        return middle, (middle - size, middle + size)
    return f"{middle!r} {unit}", (f"{middle - size!r} {unit}", f"{middle + size!r} {unit}")

"""Lists and ranges in case files: which inputs vary, and the values that they take."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from rodwell.case.checks.explain import LIST, TAPER, TAPERED
from rodwell.case.file import CaseText, read_case
from rodwell.case.string.sections import check_beside
from rodwell.errors import InputError
from rodwell.studies.labels import label
from rodwell.studies.varied import Place, Varied, checked, is_varied, varied_list, varied_range

LISTS = ("catalogue", "load.applied", "hole.section")
"""Sections and keys in which a list is a list, not an input that varies; a range of ``load.applied`` varies."""

FIXED = {
    "analysis": "cannot vary: it says how the cases are computed",
    "load.until": "cannot vary: a study ends at lift-off",
}
"""Sections and keys that cannot vary, and why."""

ALLOWED_LOAD = 'write a range, "-100..-20 kN in 5", which varies, or a list of loads that act, ["-20 kN", "-40 kN"]'


def may_vary(name: str, value: object) -> bool:
    """Whether the value of a key, "section.key", is one that varies: a list of loads that act is none, a range is."""
    return is_varied(value) and (name not in LISTS or isinstance(value, str))


def is_study(case: str | Path | CaseText) -> bool:
    """Whether a file is a case file with a range, or says that it is a study.

    False for what cannot be read, and for lists in a file that does not say so: ``Case`` explains both.
    """
    try:
        data = case.data if isinstance(case, CaseText) else read_case(case).data
    except InputError:
        return False
    sections = {name: section for name, section in data.items() if isinstance(section, dict) and name not in LISTS}
    values = ((f"{name}.{key}", value) for name, section in sections.items() for key, value in section.items())
    return data.get("study") is True or any(isinstance(v, str) and may_vary(name, v) for name, v in values)


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
            out.append(_varied(Place((section, key), name, label(name)), value))
    return checked(out)


def _ranges_of(sections: list[Any]) -> Iterator[tuple[int, str, object]]:
    """Ranges in the sections of a string: number, key and what was written."""
    for number, section in enumerate(sections, 1):
        for name, value in section.items() if isinstance(section, Mapping) else ():
            if is_varied(value):
                yield number, name, value


def _varied(place: Place, value: Any) -> Varied:
    if not isinstance(value, str):
        return varied_list(place, value)
    load = place.name in LISTS
    return varied_range(place, value, ALLOWED_LOAD, signed=True) if load else varied_range(place, value)

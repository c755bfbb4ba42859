"""The file of a well, read and checked value by value, with errors in the user's words."""

from __future__ import annotations

import difflib
import typing
from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ValidationError

from rodwell.case.case import CaseError
from rodwell.case.checks.explain import (
    LIST_OF_WELLS,
    MOST_PROBLEMS,
    RANGE_LIKE,
    RANGE_OF_WELLS,
    SIMILAR,
    STUDY_OF_WELLS,
    plain,
)
from rodwell.case.file import printable_data
from rodwell.case.well.schema import WellFile
from rodwell.errors import LONGEST_VALUE, InputError

LISTED = {"string": "[[string]]", "hole.section": "[[hole.section]]", "well.operation": "[[well.operation]]"}
"""Tables in double brackets, by their place."""

VARY = ("hole", "mud", "pressure", "well")
"""Sections of which keys may vary in a parameter study."""

ROAD_MAP = ("well", "road_map")
"""A section of lists that are lists."""

_ELSEWHERE = {
    "rod": "is not taken in the file of a well: the string stands in [[string]], a section for each pipe, from the bit "
    "up; `rodwell run` takes the file of one rod",
    "load": "is not taken in the file of a well: forces at the bit stand with each operation, well.operation.bit_force",
    "dimensionless": "is not taken in the file of a well: give [[string]] and [hole] with a survey",
    "analysis": "is not taken in the file of a well: leave it out",
    "operation": "is not a section; operations stand in [[well.operation]]",
    "road_map": "is not a section; it stands in [well.road_map]",
    "survey": "is not a section; name the file as hole.survey",
    "packer": "is not taken in the file of a well: `rodwell packer` has a file of its own",
}


def read_well(data: Mapping[str, Any], source: str) -> WellFile:
    """Return what the file of a well holds, each value checked on its own.

    Raises
    ------
    CaseError
        All that is wrong with it, one problem a line.
    """
    if not isinstance(data, Mapping):
        raise CaseError(source, [("well", data, "must be a dictionary of sections, as in the file of a well")])
    try:
        return WellFile.model_validate(printable_data(data))
    except ValidationError as error:
        raise CaseError(source, problems(error, data.get("study") is True)) from None


def problems(error: ValidationError, declared: bool = False) -> list[tuple[str, object, str]]:
    """What is wrong, in the user's words: (key, value, what to do). ``declared``: the file is a parameter study."""
    out = []
    for item in error.errors()[:MOST_PROBLEMS]:
        location = item["loc"]
        value = None if isinstance(item["input"], dict | list | tuple) else item["input"]
        if item["type"] == "extra_forbidden":
            out.append((named(location), value, _unknown(location)))
        elif item["type"] == "missing":
            out.append((named(location), None, "is missing; add it"))
        elif item["type"] in ("tuple_type", "list_type") and _table(location) in LISTED:
            out.append((named(location), value, f"must be a table in double brackets: {LISTED[_table(location)]}"))
        else:
            out.append((named(location), value, _reason(item) + _several(location, item["input"], declared)))
    return out


def _several(location: tuple[int | str, ...], value: object, declared: bool) -> str:
    """What to say of a list or a range where one value is asked for, beside what is wrong with it."""
    if isinstance(value, str):
        return RANGE_OF_WELLS if len(value) <= LONGEST_VALUE and RANGE_LIKE.search(value) else ""
    if not isinstance(value, list | tuple) or location[0] not in VARY or location[:2] == ROAD_MAP:
        return ""
    return STUDY_OF_WELLS if declared else LIST_OF_WELLS


def _reason(item: Any) -> str:
    kind, text = item["type"], item["msg"]
    if kind == "value_error":
        return str(text).removeprefix("Value error, ")
    words = {
        "model_type": "must be a section with keys below it", "int_type": "must be a whole number",
        "string_type": "must be text in quotes", "bool_type": "must be true or false, without quotes",
        "float_parsing": "must be a number", "float_type": "must be a number",
    }  # fmt: skip
    if kind in ("greater_than_equal", "less_than_equal"):
        bound = item["ctx"].get("ge", item["ctx"].get("le"))
        return f"must be {'at least' if kind.startswith('greater') else 'at most'} {bound}"
    return words.get(kind, str(text)[:1].lower() + str(text)[1:])


def _table(location: tuple[int | str, ...]) -> str:
    """Sections and key of a place, without numbers."""
    return ".".join(str(part) for part in location if isinstance(part, str))


def named(location: tuple[int | str, ...]) -> str:
    """How a place in the file is called: "[[string]] 2, length", "hole.diameter"."""
    for i, part in enumerate(location):
        if isinstance(part, int) and (table := _table(location[:i])) in LISTED:
            rest = _table(location[i + 1 :])
            return f"{LISTED[table]} {part + 1}" + (f", {rest}" if rest else "")
    return ".".join(str(part) for part in location)


def _model(location: tuple[int | str, ...]) -> type[BaseModel] | None:
    """The model that holds the last part of a location."""
    model: type[BaseModel] | None = WellFile
    for part in location[:-1]:
        if isinstance(part, int) or model is None:
            continue
        field = next((f for n, f in model.model_fields.items() if part in (n, f.alias)), None)
        model = None if field is None else _inner(field.annotation)
    return model


def _inner(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    found = (_inner(part) for part in typing.get_args(annotation))
    return next((one for one in found if one is not None), None)


def _unknown(location: tuple[int | str, ...]) -> str:
    key = str(location[-1])
    if len(location) == 1 and plain(key) in _ELSEWHERE:
        return _ELSEWHERE[plain(key)]
    model = _model(location)
    known = [] if model is None else [field.alias or name for name, field in model.model_fields.items()]
    near = difflib.get_close_matches(plain(key), known, n=1, cutoff=SIMILAR)
    return f"is not known; did you mean {near[0]!r}?" if near else f"is not known; allowed are {', '.join(known)}"


def in_file(source: str, error: InputError) -> CaseError:
    """An error about what does not fit together, with the name of the file."""
    return CaseError(source, [(error.field, error.value, error.reason)])

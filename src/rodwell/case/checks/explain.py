"""What is wrong in a case file, in the user's words."""

from __future__ import annotations

import difflib
import re

from pydantic import BaseModel, ValidationError

from rodwell.case import schema
from rodwell.case.about import ReportInput
from rodwell.case.checks.pointers import KEYS_ELSEWHERE, SECTIONS_ELSEWHERE
from rodwell.case.hole.schema import CylinderInput, Hole
from rodwell.case.hole.sections import HoleSectionInput
from rodwell.errors import LONGEST_VALUE

SECTIONS: dict[str, type[BaseModel]] = {
    "rod": schema.RodInput,
    "string": schema.StringInput,
    "hole": Hole,
    "hole.section": HoleSectionInput,
    "cylinder": CylinderInput,
    "supports": schema.Supports,
    "dimensionless": schema.Dimensionless,
    "load": schema.LoadInput,
    "analysis": schema.Analysis,
    "mud": schema.Mud,
    "pressure": schema.PressureAtEnd,
    "packer": schema.PackerInput,
    "catalogue": schema.CatalogueFiles,
    "report": ReportInput,
}
"""Sections of a case file."""

MOST_PROBLEMS = 40
"""As many as are explained at once; each explanation takes a moment."""

RANGE_LIKE = re.compile(r"\.\..*\sin\s+\S+\s*$")

SIMILAR, ALIKE = 0.55, 0.8
"""How alike a known key must be to be offered, and to be offered before a section that has the key as written."""

SHORTEST_PART = 4
"""Letters that a part of a key must have at least to be taken for it: yield for yield_strength."""

_LIST = (
    "; a list of values is a parameter study: declare it with study = true at the top of the file, before the first "
    "section (`rodwell {}` then computes one {} for each value)"
)
_RANGE = "; this is a range, a parameter study: compute it with `rodwell {}`, or give one value here"
_STUDY = "; the file is a parameter study: compute it with `rodwell {}`, or give one value here"
LIST, RANGE, STUDY = _LIST.format("run", "case"), _RANGE.format("run"), _STUDY.format("run")
LIST_OF_WELLS, RANGE_OF_WELLS, STUDY_OF_WELLS = (
    _LIST.format("drag", "well"),
    _RANGE.format("drag"),
    _STUDY.format("drag"),
)
TAPER = (
    "; a taper, or a string of several pipes, is written as one [[string]] for each section, of which one may go from "
    "outer_diameter to outer_diameter_at_top"
)
TAPERED = (
    "outer_diameter", "inner_diameter", "youngs_modulus", "bending_stiffness", "torsional_stiffness", "density",
    "weight_per_length", "poisson", "pipe", "material", "grade", "yield_strength",
)  # fmt: skip
"""Keys of [rod] of which a list may be meant as a taper."""


def explain(
    error: ValidationError, declared: bool = False, within: tuple[str | int, ...] = ()
) -> list[tuple[str, object, str]]:
    """Return validation errors in the user's words: (key, value, what to do).

    ``declared`` says that the file is a parameter study, ``within`` that what was validated is a section of it.
    """
    out: list[tuple[str, object, str]] = []
    for item in error.errors()[:MOST_PROBLEMS]:
        where = _where(item["loc"])
        if item["type"] == "extra_forbidden":
            value = None if isinstance(item["input"], dict | list) else item["input"]
            out.append((where, value, unknown((*within, *item["loc"]))))
        elif item["type"] == "missing":
            out.append((where, None, "is missing; add it"))
        else:
            location = (*within, *item["loc"])
            what = _reason(item["type"], item["msg"], where, location) + _several(location, item["input"], declared)
            out.append((where, item["input"], what))
    return out


def _where(location: tuple[int | str, ...]) -> str:
    """The key as it is named: "rod.length", "string 2.length", "hole.section 1.diameter"."""
    if location[:1] in (("string",), ("hole.section",)) and len(location) > 1:
        return ".".join([f"{location[0]} {int(location[1]) + 1}", *(str(part) for part in location[2:])])
    return ".".join(str(part) or "''" for part in location)


_WHOLE = "must be a whole number{bounds}"
_SECTION = "must be a section: write [{where}] with its keys below it"
REASONS = {
    "model_type": _SECTION,
    "model_attributes_type": _SECTION,
    "dict_type": _SECTION,
    "int": _WHOLE,
    "greater_than_equal": _WHOLE,
    "less_than_equal": _WHOLE,
    "float": "must be a number",
    "bool": "must be true or false, without quotes",
    "string_too_short": "must be a name, not empty",
    "string_too_long": "is too long for a name; write it as in the catalogue",
    "list": 'must be a list in square brackets, for example ["my-pipes.toml"]',
    "string": "must be text in quotes",
}
"""What is wrong with a value, by the beginning of the kind of pydantic's error."""


def _reason(kind: str, text: str, where: str, location: tuple[int | str, ...]) -> str:
    """What is wrong with a value, by the kind of pydantic's error; its own words for kinds that are not known."""
    if kind == "value_error":
        return text.removeprefix("Value error, ")
    known = next((words for start, words in REASONS.items() if kind.startswith(start)), None)
    if known is None:
        return text[:1].lower() + text[1:]
    return known.format(where=where, bounds=_bounds(location))


def _bounds(location: tuple[int | str, ...]) -> str:
    """From where to where a whole number may go: " from 1 to 12"; nothing for a key that is not known."""
    model = SECTIONS.get(str(location[0]))
    field = None if model is None else model.model_fields.get(str(location[-1]))
    found = {type(one).__name__: one for one in (field.metadata if field is not None else ())}
    least, most = getattr(found.get("Ge"), "ge", None), getattr(found.get("Le"), "le", None)
    return "" if least is None or most is None else f" from {least} to {most}"


def _several(location: tuple[int | str, ...], value: object, declared: bool) -> str:
    """What to say of a list or range where one value is asked for, beside what is wrong with it."""
    if len(location) != 2 or location[0] not in SECTIONS or location[0] in ("analysis", "catalogue"):
        return ""
    if isinstance(value, str):
        return RANGE if len(value) <= LONGEST_VALUE and RANGE_LIKE.search(value) else ""
    if not isinstance(value, list | tuple) or location[1] in ("until", "applied"):
        return ""
    return (STUDY if declared else LIST) + (TAPER if location[0] == "rod" and location[1] in TAPERED else "")


def unknown(location: tuple[int | str, ...]) -> str:
    """What to say of an unknown key or section: what is written instead, the nearest, or the section it belongs to."""
    if location[0] in ("string", "hole.section") and len(location) > 2:
        return _unknown_key(str(location[0]), str(location[2]))
    return (
        _unknown_section(str(location[0])) if len(location) == 1 else _unknown_key(str(location[0]), str(location[1]))
    )


def _unknown_section(key: str) -> str:
    known = list(schema.CaseFile.model_fields)
    if plain(key) in SECTIONS_ELSEWHERE:
        return SECTIONS_ELSEWHERE[plain(key)]
    for section, model in SECTIONS.items():
        if key in model.model_fields:
            return f"is not a section; it belongs into [{section}]"
    return _nearest(key, known)


def _unknown_key(section: str, key: str) -> str:
    if section not in SECTIONS:
        return _unknown_section(section)
    known = [field.alias or name for name, field in SECTIONS[section].model_fields.items()]
    if key in known:
        return "needs [rod] and [hole]: it has no meaning beside [dimensionless]"
    elsewhere = KEYS_ELSEWHERE.get("rod" if section == "string" else section, {})
    if plain(key) in elsewhere:
        return elsewhere[plain(key)]
    if not difflib.get_close_matches(key, known, n=1, cutoff=ALIKE):
        for other, model in SECTIONS.items():
            if key in model.model_fields:
                return f"does not belong into [{section}] but into [{other}]"
        if key in ("title", "units", "study"):
            return f"does not belong into [{section}] but to the top of the file, before the first section"
    return _nearest(key, known)


def plain(name: str) -> str:
    """Return a name as it is looked up: lower case, with underscores."""
    return name.strip().lower().replace("-", "_").replace(" ", "_")


def _nearest(key: str, known: list[str]) -> str:
    parts = [name for name in known if len(key) >= SHORTEST_PART and plain(key) in name.split("_")]
    near = parts if len(parts) == 1 else difflib.get_close_matches(key, known, n=1, cutoff=SIMILAR)
    if near:
        return f"is not known; did you mean {near[0]!r}?"
    return f"is not known; allowed are {', '.join(known)}"

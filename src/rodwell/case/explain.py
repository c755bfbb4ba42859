"""What is wrong in a case file, in the user's words."""

from __future__ import annotations

import difflib

from pydantic import BaseModel, ValidationError

from rodwell.case import schema

SECTIONS: dict[str, type[BaseModel]] = {
    "rod": schema.RodInput,
    "hole": schema.Hole,
    "cylinder": schema.CylinderInput,
    "supports": schema.Supports,
    "dimensionless": schema.Dimensionless,
    "load": schema.LoadInput,
    "analysis": schema.Analysis,
    "mud": schema.Mud,
    "pressure": schema.PressureAtEnd,
    "catalogue": schema.CatalogueFiles,
}
"""Sections of a case file."""

MOST_PROBLEMS = 40
"""As many as are explained at once; each explanation takes a moment."""


def explain(error: ValidationError, within: tuple[str, ...] = ()) -> list[tuple[str, object, str]]:
    """Return validation errors in the user's words: (key, value, what to do)."""
    out: list[tuple[str, object, str]] = []
    for item in error.errors()[:MOST_PROBLEMS]:
        where = ".".join(str(part) or "''" for part in item["loc"])
        value = item["input"]
        kind, text = item["type"], item["msg"]
        if kind == "extra_forbidden":
            out.append((where, None, _unknown((*within, *item["loc"]))))
        elif kind == "missing":
            out.append((where, None, "is missing; add it"))
        elif kind in ("model_type", "model_attributes_type", "dict_type"):
            out.append((where, value, f"must be a section: write [{where}] with its keys below it"))
        elif kind == "value_error":
            out.append((where, value, text.removeprefix("Value error, ")))
        elif kind.startswith("int") or kind in ("greater_than_equal", "less_than_equal"):
            out.append((where, value, f"must be a whole number from 1 to {schema.MOST_MODES}"))
        elif kind.startswith("float"):
            out.append((where, value, "must be a number"))
        elif kind == "string_too_short":
            out.append((where, value, "must be a name, not empty"))
        elif kind == "string_too_long":
            out.append((where, value, "is too long for a name; write it as in the catalogue"))
        elif kind.startswith("list"):
            out.append((where, value, 'must be a list in square brackets, for example ["my-pipes.toml"]'))
        elif kind.startswith("string"):
            out.append((where, value, "must be text in quotes"))
        else:
            out.append((where, value, text[:1].lower() + text[1:]))
    return out


def _unknown(location: tuple[int | str, ...]) -> str:
    """What to say of an unknown key: the nearest known one, or the section it belongs to."""
    key = str(location[-1])
    if len(location) == 1:
        known = list(schema.CaseFile.model_fields)
        for section, model in SECTIONS.items():
            if key in model.model_fields:
                return f"is not a section; it belongs into [{section}]"
    else:
        section = str(location[0])
        known = list(SECTIONS[section].model_fields)
        for other, model in SECTIONS.items():
            if other != section and key in model.model_fields:
                return f"does not belong into [{section}] but into [{other}]"
        if key in known:
            return "needs [rod] and [hole]: it has no meaning beside [dimensionless]"
    near = difflib.get_close_matches(key, known, n=1, cutoff=0.55)
    if near:
        return f"is not known; did you mean {near[0]!r}?"
    return f"is not known; allowed are {', '.join(known)}"

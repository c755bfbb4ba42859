"""Parts of a case that are read on their own, and the error that tells all that is wrong with one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from rodwell.case import schema
from rodwell.case.checks.explain import explain
from rodwell.case.hole.sections import HoleSectionInput, called, check_parts
from rodwell.errors import InputError, printable

MOST_LINES = 25
"""Problems that one message tells."""


class CaseError(InputError):
    """A case that cannot be used: all that is wrong with it, one problem a line."""

    def __init__(self, source: str, problems: list[tuple[str, object, str]]) -> None:
        self.problems = problems
        super().__init__(*problems[0])
        lines = [str(InputError(*problem)) for problem in problems[:MOST_LINES]]
        lines += [f"and {len(problems) - MOST_LINES} more"] if len(problems) > MOST_LINES else []
        self.args = (f"{printable(source)}: " + (lines[0] if len(lines) == 1 else "\n  " + "\n  ".join(lines)),)


def string_rod_of(given: Any, source: str) -> schema.StringRod:
    """[rod] beside [[string]]."""
    try:
        return schema.StringRod.model_validate(given)
    except ValidationError as error:
        problems = [(f"rod.{key}", value, what) for key, value, what in explain(error, within=("rod",))]
        raise CaseError(source, problems) from None


def split_hole(data: Mapping[str, Any], source: str) -> tuple[tuple[HoleSectionInput, ...], dict[str, Any]]:
    """[[hole.section]], and the data of a case without them."""
    hole = data.get("hole")
    if not isinstance(hole, Mapping) or "section" not in hole:
        return (), dict(data)
    check_parts(hole["section"])
    out, problems = [], []
    for number, part in enumerate(hole["section"]):
        try:
            out.append(HoleSectionInput.model_validate(part))
        except ValidationError as error:
            found = explain(error, within=("hole.section", number))
            problems += [(f"{called(number + 1)}.{key}", value, what) for key, value, what in found]
    if problems:
        raise CaseError(source, problems)
    return tuple(out), {**data, "hole": {key: value for key, value in hole.items() if key != "section"}}


def load_of(
    given: Mapping[str, Any], with_dimensions: bool, source: str
) -> schema.LoadInput | schema.DimensionlessLoad:
    """[load] in physical units beside [rod], in plain numbers beside [dimensionless]."""
    model = schema.LoadInput if with_dimensions else schema.DimensionlessLoad
    try:
        return model.model_validate(given)
    except ValidationError as error:
        explained = explain(error, within=("load",))
        problems = [(f"load.{key.partition('.')[0]}", value, what) for key, value, what in explained]
        raise CaseError(source, problems) from None


def load_problems(data: Mapping[str, Any]) -> list[tuple[str, object, str]]:
    """What is wrong in [load] of a file in which something else is wrong already."""
    given = data.get("load", {})
    if not isinstance(given, Mapping):
        return []
    try:
        load_of(given, "dimensionless" not in data or "rod" in data or "hole" in data, "")
    except CaseError as error:
        return error.problems
    return []


def named(field: str, compute: Any) -> Any:
    """Run a check and give its error the name that the user wrote."""
    try:
        return compute()
    except InputError as error:
        raise InputError(field, error.value, error.reason) from None

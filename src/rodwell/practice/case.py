"""A case: what the user has, read from a TOML file or a dictionary, checked, and made dimensionless."""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from rodwell.analysis.accuracy import checked_rtol
from rodwell.errors import InputError
from rodwell.practice import schema
from rodwell.practice.capacity import Cylinder, cylinder_of
from rodwell.practice.physical import physical_problem
from rodwell.practice.scales import Scales
from rodwell.practice.uncertainty import Moved, UncertainInput, split
from rodwell.problem import Problem, checked_ends

SECTIONS: dict[str, type[BaseModel]] = {
    "rod": schema.Rod,
    "hole": schema.Hole,
    "cylinder": schema.Cylinder,
    "dimensionless": schema.Dimensionless,
    "load": schema.Load,
    "analysis": schema.Analysis,
}


class CaseError(InputError):
    """A case that cannot be used: all that is wrong with it, one problem a line."""

    def __init__(self, source: str, problems: list[tuple[str, object, str]]) -> None:
        self.problems = problems
        super().__init__(*problems[0])
        lines = [str(InputError(*problem)) for problem in problems]
        self.args = (f"{source}: " + (lines[0] if len(lines) == 1 else "\n  " + "\n  ".join(lines)),)


@dataclass(frozen=True)
class Case:
    """A rod in a hole, ready to be computed.

    Attributes
    ----------
    title
        For the report.
    problem
        The dimensionless problem.
    scales
        How it was made dimensionless; None for a case given without dimensions.
    modes
        Number of buckling modes to compute and follow.
    until
        End force at which branches end, in B/L² (tension positive); None: chosen from the loads found.
    rtol
        Relative tolerance of every reported number.
    given
        The inputs as they were written, section by section.
    source
        File name, or "case".
    text
        The file as it was read.
    cylinder
        Section and strength of the cylinder, if given.
    uncertain
        Inputs that were given with "±", and what becomes of the problem if they move.
    """

    title: str
    problem: Problem
    scales: Scales | None
    modes: int
    until: float | None
    rtol: float
    given: Mapping[str, Any]
    source: str = "case"
    text: str = ""
    cylinder: Cylinder | None = None
    uncertain: tuple[UncertainInput, ...] = ()

    @classmethod
    def read(cls, path: str | Path) -> Case:
        """Read a case file.

        Raises
        ------
        CaseError
            Naming the key, what is allowed and what to do, for everything that is wrong with the file.
        InputError
            If the file cannot be read.
        """
        file = Path(path)
        try:
            text = file.read_text(encoding="utf-8-sig")
        except FileNotFoundError:
            near = difflib.get_close_matches(file.name, _siblings(file), n=1)
            hint = f"; did you mean {str(file.with_name(near[0]))!r}?" if near else ""
            raise InputError("case file", str(file), f"does not exist{hint}") from None
        except IsADirectoryError:
            raise InputError("case file", str(file), "is a folder; name a TOML file in it") from None
        except UnicodeDecodeError:
            raise InputError("case file", str(file), "is not text in UTF-8; case files are TOML") from None
        except (OSError, ValueError) as problem:
            reason = getattr(problem, "strerror", None) or str(problem)
            raise InputError("case file", str(file), f"cannot be read: {reason}") from None
        try:
            data = tomllib.loads(text)
        except tomllib.TOMLDecodeError as problem:
            hint = '; quantities and text stand in quotes, for example length = "30 m"'
            raise InputError("case file", str(file), f"is not valid TOML: {problem}{hint}") from None
        except (ValueError, RecursionError):
            raise InputError("case file", str(file), "is not valid TOML: a number or a nesting too large") from None
        return cls.from_dict(data, source=file.name, text=text)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any], *, source: str = "case", text: str = "") -> Case:
        """Make a case from the content of a case file as a dictionary; errors as in :meth:`read`."""
        if not isinstance(data, Mapping):
            raise CaseError(source, [("case", data, "must be a dictionary of sections, as in a case file")])
        try:
            clean, moved = split(data)
            case = cls._certain(clean, source, text)
        except CaseError:
            raise
        except InputError as problem:
            value = _as_written(data, problem.field, problem.value)
            raise CaseError(source, [(problem.field, value, problem.problem)]) from None
        inputs = tuple(_uncertain(data, clean, *key, pair) for key, pair in moved.items())
        return replace(case, uncertain=inputs, given={k: v for k, v in data.items() if k != "title"})

    @classmethod
    def _certain(cls, data: Mapping[str, Any], source: str, text: str) -> Case:
        """A case from data without uncertainties."""
        try:
            parsed = schema.CaseFile.model_validate(dict(data))
        except ValidationError as problem:
            raise CaseError(source, _explain(problem)) from None
        return _assemble(parsed, data, source, text)


def _uncertain(
    data: Mapping[str, Any], clean: Mapping[str, Any], section: str, key: str, pair: tuple[Any, Any]
) -> UncertainInput:
    """What becomes of the case as one input moves by its uncertainty down and up."""
    sides: list[Moved | None] = []
    for value in pair:
        try:
            case = Case._certain({**clean, section: {**clean[section], key: value}}, "case", "")
            sides.append((case.problem, case.scales))
        except InputError:
            sides.append(None)
    if sides == [None, None]:
        raise CaseError("case", [(f"{section}.{key}", data[section][key], "moves out of what is allowed either way")])
    return UncertainInput(f"{section}.{key}", str(data[section][key]), *sides)


def _as_written(data: Mapping[str, Any], field: str, value: object) -> object:
    """What the user wrote for a key, rather than what became of it; None stays None."""
    section, _, key = field.partition(".")
    written = data.get(section)
    return written[key] if value is not None and isinstance(written, Mapping) and key in written else value


def _siblings(file: Path) -> list[str]:
    try:
        return [p.name for p in file.parent.iterdir() if p.suffix == ".toml"]
    except OSError:
        return []


def _explain(error: ValidationError, within: tuple[str, ...] = ()) -> list[tuple[str, object, str]]:
    """Validation errors in the user's words: (key, value, what to do)."""
    out: list[tuple[str, object, str]] = []
    for item in error.errors():
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
    near = difflib.get_close_matches(key, known, n=1, cutoff=0.55)
    if near:
        return f"is not known; did you mean {near[0]!r}?"
    return f"is not known; allowed are {', '.join(known)}"


def _assemble(parsed: schema.CaseFile, data: Mapping[str, Any], source: str, text: str) -> Case:
    physical = parsed.rod is not None or parsed.hole is not None
    if physical and parsed.dimensionless is not None:
        raise InputError("dimensionless", None, "cannot stand beside [rod] and [hole]: give one or the other")
    if not physical and parsed.dimensionless is None:
        raise InputError("rod", None, "is missing: give [rod] and [hole], or [dimensionless]")
    load = _load(parsed.load, physical, source)
    if physical:
        problem, scales = physical_problem(parsed.rod, parsed.hole, load.twist)
        until = None if load.until is None else load.until / scales.factor("force")
    else:
        problem, scales, until = _dimensionless(parsed.dimensionless, load.twist), None, load.until
    if until is not None and not math.isfinite(until):
        raise InputError("load.until", load.until, "must be finite")
    return Case(
        title=parsed.title,
        problem=problem,
        scales=scales,
        modes=parsed.analysis.modes,
        until=until,
        rtol=_named("analysis.rtol", lambda: checked_rtol(parsed.analysis.rtol)),
        given={k: v for k, v in data.items() if k != "title"},
        source=source,
        text=text,
        cylinder=_cylinder(parsed),
    )


def _cylinder(parsed: schema.CaseFile) -> Cylinder | None:
    if parsed.cylinder is None:
        return None
    if parsed.hole is None:
        raise InputError("cylinder", None, "needs [rod] and [hole]: a dimensionless case has no stresses")
    return cylinder_of(parsed.cylinder, parsed.hole)


def _load(given: Mapping[str, Any], physical: bool, source: str) -> schema.Load | schema.DimensionlessLoad:
    """[load] in physical units beside [rod], in plain numbers beside [dimensionless]."""
    model = schema.Load if physical else schema.DimensionlessLoad
    try:
        return model.model_validate(given)
    except ValidationError as error:
        found = [(f"load.{key}", value, what) for key, value, what in _explain(error, within=("load",))]
        raise CaseError(source, found) from None


def _named(field: str, compute: Any) -> Any:
    """Run a check and give its error the name that the user wrote."""
    try:
        return compute()
    except InputError as problem:
        raise InputError(field, problem.value, problem.problem) from None


def _dimensionless(given: schema.Dimensionless | None, twist: float) -> Problem:
    assert given is not None
    try:
        return Problem(
            weight=given.weight,
            alpha=given.alpha,
            clearance=given.clearance,
            poisson=given.poisson,
            twist=twist,
            ends=checked_ends(given.ends),
        )
    except InputError as problem:
        section = "load" if problem.field == "twist" else "dimensionless"
        raise InputError(f"{section}.{problem.field}", problem.value, problem.problem) from None

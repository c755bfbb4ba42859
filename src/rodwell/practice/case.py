"""A case: what the user has, read from a TOML file or a dictionary, checked, and made dimensionless."""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from rodwell.analysis.accuracy import checked_rtol
from rodwell.errors import InputError
from rodwell.practice import schema
from rodwell.practice.scales import Scales
from rodwell.problem import Problem

SECTIONS: dict[str, type[BaseModel]] = {
    "rod": schema.Rod,
    "hole": schema.Hole,
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
            parsed = schema.CaseFile.model_validate(dict(data))
        except ValidationError as problem:
            raise CaseError(source, _explain(problem)) from None
        try:
            return _assemble(parsed, data, source, text)
        except CaseError:
            raise
        except InputError as problem:
            value = _as_written(data, problem.field, problem.value)
            raise CaseError(source, [(problem.field, value, problem.problem)]) from None


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
        problem, scales = _physical(parsed.rod, parsed.hole, load.twist)
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
    )


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
        )
    except InputError as problem:
        section = "load" if problem.field == "twist" else "dimensionless"
        raise InputError(f"{section}.{problem.field}", problem.value, problem.problem) from None


def _physical(rod: schema.Rod | None, hole: schema.Hole | None, twist: float) -> tuple[Problem, Scales]:
    if rod is None:
        raise InputError("rod", None, "is missing: a case with [hole] needs [rod]")
    if hole is None:
        raise InputError("hole", None, "is missing: a case with [rod] needs [hole]")
    stiffness = _stiffness(rod)
    weight = _weight_per_length(rod, hole.gravity)
    clearance = _clearance(rod, hole)
    if clearance >= rod.length:
        raise InputError(
            "hole.clearance" if hole.clearance else "hole.diameter",
            hole.clearance or hole.diameter,
            f"leaves a clearance of {clearance:g} m, which must be below the rod's length of {rod.length:g} m",
        )
    scales = Scales(rod.length, stiffness)
    try:
        problem = Problem(
            weight=weight / scales.factor("force_per_length"),
            alpha=_angle(hole),
            clearance=clearance / rod.length,
            poisson=rod.poisson,
            twist=twist / scales.factor("moment"),
        )
    except InputError as found:
        names = {
            "weight": "rod.length",
            "poisson": "rod.poisson",
            "twist": "load.twist",
            "clearance": "hole.diameter",
        }
        name = names.get(found.field, found.field)
        what = found.problem
        if found.field == "weight":
            what = (
                f"makes γ = mg L³/B = {weight / scales.factor('force_per_length'):g}, which {what}: check the units of "
            )
            what += "length, weight or density, stiffness or diameters, and gravity"
        raise InputError(name, None if found.field == "weight" else found.value, what) from None
    return problem, scales


def _area_and_inertia(rod: schema.Rod, reason: str) -> tuple[float, float]:
    if rod.outer_diameter is None:
        raise InputError("rod.outer_diameter", None, f"is missing: it is needed {reason}")
    outer, inner = rod.outer_diameter, rod.inner_diameter or 0.0
    if inner >= outer:
        raise InputError("rod.inner_diameter", inner, f"must be below the outer diameter of {outer:g} m")
    return math.pi / 4.0 * (outer**2 - inner**2), math.pi / 64.0 * (outer**4 - inner**4)


def _stiffness(rod: schema.Rod) -> float:
    if rod.bending_stiffness is not None:
        if rod.youngs_modulus is not None:
            raise InputError("rod.bending_stiffness", None, "contradicts rod.youngs_modulus: give only one of the two")
        return rod.bending_stiffness
    if rod.youngs_modulus is None:
        raise InputError("rod.youngs_modulus", None, "is missing: give it, or rod.bending_stiffness")
    return rod.youngs_modulus * _area_and_inertia(rod, "with rod.youngs_modulus")[1]


def _weight_per_length(rod: schema.Rod, gravity: float) -> float:
    if rod.weight_per_length is not None:
        if rod.density is not None:
            raise InputError("rod.weight_per_length", None, "contradicts rod.density: give only one of the two")
        return rod.weight_per_length
    if rod.density is None:
        raise InputError("rod.density", None, "is missing: give it, or rod.weight_per_length (may be 0 N/m)")
    return rod.density * _area_and_inertia(rod, "with rod.density")[0] * gravity


def _clearance(rod: schema.Rod, hole: schema.Hole) -> float:
    if hole.clearance is not None:
        if hole.diameter is not None:
            raise InputError("hole.clearance", None, "contradicts hole.diameter: give only one of the two")
        return hole.clearance
    if hole.diameter is None:
        raise InputError("hole.diameter", None, "is missing: give it, or hole.clearance (from axis to axis)")
    if rod.outer_diameter is None:
        raise InputError("rod.outer_diameter", None, "is missing: it is needed with hole.diameter")
    if rod.outer_diameter >= hole.diameter:
        raise InputError(
            "hole.diameter",
            hole.diameter,
            f"must be above the rod's outer diameter of {rod.outer_diameter:g} m: the rod does not fit",
        )
    return 0.5 * (hole.diameter - rod.outer_diameter)


def _angle(hole: schema.Hole) -> float:
    angles = {
        "angle_from_vertical": hole.angle_from_vertical,
        "angle_from_horizontal": hole.angle_from_horizontal,
    }
    given = [(name, value) for name, value in angles.items() if value is not None]
    if len(given) != 1:
        raise InputError(
            "hole.angle_from_vertical",
            None,
            "is missing: give it or hole.angle_from_horizontal"
            if not given
            else "contradicts hole.angle_from_horizontal: give only one of the two",
        )
    name, value = given[0]
    degrees = round(math.degrees(value), 12)  # "90 deg" makes its way through radians
    if not 0.0 <= degrees <= 90.0:
        raise InputError(f"hole.{name}", f"{degrees:g} deg", 'must be from "0 deg" to "90 deg"')
    return degrees if name == "angle_from_vertical" else 90.0 - degrees

"""Parameter studies: a case file with lists or ranges, computed point by point."""

from __future__ import annotations

import itertools
import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rodwell.analysis.branches import Branch
from rodwell.analysis.critical import critical_loads
from rodwell.analysis.fields import ZOOMS
from rodwell.analysis.follow import follow
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.ladder import estimated_error
from rodwell.practice.case import Case, CaseError
from rodwell.practice.limits import uses
from rodwell.practice.loaded import LoadedRod
from rodwell.practice.units import SI, System
from rodwell.practice.varied import LISTS, Varied, is_varied, varied_inputs

Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class Result:
    """A number of one point in units B = L = 1, with its error estimate."""

    value: float
    error: float


@dataclass(frozen=True)
class Point:
    """One case of a study.

    Attributes
    ----------
    number
        Its number, from 0.
    at
        Numbers of the values that the varied inputs take.
    case
        The case; None if the inputs do not make one.
    critical
        First critical load: end force at s = 1, tension positive.
    half_waves
        Number of half waves of its mode, √(∫y''²/∫y'²)/π.
    lift_off
        Lift-off load of the first mode: end force at s = 1, tension positive; in a vertical cylinder it is buckling.
    places
        s/L of the places that lift off.
    contact
        Largest contact force per length at lift-off; None where lift-off coincides with buckling.
    used
        Parts used at lift-off of the strengths that the case tells of, 1 is all: of the rod ("yield"), of the cylinder
        and of the most loaded support, by kind.
    reasons
        Why results are missing, by name: "case", "critical", "lift_off", "contact".
    """

    number: int
    at: tuple[int, ...]
    case: Case | None
    critical: Result | None = None
    half_waves: float | None = None
    lift_off: Result | None = None
    places: tuple[float, ...] = ()
    contact: Result | None = None
    used: Mapping[str, Result] = field(default_factory=dict)
    reasons: Mapping[str, str] | None = None

    def factor(self, dimension: str) -> float:
        """SI value of one dimensionless unit of this point; 1 without dimensions."""
        if self.case is None or self.case.scales is None:
            return 1.0
        return self.case.scales.factor(dimension)

    def compression(self, name: str, bottom: bool = False) -> tuple[float, float] | None:
        """Compression at "critical" or "lift_off", **positive**, and its error, in N (or B/L²).

        At s = 1, where the end force acts, or at the ``bottom``, s = 0.
        """
        found: Result | None = getattr(self, name)
        if found is None or self.case is None:
            return None
        unit = self.factor("force")
        extra = self.case.problem.axial_weight if bottom else 0.0
        return (extra - found.value) * unit, found.error * unit


@dataclass(frozen=True)
class Study:
    """What :func:`study` found.

    Attributes
    ----------
    title, source, text
        As in :class:`rodwell.Case`.
    given
        The inputs as written.
    varied
        One or two inputs that vary.
    points
        All points; the last input varies fastest.
    """

    title: str
    source: str
    text: str
    given: Mapping[str, Any]
    varied: tuple[Varied, ...]
    points: tuple[Point, ...]

    @property
    def system(self) -> System:
        """The units in which results are shown."""
        found = (p.case.scales for p in self.points if p.case is not None and p.case.scales is not None)
        return next((scales.system for scales in found), SI)

    @property
    def physical(self) -> bool:
        """Whether the cases have dimensions."""
        return any(point.case is not None and point.case.scales is not None for point in self.points)

    def worst(self, name: str = "critical") -> Point | None:
        """The point with the least compression at s = 1 at "critical" or "lift_off"; None if none has one.

        Physical forces are compared, in N, since the unit B/L² may differ from point to point.
        """
        found = [(load[0], point) for point in self.points if (load := point.compression(name)) is not None]
        return min(found, key=lambda pair: pair[0])[1] if found else None

    @property
    def incomplete(self) -> tuple[Point, ...]:
        """Points that lack a result; their ``reasons`` say why."""
        return tuple(point for point in self.points if point.reasons)

    def inputs(self, point: Point) -> str:
        """The varied inputs of a point in words."""
        return ", ".join(f"{v.name} = {v.text(i)}" for v, i in zip(self.varied, point.at, strict=True))

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain data, for JSON."""
        from rodwell.practice.study_data import study_dict  # noqa: PLC0415

        return study_dict(self)


def study(case: str | Path | Mapping[str, Any], progress: Progress | None = None, *, units: str | None = None) -> Study:
    """Compute a parameter study: a case in which one or two inputs are lists or ranges.

    Parameters
    ----------
    case
        Path of a case file, or its content as a dictionary. A list holds values as the case file would have them
        (``["30 deg", "45 deg"]``, ``[10, 20]``); a range is a text ("30..90 deg in 13": 13 values, both ends
        included). Two inputs make a grid.
    progress
        Called with what is being done and how much is done.
    units
        "si", "field" or "mm": the units in which results are shown; by default those of the case. Tables as files are
        in SI.

    Raises
    ------
    InputError
        If nothing varies, more than two inputs do, there are too many points, a range cannot be read, or the inputs
        are wrong at every point. Where they are wrong at some, those points say so and the others are computed.
    """
    data, source, text = _read(case)
    try:
        varied = varied_inputs(data)
    except InputError as problem:
        raise CaseError(source, [(problem.field, problem.value, problem.problem)]) from None
    if not varied:
        raise CaseError(
            source, [("study", None, 'has no input that varies: give one a list, or a range "30..90 deg in 13"')]
        )
    tell = progress or (lambda _what, _done: None)
    grid = list(itertools.product(*(range(len(v.values)) for v in varied)))
    folder = Path.cwd() if isinstance(case, Mapping) else Path(case).parent
    cases = [_case(data, varied, at, source, folder, units) for at in grid]
    if all(isinstance(found, InputError) for found in cases):
        raise cases[0]  # type: ignore[misc]
    points = []
    for number, (at, found) in enumerate(zip(grid, cases, strict=True)):
        tell(f"point {number + 1} of {len(grid)}", number / len(grid))
        if isinstance(found, Case):
            points.append(_computed(number, at, found))
        else:
            points.append(Point(number, at, None, reasons={"case": str(found)}))
    tell("done", 1.0)
    title = str(data.get("title", "Untitled study"))
    return Study(title, source, text, {k: v for k, v in data.items() if k != "title"}, varied, tuple(points))


def is_study(path: Path) -> bool:
    """Whether a file is a case file with a list or range; False for what cannot be read, which ``Case`` explains."""
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError):
        return False
    sections = {name: section for name, section in data.items() if isinstance(section, dict) and name not in LISTS}
    values = ((f"{name}.{key}", value) for name, section in sections.items() for key, value in section.items())
    return any(is_varied(value) for name, value in values if name not in LISTS)


def _read(case: str | Path | Mapping[str, Any]) -> tuple[Mapping[str, Any], str, str]:
    if isinstance(case, Mapping):
        return case, "study", ""
    if not isinstance(case, str | Path):
        raise InputError("case", case, "must be the path of a case file, or its content as a dictionary")
    path = Path(case)
    try:
        text = path.read_text(encoding="utf-8-sig")
        return tomllib.loads(text), path.name, text
    except (OSError, ValueError, RecursionError):
        Case.read(path)  # says what is wrong
        raise


def _case(
    data: Mapping[str, Any],
    varied: tuple[Varied, ...],
    at: tuple[int, ...],
    source: str,
    folder: Path,
    units: str | None,
) -> Case | InputError:
    """The case of one point, or what is wrong with it."""
    single: dict[str, Any] = {k: dict(v) if isinstance(v, Mapping) else v for k, v in data.items()}
    for one, i in zip(varied, at, strict=True):
        single[one.section][one.key] = one.values[i]
    try:
        return Case.from_dict(single, source=source, folder=folder).in_units(units)
    except InputError as problem:
        return problem


def _computed(number: int, at: tuple[int, ...], case: Case) -> Point:
    """Critical load, lift-off and largest contact force of one case; reasons for what is missing."""
    try:
        mode = critical_loads(case.problem, 1, rtol=case.rtol)[0]
    except NotConvergedError as problem:
        why = str(problem)
        return Point(
            number, at, case, reasons={"critical": why, "lift_off": "no critical load", "contact": "no lift-off"}
        )
    critical, waves = Result(mode.force, mode.error), mode.wavenumber / math.pi
    reasons: dict[str, str] = {}
    lift_off = contact = None
    places: tuple[float, ...] = ()
    try:
        branch = follow(case.problem, mode, rtol=case.rtol)
        lift_off, places, contact = _at_lift_off(branch, reasons)
        used = {} if contact is None else _used(case, branch)
    except (InputError, NotConvergedError) as problem:
        reasons, used = {"lift_off": str(problem), "contact": "no lift-off"}, {}
    return Point(number, at, case, critical, waves, lift_off, places, contact, used, reasons or None)


def _used(case: Case, branch: Branch) -> dict[str, Result]:
    """Parts of the strengths used at lift-off, with errors from the two meshes."""
    assert branch.lift_off is not None
    lift = branch.lift_off
    state = LoadedRod("at lift-off", case.problem, lift.force, lift.error, lift.solution)
    out = {}
    for use in uses(case):
        coarse, fine = (use.size(mesh, ZOOMS)[0] for mesh in state.along)
        out[use.kind] = Result(fine, float(estimated_error(fine, coarse)))
    return out


def _at_lift_off(branch: Branch, reasons: dict[str, str]) -> tuple[Result | None, tuple[float, ...], Result | None]:
    lift = branch.lift_off
    if lift is None:
        reasons.update(lift_off=f"was not found: {branch.ended_because}", contact="no lift-off")
        return None, (), None
    found = Result(lift.force, lift.error)
    if branch.lift_off_at_buckling:
        reasons["contact"] = "lift-off coincides with buckling: no lateral weight"
        return found, lift.s, None
    if not branch.converged:
        reasons["lift_off"] = (
            "the branch to it does not meet the tolerance everywhere: its error says how well it is known"
        )
    peak = lift.solution.wall.contact
    return found, lift.s, Result(peak.value, peak.error)

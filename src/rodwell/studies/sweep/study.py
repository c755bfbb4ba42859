"""Parameter studies: a case file with lists or ranges, computed point by point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rodwell.case.case import Case
from rodwell.errors import InputError
from rodwell.faces import plain
from rodwell.quantities.units import SI, System
from rodwell.studies.given import Given, grid_of, in_words, read_given, what_varies
from rodwell.studies.sweep.points import StudyPoint, computed, computed_point, followed_to_loads
from rodwell.studies.sweep.varied import check_declared, varied_inputs
from rodwell.studies.varied import Varied

APPLIED = "load.applied"

Progress = Callable[[str, float], None]


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
    points: tuple[StudyPoint, ...]

    @property
    def system(self) -> System:
        """The units in which results are shown."""
        return next((point.scales.system for point in self.points if point.scales is not None), SI)

    @property
    def physical(self) -> bool:
        """Whether the cases have dimensions."""
        return any(point.scales is not None for point in self.points)

    def worst(self, name: str = "critical") -> StudyPoint | None:
        """The point with the least compression at s = 1 at "critical" or "lift_off"; None if none has one.

        Physical forces are compared, in N, since the unit B/L² may differ from point to point.
        """
        loads = [(load.value, point) for point in self.points if (load := point.compression(name)) is not None]
        return min(loads, key=lambda pair: pair[0])[1] if loads else None

    @property
    def incomplete(self) -> tuple[StudyPoint, ...]:
        """Points that lack a result; their ``reasons`` say why."""
        return tuple(point for point in self.points if point.reasons)

    def inputs(self, point: StudyPoint) -> str:
        """The varied inputs of a point in words."""
        return in_words(self.varied, point.at)

    @property
    def load_varies(self) -> bool:
        """Whether ``load.applied`` varies, which changes neither the critical load nor lift-off."""
        return any(varied.name == APPLIED for varied in self.varied)

    def rod_inputs(self, point: StudyPoint) -> str:
        """The varied inputs of a point that change its critical load and lift-off, in words; may be empty."""
        pairs = zip(self.varied, point.at, strict=True)
        return ", ".join(f"{v.called} {v.text(i)}" for v, i in pairs if v.name != APPLIED)

    @property
    def rods(self) -> tuple[StudyPoint, ...]:
        """A point for each combination of the inputs other than the load, one that was computed if there is one."""
        rods: dict[tuple[int, ...], StudyPoint] = {}
        for point in self.points:
            key = tuple(i for v, i in zip(self.varied, point.at, strict=True) if v.name != APPLIED)
            if key not in rods or (rods[key].critical is None and point.critical is not None):
                rods[key] = point
        return tuple(rods.values())

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain data, for JSON."""
        return plain(self)


def study(case: Given, progress: Progress | None = None, *, units: str | None = None) -> Study:
    """Compute a parameter study: a case in which one or two inputs are lists or ranges.

    Parameters
    ----------
    case
        Path of a case file ("-": standard input), or its content as a dictionary. A list holds values as the case file
        would have them (``["30 deg", "45 deg"]``, ``[10, 20]``); a range is a text ("30..90 deg in 13": 13 values, both
        ends included). Two inputs make a grid. A file in which lists stand for several cases must say so, with
        ``study = true`` at its top: a list may as well be meant as a taper.
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
    read = read_given(case, "case", "a case file")
    data, source = read.data, read.source
    declared = None if isinstance(case, Mapping) else check_declared
    varied = what_varies(read, declared, varied_inputs, ' "30..90 deg in 13"')
    tell = progress or (lambda _what, _done: None)
    grid = grid_of(varied)
    cases = [_case(data, varied, at, source, read.folder, units) for at in grid]
    if all(isinstance(case, InputError) for case in cases):
        raise cases[0]  # type: ignore[misc]
    points = _points(grid, cases, tell)
    tell("done", 1.0)
    title = str(data.get("title") or (Path(source).stem if read.text else "Parameter study"))
    return Study(
        title, source, read.text, {k: v for k, v in data.items() if k not in ("title", "study")}, varied, points
    )


def _points(grid: list[tuple[int, ...]], cases: list[Case | InputError], tell: Progress) -> tuple[StudyPoint, ...]:
    """All points in their order; those that differ in loads or strengths only share what is computed once."""
    same: dict[Any, list[int]] = {}
    for number, case in enumerate(cases):
        same.setdefault((case.problem, case.rtol) if isinstance(case, Case) else number, []).append(number)
    points: list[StudyPoint] = []
    for numbers in same.values():
        shared = None
        for number in numbers:
            tell(f"point {number + 1} of {len(grid)}", len(points) / len(grid))
            case = cases[number]
            if not isinstance(case, Case):
                points.append(StudyPoint(number, grid[number], None, reasons={"case": str(case)}))
                continue
            shared = followed_to_loads(computed(case) if shared is None else shared, case)
            points.append(computed_point(number, grid[number], case, shared))
    return tuple(sorted(points, key=lambda point: point.number))


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
    for v, i in zip(varied, at, strict=True):
        v.place.put(single, v.values[i])
    try:
        return Case.from_dict(single, source=source, folder=folder).in_units(units)
    except InputError as error:
        return error

"""Parameter studies of torque and drag: the file of a well in which one or two inputs are lists or ranges."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from rodwell.case.file import CaseText
from rodwell.errors import InputError, NotConvergedError
from rodwell.faces import plain
from rodwell.studies.drag.drag import drag
from rodwell.studies.drag.sweep.points import OperationAt, WellPoint, operation_at
from rodwell.studies.drag.sweep.varied import check_declared, is_study, varied_inputs
from rodwell.studies.drag.well_case import Well
from rodwell.studies.drag.words import unbalanced
from rodwell.studies.given import Given, grid_of, in_words, read_given, what_varies
from rodwell.studies.varied import Varied

Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class DragStudy:
    """What :func:`drag_study` found.

    Attributes
    ----------
    well
        The well of the first point that could be read: title, path, units.
    given
        The inputs as written.
    varied
        One or two inputs that vary.
    points
        All points; the last input varies fastest.
    """

    well: Well
    given: Mapping[str, Any]
    varied: tuple[Varied, ...]
    points: tuple[WellPoint, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the operations, in the order of the file."""
        return tuple(one.name for one in self.well.operations)

    def inputs(self, point: WellPoint) -> str:
        """The varied inputs of a point in words."""
        return in_words(self.varied, point.at)

    @property
    def pushed(self) -> bool:
        """Whether anything pushes at surface, at any point."""
        return any(point.push > 0.0 for point in self.points)

    def results(self, number: int) -> tuple[tuple[WellPoint, OperationAt], ...]:
        """An operation, counted from 0, at every point that was computed."""
        return tuple((point, point.operations[number]) for point in self.points if point.operations)

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain data, for JSON."""
        return plain(self)


def is_well_study(well: CaseText) -> bool:
    """Whether the file of a well has a range, or says that it is a study; False for what cannot be read."""
    try:
        return is_study(well.data)
    except InputError:
        return False


def drag_study(well: Given, progress: Progress | None = None, *, units: str | None = None) -> DragStudy:
    """Compute every operation of a well for every value, or pair of values, of what varies in its file.

    Parameters
    ----------
    well
        Path of the file of a well, or its content as a dictionary. A list holds values as the file would have them
        (``["100 kN", "200 kN"]``, ``[0.2, 0.3]``); a range is a text ("0.1..0.4 in 7": 7 values, both ends included).
        Two inputs make a grid. A file with lists must say ``study = true`` at its top. What may vary: keys of [hole]
        but those of its path, of [[hole.section]], [mud], [pressure], [well] and [[well.operation]]. A road map is left
        out.
    progress
        Called with what is being done and how much is done.
    units
        "si", "field" or "mm": the units in which results are shown; by default those of the file.

    Raises
    ------
    InputError
        If nothing varies, more than two inputs do, there are too many points, a range cannot be read, or the inputs
        are wrong at every point. Where they are wrong at some, those points say so and the others are computed.
    """
    read = read_given(well, "well", "the file of a well")
    declared = None if isinstance(well, Mapping) else check_declared
    varied = what_varies(read, declared, varied_inputs, ', friction = "0.1..0.4 in 7"')
    tell = progress or (lambda _what, _done: None)
    grid = grid_of(varied)
    first: Well | None = None
    points: list[WellPoint] = []
    errors: list[InputError] = []
    for number, at in enumerate(grid):
        tell(f"point {number + 1} of {len(grid)}", number / len(grid))
        try:
            one = _well(read, varied, at, first).in_units(units)
            first = first or one
            points.append(_computed(number, at, one))
        except InputError as error:
            errors.append(error)
            points.append(WellPoint(number, at, reason=str(error)))
    if first is None or len(errors) == len(grid):
        raise errors[0]
    tell("done", 1.0)
    given = {k: v for k, v in read.data.items() if k not in ("title", "study", "units")}
    return DragStudy(first, given, varied, tuple(points))


def _well(read: CaseText, varied: tuple[Varied, ...], at: tuple[int, ...], first: Well | None) -> Well:
    """The well of one point, without a road map; the survey is read once."""
    data = copy.deepcopy(dict(read.data))
    for v, i in zip(varied, at, strict=True):
        v.place.put(data, v.values[i])
    survey = None if first is None else first.survey
    well = Well.from_dict(data, survey=survey, source=read.source, text=read.text, folder=read.folder)
    return replace(well, settings=well.settings.model_copy(update={"road_map": None}))


def _computed(number: int, at: tuple[int, ...], well: Well) -> WellPoint:
    """Results of one point; what could not be computed says why."""
    try:
        found = drag(well)
    except NotConvergedError as error:
        return WellPoint(number, at, reason=str(error))
    operations = tuple(operation_at(well, one) for one in found.operations)
    return WellPoint(number, at, operations, well.push, tuple(unbalanced(found)))

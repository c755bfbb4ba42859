"""A well, ready to be computed: string, hole, fluids and operations, read from a file or a dictionary."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from rodwell.case.about import NOBODY, About, about_of
from rodwell.case.catalogue import package_catalogue, read_catalogue
from rodwell.case.checks.signs import unsigned
from rodwell.case.file import CaseText, read_case
from rodwell.case.well import schema
from rodwell.case.well.file import in_file, named, read_well
from rodwell.case.well.hole_sections import HoleSection, hole_sections, key_of_hole
from rodwell.case.well.string_sections import StringSection, string_sections
from rodwell.errors import InputError
from rodwell.quantities.units import SI, SYSTEMS, System
from rodwell.survey.survey import Survey

ROTATING = ("rotate-off-bottom", "drill", "ream", "back-ream")
UPWARD = ("pull-out", "back-ream")
DOWNWARD = ("run-in", "slide", "drill", "ream")

CLOSE_FIT = 1e-6
"""Clearance below this part of the hole's diameter is none."""


@dataclass(frozen=True)
class Operation:
    """What is done with the string.

    Attributes
    ----------
    name, kind
        What it is called; one of :data:`rodwell.case.well.schema.KINDS_OF_OPERATION`.
    bit_depth
        Measured depth of the bit in m.
    bit_force, bit_torque
        Effective axial force at the bit in N, **tension positive**, and torque there in N m.
    speed, turning
        Axial speed in m/s, 0 or more, and angular speed in rad/s: friction acts along the resultant of the two.
    """

    name: str
    kind: str
    bit_depth: float
    bit_force: float = 0.0
    bit_torque: float = 0.0
    speed: float = 0.0
    turning: float = 0.0

    @property
    def rotating(self) -> bool:
        """Whether the string turns."""
        return self.kind in ROTATING

    @property
    def direction(self) -> float:
        """+1 where friction adds to the tension upwards (the string goes out), −1 where it takes from it."""
        return 1.0 if self.kind in UPWARD else -1.0

    def slip(self, radius: float) -> tuple[float, float]:
        """Parts of the friction along the hole and around the string, for a string of this radius in m."""
        if not self.rotating:
            return 1.0, 0.0
        around = self.turning * radius
        resultant = math.hypot(self.speed, around)
        return (0.0, 1.0) if resultant == 0.0 else (self.speed / resultant, around / resultant)


@dataclass(frozen=True)
class Well:
    """A well, ready to be computed.

    Attributes
    ----------
    title, source, text
        For the report; file name and content.
    survey
        Path of the hole.
    string
        Sections from the bit up.
    hole
        Sections from the top down.
    operations
        What is done.
    settings
        [well] as it was read: block weight, contact, string, rule.
    gravity
        In m/s².
    system
        Units of the results.
    about
        For whom the report is, and by whom.
    """

    title: str
    survey: Survey
    string: tuple[StringSection, ...]
    hole: tuple[HoleSection, ...]
    operations: tuple[Operation, ...]
    settings: schema.WellInput
    gravity: float = 9.80665
    system: System = SI
    source: str = "well"
    text: str = ""
    about: About = NOBODY

    @property
    def end(self) -> float:
        """Measured depth of the last station in m."""
        return float(self.survey.md[-1])

    @property
    def push(self) -> float:
        """Largest push at surface in N: block and what pushes beside it."""
        return self.settings.block_weight + self.settings.push

    def in_units(self, name: str | None) -> Well:
        """Return this well with results shown in "si", "field" or "mm" units; None leaves it as it is."""
        if name is None:
            return self
        if name not in SYSTEMS:
            raise InputError("units", name, f"must be one of {', '.join(SYSTEMS)}")
        return replace(self, system=System(name))

    @classmethod
    def read(cls, path: str | Path | CaseText) -> Well:
        """Read the file of a well.

        Raises
        ------
        CaseError
            Naming the key, what is allowed and what to do.
        InputError
            If the file or its survey cannot be read.
        """
        read = path if isinstance(path, CaseText) else read_case(path)
        return cls.from_dict(read.data, source=read.source, text=read.text, folder=read.folder)

    @classmethod
    def from_dict(
        cls,
        data: Mapping[str, Any],
        *,
        survey: Survey | None = None,
        source: str = "well",
        text: str = "",
        folder: str | Path = ".",
    ) -> Well:
        """Make a well from the content of its file as a dictionary; errors as in :meth:`read`.

        A ``survey`` given here counts in place of ``hole.survey``.
        """
        if survey is not None and isinstance(data, Mapping) and isinstance(data.get("hole"), Mapping):
            data = {**data, "hole": {"survey": survey.source, **data["hole"]}}
        given = read_well(data, source)
        try:
            return _assemble(given, data, survey, source, text, Path(folder))
        except InputError as error:
            raise in_file(source, error) from None


def _assemble(
    given: schema.WellFile, written: Mapping[str, Any], survey: Survey | None, source: str, text: str, folder: Path
) -> Well:
    catalogue = package_catalogue() if given.catalogue is None else read_catalogue(given.catalogue.files, folder)
    gravity = given.hole.gravity
    path = survey or _survey(given.hole, folder)
    string = string_sections(given.string, gravity, given.mud, given.pressure, catalogue)
    hole = hole_sections(given.hole.section, given.hole.diameter, given.hole.friction)
    path = from_surface(path)
    end = float(path.md[-1])
    _check_reach(hole, end)
    length = sum(section.rod.length for section in string)
    if length > end * (1.0 + 1e-12) and math.isfinite(length):
        what = f"is {length:g} m long, the well {end:g} m: shorten it, leave the length of the uppermost section out, "
        raise InputError("string", None, what + "or give a survey that goes on")
    operations = tuple(_operation(one, i, end, length) for i, one in enumerate(given.well.operation))
    for i, one in enumerate(operations):
        _check_operation(one, i, given.well.operation[i], end, length)
    for section in string:
        _check_fit(section, hole, end, written["hole"])
    title = given.title or (Path(source).stem if text else "Well")
    said = None if given.report is None else given.report.model_dump(exclude_none=True)
    system = System(given.units or "si")
    return Well(
        title, path, string, hole, operations, given.well, gravity, system, source, text, about_of(said, folder)
    )


def from_surface(survey: Survey) -> Survey:
    """A survey that begins at the surface: a vertical station at 0 m is added where the first is deeper, and said."""
    first = float(survey.md[0])
    if first <= 0.0:
        return survey
    azimuth = None if survey.azimuth is None else np.concatenate([survey.azimuth[:1], survey.azimuth])
    what = (
        f"the survey begins at {first:g} m with an inclination of {survey.inclination[0]:g}°: a vertical station at "
        "0 m was added, and the hole between them is an arc"
    )
    return replace(
        survey, md=np.concatenate([[0.0], survey.md]), inclination=np.concatenate([[0.0], survey.inclination]),
        azimuth=azimuth, force=None, notes=(*survey.notes, what),
    )  # fmt: skip


def _check_reach(hole: tuple[HoleSection, ...], end: float) -> None:
    if hole[-1].end < end - 1e-3:
        what = f"ends above the last station at {end:g} m: let the last section go on, or leave its `to` out"
        raise InputError(named(("hole", "section", len(hole) - 1, "to")), f"{hole[-1].end:g} m", what)


def _operation(given: schema.OperationInput, number: int, end: float, length: float) -> Operation:
    depth = given.bit_depth if given.bit_depth is not None else min(end, length)
    return Operation(
        given.name or given.kind, given.kind, depth, given.bit_force or 0.0, given.bit_torque or 0.0,
        given.speed or 0.0, 2.0 * math.pi / 60.0 * (given.rpm or 0.0),
    )  # fmt: skip


def _check_operation(one: Operation, number: int, given: schema.OperationInput, end: float, length: float) -> None:
    def key(name: str) -> str:
        return named(("well", "operation", number, name))

    if one.bit_depth > end * (1.0 + 1e-12):
        raise InputError(key("bit_depth"), f"{one.bit_depth:g} m", f"is below the last station at {end:g} m: give a "
                         "survey that goes on, or a depth above")  # fmt: skip
    if one.bit_depth > length * (1.0 + 1e-12):
        what = f"cannot be reached: the string is {length:g} m long; leave the length of its uppermost section out"
        raise InputError(key("bit_depth"), f"{one.bit_depth:g} m", what)
    if one.kind != "pull-out":
        check_weight_on_bit(key("bit_force"), one.bit_force)
    if one.kind in ("run-in", "rotate-off-bottom") and one.bit_force != 0.0:
        what = 'has no meaning off bottom: the bit is free; take kind = "slide" or "drill", or leave it out'
        raise InputError(key("bit_force"), _force(one.bit_force), what)
    if one.kind == "pull-out" and one.bit_force < 0.0:
        what = "pushes the bit while the string is pulled out: write an overpull without the sign, or leave it out"
        raise InputError(key("bit_force"), _force(one.bit_force), what)
    if not one.rotating:
        for name in ("bit_torque", "rpm"):
            if getattr(given, name) not in (None, 0.0):
                what = f"has no meaning while the string does not turn ({one.kind}): leave it out"
                raise InputError(key(name), getattr(given, name), what)
    if given.rpm is not None and not (math.isfinite(given.rpm) and given.rpm >= 0.0):
        raise InputError(key("rpm"), given.rpm, "must be 0 or more")
    if one.kind in ("ream", "back-ream") and not (one.speed > 0.0 and one.turning > 0.0):
        name = "speed" if not one.speed > 0.0 else "rpm"
        what = f"{one.kind} needs speed and rpm, which divide the friction"
        raise InputError(key(name), getattr(given, name), f"{_lacking(getattr(given, name))}: {what}")
    if one.kind == "drill" and one.speed > 0.0 and not one.turning > 0.0:
        what = f"{_lacking(given.rpm)}: with a speed, friction is divided between the two"
        raise InputError(key("rpm"), given.rpm, what)
    if one.kind == "rotate-off-bottom" and one.speed > 0.0:
        raise InputError(key("speed"), given.speed, "has no meaning: the bit stays where it is; take ream or back-ream")


def _lacking(value: float | None) -> str:
    """What is wrong with a value that is missing, or 0."""
    return "is missing" if value is None else "must be above 0"


def check_weight_on_bit(field: str, force: float) -> None:
    """Raise an InputError for ``field`` if a force at the bit in N would pull at what goes down."""
    if force > 0.0:
        what = f'puts the bit in tension: weight on bit is negative, write "-{unsigned(_force(force))}"'
        raise InputError(field, _force(force), what)


def _force(value: float) -> str:
    return f"{value / 1e3:g} kN"


def _survey(hole: schema.WellHole, folder: Path) -> Survey:
    """The path of the hole; errors about the file are about its key."""
    try:
        return Survey.read(folder / hole.survey, depth_unit=hole.depth_unit, well=hole.well)
    except InputError as error:
        if error.field != "survey":
            raise
        raise InputError("hole.survey", error.value, error.reason) from None


def _check_fit(section: StringSection, hole: tuple[HoleSection, ...], end: float, written: Mapping[str, Any]) -> None:
    """Raise an InputError for a diameter of the hole, as ``written`` in [hole], that the string does not fit."""
    outer = section.rod.outer_diameter
    if outer is None:
        what = "is missing: torque, clearance and stress need it"
        raise InputError(f"[[string]], {section.name}, outer_diameter", None, what)
    for i, part in enumerate(hole):
        if part.start < end and not part.diameter - outer > CLOSE_FIT * part.diameter:
            own = written["section"][i].get("diameter") if written.get("section") else None
            key, value = ("hole.diameter", written["diameter"]) if own is None else (key_of_hole(i, "diameter"), own)
            what = f"must be above the outer diameter of {section.name}, {outer:g} m: the string does not fit"
            raise InputError(key, value, what)

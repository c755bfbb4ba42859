"""A case: what the user has, read from a TOML file or a dictionary, checked, and made dimensionless."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from rodwell.case import schema
from rodwell.case.about import NOBODY, About, about_of
from rodwell.case.applied import AppliedLoad
from rodwell.case.beside import Pair
from rodwell.case.catalogue import Catalogue, package_catalogue, read_catalogue
from rodwell.case.checks.explain import SECTIONS, explain
from rodwell.case.checks.plausible import implausible
from rodwell.case.checks.said import gauge_facts, in_users_words
from rodwell.case.checks.signs import check_loads
from rodwell.case.dimensionless import check_sections, dimensionless, stiffness_of_wall
from rodwell.case.facts import Fact
from rodwell.case.file import CaseText, printable_data, read_case
from rodwell.case.fluids import NO_FLUIDS, Fluids
from rodwell.case.hole.cylinder import Cylinder, cylinder_of
from rodwell.case.hole.sections import HoleSectionInput
from rodwell.case.parts import CaseError, load_of, load_problems, named, split_hole, string_rod_of
from rodwell.case.physical import Physical, physical
from rodwell.case.pipe import PhysicalRod
from rodwell.case.string.sections import PhysicalString, check_beside
from rodwell.case.uncertain import Moved, UncertainInput, split
from rodwell.errors import InputError
from rodwell.faces import Shown
from rodwell.problem.problem import Problem
from rodwell.quantities.scales import Scales
from rodwell.quantities.tolerance import checked_rtol
from rodwell.quantities.units import SYSTEMS, System

__all__ = ["SECTIONS", "Case", "CaseError"]

LONGEST_TITLE = 300
"""Characters that a title may have: it stands above figures and on every page."""


@dataclass(frozen=True)
class Case(Shown):
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
        Effective end force at s = 1 at which branches end, in B/L² (tension positive); None: chosen from the loads
        found.
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
    rod
        The rod in SI units: section, weight in air, strength; None for a case without dimensions.
    fluids
        Mud and pressures; forces of a case with them are effective ones.
    facts
        What followed from the inputs on the way to the problem: weight, forces, clearance, and sources.
    applied
        The loads that act, of ``load.applied``.
    supports
        What each support can bear, if given.
    gravity
        In m/s².
    about
        For whom the report is, by whom, and its logo.
    off_wall
        Whether ``rodwell run`` follows the rod beyond lift-off.
    wall_stiffness
        Stiffness of the wall in B/L⁴, push per length and depth; infinite: rigid. It counts in load paths only: all
        else takes the wall as rigid.
    string
        The sections of a string in SI units, from the bottom up; ``rod`` is then a rod of the longest section's data
        and the whole length. None of a uniform rod.
    pairs
        Where the clearance has steps, the pieces of the rod between them, from s = 0: what lies beside what.
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
    rod: PhysicalRod | None = None
    fluids: Fluids = NO_FLUIDS
    facts: tuple[Fact, ...] = ()
    applied: tuple[AppliedLoad, ...] = ()
    supports: schema.Supports | None = None
    gravity: float = 9.80665
    about: About = NOBODY
    string: PhysicalString | None = None
    pairs: tuple[Pair, ...] = ()
    off_wall: bool = True
    wall_stiffness: float = math.inf

    @property
    def yield_strength(self) -> float | None:
        """Yield strength of the rod in Pa (the least of a string's), None where it is not given everywhere."""
        rods = [member.rod for member in self.string.members] if self.string is not None else [self.rod]
        known = [rod.yield_strength for rod in rods if rod is not None and rod.yield_strength is not None]
        return min(known) if len(known) == len(rods) else None

    @property
    def with_fluids(self) -> bool:
        """Whether mud or pressures make effective forces differ from real ones."""
        return self.fluids != NO_FLUIDS

    def in_units(self, name: str | None) -> Case:
        """Return this case with results shown in "si", "field" or "mm" units; None leaves it as it is.

        Raises
        ------
        InputError
            For a name that is not known, or a case without dimensions.
        """
        if name is None:
            return self
        if name not in SYSTEMS:
            raise InputError("units", name, f"must be one of {', '.join(SYSTEMS)}")
        if self.scales is None:
            raise InputError("units", name, "needs a case with dimensions: this one has [dimensionless], leave it out")
        return replace(self, scales=replace(self.scales, system=System(name)))

    @classmethod
    def read(cls, path: str | Path | CaseText) -> Case:
        """Read a case file; "-" is standard input, which like any pipe is read once.

        What cannot be printed in its texts (control characters, escape sequences) is replaced by visible escapes.

        Raises
        ------
        CaseError
            Naming the key, what is allowed and what to do, for everything that is wrong with the file.
        InputError
            If the file cannot be read.
        """
        read = path if isinstance(path, CaseText) else read_case(path)
        return cls.from_dict(read.data, source=read.source, text=read.text, folder=read.folder)

    @classmethod
    def from_dict(
        cls, data: Mapping[str, Any], *, source: str = "case", text: str = "", folder: str | Path = "."
    ) -> Case:
        """Make a case from the content of a case file as a dictionary; errors as in :meth:`read`.

        Catalogue files and surveys are sought from ``folder``.
        """
        if not isinstance(data, Mapping):
            raise CaseError(source, [("case", data, "must be a dictionary of sections, as in a case file")])
        data = printable_data(data)
        try:
            clean, moved = split(data)
            case = cls._certain(clean, source, text, Path(folder))
            case = replace(case, about=about_of(clean.get("report"), Path(folder)))
        except CaseError:
            raise
        except InputError as error:
            raise CaseError(source, [in_users_words(data, error)]) from None
        inputs = tuple(_uncertain(data, clean, *key, pair, Path(folder)) for key, pair in moved.items())
        return replace(case, uncertain=inputs, given={name: data[name] for name in case.given})

    @classmethod
    def _certain(cls, data: Mapping[str, Any], source: str, text: str, folder: Path) -> Case:
        """A case from data without uncertainties."""
        whole, string_rod = dict(data), None
        if "string" in data:  # [rod] has what belongs to the whole only
            beside = whole.pop("rod", {})
            check_beside(beside, data["string"])
        hole_parts, whole = split_hole(whole, source)
        try:
            parsed = schema.CaseFile.model_validate(whole)
        except ValidationError as error:
            raise CaseError(source, [*explain(error, data.get("study") is True), *load_problems(data)]) from None
        if parsed.string is not None:
            string_rod = string_rod_of(beside, source)
        files = parsed.catalogue
        catalogue = package_catalogue() if files is None else read_catalogue(files.files, folder)
        return _assemble(parsed, data, source, text, catalogue, string_rod, folder, hole_parts)


def _uncertain(
    data: Mapping[str, Any], clean: Mapping[str, Any], section: str, key: str, pair: tuple[Any, Any], folder: Path
) -> UncertainInput:
    """What becomes of the case as one input moves by its uncertainty down and up."""
    sides: list[Moved | None] = []
    for value in pair:
        try:
            case = Case._certain({**clean, section: {**clean[section], key: value}}, "case", "", folder)
            sides.append((case.problem, case.scales))
        except InputError:
            sides.append(None)
    if sides == [None, None]:
        raise CaseError("case", [(f"{section}.{key}", data[section][key], "moves out of what is allowed either way")])
    return UncertainInput(f"{section}.{key}", str(data[section][key]), *sides)


def _assemble(
    parsed: schema.CaseFile,
    data: Mapping[str, Any],
    source: str,
    text: str,
    catalogue: Catalogue,
    string_rod: schema.StringRod | None,
    folder: Path,
    hole_parts: tuple[HoleSectionInput, ...],
) -> Case:
    if parsed.title is not None and len(parsed.title) > LONGEST_TITLE:
        raise InputError("title", parsed.title, f"must have at most {LONGEST_TITLE} characters")
    with_dimensions = parsed.rod is not None or parsed.hole is not None or string_rod is not None
    if with_dimensions and parsed.dimensionless is not None:
        raise InputError("dimensionless", None, "cannot stand beside [rod] and [hole]: give one or the other")
    if not with_dimensions and parsed.dimensionless is None:
        raise InputError("rod", None, "is missing: give [rod] and [hole], or [dimensionless]")
    if not with_dimensions:
        check_sections(parsed)
    load = load_of(parsed.load, with_dimensions, source)
    case: Case
    common = {
        "title": parsed.title or (Path(source).stem if text else "Rod in a hole"),
        "modes": parsed.analysis.modes,
        "rtol": named("analysis.rtol", lambda: checked_rtol(parsed.analysis.rtol)),
        "off_wall": parsed.analysis.off_wall,
        "given": {name: values for name, values in data.items() if name in SECTIONS},  # as they were written
        "source": source,
        "text": text,
    }
    if isinstance(load, schema.LoadInput):
        found = _plausible(parsed, load, catalogue, data, source, string_rod, folder, hole_parts)
        check_loads(parsed.load, found.problem, found.applied)
        wall, hole = parsed.cylinder, parsed.hole
        cylinder = None if wall is None or hole is None else cylinder_of(wall, hole)
        case = Case(problem=found.problem, scales=found.scales, until=found.until, cylinder=cylinder,
                    rod=found.rod, fluids=found.fluids, facts=(*found.facts, *gauge_facts(data)), applied=found.applied,
                    supports=parsed.supports, gravity=found.gravity, string=found.string, pairs=found.pairs,
                    wall_stiffness=found.wall_stiffness, **common)  # fmt: skip
    else:
        problem, until, applied = dimensionless(parsed.dimensionless, load)
        case = Case(problem=problem, scales=None, until=until, applied=applied,
                    wall_stiffness=stiffness_of_wall(parsed.dimensionless), **common)  # fmt: skip
    if case.until is not None and not math.isfinite(case.until):
        raise InputError("load.until", load.until, "must be finite")
    if not all(math.isfinite(item.force) for item in case.applied):
        raise InputError("load.applied", load.applied, "must be finite")
    return case


def _plausible(
    parsed: schema.CaseFile,
    load: schema.LoadInput,
    catalogue: Catalogue,
    data: Mapping[str, Any],
    source: str,
    string_rod: schema.StringRod | None,
    folder: Path,
    hole_parts: tuple[HoleSectionInput, ...],
) -> Physical:
    """The case made dimensionless; what is not plausible stops it, beside what does not fit."""
    try:
        found = physical(parsed, load, catalogue, string_rod, folder, hole_parts)
    except InputError as error:
        odd = implausible(parsed, load, None, data) if parsed.plausible is not False else []
        mine = [what for key, _, what in odd if key == error.field]
        key, value, reason = in_users_words(data, error)
        raise CaseError(
            source, [(key, value, "; it ".join([reason, *mine[:1]])), *(item for item in odd if item[0] != error.field)]
        ) from None
    odd = implausible(parsed, load, found, data) if parsed.plausible is not False else []
    if odd:
        raise CaseError(source, odd)
    return found

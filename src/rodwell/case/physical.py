"""From the rod, hole, fluids and load of a case file to the dimensionless problem."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rodwell.case import schema
from rodwell.case.applied import AppliedLoad
from rodwell.case.beside import Pair, pairs_of, reference, sections_of, stepped
from rodwell.case.catalogue import Catalogue
from rodwell.case.facts import Fact
from rodwell.case.fluids import Fluids, fluid_facts, fluids_of, weight_in
from rodwell.case.hole.lie import Lie, lie_of
from rodwell.case.hole.schema import Hole
from rodwell.case.hole.sections import WHOLE, HoleSectionInput, by_depth, parts_of
from rodwell.case.pipe import PhysicalRod, physical_rod
from rodwell.case.string.sections import PhysicalString, check_length, string_of
from rodwell.errors import InputError
from rodwell.problem.checks import SMALLEST_CLEARANCE
from rodwell.problem.ends import checked_ends
from rodwell.problem.problem import Problem
from rodwell.problem.profile import extremes
from rodwell.problem.words import where_it_bridges
from rodwell.quantities.scales import Scales
from rodwell.quantities.units import System

RIGID_ELSEWHERE = "push per length and depth; counts beyond lift-off, all that is told of the rod on the wall is rigid"


@dataclass(frozen=True)
class Physical:
    """A case with dimensions: problem, scales, effective end forces at s = 1 in B/L², and how.

    Gravity is in m/s², the stiffness of the wall in B/L⁴.
    """

    problem: Problem
    scales: Scales
    until: float | None
    applied: tuple[AppliedLoad, ...]
    rod: PhysicalRod
    fluids: Fluids
    gravity: float
    facts: tuple[Fact, ...]
    string: PhysicalString | None = None
    wall_stiffness: float = math.inf
    pairs: tuple[Pair, ...] = ()


def physical(
    parsed: schema.CaseFile,
    load: schema.LoadInput,
    catalogue: Catalogue,
    string_rod: schema.StringRod | None = None,
    folder: Path = Path(),
    hole_parts: Sequence[HoleSectionInput] = (),
) -> Physical:
    """Return the dimensionless problem of a case with dimensions, and what it was made from.

    ``string_rod`` is [rod] beside [[string]], ``hole_parts`` are [[hole.section]]; surveys are sought from ``folder``.

    Raises
    ------
    InputError
        Naming the key of the case file that is missing, contradicts another, or does not fit the others.
    """
    given = string_rod or parsed.rod
    if given is None:
        raise InputError("rod", None, "is missing: a case with [hole] needs [rod]")
    if parsed.hole is None:
        raise InputError("hole", None, "is missing: a case with [rod] needs [hole]")
    hole, string = parsed.hole, None
    if string_rod is not None:
        string, fluids = string_of(parsed.string or (), hole, parsed.mud, parsed.pressure, catalogue)
        check_length(string, string_rod.length)
        rod, weight = string.whole, string.unit_weight
    else:
        assert parsed.rod is not None
        rod = physical_rod(parsed.rod, hole.gravity, catalogue, parsed.rod.length)
        fluids = fluids_of(parsed.mud, parsed.pressure, rod)
        weight = weight_in(fluids, rod, hole.gravity)
    pairs = pairs_of(rod, string, hole, parts_of(hole_parts, hole, rod.length))
    clearance = reference(pairs)
    for pair in pairs:
        _check_clearance(pair, hole, rod.length)
    radius = None if rod.outer_diameter is None else 0.5 * rod.outer_diameter
    lie, system = lie_of(hole, rod.length, folder, by_depth(hole_parts)), System(parsed.units or "si")
    scales = Scales(rod.length, rod.stiffness, radius, system, load.at == "bottom", lie.height < 0.0)
    problem = _problem(given.ends, rod, hole, scales, weight, pairs, load.twist, string, lie)
    if string is None:
        facts = [*rod.facts, *fluid_facts(fluids, rod, hole.gravity)]
    else:
        facts = [*string.facts(), Fact("mean weight per length mg, in the fluids", weight, "force_per_length")]
    if stepped(pairs):
        facts += [
            Fact(f"clearance, from axis to axis: {pair.name}", extremes(pair.clearance)[0], "length",
                 f"s/L = {pair.start:.4g} to {pair.end:.4g}" + _up_to(pair, system)) for pair in pairs
        ]  # fmt: skip
    note = "of the longest piece" if stepped(pairs) else _clearance_from(hole, string is None)
    facts += [Fact("clearance Δ, from axis to axis", clearance, "length", note), *lie.facts]
    if hole.wall_stiffness is not None:
        facts.append(Fact("stiffness of the wall", hole.wall_stiffness, "stress", RIGID_ELSEWHERE))
    if parsed.packer is not None:
        facts.append(Fact("packer", "as given", note="changes of length and the packer's force: `rodwell packer`"))
    at_end = rod if string is None else string.at_end(load.at == "bottom")
    until, applied, how = _end_force(load, parsed, problem, scales, replace(at_end, length=rod.length), fluids,
                                    lie.height)  # fmt: skip
    wall = math.inf if hole.wall_stiffness is None else hole.wall_stiffness / scales.factor("stress")
    pieces = pairs if stepped(pairs) else ()
    if problem.bridges or problem.ramps:
        _check_bridging(problem, hole, lie)
    return Physical(problem, scales, until, applied, rod, fluids, hole.gravity, (*facts, *how), string, wall, pieces)


def _check_bridging(problem: Problem, hole: Hole, lie: Lie) -> None:
    """Refuse of a string that leaves the wall by itself, or beside several clearances, what is not computed of it."""
    where = "where the clearance varies" if problem.ramps else where_it_bridges(problem)
    if problem.floats:
        raise InputError("mud.outside", None, f"lets the rod float, which is not computed {where}")
    if lie.height < 0.0:
        what = f"puts s = 1 below s = 0, which is not computed {where}"
        raise InputError("hole.angle_from_vertical", hole.angle_from_vertical, what)
    if hole.wall_stiffness is not None:
        what = f"is not computed {where}: leave it out, for a rigid wall"
        raise InputError("hole.wall_stiffness", hole.wall_stiffness, what)


def _check_clearance(pair: Pair, hole: Hole, length: float) -> None:
    """Refuse a clearance that is no part of the rod's length."""
    (clearance, _, widest), where = extremes(pair.clearance), "" if pair.name == WHOLE else f" beside {pair.name}"
    field, value = ("hole.clearance", hole.clearance) if hole.clearance else (f"{pair.part.name}.diameter", None)
    if pair.part.diameter is not None and not hole.clearance:
        field, value = "hole.diameter", extremes(pair.part.diameter)[0]
    if widest >= length:
        what = f"leaves a clearance of {widest:g} m{where}, which must be below the rod's length of {length:g} m"
        raise InputError(field, value, what)
    if clearance < SMALLEST_CLEARANCE * length:
        raise InputError(
            field, value,
            f"leaves a clearance of {clearance:.3g} m{where}, {clearance / length:.1g} of the rod's length; at least "
            f"{SMALLEST_CLEARANCE:g} of it is needed: check the units of diameters and length",
        )  # fmt: skip


def _problem(
    ends: str,
    rod: PhysicalRod,
    hole: Hole,
    scales: Scales,
    weight: float,
    pairs: tuple[Pair, ...],
    twist: float,
    string: PhysicalString | None,
    lie: Lie,
) -> Problem:
    """The problem in units B = L = 1; errors in the names of the case file."""
    clearance = reference(pairs)
    try:
        return Problem(
            weight=abs(weight) / scales.factor("force_per_length"),
            floats=weight < 0.0,
            alpha=90.0 if lie.axis else lie.alpha,
            build=lie.build,
            walk=lie.walk,
            axis=lie.axis,
            clearance=clearance / rod.length,
            poisson=rod.poisson,
            torsion=rod.torsion,
            twist=twist / scales.factor("moment"),
            ends=checked_ends(ends),
            sections=sections_of(pairs, string),
        )
    except InputError as error:
        if error.field.startswith("section "):
            number, _, ratio = error.field.removeprefix("section ").partition(", ")
            what = f"is {error.value:g} times that of the string, which {error.reason}: check the units of the section"
            keys = [one.key for one in string.members] if string is not None and not stepped(pairs) else [
                pair.name for pair in pairs
            ]  # fmt: skip
            raise InputError(f"{keys[int(number) - 1]}, {ratio}", None, what) from None
        names = {
            "weight": "rod.length",
            "poisson": "rod.poisson",
            "torsion": "rod.torsional_stiffness",
            "twist": "load.twist",
            "ends": "rod.ends",
            "clearance": "hole.diameter" if hole.clearance is None else "hole.clearance",
            "build": "hole.build",
            "walk": "hole.walk",
            "axis": "hole.centerline" if hole.survey is None else "hole.survey",
            "floats": "mud.outside",
            "sections": "string",
            "sections, clearance": "hole.section",
        }
        name = names.get(error.field, error.field)
        what = error.reason
        if error.field == "weight":
            what = f"makes γ = mg L³/B = {abs(weight) / scales.factor('force_per_length'):g}, which {what}: check the "
            what += "units of length, weight or density, stiffness or diameters, and gravity"
        if error.field == "clearance":
            what = f"makes Δ/L = {clearance / rod.length:.3g}, which {what}: check its unit and that of the length"
        if error.field == "sections, clearance":
            raise InputError(name, None, f"lets the clearance have {error.value}, and it {what}") from None
        if error.field == "sections" and "clearance" in what:
            what += ", as hole.clearance"
        if error.field == "floats":
            what = "lifts the rod, and rods that float are computed in straight holes only: check density and diameters"
        raise InputError(name, None if error.field in ("weight", "floats") else error.value, what) from None


def _end_force(
    load: schema.LoadInput,
    parsed: schema.CaseFile,
    problem: Problem,
    scales: Scales,
    rod: PhysicalRod,
    fluids: Fluids,
    height: float,
) -> tuple[float | None, tuple[AppliedLoad, ...], list[Fact]]:
    """Effective end forces at s = 1 in B/L² from load.until and load.applied, wherever and however they are measured.

    The real force becomes the effective one where it is measured; from the bottom to the top the effective force
    grows by the buoyed weight over the height of the rod (in L), N(s) = F + γ cos α (s − 1) in a straight hole.
    """
    if load.until is None and load.applied is None:
        check_force_words(load)
        return None, (), []
    if parsed.pressure is not None and load.kind is None:
        key = "until" if load.until is not None else "applied"
        what = (
            f'is missing: with [pressure], say whether load.{key} is the "real" force in the wall of the pipe or the '
        )
        raise InputError("load.kind", None, what + '"effective" one')
    assert parsed.hole is not None
    bottom, gravity = load.at == "bottom", parsed.hole.gravity
    drop = rod.length * height if bottom else 0.0
    less = fluids.effective_minus_real(rod, gravity, drop) if load.kind == "real" else 0.0
    where = f"end s = {0 if bottom else 1}" if scales.climbs else "bottom, s = 0" if bottom else "top, s = 1"
    facts = []

    def at_top(given: float, what: str) -> float:
        force = (given + less) / scales.factor("force") + (problem.hung_weight if bottom else 0.0)
        how = f"from {load.kind or 'effective'} {scales.system.text(given, 'force', 6)} at the {where}"
        facts.append(Fact(f"{what}, effective, at s = 1", force * scales.factor("force"), "force", how))
        return force

    until = None if load.until is None else at_top(load.until, "end force asked for")
    applied = tuple(
        AppliedLoad(at_top(given, "applied end force"), given, bottom, load.kind == "real")
        for given in load.applied or ()
    )
    check_reach(until, applied)
    return until, applied, facts


def check_reach(until: float | None, applied: tuple[AppliedLoad, ...]) -> None:
    """Refuse applied loads that lie beyond load.until."""
    if until is None or not applied or min(load.force for load in applied) >= until:
        return
    raise InputError("load.until", None, "ends before load.applied: give one that is at least as compressive, or none")


def check_force_words(load: schema.LoadInput | schema.DimensionlessLoad) -> None:
    """Refuse words on load.until where it is not given."""
    for key in ("at", "kind"):
        if getattr(load, key, None) is not None:
            raise InputError(
                f"load.{key}",
                getattr(load, key),
                "tells of load.until and load.applied: give load.until or load.applied too, or leave it out",
            )


def _up_to(pair: Pair, system: System) -> str:
    """Up to which clearance it goes in a piece in which it varies."""
    least, _, most = extremes(pair.clearance)
    return "" if least == most else f", varying: up to {system.text(most, 'length', 6)}"


def _clearance_from(hole: Hole, one_rod: bool) -> str:
    of_rod = "the rod's outer diameter" if one_rod else "the outer diameter of a section"
    return "as given" if hole.clearance is not None else f"half of the hole's diameter less {of_rod}"

"""Stress along the rod in one state, against its strength."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.discrete.curved import ends_of_lying_rod, height_of_rod
from rodwell.case.case import Case
from rodwell.case.pipe import PhysicalRod
from rodwell.case.string.sections import Member
from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray
from rodwell.quantities.scales import Scales
from rodwell.quantities.value import Peak, Value
from rodwell.strength.loaded import Fields, LoadedRod
from rodwell.strength.stress import PLACES, Loading, Section, Stresses, section_of, stresses

if TYPE_CHECKING:
    from rodwell.strength.off_wall import RodOffWall


@dataclass(frozen=True, slots=True, kw_only=True)
class RodStress(Peak):
    """Largest von Mises stress in the rod: value and error in Pa, place s/L, and the parts that make it up there.

    ``safety`` is the yield strength over the stress, None where the strength is not known; of a string, the least of
    all sections.
    """

    fibre: str
    axial: float
    bending: float
    torsion: float
    safety: Value | None


@dataclass(frozen=True)
class RodSection:
    """The rod's section with what is needed for stresses in it: a case with dimensions and the outer diameter.

    ``number`` is that of a section of a string, from 0 at the bottom; None of a uniform rod.
    """

    rod: PhysicalRod
    section: Section
    scales: Scales
    case: Case
    number: int | None = None

    @property
    def member(self) -> Member | None:
        """The section of the string."""
        return None if self.number is None or self.case.string is None else self.case.string.members[self.number]

    def _line(self, s: FloatArray, of: Callable[[PhysicalRod], float]) -> float | FloatArray:
        """A diameter in m: one, or where the section tapers those at places s/L (m,)."""
        if self.member is None or self.member.taper is None:
            return of(self.rod)
        assert self.case.string is not None
        return self.member.taper.line(of, self.case.string.part_of(self.member, s))

    def ring(self, s: FloatArray) -> Section:
        """What bears load: one section, or where it tapers those at places s/L (m,)."""
        if self.member is None or self.member.taper is None:
            return self.section
        outer, inner = self._line(s, lambda rod: rod.bearing_diameter), self._line(s, lambda rod: rod.inner_diameter)
        return Section(0.5 * outer, 0.5 * inner)

    @property
    def strength(self) -> float | None:
        """Yield strength in Pa, None where it is not given."""
        return self.rod.yield_strength

    def drop(self, f: Fields) -> FloatArray:
        """Height in m of s = 1, as it lies in the rod that has not buckled, above places of the rod."""
        p = self.case.problem
        if p.hole is not None:
            start, end = ends_of_lying_rod(p)
            top = height_of_rod(p, np.array([end]), np.array([math.pi if p.on_top else 0.0]))
            above = top - height_of_rod(p, start + f["z"], f["xi2"])
            return self.scales.length * (-above if p.floats else above)  # of a rod that floats upside down
        alpha = math.radians(p.alpha)
        own, last = (p.rod.clearance(f["s"]), p.rod.clearance(np.ones(1))) if p.ramps else (1.0, 1.0)
        up = (-1.0 if p.floats else 1.0) * p.clearance * math.sin(alpha) * (last - own * np.cos(f["xi2"]))
        axial = 0.0 if p.alpha == 90.0 else math.cos(alpha)
        return self.scales.length * ((1.0 - f["z"]) * axial - up)

    def loading(self, f: Fields) -> Loading:
        """What acts on the sections, from fields in units B = L = 1.

        The force in the theory is the effective one; that in the wall follows from the pressures at the same height.
        """
        drop, fluids = self.drop(f), self.case.fluids
        inside, outside = fluids.pressures(self.case.gravity, drop)
        outer, bore = self._line(f["s"], lambda rod: rod.outer_diameter or 0.0), 2.0 * self.ring(f["s"]).inner
        less = math.pi / 4.0 * (outside * outer**2 - inside * bore**2)
        moment = self.scales.factor("moment")
        return Loading(
            force=f["rod_F1"] * self.scales.factor("force") - less,
            bending=moment * np.hypot(f["rod_M2"], f["rod_M3"]),
            torque=moment * np.abs(f["rod_M1"]),
            inside=np.asarray(inside),
            outside=np.asarray(outside),
        )

    def stresses(self, f: Fields) -> Stresses:
        """Stresses along the rod in Pa, from fields in units B = L = 1."""
        return stresses(self.ring(f["s"]), self.loading(f))

    def von_mises(self, f: Fields) -> FloatArray:
        """The largest von Mises stress of each section in Pa, (m,)."""
        return self.stresses(f).von_mises

    def strength_at(self, f: Fields) -> FloatArray:
        """Yield strength in Pa at each place, (m,); infinite where it is not known."""
        return np.full(f["s"].shape, self.strength or math.inf)

    def used(self, f: Fields) -> FloatArray:
        """Part of the yield strength that the stress uses up, (m,); nought where the strength is not known."""
        return self.von_mises(f) / (self.strength or math.inf)

    def number_at(self, s: FloatArray) -> IntArray:
        """Number of the section of a string at places s/L (m,), that towards s = 1 where two meet."""
        assert self.case.string is not None
        steps = np.array([start for start, _ in self.case.string.ends[1:]])
        # alike neighbours are one section of the problem, but two of the string
        return np.searchsorted(np.round(steps, 15), s, side="right").astype(np.int64)

    def inside(self, f: Fields) -> BoolArray:
        """Which places of the fields are in this section of a string, (m,); all, of a uniform rod."""
        if self.number is None:
            return np.ones(f["s"].shape, dtype=np.bool_)
        return np.asarray(self.number_at(f["s"]) == self.number)

    def largest(self, state: LoadedRod | RodOffWall) -> RodStress:
        """Largest von Mises stress along the rod, or along this section of a string, in a state."""
        peak = state.largest(lambda f: np.where(self.inside(f), self.von_mises(f), 0.0))
        place = np.array([peak.s])
        there, area = self.stresses(state.fields(place)), float(np.min(self.ring(place).area))
        # a force that is known to an error only changes the axial stress, if the rod is straight
        error = peak.error + (state.error * self.scales.factor("force") / area if state.straight else 0.0)
        safety = None
        if self.strength is not None and peak.value > 0.0:
            factor = self.strength / peak.value
            safety = Value(factor, factor * error / peak.value)
        fibre = PLACES[int(there.fibre[0])]
        return RodStress(
            peak.value,
            error,
            peak.s,
            fibre=fibre if there.bending[0] > 0.0 else fibre.partition(",")[0],
            axial=float(there.axial[0]),
            bending=float(there.bending[0]),
            torsion=float(there.torsion[0]),
            safety=safety,
        )


def _names(record: type) -> list[str]:
    """Names of the entries of a record."""
    return [entry.name for entry in fields(record)]


@dataclass(frozen=True)
class StringSections:
    """The sections of a string, each with its own ring and strength: what :class:`RodSection` is for a uniform rod."""

    members: tuple[RodSection, ...]

    @property
    def strength(self) -> float | None:
        """Least yield strength in Pa, None where it is not given for every section."""
        return self.members[0].case.yield_strength

    def _each(self, f: Fields, of: Callable[[RodSection, Fields], FloatArray]) -> FloatArray:
        """Something made from the fields by the section in which each place lies, (m,)."""
        out = np.zeros(f["s"].shape)
        for member in self.members:
            inside = member.inside(f)
            if np.any(inside):
                out[inside] = of(member, {name: values[inside] for name, values in f.items()})
        return out

    def loading(self, f: Fields) -> Loading:
        """What acts on the sections, as :meth:`RodSection.loading`."""
        return Loading(**{name: self._each(f, self._part(RodSection.loading, name)) for name in _names(Loading)})

    def stresses(self, f: Fields) -> Stresses:
        """Stresses along the rod, as :meth:`RodSection.stresses`."""
        return Stresses(**{name: self._each(f, self._part(RodSection.stresses, name)) for name in _names(Stresses)})

    @staticmethod
    def _part(of: Callable[[RodSection, Fields], Any], name: str) -> Callable[[RodSection, Fields], FloatArray]:
        return lambda member, f: np.asarray(getattr(of(member, f), name))

    def strength_at(self, f: Fields) -> FloatArray:
        """Yield strength in Pa at each place, (m,); infinite where it is not known."""
        return self._each(f, RodSection.strength_at)

    def von_mises(self, f: Fields) -> FloatArray:
        """The largest von Mises stress of each section in Pa, (m,)."""
        return self._each(f, RodSection.von_mises)

    def used(self, f: Fields) -> FloatArray:
        """Part of its own yield strength that the stress uses up, (m,); nought where that is not known."""
        return self._each(f, RodSection.used)

    def largest_each(self, state: LoadedRod | RodOffWall) -> tuple[RodStress, ...]:
        """Largest von Mises stress in each section, from the bottom up."""
        return tuple(member.largest(state) for member in self.members)

    def largest(self, state: LoadedRod | RodOffWall) -> RodStress:
        """Largest von Mises stress of all sections; the safety factor is the least of all, each to its own strength."""
        each = self.largest_each(state)
        factors = [stress.safety for stress in each if stress.safety is not None]
        least = min(factors, key=lambda factor: factor.value) if len(factors) == len(each) else None
        return replace(max(each, key=lambda stress: stress.value), safety=least)


def rod_section(case: Case) -> RodSection | StringSections | None:
    """The rod's section of a case, or the sections of its string.

    None for a case without dimensions, or without the outer diameter of the rod or of any section.
    """
    if case.rod is None or case.scales is None:
        return None
    if case.string is None:
        section = section_of(case.rod)
        return None if section is None else RodSection(case.rod, section, case.scales, case)
    members = []
    for number, one in enumerate(case.string.members):
        section = section_of(one.rod)
        if section is None:
            return None
        members.append(RodSection(one.rod, section, case.scales, case, number))
    return StringSections(tuple(members))

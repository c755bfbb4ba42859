"""Stress along the rod in one state, against its strength."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rodwell.case.case import Case
from rodwell.case.pipe import PhysicalRod
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.scales import Scales
from rodwell.quantities.value import Peak, Value
from rodwell.strength.loaded import Fields, LoadedRod
from rodwell.strength.stress import PLACES, Loading, Section, Stresses, section_of, stresses


@dataclass(frozen=True, slots=True, kw_only=True)
class RodStress(Peak):
    """Largest von Mises stress in the rod: value and error in Pa, place s/L, and the parts that make it up there.

    ``safety`` is the yield strength over the stress, None where the strength is not known.
    """

    fibre: str
    axial: float
    bending: float
    torsion: float
    safety: Value | None


@dataclass(frozen=True)
class RodSection:
    """The rod's section with what is needed for stresses in it: a case with dimensions and the outer diameter."""

    rod: PhysicalRod
    section: Section
    scales: Scales
    case: Case

    @property
    def strength(self) -> float | None:
        """Yield strength in Pa, None where it is not given."""
        return self.rod.yield_strength

    def drop(self, f: Fields) -> FloatArray:
        """Height in m of s = 1, as it lies in the straight rod, above places of the rod."""
        p = self.case.problem
        alpha = math.radians(p.alpha)
        up = p.clearance * math.sin(alpha) * (1.0 - np.cos(f["xi2"]))
        axial = 0.0 if p.alpha == 90.0 else math.cos(alpha)
        return self.scales.length * ((1.0 - f["z"]) * axial - up)

    def loading(self, f: Fields) -> Loading:
        """What acts on the sections, from fields in units B = L = 1.

        The force in the theory is the effective one; that in the wall follows from the pressures at the same height.
        """
        drop, fluids = self.drop(f), self.case.fluids
        inside, outside = fluids.pressures(self.case.gravity, drop)
        less = outside * self.rod.outer_area - inside * self.rod.bore_area
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
        return stresses(self.section, self.loading(f))

    def von_mises(self, f: Fields) -> FloatArray:
        """The largest von Mises stress of each section in Pa, (m,)."""
        return self.stresses(f).von_mises

    def largest(self, state: LoadedRod) -> RodStress:
        """Largest von Mises stress along the rod in a state."""
        peak = state.largest(self.von_mises)
        there = self.stresses(state.fields(np.array([peak.s])))
        # a force that is known to an error only changes the axial stress, if the rod is straight
        error = peak.error + (state.error * self.scales.factor("force") / self.section.area if state.straight else 0.0)
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


def rod_section(case: Case) -> RodSection | None:
    """The rod's section of a case; None for a case without dimensions or without the rod's outer diameter."""
    if case.rod is None or case.scales is None:
        return None
    section = section_of(case.rod)
    return None if section is None else RodSection(case.rod, section, case.scales, case)

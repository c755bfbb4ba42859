"""Whether the cylinder itself bears what the rod does to it: stress against strength."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.state.compared import compared_peaks
from rodwell.analysis.state.fields import fields_at, largest_of
from rodwell.case.hole.cylinder import Cylinder
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.scales import Scales
from rodwell.quantities.value import Peak


@dataclass(frozen=True, slots=True, kw_only=True)
class Stress(Peak):
    """Largest equivalent stress in the cylinder: value and error in Pa, place s/L, and part of the yield strength."""

    utilisation: float


def cylinder_stress(state: Solution, cylinder: Cylinder, scales: Scales) -> Stress:
    """Largest von Mises stress √(σ² + 3τ²) at the outer surface of the cylinder in a state.

    σ = M R/I with M = √(μ² + (λ cos η)²) and τ = T₂ R/2I from the moments in the cylinder, (59). The pressing of
    the rod on the wall where it lies, and loads that do not come from the rod, are not in it.
    """
    peak = compared_peaks(*(_largest(state, *level, cylinder, scales) for level in state.levels))
    return Stress(*peak, utilisation=peak.value / cylinder.yield_strength)


def von_mises(cylinder: Cylinder, f: dict[str, FloatArray], scales: Scales) -> FloatArray:
    """Equivalent stress at the outer surface in Pa, (m,), from fields along the rod in units B = L = 1."""
    per_moment = 0.5 * cylinder.outer_diameter / cylinder.inertia * scales.factor("moment")
    bending = per_moment * np.hypot(f["mu"], f["cylinder_M3"])
    return np.asarray(np.sqrt(bending**2 + 3.0 * (0.5 * per_moment * f["T2"]) ** 2))


def _largest(
    solution: Solution, family: Family, state: State, cylinder: Cylinder, scales: Scales
) -> tuple[float, float]:
    """Largest stress and its place on one mesh."""
    return largest_of(lambda s: von_mises(cylinder, fields_at(solution.problem, family, state, s), scales), state.space)

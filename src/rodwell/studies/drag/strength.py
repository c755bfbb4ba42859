"""What a string bears in a well: real tension, bending, stress, stretch and twist, from the forces along it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.endless.local import LIMITS, local_state
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value
from rodwell.strength.stress import Loading, section_of, stresses
from rodwell.studies.drag.contact import BUCKLES, CURVATURE, HELICAL, RATIO, SINUSOIDAL, STRAIGHT
from rodwell.studies.drag.run import Run, tvd_at
from rodwell.studies.drag.well_case import Well


@dataclass(frozen=True)
class Strength:
    """Along the rows of a run, (m,) each, from the bit up; NaN where a section is not known well enough.

    Attributes
    ----------
    true_force
        Axial force in the wall of the pipe in N, tension positive.
    curvature
        Largest curvature of the string in 1/m: that of the hole and that of the local state, as if in one plane.
    bending, von_mises
        Bending stress and largest von Mises stress in Pa.
    used
        Von Mises stress as a part of the yield strength; NaN where that is not given.
    stretch, twist
        Of the whole string: elongation in m by the real force and pressures, against the string without either, and
        angle in rad by which the upper end is turned against the bit; None where a section is not known.
    helix_slope
        Largest slope of a helical interval against the hole, that of a helix without weight, r √(P/2B); 0 without one.
    not_judged
        Sections of the string in this run whose yield strength, or wall, is not given: nothing is known of their
        ``used``.
    """

    true_force: FloatArray
    curvature: FloatArray
    bending: FloatArray
    von_mises: FloatArray
    used: FloatArray
    stretch: Value | None
    twist: Value | None
    helix_slope: float
    not_judged: tuple[str, ...]


def strength_of(well: Well, one: Run, bent: FloatArray | None = None) -> Strength:
    """Return what the string bears; ``bent`` is the curvature of a stiff string in 1/m at the rows, (m,)."""
    rows = len(one.rows)
    section = one.pieces.section[one.piece]
    depth = tvd_at(well.survey, one.measured_depth)
    curvature = one.column(CURVATURE) + local_curvature(one)
    if bent is not None:
        curvature = np.where(one.states == STRAIGHT, bent, np.maximum(curvature, bent))
    true, bending, mises, used = (np.full(rows, np.nan) for _ in range(4))
    strain, turn = np.zeros(rows), np.zeros(rows)
    known, not_judged = True, []
    for i, part in enumerate(well.string):
        here = section == i
        if not np.any(here):
            continue
        rod, ring = part.rod, section_of(part.rod)
        if ring is None or rod.yield_strength is None:
            not_judged.append(part.name)
        inside, outside = part.fluids.pressures(well.gravity, depth[here])
        if ring is None:
            known = False
            continue
        real = one.forces[here] + inside * rod.bore_area - outside * rod.outer_area
        moment = rod.stiffness * curvature[here]
        found = stresses(ring, Loading(real, moment, np.abs(one.torques[here]), inside, outside))
        true[here], bending[here], mises[here] = real, found.bending, found.von_mises
        if rod.yield_strength is not None:
            used[here] = found.von_mises / rod.yield_strength
        modulus = rod.stiffness / ring.inertia
        lateral = 2.0 * rod.poisson * (inside * rod.bore_area - outside * rod.outer_area)
        strain[here] = (real - lateral) / (modulus * ring.area)
        torsion = rod.torsion if rod.torsion is not None else 1.0 / (1.0 + rod.poisson)
        turn[here] = one.torques[here] / (torsion * rod.stiffness)
    stretch = _sum(one, strain) if known else None
    return Strength(
        true, curvature, bending, mises, used, stretch, _sum(one, turn), _helix_slope(well, one), tuple(not_judged)
    )


def local_curvature(one: Run) -> FloatArray:
    """Largest curvature in 1/m that the local state adds to that of the hole, (m,).

    From the exact state; where there is none in the table, or by the correlation, r P/2B, a helix without weight.
    """
    compression, ratio = np.maximum(-one.forces, 0.0), one.column(RATIO)
    buckled = one.states != STRAIGHT
    out = np.asarray(np.where(buckled, 0.5 * compression / ratio, 0.0))
    if one.contact.name == "exact":
        for state, (name, low, high) in _TABLED.items():
            beta = load_of(one)
            here = (one.states == state) & (beta >= low) & (beta <= high)
            if np.any(here):
                scale = np.sqrt(one.pressing[here] / ratio[here])
                out[here] = scale * np.asarray(local_state(beta[here], name).curvature_largest)
    return out


_TABLED = {
    SINUSOIDAL: ("sinusoidal", BUCKLES, LIMITS.sinusoidal_lift_off.value),
    HELICAL: ("helical", LIMITS.helix_lift_off.value, 1e4),
}
"""States by number: name, and between which β they stand in the table; far beyond, weight does not matter."""


def _helix_slope(well: Well, one: Run) -> float:
    stiffness = np.array([part.rod.stiffness for part in well.string])[one.pieces.section[one.piece]]
    squared = 0.5 * np.maximum(-one.forces, 0.0) * stiffness / one.column(RATIO) ** 2
    return float(np.sqrt(np.max(squared, where=one.states == HELICAL, initial=0.0)))


def load_of(one: Run) -> FloatArray:
    """β = P/√(B q/r) along the rows, (m,); 0 in tension, infinite where nothing presses a compressed string."""
    unit = np.sqrt(one.column(RATIO) * one.pressing)
    compression = np.maximum(-one.forces, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(compression > 0.0, compression / unit, 0.0))


def _sum(one: Run, values: FloatArray) -> Value:
    """∫ along the string by trapezia; the error is that of these from how the slope changes from step to step."""
    up = one.rows[:, 0]
    steps = np.diff(up)
    wide = steps > 0.0
    h, rise = steps[wide], np.diff(values)[wide]
    total = float(np.sum(0.5 * (values[:-1] + values[1:])[wide] * h))
    change = np.abs(np.diff(rise / h, prepend=rise[:1] / h[:1]))
    return Value(total, float(np.sum(h**2 * change)) / 12.0 + 1e-13 * float(np.sum(np.abs(values[1:])[wide] * h)))

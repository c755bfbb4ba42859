"""Derivatives of critical loads by what a problem is made of, from the mode: the theorem of Hellmann and Feynman."""

from __future__ import annotations

import math

import numpy as np

from rodwell.analysis.discrete.family import path
from rodwell.numerics.equilibria.family import on_path
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, LATERAL_WEIGHT
from rodwell.problem.problem import Problem
from rodwell.problem.varying import ParameterPath
from rodwell.quantities.arrays import FloatArray


def lever_at(problem: Problem, places: FloatArray) -> FloatArray:
    """N(s) at F = 0 and wₐ = 1, at places (m,): s − 1, or what hangs below the upper end of sections."""
    return problem.rod.lever(places) if problem.sections else places - 1.0


def load_slope(
    problem: Problem, space: SplineSpace, coefficients: FloatArray, axial: float, foundation: float
) -> float:
    """dF/dq of a critical load with the mode given by ``coefficients``, from the rates of wₐ and wₗ/Δ by q.

    With the coefficients of (64): dF/dq = −(∫ (∂wₐ/∂q)(s − 1) v′² ds + ∫ ∂(wₗ/Δ)/∂q v² ds) / ∫ v′² ds.
    """
    y, slope, _ = space.at_points(coefficients)
    w, s = space.weights, space.points
    shares = w * problem.rod.weight(s) if problem.sections else w
    above = axial * (w @ (lever_at(problem, s) * slope**2)) + foundation * (shares @ y**2)
    return float(-above / (w @ slope**2))


def section_slopes(problem: Problem, space: SplineSpace, coefficients: FloatArray) -> dict[str, FloatArray]:
    """Derivatives of a critical load by the data of each of n sections.

    "stiffness" and "weight", (n,), are those by the ratios b and q, where these taper by a factor on all their values;
    "upper_end", (n − 1,), those by the place of the step above a section, which becomes longer as the next becomes
    shorter, if neither tapers. With the bending moment m = b v″, which is
    continuous, the change [x] of x at the step towards s = 1, and h′ = q,

        dF/db = −∫ v″² ds,   dF/dq = −∫ wₐ ∂h/∂q v′² + (wₗ/Δ) v² ds,
        dF/ds = −(m² [1/b] − (wₗ/Δ)[q] v² + wₐ [q] ∫₀ˢ v′² ds),

    the first two integrals over the section (∂h/∂q is minus the length of it that is above; by a factor, minus its
    weight that is above, and the others have b and q in them), all over ∫ v′² ds.
    """
    rod, breaks = problem.rod, problem.rod.breaks
    y, slope, bend = space.at_points(coefficients)
    w, piece = space.weights, rod.stiffness.piece_of(space.points)
    whole, n = w @ slope**2, len(problem.sections)

    def each(values: FloatArray) -> FloatArray:
        return np.asarray(np.bincount(piece, w * values, n), dtype=float)

    below = np.concatenate([[0.0], np.cumsum(each(slope**2))])
    lateral, axial = problem.foundation / problem.clearance, problem.axial_weight
    lengths, above = np.diff(breaks), breaks[piece + 1] - space.points
    stiffer, heavier = np.ones((2, above.size))
    if rod.tapered:
        tapers, ends = rod.tapers("weight"), rod.lever.in_pieces(breaks[1:], np.arange(n))
        stiffer = np.where(rod.tapers("stiffness")[piece], rod.stiffness(space.points), 1.0)
        heavier = np.where(tapers[piece], rod.weight(space.points), 1.0)
        lengths = np.where(tapers, ends - rod.lever(breaks[:-1]), lengths)
        above = np.where(tapers[piece], ends[piece] - rod.lever(space.points), above)
    hung = -(lengths * below[:-1] + each(above * slope**2))
    at, _, curvature = space.evaluate(coefficients, breaks[1:-1], 3)
    b, q = rod.stiffness.coefficients[:, 0], rod.weight.coefficients[:, 0]
    moved = (b[1:] * curvature) ** 2 * np.diff(1.0 / b) - lateral * np.diff(q) * at**2
    return {
        "stiffness": -each(stiffer * bend**2) / whole,
        "weight": -(axial * hung + lateral * each(heavier * y**2)) / whole,
        "upper_end": -(moved + axial * np.diff(q) * below[1:-1]) / whole,
    }


def weight_rates(problem: Problem, over: str) -> tuple[float, float]:
    """Derivatives of wₐ and of wₗ/Δ (negative for a rod on top) by "weight", "alpha" in degrees, or "clearance"."""
    sign = -1.0 if problem.on_top else 1.0
    angle = math.radians(problem.alpha)
    if over == "weight":
        unit = problem.but(weight=1.0)
        return unit.axial_weight, unit.foundation / problem.clearance
    if over == "alpha":
        rate = math.radians(1.0) * problem.weight
        upwards = -1.0 if problem.floats else 1.0
        return -upwards * rate * math.sin(angle), sign * rate * math.cos(angle) / problem.clearance
    if over == "clearance":
        return 0.0, -problem.foundation / problem.clearance**2
    return 0.0, 0.0


def rates_along(problem: Problem, over: ParameterPath, t: float) -> tuple[float, float]:
    """Derivatives of wₐ and of wₗ/Δ at ``t`` on a path of one's own."""
    here, rate = on_path(path(problem, over), t)
    lateral = rate[LATERAL_WEIGHT] - here[LATERAL_WEIGHT] / here[CLEARANCE] * rate[CLEARANCE]
    return float(rate[AXIAL_WEIGHT]), float(lateral / here[CLEARANCE])

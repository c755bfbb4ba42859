"""Derivatives of critical loads by what a problem is made of, from the mode: the theorem of Hellmann and Feynman."""

from __future__ import annotations

import math

from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray


def load_slope(space: SplineSpace, coefficients: FloatArray, axial: float, foundation: float) -> float:
    """dF/dq of a critical load with the mode given by ``coefficients``, from the rates of wₐ and wₗ/Δ by q.

    With the coefficients of (64): dF/dq = −(∫ (∂wₐ/∂q)(s − 1) v′² ds + ∫ ∂(wₗ/Δ)/∂q v² ds) / ∫ v′² ds.
    """
    y, slope, _ = space.at_points(coefficients)
    w, s = space.weights, space.points
    above = axial * (w @ ((s - 1.0) * slope**2)) + foundation * (w @ y**2)
    return float(-above / (w @ slope**2))


def weight_rates(problem: Problem, over: str) -> tuple[float, float]:
    """Derivatives of wₐ and of wₗ/Δ (negative for a rod on top) by "weight", "alpha" in degrees, or "clearance"."""
    sign = -1.0 if problem.on_top else 1.0
    angle = math.radians(problem.alpha)
    if over == "weight":
        unit = problem.but(weight=1.0)
        return unit.axial_weight, unit.foundation / problem.clearance
    if over == "alpha":
        rate = math.radians(1.0) * problem.weight
        return -rate * math.sin(angle), sign * rate * math.cos(angle) / problem.clearance
    if over == "clearance":
        return 0.0, -problem.foundation / problem.clearance**2
    return 0.0, 0.0

"""Families of equilibria of a :class:`Problem`: where rod meets solver."""

from __future__ import annotations

import numpy as np

from rodwell.numerics.families import Family
from rodwell.numerics.spaces import FloatArray, SplineSpace
from rodwell.physics.model import RodOnCylinder
from rodwell.physics.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, LATERAL_WEIGHT, PARAMETERS, TWIST
from rodwell.problem import Problem

CLAMPED = 2
"""Spline coefficients held at a clamped end: those of y and y'."""


def parameters(problem: Problem, force: float = 0.0) -> FloatArray:
    """Physical parameters of ``problem`` in the order that kernels take them, (5,)."""
    out = np.empty(len(PARAMETERS))
    out[FORCE], out[AXIAL_WEIGHT], out[LATERAL_WEIGHT] = force, problem.axial_weight, problem.foundation
    out[CLEARANCE], out[TWIST] = problem.clearance, problem.twist
    return out


def force_family(problem: Problem, space: SplineSpace, *, parity: int, wavenumber: float, force_scale: float) -> Family:
    """Equilibria of ``problem`` as the end force F varies.

    ``wavenumber`` sets the slope that counts as one unit of arclength, Δ k (an amplitude of one radian);
    ``force_scale`` the change of force that does.
    """
    rates = np.zeros(len(PARAMETERS))
    rates[FORCE] = 1.0
    return Family(
        model=RodOnCylinder(),
        base=parameters(problem),
        rates=rates,
        space=space,
        held=(CLAMPED, CLAMPED),
        parity=parity,
        scale_c=problem.clearance,
        slope_scale=problem.clearance * wavenumber,
        lam_scale=force_scale,
    )

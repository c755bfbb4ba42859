"""An elastic curve in space beside the rod in a curved hole: a method that knows no formula of the rod on the wall.

The centre line is put into space on the wall of the arc, its curvature and height are differentiated and integrated by
Chebyshev polynomials, and the energy is made least over the coefficients of a polynomial by Newton's method with
differences of nothing but itself.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial import chebyshev

from rodwell import Problem
from rodwell.quantities.arrays import FloatArray

CLEARANCE = 0.01

DEGREE = 64
NODES = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
FIT = np.linalg.inv(chebyshev.chebvander(NODES, DEGREE))
"""From values at the nodes to coefficients of Chebyshev polynomials."""

CLAMPED = chebyshev.poly2cheb([0.0625, 0.0, -0.125, 0.0, 0.0625])
"""s²(1 − s)²."""


def energy_in_space(coefficients: FloatArray, problem: Problem, force: float) -> float:
    """Bending, height and work of a rod with θ = s²(1 − s)² Σ aₖ Tₖ on the wall of a constant arc.

    A rod that floats is on the opposite wall, towards N1, and what lifts it does work as it rises.
    """
    down = -1.0 if problem.floats else 1.0
    shape = CLEARANCE * chebyshev.chebmul(CLAMPED, coefficients)
    slope = 2.0 * chebyshev.chebval(NODES, chebyshev.chebder(shape))
    theta, kappa = chebyshev.chebval(NODES, shape) / CLEARANCE, np.array([problem.build, -problem.walk])
    inwards = down * (kappa[0] * np.cos(theta) - kappa[1] * np.sin(theta))
    ahead = chebyshev.chebint(FIT @ (np.sqrt(1.0 - slope**2) / (1.0 + CLEARANCE * inwards)), lbnd=-1.0, scl=0.5)
    start = 0.5 - 0.5 / (1.0 + CLEARANCE * down * problem.build)
    place = start + chebyshev.chebval(NODES, ahead) - 0.5
    size, alpha = float(np.hypot(*kappa)), math.radians(problem.alpha)
    bend = np.array([kappa[0] / size, kappa[1] / size, 0.0])  # along N1, N2, T of the middle
    sine, cosine = np.sin(size * place)[:, None], np.cos(size * place)[:, None]
    axial = np.array([0.0, 0.0, 1.0])
    axis = (sine * axial + (1.0 - cosine) * bend) / size
    tilt = (cosine - 1.0) * bend - sine * axial  # what turning T by κS about T × k does to k/κ
    n1, n2 = (np.eye(3)[i] + bend[i] * tilt for i in (0, 1))
    centre = axis - down * CLEARANCE * (np.cos(theta)[:, None] * n1 - np.sin(theta)[:, None] * n2)
    second = 4.0 * chebyshev.chebval(NODES, chebyshev.chebder(FIT @ centre, 2))
    height = np.sin(alpha) * centre[:, 0] + np.cos(alpha) * centre[:, 2]
    density = chebyshev.chebint(FIT @ (0.5 * np.sum(second**2, axis=0) + down * problem.weight * height), scl=0.5)
    stored = float(np.diff(chebyshev.chebval(np.array([-1.0, 1.0]), density))[0])
    return stored - force * (1.0 + CLEARANCE * down * problem.build) * float(chebyshev.chebval(1.0, ahead))


def least_energy(problem: Problem, force: float, count: int) -> FloatArray:
    """Coefficients (count,) of least energy, by Newton's method with differences of the energy alone."""
    step = 1e-2 * np.eye(count)
    at = np.zeros(count)
    for _ in range(6):
        here = energy_in_space(at, problem, force)
        after, before = (
            np.array([energy_in_space(at + sign * one, problem, force) for one in step]) for sign in (1.0, -1.0)
        )
        hessian = np.diag(after - 2.0 * here + before)
        for i in range(count):
            for j in range(i):
                both = energy_in_space(at + step[i] + step[j], problem, force)
                hessian[i, j] = hessian[j, i] = both - after[i] - after[j] + here
        at = at - 1e-2 * np.linalg.solve(hessian, 0.5 * (after - before))
    return at

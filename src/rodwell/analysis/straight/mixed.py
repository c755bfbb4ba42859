"""Branches that leave the straight rod along two modes at once, where their critical loads coincide.

Next to a double load equilibria lie close to the plane of the two modes, where the energy restricted to it is
stationary: with amplitudes a, its gradient g(a) and G = ∫φᵢ′φⱼ′, what the load has beyond the critical one is a
multiplier, g(a) ∥ G a. On a small circle that is one equation for the direction. Besides the modes themselves it has
solutions in which both grow together. See M. Golubitsky, I. Stewart, D. G. Schaeffer, *Singularities and Groups in
Bifurcation Theory* II, Springer (1988), chapter X. Under twist, whose energy has terms of third order, directions are
those of the lowest order.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from rodwell.analysis.discrete.family import family, reflections
from rodwell.analysis.straight.critical import Mode
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Value

DIRECTIONS = 180
"""Directions in half a turn at which the equation is looked at; two solutions closer than that are not seen."""

SMALL = 1e-2
"""Radius of the circle, in radians around the cylinder."""

PURE = 1e-2
"""Angle in rad within which a direction is that of a mode by itself, or of another solution."""


def mixed_modes(problem: Problem, first: Mode, second: Mode) -> tuple[Mode, ...]:
    """Directions in which branches leave a double critical load along both modes, images by reflections left out."""
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    equation = _equation(problem, first, second)
    angles = np.pi * (np.arange(DIRECTIONS + 1) + 0.5) / DIRECTIONS
    values = [equation(angle) for angle in angles]
    found: list[float] = []
    for (low, at_low), (high, at_high) in pairwise(zip(angles, values, strict=True)):
        if at_low * at_high >= 0.0:
            continue
        angle = float(brentq(equation, low, high))
        images = (angle, np.pi - angle) if _turns(problem, first, second) else (angle,)
        if not any(_same(image, known) for image in images for known in (0.0, 0.5 * np.pi, *found)):
            found.append(angle)
    return tuple(_mixture(problem, first, second, angle) for angle in found)


def _same(angle: float, other: float) -> bool:
    """Whether two directions are one, up to the sign."""
    return abs(math.sin(angle - other)) < PURE


def _turns(problem: Problem, first: Mode, second: Mode) -> bool:
    """Whether a reflection changes the sign of one amplitude against the other."""
    return first.parity * second.parity < 0 and any(turned for _, turned in reflections(problem))


def _scale(mode: Mode) -> float:
    """What makes of a mode an amplitude of one radian around the cylinder."""
    return float(mode.problem.clearance / np.max(np.abs(mode.space.at_points(mode.coefficients)[0])))


def _equation(problem: Problem, first: Mode, second: Mode) -> Callable[[float], float]:
    """What vanishes in the direction (cos θ, sin θ) of a branch: the part of g(a) across G a."""
    space, load = first.space, 0.5 * (first.force + second.force)
    plane = np.array([_scale(mode) * mode.coefficients for mode in (first, second)])
    slopes = np.array([space.at_points(c)[1] for c in plane])
    gram = (slopes * space.weights) @ slopes.T
    equilibria = family(problem, space, parity=0, wavenumber=first.wavenumber, scale=abs(load))

    def across(angle: float) -> float:
        a = np.array([np.cos(angle), np.sin(angle)])
        gradient = plane @ equilibria.assemble(SMALL * a @ plane, load)[1]
        along = gram @ a
        return float(gradient[0] * along[1] - gradient[1] * along[0])

    return across


def _mixture(problem: Problem, first: Mode, second: Mode, angle: float) -> Mode:
    """The direction (cos θ, sin θ) in the plane of two modes."""
    shares = _scale(first) * np.cos(angle), _scale(second) * np.sin(angle)
    coefficients = shares[0] * first.coefficients + shares[1] * second.coefficients
    coarse = shares[0] * first.coarse[1] + shares[1] * second.coarse[1]
    apart = abs(first.force - second.force)
    load = Value(0.5 * (first.force + second.force), max(first.error, second.error) + apart)
    return replace(
        first, load=load, parity=first.parity if first.parity == second.parity else 0,
        wavenumber=first.space.wavenumber(coefficients), coefficients=coefficients,
        coarse=(first.coarse[0], coarse), mixed=True,
    )  # fmt: skip

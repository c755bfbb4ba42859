"""How a string lies in a hole whose clearance has steps: it bridges them, in the vertical plane of the hole's axis.

Beside a step it lies on the wall of the wider part, leaves it, rises over the edge of the narrower part, touching it at
one place without a couple, and comes down on the wall beyond. Which parts touch is found with a beam of small slopes
that springs keep off the walls' lower sides: a convex problem, so long as the string is nowhere compressed. The pattern
found there is solved for as any other, with the energy of any slope (:mod:`rodwell.analysis.off_wall.arrange`).
"""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import cholesky_banded, solveh_banded

from rodwell.analysis.off_wall.arrange import solved, wavenumber
from rodwell.analysis.off_wall.conditions import PatternedState, conditions
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.basis import tabulate
from rodwell.numerics.stretches.carry import Sampler
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import BoolArray, FloatArray

FREE_LENGTH = 24.0 / (2.0 * math.sqrt(3.0) - 3.0)
"""a⁴ w/(Bδ): how far from the edge a heavy beam without end force touches the wider part, over a step δ."""

PER_BRIDGE, PER_WAVE, FEWEST = 40, 8.0, 1000
"""Elements of the beam: in a free length, in a wavelength over 2π of the stretched or bedded beam, and in all."""

MOST = 40_000

TOUCHING = 1e-5
"""Part of the smallest step below which a gap counts as contact, and the sag of the springs by as much less."""

SHORTEST = 0.05
"""Part of a free length below which a piece of contact is taken for a point."""

JOINED = 0.25
"""Part of a free length below which a gap between pieces of contact is one of the springs, which stand apart: under
weight no gap is that short that begins without a slope and ends without a curvature."""

HARDER, ROUNDS, HALVINGS = 10.0, 60, 30
"""Factor from one stiffness of the springs to the next; rounds of Newton's method with each, halvings of a step."""


def unstretched(problem: Problem) -> float:
    """The least end force F at s = 1 under which no part of the straight rod is compressed."""
    return max(problem.hung_weight, 0.0)


def bridged(model: RodInHole, load: float) -> PatternedState | None:
    """How the string lies at an end force under which a beam without walls is stable; None if that was not found."""
    try:
        places, height = _beam(model, load)
    except np.linalg.LinAlgError:  # it would buckle without walls: there may be several states
        return None
    for at_ends in (True, False):
        pattern, breaks = _pattern(model.problem, places, height[::2], at_ends)
        found = solved(model, pattern, breaks, load, _sampler(places, height))
        if found is not None and all(one.value >= 0.0 for one in conditions(found)):
            return found
    return None


def _steps(problem: Problem) -> FloatArray:
    """Heights of the steps of the wall, in Δ."""
    return np.abs(np.diff(problem.rod.clearance.coefficients[:, 0]))


def free_lengths(problem: Problem) -> FloatArray:
    """Length, in L, by which a heavy beam without end force bridges each boundary of sections on its wider side.

    Those of the softer and lighter of two sections; 0 where the clearance has no step.
    """
    rod = problem.rod
    stiffness, weight = rod.stiffness.coefficients[:, 0], rod.weight.coefficients[:, 0]
    softest, lightest = (np.minimum(one[:-1], one[1:]) for one in (stiffness, weight))
    heaviest = np.maximum(weight[:-1], weight[1:])
    per_length = problem.lateral_weight * np.where(lightest > 0.0, lightest, heaviest)
    return np.asarray((FREE_LENGTH * softest * problem.clearance * _steps(problem) / per_length) ** 0.25)


def _beam(model: RodInHole, load: float) -> tuple[FloatArray, FloatArray]:
    """Nodes of a beam (n,), and its height above the hole's axis and slope there in Δ, in turn, (2n,)."""
    problem, breaks = model.problem, model.problem.rod.breaks
    lengths = free_lengths(problem)
    finest = min(float(np.min(lengths[lengths > 0.0])) / PER_BRIDGE, 1.0 / (PER_WAVE * wavenumber(model, load)))
    numbers = np.ceil(np.diff(breaks) / max(finest, 1.0 / MOST)).astype(int)
    numbers = np.maximum(numbers, np.ceil(FEWEST * np.diff(breaks)).astype(int))
    parts = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(breaks[:-1], breaks[1:], numbers, strict=True)]
    places = np.append(np.concatenate(parts), 1.0)
    band, force = _assembled(model, load, places)
    floor, held = -_narrowest(problem, places), _held(problem, places.size)
    cholesky_banded(_without_held(band, held), lower=True)
    height = np.zeros(2 * places.size)
    height[::2] = floor
    size = _sag(problem, places)
    for stiffness in size * HARDER ** np.arange(-4.0, 1.0):
        height = _on_springs(band, force, floor, held, stiffness, height)
    return places, height


def _narrowest(problem: Problem, places: FloatArray) -> FloatArray:
    """The clearance in Δ at places, at a step that of the narrower part."""
    before, after = (problem.rod.clearance(np.clip(np.nextafter(places, to), 0.0, 1.0)) for to in (-1.0, 2.0))
    return np.minimum(before, after)


def _held(problem: Problem, nodes: int) -> BoolArray:
    """Which heights and slopes the ends hold: all ends hold the height, all but ball joints the slope."""
    held = np.zeros(2 * nodes, dtype=bool)
    held[[0, -2]] = True
    held[[1, -1]] = [end != "ball" for end in problem.ends]
    return held


def _sag(problem: Problem, places: FloatArray) -> float:
    """Stiffness of a spring at a node that the weight of a free length presses in by far less than a step."""
    steps, lengths = _steps(problem), free_lengths(problem)
    bridges = lengths > 0.0
    weight = problem.lateral_weight * float(np.max(problem.rod.weight.coefficients)) / problem.clearance
    return weight * float(np.max(lengths)) / (0.1 * TOUCHING * float(np.min(steps[bridges])))


def _assembled(model: RodInHole, load: float, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Stiffness as a lower band (4, 2n) and load (2n,) of the beam under its tension and weight."""
    problem, h = model.problem, np.diff(places)
    points, weights = np.polynomial.legendre.leggauss(4)
    xi = 0.5 * (points + 1.0)
    table = tabulate(3, xi, 3)  # (3, q, 4)
    s = places[:-1, None] + h[:, None] * xi
    rod, shape = problem.rod, s.shape
    stiffness, weight, lever = (one(s.ravel()).reshape(shape) for one in (rod.stiffness, rod.weight, rod.lever))
    tension = load + problem.axial_weight * lever
    scale = np.stack([np.ones_like(h), h, np.ones_like(h), h], axis=1)  # of slopes
    w = 0.5 * weights
    matrix = np.einsum("eq,qi,qj->eij", stiffness * w / h[:, None] ** 3, table[2], table[2])
    matrix += np.einsum("eq,qi,qj->eij", tension * w / h[:, None], table[1], table[1])
    matrix *= scale[:, :, None] * scale[:, None, :]
    push = -problem.lateral_weight / problem.clearance * np.einsum("eq,qi->ei", weight * w * h[:, None], table[0])
    band, force = np.zeros((4, 2 * places.size)), np.zeros(2 * places.size)
    first = 2 * np.arange(h.size)
    for i in range(4):
        np.add.at(force, first + i, push[:, i] * scale[:, i])
        for j in range(i + 1):
            np.add.at(band[i - j], first + j, matrix[:, i, j])
    return band, force


def _without_held(band: FloatArray, held: BoolArray) -> FloatArray:
    """A lower band whose rows and columns of what is held are those of the identity."""
    out, free = band.copy(), ~held
    out[0, held] = 1.0
    for k in range(1, 4):
        out[k, :-k] *= free[k:] & free[:-k]
    return out


def _on_springs(
    band: FloatArray, force: FloatArray, floor: FloatArray, held: BoolArray, stiffness: float, height: FloatArray
) -> FloatArray:
    """The beam on one-sided springs at its nodes: a convex energy, minimised by Newton's method with halved steps."""
    free = ~held

    def gradient(u: FloatArray) -> FloatArray:
        out = band[0] * u - force
        for k in range(1, 4):
            out[k:] += band[k, :-k] * u[:-k]
            out[:-k] += band[k, :-k] * u[k:]
        out[::2] -= stiffness * np.maximum(floor - u[::2], 0.0)
        return np.asarray(out * free)

    for _ in range(ROUNDS):
        now, pressed = gradient(height), height[::2] < floor
        sprung = band.copy()
        sprung[0, ::2] += stiffness * pressed
        sprung = _without_held(sprung, held)
        step = -solveh_banded(sprung, now, lower=True) * free
        part = 1.0
        for _ in range(HALVINGS):  # along a line a convex energy falls as long as its slope is negative
            if float(gradient(height + part * step) @ step) <= 0.5 * abs(float(now @ step)):
                break
            part *= 0.5
        height = height + part * step
        if part == 1.0 and np.array_equal(pressed, height[::2] < floor):
            break
    return height


def _pattern(problem: Problem, places: FloatArray, height: FloatArray, at_ends: bool) -> tuple[Pattern, FloatArray]:
    """Which parts of a beam with this height (n,) at its nodes touch: the pattern, and the ends of its stretches.

    ``at_ends``: whether short contact beside an end counts, where it may be that of the end itself.
    """
    steps, lengths = _steps(problem), free_lengths(problem)
    bridges = lengths > 0.0
    near = TOUCHING * float(np.min(steps[bridges]))
    short = SHORTEST * float(np.min(lengths[bridges]))
    on = height + _narrowest(problem, places) < near
    corner = np.isin(places, problem.rod.clearance_steps)
    edges = tuple(map(float, places[on & corner]))
    touching, breaks = [], []
    flat = np.concatenate([[False], on & ~corner, [False]])
    starts, stops = np.flatnonzero(flat[1:] & ~flat[:-1]), np.flatnonzero(flat[:-1] & ~flat[1:]) - 1
    pieces = list(zip(places[starts], places[stops], strict=True))
    for left, right in _joined(pieces, JOINED * float(np.min(lengths[bridges])), places[corner]):
        at_end = left == 0.0, right == 1.0
        if right - left < short and not (any(at_end) and at_ends and right > left):
            if not any(at_end):  # there it is held anyway
                touching.append(False)
                breaks.append(0.5 * (left + right))
            continue
        touching += [True] if at_end[0] else [False, True]
        breaks += [end for end, last in zip((left, right), at_end, strict=True) if not last]
    if len(touching) == len(breaks):  # nothing touches at s = 1
        touching.append(False)
    return Pattern(tuple(touching), planar=True, edges=edges), np.array(breaks)


def _joined(pieces: list[tuple[float, float]], short: float, corners: FloatArray) -> list[tuple[float, float]]:
    """Pieces of contact, those joined that have less than ``short`` between them, and no corner."""
    out: list[tuple[float, float]] = []
    for left, right in pieces:
        apart = not out or left - out[-1][1] > short
        if apart or np.any((corners > out[-1][1]) & (corners < left)):
            out.append((left, right))
        else:
            out[-1] = (out[-1][0], right)
    return out


def _sampler(places: FloatArray, height: FloatArray) -> Sampler:
    """A beam with heights and slopes (2n,) at its nodes, as a shape in the plane."""

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        element = np.clip(np.searchsorted(places, s, side="right") - 1, 0, places.size - 2)
        h = np.diff(places)[element]
        ends = np.stack([height[2 * element + k] * (h if k % 2 else 1.0) for k in range(4)], axis=1)
        table = tabulate(3, (s - places[element]) / h, 3)
        fields = np.zeros((2, 3, s.size))
        fields[0] = np.einsum("okf,kf->ok", table, ends) / h ** np.arange(3)[:, None]
        return fields, np.zeros((3, s.size))

    return sample

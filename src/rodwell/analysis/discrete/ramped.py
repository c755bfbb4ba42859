"""A wall whose clearance varies along the rod, as kernels take it: see :mod:`rodwell.physics.on_wall.ramps`."""

from __future__ import annotations

from functools import partial

import numpy as np

from rodwell.numerics.equilibria.family import Given
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, COUNT, FORCE, LATERAL_WEIGHT, SIDE
from rodwell.physics.on_wall.ramps import DRIVE_TERMS, TERMS, Wall, strand, wall_at
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray, IntArray


def along_ramps(problem: Problem) -> Given:
    """What :mod:`rodwell.physics.on_wall.ramps` names at places (m,), (m, 66)."""
    return partial(_rows_at, problem.rod.breaks[1:-1], _table(problem))


def _rows_at(inner: FloatArray, rows: FloatArray, places: FloatArray) -> FloatArray:
    return np.ascontiguousarray(rows[np.searchsorted(inner, places, side="right")])


def _table(problem: Problem) -> FloatArray:
    """Rows (n, 66) of what is given, one for each section."""
    rod, breaks = problem.rod, problem.rod.breaks
    centre, half, owner = 0.5 * (breaks[1:] + breaks[:-1]), 0.5 * np.diff(breaks), np.arange(breaks.size - 1)
    nodes, fit = _nodes(TERMS)
    places, piece = (centre[:, None] + half[:, None] * nodes).ravel(), np.repeat(owner, TERMS)
    columns = [centre[:, None], 1.0 / half[:, None], np.ones((owner.size, 1))]
    for profile, size in ((rod.stiffness, 1.0), (rod.weight, 1.0), (rod.clearance, problem.clearance)):
        columns.append(size * profile.in_pieces(places, piece).reshape(-1, TERMS) @ fit.T)
    columns.append(np.zeros((owner.size, 3 * DRIVE_TERMS)))
    rows = np.concatenate(columns, axis=1)
    last = wall_at(np.ones(1), rows[-1:].T)
    rows[:, 2] = 1.0 / last.lying[0][0]
    rows[:, -3 * DRIVE_TERMS :] = _drive(rows, centre, half, _left_at_end(last))
    return rows


def _left_at_end(last: Wall) -> float:
    """λ + 3/2 bκ₀² at s = 1 without an end force: N = λz₀′ − (bz₀″)′ vanishes there."""
    (b, b1, _), (z1, z2, z3), bend = last.stiffness, last.lying, last.clearance[2]
    return float(((b1 * z2 + b * z3) / z1 + 1.5 * b * (bend / z1) ** 2)[0])


def _nodes(terms: int) -> tuple[FloatArray, FloatArray]:
    """Chebyshev nodes (terms,) on [−1, 1], and the matrix from values there to coefficients of powers."""
    nodes = np.polynomial.chebyshev.chebpts1(terms)
    fit = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes, terms - 1))
    powers = np.zeros((terms, terms))
    for k in range(terms):
        own = np.polynomial.chebyshev.cheb2poly(np.eye(terms)[k])
        powers[: own.size, k] = own
    return nodes, powers @ fit


def _drive(rows: FloatArray, centre: FloatArray, half: FloatArray, end: float) -> FloatArray:
    """Integrals from 1 to s of −½b′κ₀², −qΔ′ and qz₀′, the first with what is left at s = 1, (n, 3 · DRIVE_TERMS)."""
    nodes, fit = _nodes(DRIVE_TERMS - 1)
    s = centre[:, None] + half[:, None] * nodes
    wall = wall_at(s.ravel(), np.repeat(rows, nodes.size, axis=0).T)
    slope, bend, q, z1 = wall.clearance[1], wall.clearance[2], wall.weight, wall.lying[0]
    out = []
    for rate, last in ((-0.5 * wall.stiffness[1] * (bend / z1) ** 2, end), (-q * slope, 0.0), (q * z1, 0.0)):
        powers = rate.reshape(s.shape) @ fit.T * half[:, None]
        raised = np.concatenate([np.zeros((half.size, 1)), powers / np.arange(1.0, DRIVE_TERMS)], axis=1)
        above = raised @ np.ones(DRIVE_TERMS)  # at the upper end of each section
        below = raised @ (-1.0) ** np.arange(DRIVE_TERMS)
        gained = np.cumsum((above - below)[::-1])[::-1]
        raised[:, 0] += last - gained - below
        out.append(raised)
    return np.concatenate(out, axis=1)


def contact_on_ramps(problem: Problem, places: FloatArray, section: IntArray) -> tuple[FloatArray, FloatArray]:
    """Contact force per length in B/L³ of the rod that lies, towards the axis, at F = 0 and by F, at places (m,)."""
    given, shape, own = _table(problem)[section].T, np.zeros((4, places.size)), _parameters(problem)
    pressures = []
    for force in (0.0, 1.0):
        own[FORCE] = force
        pressures.append(-strand(places, shape, given, own).pressure)
    at_rest, pushed = pressures
    return at_rest, pushed - at_rest


def _parameters(problem: Problem) -> FloatArray:
    """Parameters of a rod on such a wall without an end force, as kernels take them, (7,)."""
    out = np.zeros(COUNT)
    out[AXIAL_WEIGHT], out[LATERAL_WEIGHT] = problem.axial_weight, problem.foundation
    out[CLEARANCE], out[SIDE] = problem.clearance, -1.0 if problem.outside else 1.0
    return out

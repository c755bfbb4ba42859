"""The stiff string: how a string with bending stiffness lies in a curved hole, and where it presses the wall.

In a rotation-minimising frame along the hole with curvature vector **k**, a string displaced by **u** from the axis has
the curvature **k** + **u**″ and, under the effective tension F and its weight w,

    E = ∫ ½ B |u″ + k|² + ½ F |u′|² − (F k + w g⊥)·u dx,      |u| ≤ r,

small slopes against the hole. It is solved by cubic Hermite elements with Newton's method; the wall acts at the nodes,
by a stiffness at which nothing goes into it deeper than a small part of the clearance. Where the string presses one
side only, contact forces add up to those of the soft string, concentrated where the curvature changes; where bending
takes it to the other side, there are more of them.

Ends: hinged in the middle of the hole at surface; free at the bit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, solveh_banded

from rodwell.quantities.arrays import FloatArray
from rodwell.survey.survey import Survey

INTO_WALL = (1e-3, 1e-4, 1e-5, 1e-6)
"""Parts of the clearance by which the weight of the string presses it into the wall: each wall from the one before."""

MOST_STEPS, SETTLED, SHORTEST_STEP = 200, 1e-9, 1e-6
BANDS = 8
"""Diagonals of the matrix, the main one and those below: four unknowns at a node, u₁, u₁′, u₂, u₂′."""


@dataclass(frozen=True)
class Lay:
    """A string as it lies: nodes from the top down.

    Attributes
    ----------
    depth
        Measured depths of the nodes in m, (n + 1,).
    displacement
        (n + 1, 2) in m, in the frame of the hole.
    force
        Contact force at each node in N, (n + 1,), 0 or more: the wall on the string.
    curvature
        Largest curvature |k + u″| of the string in 1/m over each element, (n,).
    settled
        Whether Newton's method has ended where nothing changes any more.
    """

    depth: FloatArray
    displacement: FloatArray
    force: FloatArray
    curvature: FloatArray
    settled: bool


@dataclass(frozen=True)
class Loads:
    """What acts on the elements of a string, (n,) each, from the top down.

    Attributes
    ----------
    stiffness, tension
        B in N m² and F in N.
    curvature
        **k** in 1/m, (n, 2).
    lateral
        w **g**⊥ in N/m, (n, 2).
    clearance
        r in m.
    """

    stiffness: FloatArray
    tension: FloatArray
    curvature: FloatArray
    lateral: FloatArray
    clearance: FloatArray


def frame(survey: Survey) -> tuple[FloatArray, FloatArray]:
    """Two unit normals at every station, (n, 2, 3), carried along the hole without turning, and tangents (n, 3).

    Coordinates north, east, down. Along an arc the frame turns with the tangent, so **k** keeps its components.
    """
    a = np.radians(survey.inclination)
    b = np.zeros(len(survey)) if survey.azimuth is None else np.radians(survey.azimuth)
    t = np.stack([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)], axis=1)
    first = np.array([np.cos(a[0]) * np.cos(b[0]), np.cos(a[0]) * np.sin(b[0]), -np.sin(a[0])])
    normals = np.empty((len(survey), 2, 3))
    normals[0] = first, np.cross(t[0], first)
    for i in range(len(survey) - 1):
        for j in range(2):
            # the rotation that takes one tangent to the next, about their common normal (double reflection)
            v = normals[i, j] - (normals[i, j] @ t[i + 1]) / (1.0 + t[i] @ t[i + 1]) * (t[i] + t[i + 1])
            normals[i + 1, j] = v / np.linalg.norm(v)
    return normals, t


def loads_at(
    survey: Survey, middles: FloatArray, normals: FloatArray, tangents: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Components of the curvature (m, 2) in 1/m and of **g**⊥ (m, 2), downwards, at measured depths (m,) in m."""
    i = np.clip(np.searchsorted(survey.md, middles, side="right") - 1, 0, len(survey) - 2)
    length, dogleg = np.diff(survey.md)[i], survey.dogleg[i]
    bent = dogleg > 1e-12
    sine = np.where(bent, np.sin(np.where(bent, dogleg, 1.0)), 1.0)
    inward = tangents[i + 1] - np.cos(dogleg)[:, None] * tangents[i]  # sin θ times the normal at the upper station
    normal = np.where(bent[:, None], inward / sine[:, None], 0.0)
    curvature = np.einsum("mjk,mk->mj", normals[i], normal) * (dogleg / length)[:, None]
    angle = dogleg * (middles - survey.md[i]) / length
    # a frame vector N of the upper station turns to N + (N·n)[(cos − 1) n − sin t]: of its third component g·N is made
    parts = np.einsum("mjk,mk->mj", normals[i], normal)
    turned = (np.cos(angle) - 1.0) * normal[:, 2] - np.sin(angle) * tangents[i][:, 2]
    return curvature, normals[i][:, :, 2] + parts * turned[:, None]


def lay(depth: FloatArray, loads: Loads, start: FloatArray) -> Lay:
    """Solve for the string at nodes of measured depth (n + 1,), from displacements (n + 1, 2)."""
    nodes = len(depth)
    h = np.diff(depth)
    band, load = _beam(h, loads)
    weight = np.linalg.norm(loads.lateral, axis=1)
    share = np.zeros(nodes)
    share[:-1] += 0.5 * h
    share[1:] += 0.5 * h
    clearance = np.minimum(np.append(loads.clearance, np.inf), np.append(np.inf, loads.clearance))
    first = np.zeros((nodes, 4))
    first[:, 0], first[:, 2] = start[:, 0], start[:, 1]
    x, settled = first.ravel(), False
    for into in INTO_WALL:
        wall = share * max(float(np.max(weight)), 1.0) / (into * float(np.min(clearance)))
        x[[0, 2]] = 0.0
        x, settled = _least(x, band, load, wall, clearance)
    u = x.reshape(-1, 4)[:, [0, 2]]
    deep = np.maximum(np.linalg.norm(u, axis=1) - clearance, 0.0)
    return Lay(depth, u, wall * deep, _bent(x, h, loads.curvature), settled)


def _bent(x: FloatArray, h: FloatArray, curvature: FloatArray) -> FloatArray:
    """Largest curvature of the string over each element, (n,): u″ is linear there."""
    values = x.reshape(-1, 2, 2)
    u, slope, step = values[:, :, 0], values[:, :, 1], h[:, None]
    rise = 6.0 * np.diff(u, axis=0)
    first = (rise - step * (4.0 * slope[:-1] + 2.0 * slope[1:])) / step**2
    last = (-rise + step * (2.0 * slope[:-1] + 4.0 * slope[1:])) / step**2
    ends = [np.linalg.norm(curvature + second, axis=1) for second in (first, last)]
    return np.asarray(np.maximum(*ends))


def _least(
    x: FloatArray, band: FloatArray, load: FloatArray, wall: FloatArray, clearance: FloatArray
) -> tuple[FloatArray, bool]:
    """Newton's method with a line search: the state of least energy from ``x``, and whether it settled."""
    energy, residual, stiff = _state(x, band, load, wall, clearance)
    for _ in range(MOST_STEPS):
        step = _solve(stiff, -residual)
        part = 1.0
        while part > SHORTEST_STEP:
            new = x + part * step
            trial = _state(new, band, load, wall, clearance)
            if trial[0] <= energy + 1e-4 * part * float(residual @ step) + 1e-12 * abs(energy):
                break
            part *= 0.5
        moved = float(np.max(np.abs(part * step.reshape(-1, 4)[:, [0, 2]]) / clearance[:, None]))
        x, (energy, residual, stiff) = new, trial
        if moved <= SETTLED:
            return x, True
    return x, False


def _beam(h: FloatArray, loads: Loads) -> tuple[FloatArray, FloatArray]:
    """Matrix of bending and tension as lower bands (8, 4(n + 1)), and loads (4(n + 1),); hinged at the first node."""
    n = len(h)
    one, zero = np.ones(n), np.zeros(n)
    b, f = loads.stiffness, loads.tension
    sixth, square = 6.0 * h, h**2
    bend = (b / h**3) * np.array(
        [
            [12.0 * one, sixth, -12.0 * one, sixth],
            [sixth, 4.0 * square, -sixth, 2.0 * square],
            [-12.0 * one, -sixth, 12.0 * one, -sixth],
            [sixth, 2.0 * square, -sixth, 4.0 * square],
        ]
    )
    pull = (f / (30.0 * h)) * np.array(
        [
            [36.0 * one, 3.0 * h, -36.0 * one, 3.0 * h],
            [3.0 * h, 4.0 * square, -3.0 * h, -square],
            [-36.0 * one, -3.0 * h, 36.0 * one, -3.0 * h],
            [3.0 * h, -square, -3.0 * h, 4.0 * square],
        ]
    )
    element = bend + pull
    shape = np.array([0.5 * h, h**2 / 12.0, 0.5 * h, -(h**2) / 12.0])
    turn = np.array([zero, -one, zero, one])
    band, load = np.zeros((BANDS, 4 * (n + 1))), np.zeros(4 * (n + 1))
    at = 4 * np.arange(n)
    for c in range(2):
        place = (2 * c, 2 * c + 1, 2 * c + 4, 2 * c + 5)
        push = (f * loads.curvature[:, c] + loads.lateral[:, c]) * shape - b * loads.curvature[:, c] * turn
        for i in range(4):
            np.add.at(load, at + place[i], push[i])
            for j in range(i + 1):
                np.add.at(band[place[i] - place[j]], at + place[j], element[i, j])
    for c in (0, 2):  # hinged in the middle at surface: a row of the identity
        for k in range(1, BANDS):
            band[k, c] = 0.0
            if c >= k:
                band[k, c - k] = 0.0
        band[0, c], load[c] = 1.0, 0.0
    return band, load


def _state(
    x: FloatArray, band: FloatArray, load: FloatArray, wall: FloatArray, clearance: FloatArray
) -> tuple[float, FloatArray, FloatArray]:
    """Energy, its gradient, and its second derivatives as bands."""
    product = band[0] * x
    for k in range(1, BANDS):
        product[k:] += band[k, :-k] * x[:-k]
        product[:-k] += band[k, :-k] * x[k:]
    u = x.reshape(-1, 4)[:, [0, 2]]
    distance = np.linalg.norm(u, axis=1)
    deep = np.maximum(distance - clearance, 0.0)
    touching = deep > 0.0
    outward = np.where(touching[:, None], u / np.where(distance > 0.0, distance, 1.0)[:, None], 0.0)
    energy = 0.5 * float(x @ product) - float(load @ x) + 0.5 * float(np.sum(wall * deep**2))
    gradient = product - load
    pushed = gradient.reshape(-1, 4)
    pushed[:, 0] += wall * deep * outward[:, 0]
    pushed[:, 2] += wall * deep * outward[:, 1]
    second = band.copy()
    across = np.where(touching, wall * deep / np.where(touching, distance, 1.0), 0.0)
    along = np.where(touching, wall, 0.0) - across
    main = second[0].reshape(-1, 4)
    main[:, 0] += across + along * outward[:, 0] ** 2
    main[:, 2] += across + along * outward[:, 1] ** 2
    second[2].reshape(-1, 4)[:, 0] += along * outward[:, 0] * outward[:, 1]
    return energy, gradient, second


def _solve(band: FloatArray, right: FloatArray) -> FloatArray:
    """Newton's step; where the matrix is not positive, a multiple of its diagonal is added until it is."""
    more = 0.0
    for _ in range(40):
        try:
            shifted = band.copy()
            shifted[0] += more * np.abs(band[0])
            return np.asarray(solveh_banded(shifted, right, lower=True, check_finite=False))
        except LinAlgError:
            more = max(10.0 * more, 1e-10)
    return np.asarray(right / np.maximum(np.abs(band[0]), 1e-300))

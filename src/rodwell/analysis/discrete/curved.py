"""A curved hole along the rod that lies in it: what kernels are given.

Coefficients are taken where the rod is before it buckles: at the place S₀(s) on the hole's axis, with dS₀/ds =
1/(1 + Δκₙ) of a rod on the generator θ = 0, and S₀(½) = ½. Of a buckled rod the place S(s) is another, by the end
shortening at most; so far is the hole off. :mod:`rodwell.analysis.state.own_places` computes states without that.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rodwell.analysis.discrete.pieces import Along, PiecewisePolynomial
from rodwell.physics.on_wall.curved import CENTRE, FIRST, SCALE, TERMS
from rodwell.problem.hole import Hole
from rodwell.problem.lying import lying_rod_beside, places_of_lying_rod
from rodwell.problem.problem import Problem
from rodwell.problem.rod import Rod
from rodwell.problem.sections import PLAIN
from rodwell.quantities.arrays import FloatArray, IntArray

PIECES = 64
"""Pieces of the rod, at least, in each of which the hole is a polynomial: to round-off for curvatures up to several
radians a length."""

RESOLVED = 1e-6
"""Part of the largest curvature to which even pieces must have that of an axis through points. Such an axis is smooth
between its points only: at each the rate of the curvature jumps, by little where points are many, which would ask for a
concentrated force on the wall. Even pieces round that off; where they miss the curvature, pieces end at the points."""

BETWEEN_STATIONS = 5e-10
"""Part of the contact, by weight and by the bend, that pieces between stations may miss in the second derivative of the
curvature, which is part of it. The curvature is smooth there: pieces are halved until they have it."""

SHARPENED = 40.0
"""Error of a polynomial's second derivative over that of its values, times the square of the length of a piece."""

MOST_HALVINGS = 5

BESIDE_NODES = np.array([0.03, 0.21, 0.37, 0.52, 0.68, 0.83, 0.97])  # places in a piece at which that is looked at

PIECES_PER_RADIAN = 12.0
"""More pieces where the hole turns more."""

BESIDE_STEP = 1e-4
"""Part of the longest piece by which a station is beside a step of a string, which takes its place: the second
derivative of the curvature jumps there, which so close to an end a polynomial has to 1e-6 of itself."""

NO_PIECE = 1e-9
"""Breaks of the axis nearer to an end of the rod, in L, make no piece of their own."""

PLACES = np.linspace(0.0, 1.0, 257)  # fine enough to interpolate between


@dataclass(frozen=True)
class HoleAlong:
    """The hole along a rod, piece by piece, as kernels take it.

    Attributes
    ----------
    breaks
        Ends of the pieces, rising from 0 to 1, (n + 1,).
    rows
        What :data:`rodwell.physics.on_wall.curved.GIVEN` names of each piece, (n, 45); of a rod that tapers what
        ``GIVEN_OF_TAPERS`` there does, (n, 52).
    """

    breaks: FloatArray
    rows: FloatArray

    def __call__(self, places: FloatArray) -> FloatArray:
        """Coefficients of the pieces in which places (m,) lie, (m, 45)."""
        return np.ascontiguousarray(self.rows[np.searchsorted(self.breaks[1:-1], places, side="right")])


def hole_along(rod: Rod, breaks: FloatArray, functions: Along) -> HoleAlong:
    """Tabulate k₁, k₂, g₁, g₂, A, C as functions of s (6, m), or the first of these, on pieces; each in one section.

    Of a rod that tapers the stiffness stands behind them.
    """
    half, centre = 0.5 * np.diff(breaks), 0.5 * (breaks[1:] + breaks[:-1])
    nodes = np.cos(np.pi * (np.arange(TERMS) + 0.5) / TERMS)
    places = (centre[:, None] + half[:, None] * nodes).ravel()
    values = functions(places).reshape(-1, TERMS)
    if rod.tapered:
        values = np.concatenate([values, rod.stiffness(places).reshape(-1, TERMS)])
    coefficients = np.linalg.solve(np.vander(nodes, increasing=True), values.T).T
    by_piece = coefficients.reshape(-1, half.size, TERMS).transpose(1, 0, 2).reshape(half.size, -1)
    about = np.stack([rod.stiffness(centre), centre, 1.0 / half], axis=1)
    return HoleAlong(breaks, np.concatenate([about, by_piece], axis=1))


def wall_side(problem: Problem) -> float:
    """1 for a rod at θ = 0 below the axis, −1 for one on top: the frame is then turned by half a turn."""
    return -1.0 if problem.on_top else 1.0


def hole_at(problem: Problem, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """K₁, k₂, g₁, g₂ (4, m) at places S (m,) of the hole's axis, in the frame turned to the rod, and T·k (m,)."""
    hole, side = _hole(problem), wall_side(problem)
    curvatures, frames, _ = hole.at(places)
    up = frames[:, :, 2]
    return side * np.stack([*curvatures.T, up[:, 0], up[:, 1]]), up[:, 2]


def rates_at(problem: Problem, places: FloatArray) -> FloatArray:
    """Derivatives of k₁, k₂ along the hole's axis, (2, m), at places S (m,), in that frame."""
    return wall_side(problem) * _hole(problem).curvature_rates(places).T


def undeformed_place(problem: Problem, s: FloatArray) -> FloatArray:
    """S₀ (m,) on the hole's axis at places ``s`` (m,) of the rod that lies on the generator θ = 0."""
    return places_of_lying_rod(_hole(problem), problem.clearance * wall_side(problem), s)


def stations_along(problem: Problem) -> FloatArray:
    """Places s, rising, (k,), of the undeformed rod beside stations of the hole; none close to an end."""
    hole = _hole(problem)
    if not hole.stations.size:
        return hole.stations
    return _inside(lying_rod_beside(hole, problem.clearance * wall_side(problem), hole.stations))


def _inside(places: FloatArray) -> FloatArray:
    return places[(places > NO_PIECE) & (places < 1.0 - NO_PIECE)]


@lru_cache(maxsize=64)
def ends_of_lying_rod(problem: Problem) -> tuple[float, float]:
    """Places S₀(0) and S₀(1) on the hole's axis beside the ends of the undeformed rod."""
    start, end = undeformed_place(problem, np.array([0.0, 1.0]))
    return float(start), float(end)


def height_of_rod(problem: Problem, places: FloatArray, angle: FloatArray) -> FloatArray:
    """Height (m,) in L of the rod's centre beside places S (m,) of the axis, at angles ξ₂ (m,) from the low side.

    Upside down of a rod that floats, as its hole is.
    """
    hole = _hole(problem)
    _, frames, points = hole.at(places)
    up = frames[:, :, 2]
    inwards = np.cos(angle) * up[:, 0] - np.sin(angle) * up[:, 1]
    return np.asarray(points[:, 2] - problem.clearance * inwards)


@lru_cache(maxsize=64)
def along_rod(problem: Problem) -> HoleAlong:
    """The hole along the undeformed rod of a problem."""
    return along_other_rod(problem, problem.rod)


@lru_cache(maxsize=64)
def along_uniform_rod(problem: Problem) -> HoleAlong:
    """The same of a uniform rod in its place, on the same pieces."""
    return along_other_rod(problem, Rod(PLAIN))


def along_other_rod(problem: Problem, rod: Rod) -> HoleAlong:
    """The same with another rod in its place, whose sections end where sections of the problem's do.

    A(s) = ∫ₛ¹ q T·k ds, of a uniform rod by how much higher the loaded end lies than the rod at s. The rod has the
    curvature κᵣ = k₁/(1 + Δk₁): what moves on bends with it, which gives C(s) = −∫ₛ¹ b κᵣκᵣ′ ds. Where clearances have
    steps b is over what is carried on (:func:`carried`), and Δ that of the section.
    """
    rise, whole = hung(problem, rod, pieces_of(problem)), rod.breaks.size != problem.rod.breaks.size
    radius = np.full(rod.breaks.size - 1, problem.clearance)
    over = np.ones(rod.breaks.size - 1)
    if problem.rod.clearance_steps.size and not whole:
        radius, over = radius * problem.rod.clearance.coefficients[:, 0], carried(problem)

    def bending(k1: FloatArray, section: IntArray) -> FloatArray:
        return np.asarray(0.5 * (k1 / (1.0 + radius[section] * k1)) ** 2 / over[section])

    def softening(s: FloatArray) -> FloatArray:
        k1 = hole_at(problem, undeformed_place(problem, s))[0][0]
        return rod.stiffness.derivative(s) * bending(k1, rod.stiffness.piece_of(s))

    ends = hole_at(problem, undeformed_place(problem, rod.breaks[1:]))[0][0]
    sections = np.arange(ends.size)
    below, above = rod.stiffness.sides  # C by parts: b κᵣ²/2, what steps of b leave of it, and what b′ does
    left = above * bending(ends[:-1], sections[1:]) - below * bending(ends[:-1], sections[:-1])
    left = np.append(left, -rod.stiffness(np.ones(1)) * bending(ends[-1:], sections[-1:]))
    left = np.cumsum(left[::-1])[::-1]
    tapered = lifted(pieces_of(problem), softening) if rod.tapered else None

    def functions(s: FloatArray) -> FloatArray:
        here, weight, section = (
            hole_at(problem, undeformed_place(problem, s))[0],
            rod.weight(s),
            rod.stiffness.piece_of(s),
        )
        here[2:] *= weight
        driven = rod.stiffness(s) * bending(here[0], section) + left[section]
        driven += 0.0 if tapered is None else tapered(s)
        return np.concatenate([here, rise(s)[None], driven[None]])

    return hole_along(rod, pieces_of(problem), functions)


@lru_cache(maxsize=64)
def carried(problem: Problem) -> FloatArray:
    """What each section carries on of the force at s = 1 along the hole, for 1 + rk₁ of its own: c, (n,).

    A section at the distance r from the axis moves 1 + rk₁ times as far as a place on the axis, so that N = (1 + rk₁)
    c (F − wA + C). N goes on at steps of the clearance, and c is 1 at s = 1; where the curvature is constant it is
    (1 + Δk₁)/(1 + rk₁), Δ that at s = 1.
    """
    rod = problem.rod
    if not rod.clearance_steps.size:
        return np.ones(rod.breaks.size - 1)
    radii = problem.clearance * rod.clearance.coefficients[:, 0]
    k1 = hole_at(problem, undeformed_place(problem, rod.breaks[1:-1]))[0][0]
    steps = (1.0 + radii[1:] * k1) / (1.0 + radii[:-1] * k1)
    return np.append(np.cumprod(steps[::-1])[::-1], 1.0)


def hung(problem: Problem, rod: Rod, breaks: FloatArray) -> PiecewisePolynomial:
    """A(s) = ∫ₛ¹ q T·k ds of the undeformed rod, between ``breaks``."""

    def climb(s: FloatArray) -> FloatArray:
        rise = hole_at(problem, undeformed_place(problem, s))[1]
        if problem.rod.clearance_steps.size:  # a step along the hole moves what lies nearer to the centre by less
            rise = rise / carried(problem)[problem.rod.clearance.piece_of(s)]
        return rod.weight(s) * rise

    return lifted(breaks, climb)


def lifted(breaks: FloatArray, rate: Along) -> PiecewisePolynomial:
    """∫ₛ¹ of a function of s, smooth between ``breaks``, as a function of s."""
    return PiecewisePolynomial.of(breaks, rate).integral_above()


@lru_cache(maxsize=64)
def pieces_of(problem: Problem) -> FloatArray:
    """Ends of the pieces of the rod, rising from 0 to 1: even, or between steps and stations or points; none long."""
    hole, stations, steps = _hole(problem), stations_along(problem), problem.rod.breaks[1:-1]
    count = max(PIECES, 2 * int(np.ceil(0.5 * PIECES_PER_RADIAN * hole.turning)))
    if stations.size:
        breaks = _pieces(_with_steps(steps, stations, count), count)
        allowed = BETWEEN_STATIONS * (problem.weight + hole.sharpest * (stations.size + 1) ** 2) / SHARPENED
        for _ in range(MOST_HALVINGS):
            if _missed(breaks, problem) * (breaks.size - 1) ** 2 <= allowed:
                break
            breaks = np.insert(breaks, np.arange(1, breaks.size), 0.5 * (breaks[1:] + breaks[:-1]))
        return breaks
    even = _pieces(steps, count) if steps.size else np.linspace(0.0, 1.0, count + 1)
    if not hole.breaks.size or _missed(even, problem) <= RESOLVED * hole.sharpest:
        return even
    points = _inside(np.interp(hole.breaks, undeformed_place(problem, PLACES), PLACES))
    return _pieces(_with_steps(steps, points, count), count)


def _with_steps(steps: FloatArray, places: FloatArray, count: int) -> FloatArray:
    """Steps of a string (k,) and places (m,), rising; of the places those that are not beside a step."""
    if not steps.size:
        return places
    away = np.min(np.abs(places[:, None] - steps), axis=1) * count >= BESIDE_STEP
    return np.sort(np.concatenate([steps, places[away]]))


def _pieces(ends: FloatArray, count: int) -> FloatArray:
    """Pieces between 0, ``ends`` and 1, none longer than 1/``count``."""
    ends = np.concatenate([[0.0], ends, [1.0]])
    parts = np.maximum(1, np.ceil(np.diff(ends) * count - 1e-9)).astype(int)
    steps = np.repeat(np.diff(ends) / parts, parts)
    within = np.concatenate([np.arange(n) for n in parts])
    return np.append(np.repeat(ends[:-1], parts) + within * steps, 1.0)


def _missed(breaks: FloatArray, problem: Problem) -> float:
    """Largest error of polynomials between ``breaks`` in the curvature of the hole along the undeformed rod."""

    def curvatures(s: FloatArray) -> FloatArray:
        return _hole(problem).curvatures(undeformed_place(problem, s)).T

    s = (breaks[:-1, None] + np.diff(breaks)[:, None] * BESIDE_NODES).ravel()
    rows = hole_along(Rod(PLAIN), breaks, curvatures)(s)
    x, coefficients = (s - rows[:, CENTRE]) * rows[:, SCALE], rows[:, FIRST:].reshape(s.size, -1, TERMS)
    pieces = np.polynomial.polynomial.polyval(x, coefficients.T, tensor=False)
    return float(np.max(np.abs(pieces - curvatures(s))))


def _hole(problem: Problem) -> Hole:
    """The hole of a problem with the weight downwards; a straight one as an arc without curvature."""
    if problem.hole is not None:
        return problem.hole
    return Hole.arc(180.0 - problem.alpha if problem.floats else problem.alpha)

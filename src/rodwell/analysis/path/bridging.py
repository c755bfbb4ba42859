"""How a string lies that leaves the wall by itself: in the vertical plane of the hole's axis.

Beside a step it lies on the wall of the wider part, leaves it, rises over the edge of the narrower part, touching it at
one place without a couple, and comes down on the wall beyond. Where it begins to float it leaves the lower side for
the upper one. Which parts touch is found with a beam of small slopes that springs keep off the walls' lower sides, and
off the upper ones where the clearance has no steps: a convex problem, so long as the string is nowhere compressed. The
pattern found there is solved for as any other, with the energy of any slope
(:mod:`rodwell.analysis.off_wall.arrange`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from scipy.linalg import cholesky_banded

from rodwell.analysis.off_wall.arrange import solved, wavenumbers
from rodwell.analysis.off_wall.changes import mended
from rodwell.analysis.off_wall.conditions import (
    GROWS,
    GROWS_AT_END,
    LEAVES_EDGE,
    LOST,
    TOUCHES,
    PatternedState,
    conditions,
)
from rodwell.analysis.off_wall.curved.beside_steps import short_gaps, with_short_gaps
from rodwell.analysis.off_wall.curved.model import K1, RodOffCurvedWall
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.basis import tabulate
from rodwell.numerics.stretches.carry import Sampler
from rodwell.numerics.stretches.springs import on_springs, sampled, without_held
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import BoolArray, FloatArray

FREE_LENGTH = 24.0 / (2.0 * math.sqrt(3.0) - 3.0)
"""a⁴ w/(Bδ): how far from the edge a heavy beam without end force touches the wider part, over a step δ."""

PER_BRIDGE, PER_WAVE, FEWEST = 40, 8.0, 24
"""Elements of the beam: in a free length, in a wavelength over 2π of the stretched or bedded beam, and in a section;
stiff ones get no more, since round-off in their moments grows like the third power."""

LIGHTEST = 1e-9
"""Weight ratio that one without weight is taken for where elements are counted."""

MOST = 40_000

SAG, LEAST_SAG = 1e-8, 1e-12
"""How far the weight of L would press one spring in, as a part of the smallest step; and at least, in Δ."""

POINTS = (2, 3, 5, 9, 1)
"""Nodes up to which a piece of contact is taken for a point: the first that gives a state is the one."""

MENDS, ORDER = 6, (LOST, LEAVES_EDGE, GROWS_AT_END, GROWS, TOUCHES)
"""How many changes a pattern found may need, and which condition that is missed is met first."""

SIZES = (3e-3, 1e-3, 2e-4, 1e-2)
"""Lengths in L with which contact begins that is missed beside an end or at a point: the first that gives a state."""

HARDER, DECADES = 10.0, 14
"""Factor from one stiffness of the springs to the next; and how many of a bed from which a beam is let down."""


def unstretched(model: RodInHole) -> float:
    """The least end force F at s = 1 under which no part of the rod is compressed that lies along the hole."""
    if model.problem.hole is None:
        return max(model.problem.heaviest, 0.0)
    return max(-float(np.min(model.resultants(0.0))), 0.0)


def bridged(model: RodInHole, load: float) -> PatternedState | None:
    """How the string lies at an end force under which a beam without walls is stable; None if that was not found."""
    steps = model.problem.rod.clearance_steps.size
    return _of_beam(model, load) or (_of_beam(model, load, let_down=True) if steps else None)


def _of_beam(model: RodInHole, load: float, *, let_down: bool = False) -> PatternedState | None:
    """The state with the contacts of a beam, which is lowered on soft springs or let down from a bed."""
    try:
        places, height = _beam(model, load, let_down=let_down)
    except np.linalg.LinAlgError:  # it would buckle without walls: there may be several states
        return None
    for start in _starts(model, load, places, height):
        found = solved(model, *start[:2], load, start[2])
        if found is not None and (found := _mended(found)) is not None:
            return found
    return None


def _starts(
    model: RodInHole, load: float, places: FloatArray, height: FloatArray
) -> Iterator[tuple[Pattern, FloatArray, Sampler]]:
    """Patterns that the beam may have, with ends of stretches and shape; then with short gaps where it has none."""
    seen: dict[Pattern, FloatArray] = {}
    sample = sampled(places, height)
    for few in POINTS:
        pattern, breaks = _pattern(model.problem, places, height[::2], few)
        if pattern not in seen:
            seen[pattern] = breaks
            yield pattern, breaks, sample
    if isinstance(model, RodOffCurvedWall) and (gaps := short_gaps(model, load)):
        for pattern, breaks in seen.items():
            yield with_short_gaps(model, pattern, breaks, sample, gaps)


def _mended(state: PatternedState) -> PatternedState | None:
    """A state near one that may miss conditions on contact, and meets them: contact that pulls goes first."""
    found = state
    for _ in range(MENDS):
        missed = [one for one in conditions(found) if not one.value >= 0.0]
        if not missed:
            return found
        worst = min(missed, key=lambda one: (ORDER.index(one.kind) if one.kind in ORDER else len(ORDER), one.value))
        tried = (mended(found, worst, size) for size in SIZES)
        again = next((one for one in tried if one is not None), None)
        if again is None:
            return None
        found = again
    return None


def at_top(model: RodInHole, load: float) -> float | None:
    """Where the beam reaches the upper side of the hole at a load, which is not computed; None where it does not.

    None too where the beam was not found: of more than some hundred sections its stiffness is lost in round-off.
    """
    try:
        places, height = _beam(model, load)
    except np.linalg.LinAlgError:
        return None
    over = height[::2] - _narrowest(model.problem, places)
    k = int(np.argmax(over))
    return float(places[k]) if over[k] > 0.0 else None


def _steps(problem: Problem) -> FloatArray:
    """Heights of the steps of the wall, in Δ."""
    return np.abs(np.diff(problem.rod.clearance.coefficients[:, 0]))


def _own_lengths(problem: Problem) -> FloatArray:
    """The length by which a beam of each section alone would bridge the lower of the steps at its ends, (n,), in L.

    Where a section tapers, one of its least stiffness and largest weight.
    """
    rod, steps = problem.rod, _steps(problem)
    lowest = np.fmin(np.append(steps, np.inf), np.append(np.inf, steps))
    lowest = np.where(lowest > 0.0, lowest, _highest(steps))  # its neighbours lie in the same hole
    weight = problem.lateral_weight * np.maximum(rod.sizes_of_weight, LIGHTEST)
    stiffness = rod.ranges["stiffness"][0]
    return np.asarray((FREE_LENGTH * stiffness * problem.clearance * lowest / weight) ** 0.25)


def _highest(steps: FloatArray) -> float:
    """The highest step in Δ; without any, the half of the hole that a string crosses where it begins to float."""
    return float(np.max(steps)) or 1.0


def _beam(model: RodInHole, load: float, *, let_down: bool = False) -> tuple[FloatArray, FloatArray]:
    """Nodes of a beam (n,), and its height above the hole's axis and slope there in Δ, in turn, (2n,).

    ``let_down``: from a bed of springs at all nodes, which keep the beam of very many joints, whose own stiffness is
    lost in round-off beside its length, until the springs of the wall do.
    """
    problem, breaks = model.problem, model.problem.rod.breaks
    per_length = np.maximum(PER_BRIDGE / _own_lengths(problem), PER_WAVE * wavenumbers(model, load))
    numbers = np.maximum(np.ceil(np.diff(breaks) * per_length), FEWEST)
    numbers = np.ceil(numbers * min(1.0, MOST / float(np.sum(numbers)))).astype(int)
    parts = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(breaks[:-1], breaks[1:], numbers, strict=True)]
    places = np.append(np.concatenate(parts), 1.0)
    band, force = _assembled(model, load, places)
    radius, held = _narrowest(problem, places), _held(problem, places.size)
    walls = -radius, _upper(problem, radius)
    if not let_down or load < unstretched(model):  # stretched it is stable, even where round-off hides it
        cholesky_banded(without_held(band, held), lower=True)
    height = np.zeros(2 * places.size)
    size = _sag(problem)
    height[::2] = walls[0]
    if not let_down:
        for stiffness in size * HARDER ** np.arange(-6.0, 1.0):
            height = on_springs(band, force, walls, held, stiffness, height)
        return places, height
    for bed in (*(size / HARDER ** np.arange(DECADES)), 0.0):
        on_bed, pushed = band.copy(), force.copy()
        on_bed[0, ::2] += bed
        pushed[::2] += bed * walls[0]
        height = on_springs(on_bed, pushed, walls, held, size, height)
    return places, height


def _narrowest(problem: Problem, places: FloatArray) -> FloatArray:
    """The clearance in Δ at places, at a step that of the narrower part."""
    before, after = (problem.rod.clearance(np.clip(np.nextafter(places, to), 0.0, 1.0)) for to in (-1.0, 2.0))
    return np.minimum(before, after)


def _upper(problem: Problem, radius: FloatArray) -> FloatArray:
    """Heights of the upper side of the hole that springs keep the beam below; none where the clearance has steps."""
    return np.full_like(radius, np.inf) if problem.rod.clearance_steps.size else radius


def _held(problem: Problem, nodes: int) -> BoolArray:
    """Which heights and slopes the ends hold: all ends hold the height, all but ball joints the slope."""
    held = np.zeros(2 * nodes, dtype=bool)
    held[[0, -2]] = True
    held[[1, -1]] = [end != "ball" for end in problem.ends]
    return held


def _sag(problem: Problem) -> float:
    """Stiffness of a spring at a node that the heaviest section's weight over L presses in by less than a step."""
    steps = _steps(problem)
    weight = problem.lateral_weight * float(np.max(problem.rod.sizes_of_weight)) / problem.clearance
    return weight / max(SAG * float(np.min(steps[steps > 0.0], initial=_highest(steps))), LEAST_SAG)


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
    bend, pressed = np.zeros(1), problem.lateral_weight * weight
    if isinstance(model, RodOffCurvedWall):
        bend, tension, pressed = model.beside(s)[K1], model.drive(s, load), model.pressed(s, load)
    scale = np.stack([np.ones_like(h), h, np.ones_like(h), h], axis=1)  # of slopes
    w = 0.5 * weights
    matrix = np.einsum("eq,qi,qj->eij", stiffness * w / h[:, None] ** 3, table[2], table[2])
    matrix += np.einsum("eq,qi,qj->eij", tension * w / h[:, None], table[1], table[1])
    matrix *= scale[:, :, None] * scale[:, None, :]
    push = -np.einsum("eq,qi->ei", pressed * w * h[:, None], table[0])
    push = (push - np.einsum("eq,qi->ei", stiffness * bend * w / h[:, None], table[2])) / problem.clearance
    band, force = np.zeros((4, 2 * places.size)), np.zeros(2 * places.size)
    first = 2 * np.arange(h.size)
    for i in range(4):
        np.add.at(force, first + i, push[:, i] * scale[:, i])
        for j in range(i + 1):
            np.add.at(band[i - j], first + j, matrix[:, i, j])
    return band, force


def _pattern(problem: Problem, places: FloatArray, height: FloatArray, few: int) -> tuple[Pattern, FloatArray]:
    """Which parts of a beam with this height (n,) at its nodes touch: the pattern, and the ends of its stretches.

    Between two corners, steps of the clearance and places where the weight changes its sign, a heavy beam that is
    nowhere compressed touches either side along one piece at most: over a gap with flat contact on both sides its
    moment would be concave, and nowhere negative at the gap's ends. Beside an end that piece begins at the end, but of
    a beam that a bend lifts there. One of no more than ``few`` nodes counts as a point, beside an end or an edge that
    is touched as none: a force between two nodes presses both.
    """
    radius = _narrowest(problem, places)
    steps, corners = problem.rod.clearance_steps, np.union1d(problem.rod.clearance_steps, problem.rod.sign_changes)
    if problem.hole is not None:
        corners = np.union1d(corners, problem.rod.stiffness_steps)
    touching, breaks = [], []
    low, high = height < -radius, height > _upper(problem, radius)
    begins = (True, True) if problem.hole is None else (low[1], low[-2])  # a bend may lift a stretched string there
    for left, right in pairwise([0.0, *corners, 1.0]):
        inside = (places > left) & (places < right)
        for piece, pressed in sorted(((places[on & inside], on) for on in (low, high)), key=_first):
            at_end = (left == 0.0 and pressed is low and begins[0], right == 1.0 and pressed is low and begins[1])
            if piece.size <= few:
                beside = np.flatnonzero(pressed & (places >= left) & (places <= right)).size > piece.size
                if piece.size and not any(at_end) and not (beside and _next_to(places, piece, left, right)):
                    touching.append(False)
                    breaks.append(float(np.mean(piece)))
                continue
            touching += [True] if at_end[0] else [False, True]
            breaks += [float(end) for end, last in zip((piece[0], piece[-1]), at_end, strict=True) if not last]
    if len(touching) == len(breaks):  # nothing touches at s = 1
        touching.append(False)
    edges = tuple(map(float, places[low & np.isin(places, steps)]))
    return Pattern(tuple(touching), planar=True, edges=edges), np.array(breaks)


def _first(piece: tuple[FloatArray, BoolArray]) -> float:
    """Where a piece of contact begins."""
    return float(np.min(piece[0], initial=1.0))


def _next_to(places: FloatArray, piece: FloatArray, left: float, right: float) -> bool:
    """Whether nodes of a piece are next to the corner at either side of them."""
    first, last = np.searchsorted(places, piece[[0, -1]])
    return bool(places[first - 1] == left or places[last + 1] == right)

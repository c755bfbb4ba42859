"""What must hold in a state of partial contact, each condition as a number that is positive while it does.

Where one of them vanishes along a path the pattern of contact changes:

* contact pushes all along a stretch on the wall: else a gap opens there,
* a point of contact pushes: else it is lost,
* the gap beside a point of contact opens like a parabola, r″ < 0: else the contact grows to a stretch,
* at a radially held end the free rod curves inwards: else contact grows from the end,
* at an end that is not radially held a rod in contact does not turn around the wall, since nothing bears the radial
  moment of it: else it leaves it; nor at a step of its stiffness (touching none in a curved hole), a kink that pulls,
* the rod nowhere reaches the wall within a free stretch: else it touches there,
* ends of stretches and points of contact keep off steps of a string and stations of the hole: else they pass them,
* the edge of a narrower part of the hole, where the rod touches it, pushes: else the rod leaves it; and so does the
  wall at a loose end of a free stretch that touches it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from rodwell.analysis.off_wall.depth import Piece, contact_pieces, least_gaps
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Elements, Pattern, corners_within, last_place, pieces_of
from rodwell.numerics.stretches.chain import ANGLE_RATE, RADIUS, Shape
from rodwell.numerics.stretches.minima import CLOSER, lowest
from rodwell.numerics.stretches.newton import Solved, gap_curvature
from rodwell.physics.off_wall import kinks
from rodwell.problem.ends import OFF_WALL_ENDS
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray, IntArray

OPENS, LOST, GROWS, GROWS_AT_END, TOUCHES, LEAVES = "opens", "lost", "grows", "grows_at_end", "touches", "leaves"
UNHELD, CROSSES, LEAVES_EDGE = "unheld", "crosses", "leaves_edge"

PER_ELEMENT = 12
"""Places in an element at which the pressure is looked at first."""

KNOWN_FORCE = 5e-6
"""A force at the end of a stretch in contact comes from third derivatives, which the elements along a path know to this
part of |F|^{3/2}: an end of a gap that has just opened may seem to pull by less."""

BESIDE_STEP, BESIDE_OWN_STEP = 2e-4, 2e-6
"""Distance from a step of a string, in L, at which an end of a stretch or a point of contact has reached it; of the gap
at a step of the stiffness in a bend, which is as short as the step is low."""

NO_SLOPE = 1e-7
"""Slope φ′ in rad/L that is as good as none at a step of the stiffness, and at an end that is not radially held."""


class Condition(NamedTuple):
    """A condition: its kind, the stretch, break or end it belongs to, its value (positive: holds), and where."""

    kind: str
    number: int
    value: float
    s: float


@dataclass(frozen=True, eq=False, repr=False)
class PatternedState:
    """An equilibrium with its pattern and the numbers of elements of its stretches."""

    pattern: Pattern
    elements: Elements
    solved: Solved

    @property
    def model(self) -> RodInHole:
        """The rod in its hole."""
        model: RodInHole = self.solved.model
        return model

    @property
    def problem(self) -> Problem:
        """The problem."""
        return self.model.problem

    @property
    def load(self) -> float:
        """End force F at s = 1 in B/L², tension positive."""
        return float(self.solved.shape.load)

    @cached_property
    def pieces(self) -> list[Piece]:
        """Contact and gaps from s = 0 behind a soft wall, where the pattern says nothing of them."""
        return contact_pieces(self.solved.shape)

    @property
    def _read_off(self) -> bool:
        """Whether contact is read off the shape: behind a soft wall, but of the straight rod that nothing presses."""
        return self.model.soft and not self.pattern.full

    @property
    def touching(self) -> tuple[bool, ...]:
        """Which stretches are in contact, from s = 0; of a hard wall those of the pattern."""
        return tuple(piece.on for piece in self.pieces) if self._read_off else self.pattern.touching

    @property
    def everywhere(self) -> bool:
        """Whether the rod is in contact everywhere."""
        return self.touching == (True,)

    @property
    def bounds(self) -> FloatArray:
        """Where the stretches begin and end, (k+1,)."""
        if self._read_off:
            return np.array([piece.left for piece in self.pieces] + [1.0])
        return np.concatenate([[0.0], self.solved.shape.breaks, [1.0]])

    @cached_property
    def edge_forces(self) -> FloatArray:
        """Outward forces on edges and on loose ends that touch the wall, (k,), from s = 0; unit as of the others."""
        return np.asarray(-self.solved.out.plain[self.solved.shape.chain.edges, RADIUS])

    @property
    def point_forces(self) -> list[tuple[float, float, str]]:
        """Places and outward forces of contact, from s = 0: "end"s of stretches, "point"s, "edge"s, "kink"s, "tip"s."""
        kinds = ["point" if self.pattern.is_point(i) else "end" for i in range(self.pattern.breaks)]
        found = list(zip(map(float, self.solved.shape.breaks), map(float, self.solved.forces), kinds, strict=True))
        found += [
            (s, float(force), "tip" if s in (0.0, 1.0) else "edge")
            for s, force in zip(self.pattern.edges, self.edge_forces, strict=True)
        ]
        found += [(s, force, "kink") for s, force in self.kink_forces]
        return sorted((s, force / float(self.model.unit(np.array(s))), kind) for s, force, kind in found)

    @cached_property
    def kink_forces(self) -> list[tuple[float, float]]:
        """Places and outward forces at kinks of the stiffness in contact, of a rod that is not planar."""
        problem, bounds = self.problem, self.solved.shape.breaks
        places, sizes = problem.rod.breaks[1:-1], problem.rod.stiffness_kink_sizes * (not self.pattern.planar)
        on = np.array(self.pattern.touching)[np.searchsorted(bounds, places)]
        return [(float(places[k]), kink_force(self, float(places[k])))
                for k in np.flatnonzero(on & (sizes != 0.0))]  # fmt: skip

    @cached_property
    def _starts(self) -> list[int]:
        return list(accumulate(map(sum, self.elements), initial=0))

    def elements_of(self, stretch: int) -> range:
        """Numbers of the elements of a stretch."""
        return range(self._starts[stretch], self._starts[stretch + 1])


@lru_cache(maxsize=16)
def conditions(state: PatternedState) -> tuple[Condition, ...]:
    """All conditions of a state, kept: those at the ends of a step and at what happens within are asked again."""
    if state.model.soft:
        return ()  # the wall's push is part of the energy: nothing is left to be asked
    solved, pattern = state.solved, state.pattern
    found = pressing(state, [i for i, on in enumerate(pattern.touching) if on])
    found += apart(state, [i for i, on in enumerate(pattern.touching) if not on])
    for i in range(pattern.breaks):
        place = float(solved.shape.breaks[i])
        found.append(Condition(LOST if pattern.is_point(i) else LEAVES, i, _pushing(state, i), place))
        if pattern.is_point(i):
            found.append(Condition(GROWS, i, float(solved.openings[i]), place))
    found += [at for last in (False, True) if (at := _at_end(state, last)) is not None]
    edges = enumerate(zip(pattern.edges, state.edge_forces, strict=True))
    found += [Condition(LEAVES_EDGE, i, float(force), s) for i, (s, force) in edges]
    return (*found, *at_steps(state))


def at_steps(state: PatternedState) -> list[Condition]:
    """No slope in contact at steps of the stiffness, no end of a stretch where elements end: at steps, at stations."""
    shape, rod, found = state.solved.shape, state.model.problem.rod, list[Condition]()
    (corners, section), (below, above) = pieces_of(state.problem), rod.stiffness_sides
    own = rod.steps_of_stiffness_alone if state.problem.bent else ()
    for i, inner in enumerate(corners_within(corners, state.elements, state.bounds if state.problem.bent else None)):
        for k in (section[corner] for corner in inner if section[corner] != section[corner + 1]):
            s = float(rod.breaks[1 + k])
            if state.pattern.touching[i] and below[k] != above[k]:
                held = -np.inf if state.problem.bent else NO_SLOPE - abs(slope_at(shape, s))
                found.append(Condition(UNHELD, 2 + k, held, s))
            if state.pattern.touching[i] and rod.stiffness_kink_sizes[k] < 0.0:
                length, shortest, _ = kink_gap(state, s)
                found.append(Condition(UNHELD, 2 + k, shortest - length, s))
        if inner:  # the ends of the stretch, upwards to its first step and downwards to its last
            first, last = float(corners[inner.start]), float(corners[inner.stop - 1])
            for number, s, end in ((2 * i - 1, first, state.bounds[i]), (2 * i, last, state.bounds[i + 1])):
                if 0 <= number < 2 * state.pattern.breaks:
                    reached = BESIDE_OWN_STEP if s in own and not state.pattern.touching[i] else BESIDE_STEP
                    found.append(Condition(CROSSES, number, abs(float(end) - s) - reached, s))
    return found


def kink_force(state: PatternedState, s: float) -> float:
    """Outward contact force over Δ at a kink of the stiffness in contact; negative: the wall would have to pull."""
    rod, k = state.problem.rod, int(np.searchsorted(state.problem.rod.breaks[1:-1], s))
    return float(rod.stiffness_kink_sizes[k] * rod.clearance.coefficients[k, 0] * slope_at(state.solved.shape, s) ** 2)


def kink_gap(state: PatternedState, s: float) -> tuple[float, float, float]:
    """Length in L of the gap at a kink still in contact, that from which on it counts, the push beside it in B/L³."""
    problem, node = state.problem, int(np.searchsorted(state.solved.shape.places, s))
    push = -float(np.mean(pressure_on(state, np.array([node - 1, node]))(np.array([[1.0], [0.0]]))))
    length = kinks.length(-problem.clearance * kink_force(state, s), push)
    return length, kinks.shortest(problem.clearance, float(problem.rod.stiffness(np.array([s]))[0]), push), push


def slope_at(shape: Shape, s: float) -> float:
    """The slope φ′ in rad/L at an end of the rod, or a step, in contact."""
    return float(shape.nodes[int(np.searchsorted(shape.places, s)), ANGLE_RATE])


def _pushing(state: PatternedState, i: int) -> float:
    """The concentrated force at a break; at an end of a stretch in contact as far as it is certain that it pulls."""
    force = float(state.solved.forces[i])
    return force if state.pattern.is_point(i) else force + KNOWN_FORCE * abs(state.load) ** 1.5


def _at_end(state: PatternedState, last: bool) -> Condition | None:
    """The curvature of the gap at a radially held end of a free stretch."""
    shape = state.solved.shape
    node = -1 if last else 0
    if state.pattern.touching[node]:
        ball = state.model.problem.ends[node] in OFF_WALL_ENDS
        return Condition(UNHELD, int(last), NO_SLOPE - abs(slope_at(shape, float(last))), float(last)) if ball else None
    if not (shape.chain.held[node, 2] and shape.chain.held[node, 0]):
        return None
    element = shape.chain.elements - 1 if last else 0
    return Condition(GROWS_AT_END, int(last), gap_curvature(shape, element, float(last)), float(last))


def pressing(state: PatternedState, stretches: Sequence[int]) -> list[Condition]:
    """The least contact forces per length −p on stretches on the wall, and where: all minima, of each the lowest first.

    They are looked at together: it takes as long as for one.
    """
    if not stretches:
        return []
    places, xi = state.solved.shape.places, np.linspace(0.0, 1.0, PER_ELEMENT + 1)
    ranges = [np.array(state.elements_of(stretch)) for stretch in stretches]
    elements = np.concatenate(ranges)
    samples = -pressure_on(state, elements)(np.broadcast_to(xi, (elements.size, xi.size)))
    found: list[tuple[int, IntArray, IntArray]] = []
    for stretch, here in zip(stretches, ranges, strict=True):
        rows = samples[np.searchsorted(elements, here)]
        values = np.concatenate([rows[:, :-1].ravel(), rows[-1, -1:]])
        low = np.flatnonzero(np.r_[True, values[1:] <= values[:-1]] & np.r_[values[:-1] <= values[1:], True])
        # a minimum between two elements is looked at in both
        number = np.minimum(np.stack([np.maximum(low - 1, 0), low], axis=1) // PER_ELEMENT, here.size - 1).ravel()
        found.append((stretch, here[number], np.repeat(low, 2) - number * PER_ELEMENT))
    at, part = (np.concatenate([one[k] for one in found]) for k in (1, 2))
    function = pressure_on(state, at)
    around = xi[np.maximum(part - 1, 0)], xi[np.minimum(part + 1, PER_ELEMENT)]
    least, where = lowest(lambda xi: -function(xi), np.linspace(*around, CLOSER, axis=1))
    owner = np.repeat([one[0] for one in found], [one[1].size for one in found])
    s, first = places[at] + (places[at + 1] - places[at]) * where, np.arange(0, least.size, 2)
    best = np.where(least[1::2] <= least[::2], first + 1, first)
    minima = [Condition(OPENS, int(owner[i]), float(least[i]), float(s[i])) for i in best]
    return sorted(minima, key=lambda one: (one.number, one.value))


def pressure_on(state: PatternedState, elements: IntArray) -> Callable[[FloatArray], FloatArray]:
    """The contact pressure p on elements in contact (k,) as a function of ξ (k, n), negative in contact."""
    shape = state.solved.shape
    left, right = shape.places[elements, None], shape.places[elements + 1, None]
    given, last = shape.chain.given_to(elements), last_place(state.problem, left, right)

    def pressure(xi: FloatArray) -> FloatArray:
        s = np.minimum(left + (right - left) * xi, last)
        return state.model.pressure(s, shape.along(elements, xi)[0], shape.load, given)

    return pressure


def apart(state: PatternedState, stretches: Sequence[int]) -> list[Condition]:
    """The least gaps within free stretches, over the polynomials with which they open from their ends, and where."""
    elements = [np.array(state.elements_of(stretch)) for stretch in stretches]
    least = least_gaps(state.solved.shape, state.pattern, stretches, elements)
    return [Condition(TOUCHES, number, *gap) for number, gap in zip(stretches, least, strict=True)]


def watched(condition: Condition, state: PatternedState) -> float:
    """The value of a condition in another state of the same pattern."""
    kind, number = condition.kind, condition.number
    if kind == OPENS:
        return pressing(state, [number])[0].value
    if kind == TOUCHES:
        return apart(state, [number])[0].value
    if kind in (GROWS, LEAVES_EDGE):
        return float((state.solved.openings if kind == GROWS else state.edge_forces)[number])
    if kind == CROSSES or (kind == UNHELD and number > 1):
        same = [one for one in at_steps(state) if one[:2] == condition[:2]]
        return same[0].value if same else np.nan
    if kind in (GROWS_AT_END, UNHELD):
        at = _at_end(state, bool(number))
        return np.nan if at is None else at.value
    return _pushing(state, number)

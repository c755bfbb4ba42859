"""Where a rod goes when its state ceases to be stable: downhill, from the direction in which it gave way.

The state is kicked along the softest direction, either way, and by small random disturbances, just beyond that load (or
that shortening, where it is controlled); the gradient flow behind a soft wall leads to a minimum, whose pattern of
contact is then solved for behind the hard wall. Frictionless, and without inertia: a rod that swings may end elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.off_wall.arrange import arranged, element_counts
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.analysis.off_wall.recognise import recognised
from rodwell.analysis.off_wall.soft import settled
from rodwell.numerics.stretches.assembly import bubbles_of
from rodwell.numerics.stretches.carry import Sampler, fields_at, sampler
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.descent import WANTED, Way, descended
from rodwell.numerics.stretches.newton import Solved, softest
from rodwell.quantities.arrays import FloatArray

BEYOND = (1e-3, 1e-2)
"""How far beyond the loss of stability the flow starts, relative to the load, or the shortening.

The second where the first is too near: a soft wall holds the rod a little longer than a hard one.
"""

BEYOND_BUCKLING = (2e-4, 2e-3, 1e-2)
"""The same for the straight rod, tried one after the other: what branches off from it is small at first."""

KICK, NOISE = 0.05, 0.02
"""Largest displacement, in Δ, of the kick along the softest direction, and size of the random ones."""

NEAR, SAMPLES = 0.1, 101
"""Distance from the state that gives way, in Δ, below which a minimum behind a soft wall is that state, still held; and
at how many places it is measured."""

WAVES = 5
"""Half-waves of the random disturbances."""

STIFFNESS = 1e6
"""Stiffness of the soft wall, in units B/L⁴."""

FLOW_DEGREE, ELEMENTS_PER_HALF_WAVE, FEWEST_ELEMENTS = 7, 3.0, 12

Tell = Callable[[float], object]
"""Called with the end force of what is being computed; what it raises ends that."""

SAME_ENERGY = 1e-6
"""States whose energies agree to this part are the same, up to mirror images."""


@dataclass(frozen=True, eq=False)
class Snap:
    """Where the flow leads, and how sure that is.

    ``agree`` of ``tried`` starts ended in ``state``, or its mirror image; ``others`` are the energies of other minima
    behind the soft wall, in BΔ²/L³
    (where the shortening is controlled, without the work of the load).
    """

    state: PatternedState
    tried: int
    agree: int
    others: tuple[float, ...]


def snapped(
    event: PatternedState,
    sense: float,
    seeds: int,
    control: Control,
    beyond: tuple[float, ...],
    near: float,
    tell: Tell | None = None,
) -> Snap | None:
    """The state to which the rod goes from one that has just ceased to be stable.

    ``sense`` is that in which the controlled quantity changes; the flow starts ``beyond`` the event, farther where it
    ended ``near`` it. ``tell`` is called with the end force at each step downhill.
    None if no start led to a state that could be solved.
    """
    for part in beyond:
        value = control.value(event.solved)
        value += sense * part * control.scale(value, event.load)
        minima = _minima(event, seeds, control, value, near if part != beyond[-1] else 0.0, tell)
        for group in _alike(minima, event.solved, control):
            low = group[0]
            soft = event.model.soft
            state = settled(event.model, low) if soft else recognised(event.model, low.shape, control, value)
            if state is not None:
                others = tuple(sorted({round(control.potential(one), 9) for one in minima if one not in group}))
                return Snap(state, 2 * seeds, len(group), others)
    return None


def _minima(
    event: PatternedState, seeds: int, control: Control, value: float, near: float, tell: Tell | None
) -> list[Solved]:
    """Minima behind a soft wall to which the disturbed state flows; none if the first is ``near`` that state."""
    minima: list[Solved] = []
    ways: list[Way] = []
    for seed in range(seeds):
        for sign in (1.0, -1.0):
            low = flowed(event, _disturbed(kicked(event.solved, sign), seed), control, value, ways=ways, tell=tell)
            if low is not None:
                minima.append(low)
            if near and len(minima) == 1 and distance(minima[0], event.solved) < near:
                return []
    return minima


def distance(one: Solved, other: Solved) -> float:
    """Largest distance between two shapes at the same places along the rod, in Δ."""
    s = np.linspace(0.0, 1.0, SAMPLES)
    first, second = (fields_at(state.shape, s)[0][:, 0] for state in (one, other))
    return float(np.max(np.hypot(*(first - second))))


def _alike(minima: list[Solved], event: Solved, control: Control) -> list[list[Solved]]:
    """Minima of equal energy, which are the same up to mirror images; the largest group first, then the lowest."""
    groups: list[list[Solved]] = []
    energy, scale = control.potential, abs(control.potential(event))
    for one in sorted(minima, key=energy):
        size = SAME_ENERGY * max(abs(energy(one)), scale)
        if groups and abs(energy(groups[-1][0]) - energy(one)) <= size:
            groups[-1].append(one)
        else:
            groups.append([one])
    return sorted(groups, key=lambda group: (-len(group), energy(group[0])))


@dataclass(frozen=True)
class Flow:
    """How closely the flow is computed: stiffness of its wall, elements in a half-wave, and how wrong a step may be."""

    stiffness: float = STIFFNESS
    elements: float = ELEMENTS_PER_HALF_WAVE
    wanted: float = WANTED


def flowed(
    event: PatternedState,
    sample: Sampler,
    control: Control,
    value: float,
    flow: Flow = Flow(),
    ways: list[Way] | None = None,
    tell: Tell | None = None,
) -> Solved | None:
    """The minimum behind a soft wall to which the flow leads from a sampled shape, with what is controlled held.

    ``ways``: of other flows there, which it may join. ``tell`` is called with the end force at each step.
    """
    model, load = event.model, value if control.by_force else event.load
    pattern, nowhere = Pattern((False,), event.pattern.turns), np.zeros(0)
    elements = element_counts(model, nowhere, load, 1.0 / flow.elements, FEWEST_ELEMENTS)
    shape, _ = arranged(model, pattern, nowhere, load, sample, degree=FLOW_DEGREE, elements=elements)
    # a soft wall is in the model already
    stiffness = 0.0 if model.soft else flow.stiffness * model.firmness(load)
    row = control.row(shape.chain, value)

    def index(one: Solved) -> int:
        if tell is not None:
            tell(one.shape.load)
        return control.index_at(one)

    return descended(model, shape, stiffness, row, index, flow.wanted, ways)


def kicked(state: Solved, sign: float) -> Shape:
    """A state displaced along the direction in which it is softest."""
    shape = state.shape
    direction = softest(state).reshape(-1, 4)
    nodes = sign * KICK / max(float(np.max(np.abs(direction[:, :2]))), 1e-12) * direction
    still = np.zeros(shape.breaks.size)
    return shape.moved(nodes, bubbles_of(state.out, nodes, still, 0.0, 0.0), still, 0.0)


def _disturbed(shape: Shape, seed: int) -> Sampler:
    """A sampler of a shape with small random waves that vanish, with their slopes, at the ends."""
    base, rng = sampler(shape), np.random.default_rng(seed)
    sizes = NOISE * rng.standard_normal((2, WAVES))

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, angle = base(s)
        fields = fields.copy()
        envelope = np.sin(np.pi * s) ** 2, np.pi * np.sin(2.0 * np.pi * s), 2.0 * np.pi**2 * np.cos(2.0 * np.pi * s)
        for k in range(WAVES):
            w = (k + 1) * np.pi
            wave = np.cos(w * s), -w * np.sin(w * s), -(w**2) * np.cos(w * s)
            both = (
                envelope[0] * wave[0],
                envelope[1] * wave[0] + envelope[0] * wave[1],
                envelope[2] * wave[0] + 2.0 * envelope[1] * wave[1] + envelope[0] * wave[2],
            )
            for i in range(2):
                for order in range(3):
                    fields[i, order] += sizes[i, k] * both[order]
        return fields, angle

    return sample

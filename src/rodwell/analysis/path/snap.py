"""Where a rod goes when its state ceases to be stable: downhill, from the direction in which it gave way.

The state is kicked along the softest direction, either way, and by small random disturbances, at a load just beyond;
the gradient flow behind a soft wall leads to a minimum, whose pattern of contact is then solved for behind the hard wall.
Frictionless, and without inertia: a rod that swings may end elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.off_wall.arrange import arranged, at_load, wavenumber
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.analysis.off_wall.recognise import recognised
from rodwell.numerics.stretches.assembly import bubbles_of
from rodwell.numerics.stretches.carry import Sampler, sampler
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.descent import descended
from rodwell.numerics.stretches.newton import Solved, softest
from rodwell.quantities.arrays import FloatArray

BEYOND = 1e-3
"""How far beyond the loss of stability the flow starts, relative to the load."""

KICK, NOISE = 0.05, 0.02
"""Largest displacement, in Δ, of the kick along the softest direction, and size of the random ones."""

WAVES = 5
"""Half-waves of the random disturbances."""

STIFFNESS = 1e6
"""Stiffness of the soft wall, in units B/L⁴."""

FLOW_DEGREE, ELEMENTS_PER_HALF_WAVE, FEWEST_ELEMENTS = 7, 3.0, 12

SAME_ENERGY = 1e-6
"""States whose energies agree to this part are the same, up to mirror images."""


@dataclass(frozen=True, eq=False)
class Snap:
    """Where the flow leads, and how sure that is.

    ``agree`` of ``tried`` starts ended in ``state``, or its mirror image; ``others`` are the energies (scaled) of the rest.
    """

    state: PatternedState
    tried: int
    agree: int
    others: tuple[float, ...]


def snapped(event: PatternedState, sense: float, seeds: int) -> Snap | None:
    """The state to which the rod goes from one that has just ceased to be stable; ``sense`` of the load's change.

    None if no start led to a state that could be solved.
    """
    load = event.load + sense * BEYOND * max(abs(event.load), 1.0)
    found: list[PatternedState] = []
    tried = 0
    for seed in range(seeds):
        for sign in (1.0, -1.0):
            tried += 1
            state = from_start(event, _disturbed(_kicked(event.solved, sign), seed), load)
            if state is not None:
                found.append(state)
    if not found:
        return None
    return _most(found, tried, abs(event.solved.out.energy))


def _most(found: list[PatternedState], tried: int, scale: float) -> Snap:
    """The state in which most starts ended; the lowest of equally many."""
    energies = np.array([one.solved.out.energy for one in found])
    size = max(float(np.max(np.abs(energies))), scale)
    same = np.abs(energies[:, None] - energies[None, :]) <= SAME_ENERGY * size
    votes = same.sum(axis=1)
    best = int(np.lexsort((energies, -votes))[0])
    others = sorted({round(float(e), 12) for e in energies[~same[best]]})
    return Snap(found[best], tried, int(votes[best]), tuple(others))


def from_start(event: PatternedState, sample: Sampler, load: float) -> PatternedState | None:
    """The state to which the flow leads from a sampled shape at a load."""
    model = event.model
    count = max(FEWEST_ELEMENTS, int(np.ceil(ELEMENTS_PER_HALF_WAVE * wavenumber(model, load) / np.pi)))
    shape, _ = arranged(
        model, Pattern((False,), event.pattern.turns), np.zeros(0), load, sample, degree=FLOW_DEGREE, elements=(count,)
    )
    low = descended(model, shape, STIFFNESS)
    return None if low is None else recognised(model, low.shape)


def _kicked(state: Solved, sign: float) -> Shape:
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


__all__ = ["Snap", "at_load", "from_start", "snapped"]

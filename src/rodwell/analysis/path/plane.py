"""A rod leaves the plane in which it lies in a soft wall, or has arched away from a hard one, and comes back to it.

Planar states keep to the plane while Newton's method solves for them, and disturbances out of it count in their
stability index. Where it changes, states on either side of the plane branch off, mirror images of each other.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rodwell.analysis.off_wall.arrange import solved, with_new_elements
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.pattern import chain
from rodwell.numerics.stretches.assembly import bubbles_of
from rodwell.numerics.stretches.bordered import Row
from rodwell.numerics.stretches.carry import Sampler, sampler
from rodwell.numerics.stretches.chain import Chain
from rodwell.numerics.stretches.newton import Solved, softest, solve
from rodwell.quantities.arrays import FloatArray

ASIDE = 0.1
"""Distance from the plane, in Δ, of the first state that has left it."""

IN_PLANE = 0.02
"""Distance from the plane, in Δ, below which a path that folds has come back to it."""

FARTHER = 1e-6
"""How far beyond its branch point a planar state is solved for first, as a part of the load."""


def out_of_plane(state: PatternedState) -> PatternedState | None:
    """The first state of the branch that leaves the plane at a state where a planar path loses stability."""
    shape, model = state.solved.shape, state.model
    pattern = replace(state.pattern, planar=False)
    links, _ = chain(model.problem, model.given, pattern, state.elements, shape.chain.degree)
    found = displaced(state, links, ASIDE)
    return None if found is None else with_new_elements(PatternedState(pattern, state.elements, found))


def freed(state: PatternedState) -> PatternedState | None:
    """A stable state in the plane as one that may leave it; None if it was not found."""
    shape, pattern = state.solved.shape, replace(state.pattern, planar=False)
    return solved(state.model, pattern, shape.breaks, shape.load, sampler(shape), degree=shape.chain.degree)


def displaced(state: PatternedState, links: Chain, aside: float) -> Solved | None:
    """The equilibrium, at a load that is found, of a state displaced by so much, in Δ, where it is softest.

    On the chain ``links``, which may hold less than that of the state.
    """
    shape = state.solved.shape
    direction = softest(state.solved).reshape(-1, 4) * ~links.unmoved
    direction = direction / float(np.max(np.abs(direction[:, :2])))
    nodes, still = aside * direction, np.zeros_like(shape.breaks)
    moved = shape.moved(nodes, bubbles_of(state.solved.out, nodes, still, 0.0, 0.0), still, 0.0)
    row = Row(direction, still, 0.0, float(np.sum(direction * moved.nodes)))
    return solve(state.model, replace(moved, chain=links), row)[1]


def back_in_plane(state: PatternedState, sense: float) -> PatternedState | None:
    """The planar state beside one that has come back to the plane, in this sense of the load; None if it has not."""
    problem, shape = state.model.problem, state.solved.shape
    aside = float(np.max(np.abs(shape.cartesian[:, 1])))
    arched, sunk = problem.untouched and problem.isotropic_ends, state.model.soft and problem.twist == 0.0
    bent = problem.hole is not None and problem.hole.planar and problem.twist == 0.0
    if not (arched or sunk or bent) or state.pattern.planar or aside > IN_PLANE:
        return None
    load = state.load + sense * FARTHER * abs(state.load)
    pattern = replace(state.pattern, planar=True, turns=0)
    return solved(state.model, pattern, shape.breaks, load, flattened(sampler(shape)))


def flattened(sample: Sampler) -> Sampler:
    """A shape without its distance from the plane."""

    def flat(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, angle = sample(s)
        fields, angle = fields.copy(), np.zeros_like(angle)
        fields[1] = 0.0
        angle[0] = np.where(fields[0, 0] > 0.0, np.pi, 0.0)
        return fields, angle

    return flat

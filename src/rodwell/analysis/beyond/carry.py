"""From a state of the rod kept on the wall to the same state of a rod that may leave it."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.off_wall.arrange import solved
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.numerics.stretches.carry import Sampler, rim_fields
from rodwell.quantities.arrays import FloatArray


def sampled(solution: Equilibrium) -> Sampler:
    """Sample a state of the rod kept on the wall."""
    family, state = solution.meshes.fine, solution.point.fine
    clearance, rise = solution.problem.clearance, solution.problem.rise

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        angle = np.array(family.space.evaluate(state.c, s, 3)) / clearance
        angle[0] += rise * s / clearance
        angle[1] += rise / clearance
        return rim_fields(angle), angle

    return sample


def carried(model: RodInHole, solution: Equilibrium) -> PatternedState | None:
    """A state of the rod kept on the wall as a chain of one stretch in contact; None if it was not found."""
    pattern = Pattern((True,), solution.problem.turns)
    return solved(model, pattern, np.zeros(0), solution.force, sampled(solution))

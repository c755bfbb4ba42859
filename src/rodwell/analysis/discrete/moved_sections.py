"""The hole along a string of which one section has another stiffness or weight, as kernels take it.

What is given of a hole is linear in both: a section adds to A(s) and C(s), of itself and of what lies below it, what a
uniform rod in its place would, times its ratio. So nothing is tabulated anew for a change of one of many sections.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.analysis.discrete.curved import HoleAlong, along_rod, along_uniform_rod
from rodwell.physics.on_wall.curved import BENDING, FIRST, FUNCTIONS, LIFT, OFFSET, STIFFNESS, TERMS
from rodwell.physics.on_wall.curved import hole_at as tabulated
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import IntArray


def moved_section(problem: Problem, number: int, ratio: str) -> Callable[[float], HoleAlong]:
    """The hole along the string with "stiffness" or "weight" of section ``number`` (from 0) moved by what is given.

    Of a section that tapers all its values are moved, by that part of each.
    """
    rod, own = problem.rod, along_rod(problem)
    one = own if rod.tapers(ratio)[number] else along_uniform_rod(problem)
    low, high = (float(x) for x in rod.breaks[number : number + 2])
    within = (own.breaks[:-1] >= low) & (own.breaks[:-1] < high)
    below = own.breaks[:-1] < low
    change = np.zeros_like(own.rows)
    of_rod = _columns(*((OFFSET,) if ratio == "stiffness" else (LIFT, *map(FUNCTIONS.index, ("g1", "g2")))))
    change[np.ix_(within, of_rod)] = one.rows[np.ix_(within, of_rod)]
    if ratio == "stiffness":
        change[within, STIFFNESS] = one.rows[within, STIFFNESS]
        if rod.tapered:
            change[within, FIRST + BENDING * TERMS] = 1.0
        if rod.tapers(ratio)[number]:
            change[np.ix_(within, _columns(BENDING))] = own.rows[np.ix_(within, _columns(BENDING))]
    along = OFFSET if ratio == "stiffness" else LIFT
    start, end = (float(tabulated(x, one(x).T)[along][0]) for x in (np.array([low]), np.array([high])))
    constant = FIRST + along * TERMS
    change[within, constant] -= end
    change[below, constant] = start - end
    return lambda step: HoleAlong(own.breaks, own.rows + step * change)


def _columns(*which: int) -> IntArray:
    return np.array([FIRST + k * TERMS + j for k in which for j in range(TERMS)])

"""Energies of a state, and what the supports of rod and cylinder exert: one number each, or one vector."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.discrete.family import shape
from rodwell.analysis.state.compared import compared
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.analysis.state.fields import fields_at
from rodwell.analysis.state.in_hole import end_loads_in_hole
from rodwell.analysis.state.on_ramps import OnRamps, beside_wall, on_even_wall
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.frames import frames
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, LATERAL_WEIGHT, TWIST
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

ENERGIES = ("bending_energy", "twist_energy", "lateral_energy", "axial_energy", "end_work")
"""Names of the energies; bending + lateral + axial − end work is the energy that is stationary."""


@dataclass(frozen=True)
class Reaction:
    """What a support exerts on an end of rod or cylinder.

    Attributes
    ----------
    on
        "rod" or "cylinder".
    s
        0.0 or 1.0.
    force, moment
        Components along i (up across the cylinder), j, k (along its axis, from s = 0 to s = 1), (3,) each, in B/L² and
        B/L. The moment is about the axis of the rod, or of the cylinder, at that end. In a curved hole along its N₁,
        N₂, T there, and of the rod only; the collar that takes F bends the rod with the hole, too: at s = 1 the force
        along T is F less what that moment drives, F − M·(κₙu₂ − κₜd₁)/h. Where the clearance varies, of the rod only,
        too.
    force_error, moment_error
        Error estimates, (3,).
    """

    on: str
    s: float
    force: FloatArray
    moment: FloatArray
    force_error: FloatArray
    moment_error: FloatArray


def energies(solution: Equilibrium) -> dict[str, Value]:
    """Energies in B/L relative to the straight, equally twisted rod, each with its error estimate; see ``ENERGIES``."""
    coarse, fine = (_energies(solution.problem, f, state) for f, state in solution.levels)
    return {k: compared(coarse[k], fine[k]) for k in ENERGIES}


def _energies(problem: Problem, family: Family, state: State) -> dict[str, float]:
    if not on_even_wall(problem):
        return beside_wall(problem, family, state).energies()
    space, p = state.space, family.parameters(state.lam)
    s, w = space.points, space.weights
    y, y1, y2 = shape(family, state, s, 3)
    cos = np.sqrt(1.0 - y1**2)
    sagging = y1**2 / (1.0 + cos)  # 1 − cos η = 1 − z'
    rod = problem.rod
    b, weight, lever = (rod.stiffness(s), rod.weight(s), -rod.lever(s)) if problem.sections else (1.0, 1.0, 1.0 - s)
    bending = b * (y2**2 / cos**2 + y1**4 / p[CLEARANCE] ** 2)
    height = weight * np.sin(0.5 * y / p[CLEARANCE]) ** 2
    return {
        "bending_energy": float(0.5 * w @ bending),
        "twist_energy": float(0.5 * p[TWIST] ** 2 / problem.whole_torsion),
        "lateral_energy": float(2.0 * p[CLEARANCE] * p[LATERAL_WEIGHT] * (w @ height)),
        "axial_energy": float(-p[AXIAL_WEIGHT] * (w @ (sagging * lever))),
        "end_work": float(-p[FORCE] * (w @ sagging) + p[TWIST] * (w @ (y1 * sagging)) / p[CLEARANCE]),
    }


def end_rotation(solution: Equilibrium) -> Value:
    """How far the end s = 1 is turned about its axis against the end s = 0, ξ₁ + ξ₂ there, in rad.

    Positive as T₁ turns it: it is what the dead torque T₁ works on. Of the straight rod it is T₁/C. At an end that can
    turn across the axis it is the angle in the braid's terms. In a curved hole it is counted from frames that do not
    rotate about the hole's axis from one end to the other.
    """
    coarse, fine = (_end_rotation(solution.problem, f, state) for f, state in solution.levels)
    return compared(coarse, fine)


def _end_rotation(problem: Problem, family: Family, state: State) -> float:
    f = fields_at(problem, family, state, np.array([0.0, 1.0]))
    return float(np.diff(f["xi1"] + f["xi2"])[0])


def reactions(solution: Equilibrium) -> tuple[Reaction, ...]:
    """What the supports exert on rod and cylinder at s = 0 and s = 1.

    The part of rod or cylinder towards larger s exerts F⁽ⁱ⁾, M⁽ⁱ⁾ on the part towards smaller s, so a support at s = 1
    exerts F⁽ⁱ⁾(1), M⁽ⁱ⁾(1), one at s = 0 −F⁽ⁱ⁾(0), −M⁽ⁱ⁾(0). Between the ends the wall takes up the rod's lateral
    weight place by place, (50), in the line of the weight; that part is no end reaction. With T₁ ≠ 0 a clamped end
    bends the rod against its torque: the radial force −T₁ ω₂ that this needs comes from the cylinder by (B12),
    and appears on both with opposite signs.
    """
    coarse, fine = (_reactions(solution.problem, f, state) for f, state in solution.levels)
    out = []
    for key, (force, moment) in fine.items():
        errors = (estimated_error(new, old) for new, old in zip((force, moment), coarse[key], strict=True))
        out.append(Reaction(*key, force, moment, *errors))
    return tuple(out)


def _reactions(
    problem: Problem, family: Family, state: State
) -> dict[tuple[str, float], tuple[FloatArray, FloatArray]]:
    if problem.ramps:
        return OnRamps(problem, family, state).end_loads()
    return end_loads(fields_at(problem, family, state, np.array([0.0, 1.0])))


def end_loads(f: dict[str, FloatArray]) -> dict[tuple[str, float], tuple[FloatArray, FloatArray]]:
    """Force and moment of the supports on rod and cylinder, by (which, s), from the fields at s = 0 and s = 1.

    In a curved hole those on the rod: see :class:`Reaction`.
    """
    if "cylinder_F1" not in f:
        return end_loads_in_hole(f)
    axes = frames(f["xi1"], f["eta"], f["xi2"])
    out = {}
    for end, sign in ((0, -1.0), (1, 1.0)):
        rod, cylinder = axes["R11"][end], axes["R12"][end]
        force = np.array([f[f"rod_F{i}"][end] for i in (1, 2, 3)])
        moment = np.array([f[f"rod_M{i}"][end] for i in (1, 2, 3)])
        out["rod", float(end)] = (sign * rod @ force, sign * rod @ moment)
        force = np.array([f[f"cylinder_F{i}"][end] for i in (1, 2, 3)])
        moment = np.array([f["T2"][end], f["mu"][end], f["cylinder_M3"][end]])
        out["cylinder", float(end)] = (sign * cylinder @ force, sign * cylinder @ moment)
    return out

"""The straight rod under an end force, or the one that lies along a curved hole: every field, in closed form."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete.curved import lifted
from rodwell.analysis.discrete.family import parameters
from rodwell.analysis.discrete.ramped import along_ramps
from rodwell.analysis.straight.lying import lying_fields
from rodwell.physics.on_wall.ramps import strand, wall_at
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

ZERO = ("y", "eta", "rod_F2", "rod_F3", "rod_M2", "rod_M3", "cylinder_F1", "cylinder_F2", "cylinder_F3", "T2", "mu",
        "cylinder_M3")  # fmt: skip


def straight_fields(problem: Problem, force: float, s: FloatArray) -> dict[str, FloatArray]:
    """Fields of the straight rod at ``s`` (m,), in units B = L = 1; names as in the nomenclature.

    ``force`` is the end force at s = 1, tension positive: the axial force is N(s) = F + γ cos α (s − 1) (of
    sections with their weights), the contact pressure that of the lateral weight. In a curved hole they are those of
    :func:`rodwell.analysis.straight.lying.lying_fields`; where the clearance varies the wall bends and pushes the rod.
    """
    if problem.hole is not None:
        return lying_fields(problem, force, s)
    s = np.asarray(s, dtype=float)
    if problem.ramps:
        return _on_ramps(problem, force, s)
    out = {name: np.zeros_like(s) for name in ZERO}
    axial, foundation = problem.axial_weight * (s - 1.0), np.full_like(s, problem.foundation)
    turned = problem.twist / problem.torsional_stiffness * s
    if problem.sections:
        rod = problem.rod
        axial, foundation = problem.axial_weight * rod.lever(s), problem.foundation * rod.weight(s)
        turned = problem.twist / problem.torsional_stiffness * rod.turned(s)
    return out | {
        "z": s,
        "xi1": turned,
        "xi2": np.full_like(s, np.pi if problem.on_top else 0.0),
        "rod_F1": force + axial,
        "rod_M1": np.full_like(s, -problem.twist),
        "contact_pressure": -foundation,
    }


def _on_ramps(problem: Problem, force: float, s: FloatArray) -> dict[str, FloatArray]:
    """The same where the clearance varies along the rod; no fields of the cylinder."""
    given = along_ramps(problem)
    rod, none = strand(s, np.zeros((4, s.size)), given(s).T, parameters(problem, force)), np.zeros_like(s)
    ahead = lifted(problem.rod.breaks, lambda x: np.asarray(wall_at(x, given(x).T).lying[0]))
    return {
        **dict.fromkeys(("y", "eta", "xi1", "omega1", "omega2", "rod_F3", "rod_M1", "rod_M2"), none),
        "z": ahead(np.zeros(1)) - ahead(s),
        "xi2": np.full_like(s, np.pi if problem.on_top else 0.0),
        "omega3": np.asarray(rod.omega[2]),
        "rod_F1": np.asarray(rod.force[0]),
        "rod_F2": np.asarray(rod.force[1]),
        "rod_M3": problem.rod.stiffness(s) * rod.omega[2],
        "contact_pressure": np.asarray(rod.pressure),
    }

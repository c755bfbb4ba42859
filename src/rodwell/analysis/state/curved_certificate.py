"""The certificate of a state in a curved hole: balance of forces and moments in space, on the curve that the rod makes.

Nothing of the energy that the engine makes stationary enters: the rod's centre is put on the wall of the hole in space,
its tangent and curvature follow by numerical derivatives, and force and moment, put together from the fields, must
balance weight and contact as vectors:

    r′ = t,   t′ = M × t of the rod's bending,   n − n(0) = ∫ (w k + p d₁) ds,   M′ + t × n = 0.

At steps between sections the wall exerts a force along d₁ and a couple c about u₁, two opposite forces that the rod
turns: c d₁′ = c (ω₁u₁ − ω₃t₁) is left of them. The moment about d₁ does not jump.

The state is solved with every cross-section at its own place first (:mod:`rodwell.analysis.state.own_places`): a branch
takes the hole where the undeformed rod is, and by how much its numbers are off is told beside.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.state.fields import gauss_calculus, gauss_places
from rodwell.analysis.state.in_hole import InHole
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, TWIST
from rodwell.problem.ends import HOLD_ANGLE
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

_TINY = 1e-300


def residuals(problem: Problem, family: Family, state: State) -> dict[str, float]:
    """What is left of each balance, divided by the largest of its terms along the rod."""
    rod = InHole(problem, family, state)
    s = gauss_places(family.space)
    half = 0.5 * np.diff(family.space.breaks)
    _, whole, running, derivative = gauss_calculus()

    def rate(values: FloatArray) -> FloatArray:
        by_element = values.reshape(half.size, -1, 3)
        return np.asarray(np.einsum("pq,eqi->epi", derivative, by_element) / half[:, None, None]).reshape(-1, 3)

    def integral(values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """From s = 0 to each place, and to s = 1."""
        by_element = values.reshape(half.size, -1, 3)
        pieces = np.einsum("q,eqi->ei", whole, by_element) * half[:, None]
        before = np.concatenate([np.zeros((1, 3)), np.cumsum(pieces, axis=0)[:-1]])
        part = np.einsum("pq,eqi->epi", running, by_element) * half[:, None, None]
        return np.asarray(before[:, None] + part).reshape(-1, 3), np.sum(pieces, axis=0)

    fields = rod.strand(s)
    centre, frame = rod.frames(s)
    tangent, d1, u1 = frame.transpose(1, 0, 2)

    force, moment = (vector_of(fields, kind, frame) for kind in ("F", "M"))
    largest = float(np.max(np.linalg.norm(force, axis=1)))  # a rod that lies still has no shear
    weight = np.zeros_like(force)
    weight[:, 2] = rod.parameters[AXIAL_WEIGHT] * problem.rod.weight(s)
    bent = fields["omega3"][:, None] * d1 - fields["omega2"][:, None] * u1
    loads = weight + fields["contact_pressure"][:, None] * d1
    gained, whole_gain = integral(loads)
    steps = problem.rod.breaks[1:-1]
    if steps.size:
        at_steps = _at_steps(rod, steps)
        gained, whole_gain = gained + at_steps[np.searchsorted(steps, s)], whole_gain + at_steps[-1]
    middle = s.size // 2  # where third derivatives of a spline are known best
    first = force[middle] - gained[middle]
    out = {
        "r′ = t": largest_left(rate(centre), -tangent),
        "t′ = M × t": largest_left(rate(tangent), -bent),
        "force balance": largest_left(force - first, -gained, least=max(float(np.max(np.abs(weight))), _TINY)),
        "moment balance": largest_left(rate(moment), np.cross(tangent, force), least=largest),
    }
    if steps.size:
        out["moment at steps"] = _moment_at_steps(rod, steps, float(np.max(np.abs(fields["rod_M2"]))))
    return out | _ends(problem, rod, np.array([first, first + whole_gain]))


def largest_left(*terms: FloatArray, least: float = _TINY) -> float:
    """What is left of a sum of vectors along the rod, (m, 3) each, against the largest of them."""
    size = max(least, *(float(np.max(np.linalg.norm(term, axis=1))) for term in terms))
    return float(np.max(np.linalg.norm(np.sum(terms, axis=0), axis=1))) / size


def _at_steps(rod: InHole, steps: FloatArray) -> FloatArray:
    """What the wall at steps (k,) makes of the rod's force, added up from s = 0, (k + 1, 3)."""
    couple, radial = rod.steps()
    tangent, d1, u1 = rod.frames(steps)[1].transpose(1, 0, 2)
    bent = rod.strand(steps)
    turned = bent["omega1"][:, None] * u1 - bent["omega3"][:, None] * tangent
    forces = radial[:, None] * d1 + couple[:, None] * turned
    return np.concatenate([np.zeros((1, 3)), np.cumsum(-forces, axis=0)])


def _moment_at_steps(rod: InHole, steps: FloatArray, size: float) -> float:
    below, above = (rod.strand(s)["rod_M2"] for s in (np.nextafter(steps, 0.0), steps))
    return float(np.max(np.abs(above - below))) / max(size, _TINY)


def vector_of(fields: dict[str, FloatArray], kind: str, frame: FloatArray) -> FloatArray:
    """Force ("F") or moment ("M") of the rod in space, (m, 3)."""
    return np.asarray(sum(fields[f"rod_{kind}{i + 1}"][:, None] * frame[:, i] for i in range(3)))


def _ends(problem: Problem, rod: InHole, forces: FloatArray) -> dict[str, float]:
    """What ends hold, and the moment and the force around the hole that they leave free, relative to the largest.

    ``forces`` (2, 3) are those at s = 0 and s = 1 by the balance of the whole. The force that goes with y is n·u₂ +
    (b ω₃ sin η + T₁(cos η − 1))/Δ: a step around the hole turns the rod, too.
    """
    everywhere = np.concatenate([[0.0, 1.0], np.linspace(0.0, 1.0, 201)])
    (y, y1), fields = rod.shape(everywhere, 2), rod.strand(everywhere)
    cos = np.sqrt(1.0 - y1**2)
    tangent, _, u1 = rod.frames(everywhere[:2])[1].transpose(1, 0, 2)
    u2 = y1[:2, None] * tangent + cos[:2, None] * u1
    around = np.sum(forces * u2, axis=1)
    around += (fields["rod_M3"] * y1 + rod.parameters[TWIST] * (cos - 1.0))[:2] / rod.clearance
    size = float(np.max(np.linalg.norm([fields[f"rod_F{i}"] for i in (1, 2, 3)], axis=0)))
    out: dict[str, float] = {}
    for k, end in enumerate(problem.ends):
        if end in HOLD_ANGLE:
            out[f"y({k})"] = abs(float(y[k])) / max(float(np.max(np.abs(y))), _TINY)
        else:
            out[f"force around ({k})"] = abs(float(around[k])) / max(size, _TINY)
        if end in ("clamped", "guided"):
            out[f"y′({k})"] = abs(float(y1[k])) / max(float(np.max(np.abs(y1))), _TINY)
        else:
            largest = float(np.max(np.abs(fields["rod_M2"])))
            out[f"M₂({k})"] = abs(float(fields["rod_M2"][k])) / max(largest, _TINY)
    return out

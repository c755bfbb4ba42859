"""The certificate of a state on a wall whose clearance varies: balance in space, on the curve that the rod makes.

As in curved holes (:mod:`rodwell.analysis.state.curved_certificate`) nothing of the energy that the engine makes
stationary enters: positions in space are differentiated numerically, and force and moment from the fields must balance
as vectors with weight and contact. The wall pushes across the hole as the contact pressure tells, and along it as on
the rod that lies; what this rod's own contact would do there beyond that is told beside.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.state.curved_certificate import largest_left, vector_of
from rodwell.analysis.state.fields import gauss_calculus, gauss_places
from rodwell.analysis.state.on_ramps import OnRamps
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, FORCE, LATERAL_WEIGHT
from rodwell.problem.ends import HOLD_ANGLE
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

_TINY = 1e-300


def residuals(problem: Problem, family: Family, state: State) -> dict[str, float]:
    """What is left of each balance, divided by the largest of its terms along the rod."""
    rod = OnRamps(problem, family, state)
    s, half = gauss_places(family.space), 0.5 * np.diff(family.space.breaks)
    _, _, _, derivative = gauss_calculus()

    def rate(values: FloatArray) -> FloatArray:
        by_element = values.reshape(half.size, -1, 3)
        return np.asarray(np.einsum("pq,eqi->epi", derivative, by_element) / half[:, None, None]).reshape(-1, 3)

    fields, (centre, frame) = rod.strand(s), rod.frames(s)
    tangent, d1, u1 = frame.transpose(1, 0, 2)
    force, moment = (vector_of(fields, kind, frame) for kind in ("F", "M"))
    largest = float(np.max(np.linalg.norm(force, axis=1)))
    bent = fields["omega3"][:, None] * d1 - fields["omega2"][:, None] * u1
    loads, sizes = _loads(rod, s)
    out = {
        "r′ = t": largest_left(rate(centre), -tangent),
        "t′ = M × t": largest_left(rate(tangent), -bent),
        "force balance": _integrated(rod, s, half, force, loads) / max(largest, sizes),
        "moment balance": largest_left(rate(moment), np.cross(tangent, force), least=largest),
        "F along the hole at s = 1": abs(float(rod.end_loads()["rod", 1.0][0][2] - rod.parameters[FORCE])) / largest,
    }
    steps = problem.rod.breaks[1:-1]
    below, above = (rod.strand(x)["rod_M2"] for x in (np.nextafter(steps, 0.0), steps))
    largest_moment = float(np.max(np.abs(fields["rod_M2"]))) + _TINY
    out["moment at steps"] = float(np.max(np.abs(above - below), initial=0.0)) / largest_moment
    return out | _ends(problem, rod, largest, largest_moment)


def _loads(rod: OnRamps, s: FloatArray) -> tuple[FloatArray, float]:
    """Weight and contact per length along i, j, k, (m, 3), and their largest size."""
    p, (push, _) = rod.parameters, rod.push(s)
    angle, q = rod.angle(rod.shape(s, 1)[0]), rod.wall(s).weight
    down = p[LATERAL_WEIGHT] if rod.problem.on_top else -p[LATERAL_WEIGHT]
    weight = np.stack([down * q, 0.0 * s, rod.pushed_along(s) - q * p[AXIAL_WEIGHT]], axis=1)
    contact = push[:, None] * np.stack([np.cos(angle), -np.sin(angle), 0.0 * s], axis=1)
    return weight + contact, float(max(np.max(np.abs(weight)), np.max(np.abs(contact))))


def _integrated(rod: OnRamps, s: FloatArray, half: FloatArray, force: FloatArray, loads: FloatArray) -> float:
    """The largest of F(s) − F at the first place + ∫ loads ds, with what the wall does at ends of sections."""
    _, whole, running, _ = gauss_calculus()
    by_element = loads.reshape(half.size, -1, 3)
    pieces = np.einsum("q,eqi->ei", whole, by_element) * half[:, None]
    before = np.concatenate([np.zeros((1, 3)), np.cumsum(pieces, axis=0)[:-1]])
    part = np.einsum("pq,eqi->epi", running, by_element) * half[:, None, None]
    gained = -np.asarray(before[:, None] + part).reshape(-1, 3)
    steps = rod.problem.rod.breaks[1:-1]
    if steps.size:
        couple, radial = rod.steps()
        tangent, d1, u1 = rod.frames(steps)[1].transpose(1, 0, 2)
        bent = rod.strand(steps)
        turned = bent["omega1"][:, None] * u1 - bent["omega3"][:, None] * tangent
        jumps = -(radial[:, None] * d1 + couple[:, None] * turned)
        gained += np.concatenate([np.zeros((1, 3)), np.cumsum(jumps, axis=0)])[np.searchsorted(steps, s)]
    left = force - gained
    return float(np.max(np.linalg.norm(left - left[s.size // 2], axis=1)))


def _ends(problem: Problem, rod: OnRamps, largest: float, largest_moment: float) -> dict[str, float]:
    """What ends hold, and what they leave free, relative to the largest.

    An end that slides around the hole, radially held, turns about its axis: the torque about that vanishes.
    """
    places = np.concatenate([[0.0, 1.0], np.linspace(0.0, 1.0, 201)])
    y, y1 = rod.shape(places, 2)
    loads = rod.end_loads()
    out: dict[str, float] = {}
    for k, end in enumerate(problem.ends):
        force, moment = loads["rod", float(k)]
        if end in HOLD_ANGLE:
            out[f"y({k})"] = abs(float(y[k])) / max(float(np.max(np.abs(y))), _TINY)
        else:
            centre = rod.frames(places[k : k + 1])[0][0]
            torque = float(np.cross(centre, force)[2] + moment[2])
            out[f"torque about the axis ({k})"] = abs(torque) / (largest * rod.clearance)
        if end in ("clamped", "guided"):
            out[f"y′({k})"] = abs(float(y1[k])) / max(float(np.max(np.abs(y1))), _TINY)
        else:  # the pin is radial
            angle = float(rod.angle(y[k]))
            radial = float(moment @ np.array([-np.cos(angle), np.sin(angle), 0.0]))
            out[f"M about the radius ({k})"] = abs(radial) / largest_moment
    return out

"""The endless string of equal joints, which lies on its tool joints: its critical load by Bloch waves, small slopes.

Each tool joint touches the wall at both its edges, the body between two of them not at all. A period is symmetric, so
by balance each edge bears half its weight, whatever the shape. Out of the vertical plane the rod is a beam column on a
spring at each edge, its force over the clearance there. A disturbance v(s + 1) = e^{iκ} v(s) exists where e^{iκ} is an
eigenvalue of the matrix T that takes (v, v′, b v″, b v‴ − N v′) along a period; these come in pairs λ, 1/λ, so that
μ = 2 cos κ obeys μ² − t μ + ½(t² − tr T²) − 2 = 0 with t = tr T. The critical load is the least at which a root is
real and lies in [−2, 2]: the minimum over all wavenumbers κ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.problem.profile import extremes
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

STEPS = 400
"""Loads that are looked at, even in their square roots, up to that of a body clamped between its tool joints."""

SMALL = 4.0
"""What small slopes leave out of a load, in largest slopes squared of that load."""

ROUND_OFF = 1e-14
"""Of the traces, in their squares; of numbers in closed form, in these."""

FEWEST = 3
"""Joints of a finite string that is compared with the endless one."""

SAMPLES = 33
"""Places in each section at which the shape is looked at."""


@dataclass(frozen=True)
class JointedString:
    """An endless string of equal joints on its tool joints, as it buckles out of its plane.

    Attributes
    ----------
    problem
        One period, whose length is the unit.
    load
        Axial force along the string at which it buckles, tension positive, in B/L².
    phase
        κ in radians: how far the buckling mode turns its phase from one joint to the next. π: neighbours bow to
        opposite sides; towards 0: waves much longer than a joint.
    edge_force
        The contact force of each of the two edges of a tool joint, in B/L².
    sag
        How far the body hangs below its ends at that load, in L.
    room
        How far it may before it touches the wall, in L.
    end_effect
        What a string of n joints needs more, times n², as n grows: π²P″(κ)/2 with the compression P(κ) at which the
        wave of phase κ begins to grow, in B/L²; see :meth:`of_joints`.
    spread
        The load with the mean weight spread along the tool joints' clearance, −2√(B̄ w̄/Δ) with 1/B̄ the mean of 1/B, in
        B/L²: what a bed in place of the joints would give. It is no bound.
    """

    problem: Problem
    load: Value
    phase: float
    edge_force: Value
    sag: Value
    room: Value
    end_effect: float
    spread: Value

    def of_joints(self, count: int) -> tuple[float, float]:
        """Between which axial forces a string of so many joints buckles sideways: (least, most compressed).

        In B/L², tension positive; its ends are held against rolling. The wave of an endless string swells and dies away
        along a finite one: in half a sine wave over all its joints, or over two less where clamped ends keep the
        outermost straight. To second order in 1/n: no bound for a few joints.

        Raises
        ------
        InputError
            If ``count`` is less than 3.
        """
        if count < FEWEST:
            raise InputError("count", count, f"must be at least {FEWEST}: the difference is that of many joints")
        return self.load.value, self.load.value - self.end_effect / (count - 2) ** 2

    def as_dict(self) -> dict[str, Any]:
        """All numbers, units B = L = 1 of one period."""
        return {
            "load": self.load.as_dict(),
            "phase": self.phase,
            "edge_force": self.edge_force.as_dict(),
            "sag": self.sag.as_dict(),
            "room": self.room.as_dict(),
            "end_effect": self.end_effect,
            "spread_load": self.spread.as_dict(),
            "unit": "B/L^2, lengths in L, the length of one joint",
            "convention": "axial force, tension positive",
        }


def _closed(number: float) -> Value:
    """A number in closed form, with round-off."""
    return Value(number, ROUND_OFF * abs(number))


def jointed_string(problem: Problem) -> JointedString:
    """Find the load at which an endless string of equal joints, lying on its tool joints, buckles sideways.

    Parameters
    ----------
    problem
        One period, from the middle of a tool joint to the middle of the next: symmetric sections, of which the first
        and the last, of the least clearance, are halves of tool joints. Its ends and its axial weight do not count:
        the force is taken as constant over some joints.

    Raises
    ------
    InputError
        If the problem is no such period.
    NotConvergedError
        If the body, or the middle of a tool joint, touches the wall at that load, which is not computed.
    """
    _check(problem)
    body = float(np.ptp(problem.rod.clearance_steps))
    stiffest = float(np.max(problem.rod.stiffness.coefficients))
    roots = np.linspace(0.0, 2.0 * math.pi * math.sqrt(stiffest) / body, STEPS + 1)[1:]
    first = next((i for i, root in enumerate(roots) if _least(problem, float(root) ** 2) < 0.0), None)
    if not first:
        raise NotConvergedError("no load was found at which the endless string buckles sideways")
    below, above = float(roots[first - 1]) ** 2, float(roots[first]) ** 2
    compression = float(brentq(lambda p: _least(problem, p), below, above, xtol=1e-13 * above, rtol=1e-14))
    step = 1e-6 * compression
    rate = (_least(problem, compression + step) - _least(problem, compression - step)) / (2.0 * step)
    trace, rest = _traces(problem, compression)
    noise = ROUND_OFF * (1.0 + trace**2 + abs(rest)) / abs(rate)
    sag, slope = _sag(problem, compression, noise)
    rod = problem.rod
    mean = math.sqrt(problem.lateral_weight * rod.whole_weight / (rod.compliance * _radius(problem)))
    return JointedString(
        problem, Value(-compression, noise + SMALL * slope**2 * compression), math.acos(0.5 * _softest(trace)),
        _closed(_edge_force(problem)), sag, _closed(_room(problem)), _end_effect(trace, rate), _closed(-2.0 * mean),
    )  # fmt: skip


def _check(problem: Problem) -> None:
    if problem.ramps:
        problem.refuse_bridges("endless strings of joints")
    sections = problem.sections
    clearance = [extremes(section[3])[0] for section in sections]
    what = "must be one period, from the middle of a tool joint to the middle of the next (joints = 1 in a case): "
    if len(sections) < 3 or min(clearance[1:-1]) <= max(clearance[0], clearance[-1]):
        shown = f"{len(sections)} of them"
        raise InputError("sections", shown, what + "half a tool joint, wider sections, half a tool joint")
    problem.refuse_tapers("endless strings of joints")
    if problem.rod.mixed:
        raise InputError("sections", f"{len(sections)} of them", what + "all of it sinks, or all of it floats")
    if not problem.rod.symmetric:
        raise InputError("sections", f"{len(sections)} of them", what + "the same seen from either end")
    if problem.lateral_weight == 0.0:
        raise InputError("weight", problem.weight, "must press the string to its hole, by w sin α above 0")
    if problem.twist or problem.hole is not None:
        name = "twist" if problem.twist else "hole"
        raise InputError(name, None, "is not computed for an endless string of joints: leave it out")


def _radius(problem: Problem) -> float:
    """Clearance of the tool joints."""
    return problem.clearance * extremes(problem.sections[0][3])[0]


def _edge_force(problem: Problem) -> float:
    return 0.5 * problem.lateral_weight * problem.rod.whole_weight


def _room(problem: Problem) -> float:
    return problem.clearance * min(extremes(section[3])[0] for section in problem.sections[1:-1]) - _radius(problem)


def _along(length: float, stiffness: float, weight: float, compression: float) -> FloatArray:
    """Takes (v, v′, b v″, b v‴ − N v′, 1) along a piece under a load per length, (5, 5)."""
    rates = np.zeros((5, 5))
    rates[0, 1], rates[1, 2], rates[2, 1], rates[2, 3], rates[3, 4] = 1.0, 1.0 / stiffness, -compression, 1.0, -weight
    return np.asarray(expm(rates * length))


def _traces(problem: Problem, compression: float) -> tuple[float, float]:
    """The trace of T, and ½((tr T)² − tr T²)."""
    spring, whole = np.eye(4), np.eye(4)
    spring[3, 0] = -_edge_force(problem) / _radius(problem)
    last = len(problem.sections) - 1
    for i, ((length, *_), stiffness) in enumerate(
        zip(problem.sections, problem.rod.stiffness.coefficients, strict=True)
    ):
        whole = _along(length, float(stiffness[0]), 0.0, compression)[:4, :4] @ whole
        if i in (0, last - 1):
            whole = spring @ whole
    trace = float(np.trace(whole))
    return trace, 0.5 * (trace**2 - float(np.trace(whole @ whole)))


def _softest(trace: float) -> float:
    """The μ = 2 cos κ of the wave that costs least."""
    return min(max(0.5 * trace, -2.0), 2.0)


def _least(problem: Problem, compression: float) -> float:
    """The quadratic of μ at the μ in [−2, 2] where it is least: below 0 where a wave grows."""
    trace, rest = _traces(problem, compression)
    mu = _softest(trace)
    return mu**2 - trace * mu + rest - 2.0


def _end_effect(trace: float, rate: float) -> float:
    """π²P″(κ)/2 where f(P, μ) = μ² − tμ + … − 2 vanishes, ``rate`` = ∂f/∂P there: P″ = P_μμ μ′² + P_μ μ″, μ = 2 cos κ.

    Where μ lies within its range f is least there, so that P_μ = 0; else μ′ = 0.
    """
    mu = _softest(trace)
    of_mu, phase = -(2.0 * mu - trace) / rate, math.acos(0.5 * mu)
    curvature = -2.0 / rate * (2.0 * math.sin(phase)) ** 2 - 2.0 * math.cos(phase) * of_mu
    return 0.5 * math.pi**2 * curvature


def _sag(problem: Problem, compression: float, noise: float) -> tuple[Value, float]:
    """The sag at a load that is known to ``noise``, and the largest slope.

    Its error is what small slopes leave out of it, itself and by the load, and what more places change.
    """
    sag, slope = _lying(problem, compression, SAMPLES)
    finer, _ = _lying(problem, compression, 2 * SAMPLES - 1)
    step = SMALL * slope**2 * compression + noise
    other, _ = _lying(problem, compression - step, SAMPLES)
    error = abs(finer - sag) + abs(other - sag) + (SMALL * slope**2 + ROUND_OFF) * abs(sag)
    return Value(finer, error), slope


def _lying(problem: Problem, compression: float, samples: int) -> tuple[float, float]:
    """Sag of the body under its ends, and the largest slope, of the string in its plane.

    Raises
    ------
    NotConvergedError
        Where it touches anything but its edges.
    """
    rod, force = problem.rod, _edge_force(problem)
    places, shapes, now, breaks = [0.0], [np.eye(5)], np.eye(5), rod.breaks
    for i, (left, right) in enumerate(pairwise(breaks)):
        stiffness, weight = (float(profile.coefficients[i, 0]) for profile in (rod.stiffness, rod.weight))
        for s in np.linspace(float(left), float(right), samples)[1:]:
            here = _along(float(s) - places[-1], stiffness, weight * problem.lateral_weight, compression)
            now = here @ now
            places.append(float(s))
            shapes.append(now.copy())
        if i in (0, len(problem.sections) - 2):
            now = now.copy()
            now[3, 4] += force
    by_moment, by_load = (np.array([shape[:2, k] for shape in shapes]) for k in (2, 4))
    moment = -by_load[-1, 1] / by_moment[-1, 1]  # the slope vanishes in the middle of a joint, here and at the next
    height, slope = (by_load + moment * by_moment).T
    s = np.array(places)
    edge = float(breaks[1])
    height = height - float(height[samples - 1])
    beside = (s <= edge) | (s >= float(breaks[-2]))
    sag = -float(np.min(height[~beside]))
    if float(np.min(height[beside])) < -1e-12 * problem.clearance:
        raise NotConvergedError("the tool joints bend down between their edges and touch the wall: not computed")
    floor = _radius(problem) - problem.clearance * rod.clearance(s)
    if np.any(height[~beside] < floor[~beside]):
        raise NotConvergedError(
            f"the body hangs {sag:.3g} L below its ends at {-compression:.6g} B/L², and touches the wall at "
            f"{_room(problem):.3g} L: joints whose bodies lie on the wall too are not computed"
        )
    return sag, float(np.max(np.abs(slope)))

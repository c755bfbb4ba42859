"""The rod that lies along a curved hole, before it buckles: contact per length, and where it leaves the wall by itself.

In a hole whose axis lies in a vertical plane a rod on its low or high generator, θ = 0, is in equilibrium under any end
force. In compression it is pressed to the outside of the curve, in tension to the inside, so that the contact per
length is P = a(s) + b(s) F: the rod lies where P ≥ 0 everywhere, between two end forces at most.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete.curved import HoleAlong, along_rod, undeformed_place
from rodwell.analysis.discrete.family import parameters
from rodwell.analysis.straight.scale import load_scale
from rodwell.errors import InputError
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.physics.on_wall.curved import step_loads, strand
from rodwell.physics.on_wall.parameters import SIDE
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Peak, Value

PIECES, POINTS = 64, 8
"""Pieces, and Gauss points in each, over which the contact is added up; then with twice as many pieces."""

PLACES = 2001
"""Places at which the contact is looked at before its extremes are refined."""


def refuse_spatial(problem: Problem) -> None:
    """Raise where θ = 0 is no equilibrium: out of the vertical plane, or under a torque T₁ that turns a free end.

    Or where the curvature changes, too: the shear T₁κᵣ that balances a torque in a bend changes with it.
    """
    hole = problem.hole
    if hole is not None and not hole.planar:
        name = "axis" if problem.axis else "walk"
        raise InputError(
            name,
            f"{len(problem.axis)} points" if problem.axis else problem.walk,
            "bends the hole sideways, where the rod lies on no straight generator and has no critical load: it moves "
            "with every change of the end force; ask how it lies, and where that ends (rodwell.lying_rod)",
        )
    if hole is not None and problem.twist != 0.0 and problem.axis:
        raise InputError(
            "twist",
            problem.twist,
            "pushes the rod sideways where the curvature of the hole changes along it, as along points or stations it "
            "does: it lies on no straight generator there and has no critical load. Give no twist, or ask for states "
            "at single end forces (rodwell.equilibrium) and follow them",
        )
    if hole is not None and problem.twist != 0.0 and problem.ends != ("clamped", "clamped"):
        raise InputError(
            "ends",
            "-".join(problem.ends),
            "with a twisting moment in a curved hole must be clamped-clamped: the moment turns other ends around the "
            "hole at once, and there is no critical load",
        )


def lying_contact(problem: Problem, force: float, s: FloatArray, along: HoleAlong | None = None) -> FloatArray:
    """Force per length (m,) by which the wall presses the rod at ``s`` (m,), in B/L³; negative: it would pull.

    In a hole that is given ``along`` the rod in place of the problem's, if there is one.
    """
    rows = (along_rod(problem) if along is None else along)(s).T
    still = np.zeros((4, s.size))
    p = parameters(problem, force)
    return np.asarray(-p[SIDE] * strand(s, still, rows, p)[-1])


def lying_steps(problem: Problem, force: float) -> tuple[FloatArray, FloatArray]:
    """Couple about u₁ and force along d₁, (k,) each, by which the wall holds the lying rod at steps of a string."""
    steps, rows = problem.rod.breaks[1:-1], along_rod(problem)
    still = np.zeros((4, steps.size))
    sides = rows(np.nextafter(steps, 0.0)).T, rows(steps).T
    return step_loads(steps, (still, still), sides, problem.rod.stiffness_sides, parameters(problem, force))


def off_at_steps(problem: Problem, force: float) -> float | None:
    """Over which length in L, at least, the lying rod is off the wall beside a step of a string; None: nowhere.

    The wall holds it by the couple c at the step. Where it only pushes, the rod touches it again at two places ℓ apart,
    between which it is pressed to the wall by P per length at most: no more than Pℓ²/2 holds that couple, so that
    ℓ ≥ √(2c/P). The end force on the small slopes of that stretch is left out.
    """
    steps = problem.rod.breaks[1:-1]
    couple = np.abs(lying_steps(problem, force)[0])
    pressed = np.maximum(*(lying_contact(problem, force, s) for s in (np.nextafter(steps, 0.0), steps)))
    there = (couple > 0.0) & (pressed > 0.0)
    return float(np.max(np.sqrt(2.0 * couple[there] / pressed[there]))) if np.any(there) else None


def lying_fields(problem: Problem, force: float, s: FloatArray) -> dict[str, FloatArray]:
    """Fields of the rod that lies on θ = 0 under an end force, at places ``s`` (m,), in units B = L = 1.

    Names and components are those of a buckled rod in the hole. The hole alone bends it: ω₃ = k₁/(1 + Δk₁), about u₁,
    and ω₂ where the hole turns sideways.
    """
    s = np.asarray(s, dtype=float)
    still, p = np.zeros(s.shape), parameters(problem, force)
    rod = problem.rod
    omega1, omega2, omega3, f1, f2, f3, pressure = (
        np.broadcast_to(value, s.shape).astype(float)
        for value in strand(s, np.zeros((4, s.size)), along_rod(problem)(s).T, p)
    )
    return {
        "y": still,
        "xi2": still + (np.pi if problem.on_top else 0.0),
        "eta": still,
        "xi1": problem.twist / problem.torsional_stiffness * rod.turned(s),
        "z": undeformed_place(problem, s) - undeformed_place(problem, np.array([0.0])),
        "omega1": omega1,
        "omega2": omega2,
        "omega3": omega3,
        "rod_F1": f1,
        "rod_F2": f2,
        "rod_F3": f3,
        "rod_M1": still - problem.twist,
        "rod_M2": rod.stiffness(s) * omega2,
        "rod_M3": rod.stiffness(s) * omega3,
        "contact_pressure": pressure,
    }


def lying_contact_in_all(problem: Problem, force: float) -> Value:
    """∫|P| ds of the lying rod in B/L², with the forces of the wall at steps, and the error of its quadrature."""
    sums = []
    at_steps = float(np.sum(np.abs(lying_steps(problem, force)[1])))
    for pieces in (PIECES, 2 * PIECES):
        nodes, weights = np.polynomial.legendre.leggauss(POINTS)
        ends = np.union1d(np.linspace(0.0, 1.0, pieces + 1), problem.rod.breaks)
        half = 0.5 * np.diff(ends)
        s = (ends[:-1, None] + half[:, None] * (nodes + 1.0)).ravel()
        each = np.abs(lying_contact(problem, force, s)).reshape(half.size, POINTS) @ weights
        sums.append(float(half @ each) + at_steps)
    return Value(sums[1], float(estimated_error(sums[1], sums[0])))


def _places(problem: Problem) -> FloatArray:
    """Places, rising, at which the contact is looked at: both sides of every step of a string among them."""
    steps = problem.rod.breaks[1:-1]
    return np.unique(np.concatenate([np.linspace(0.0, 1.0, PLACES), np.nextafter(steps, 0.0), steps]))


def least_contact(problem: Problem, force: float) -> Peak:
    """Least contact per length of the lying rod and where it is; below 0 the wall would have to pull there."""
    s = _places(problem)
    for _ in range(4):  # ever closer between the neighbours of the least
        values = lying_contact(problem, force, s)
        least = int(np.argmin(values))
        here = float(values[least]), float(s[least])
        s = np.linspace(s[max(least - 1, 0)], s[min(least + 1, s.size - 1)], 41)
    size = float(np.max(np.abs(lying_contact(problem, force, np.linspace(0.0, 1.0, 9)))))
    return Peak(here[0], 64.0 * np.finfo(float).eps * (size + abs(force)), here[1])


def check_pressed(problem: Problem, buckling: float) -> None:
    """Raise where a rod has left the wall of a curved hole before it buckles, at the end force ``buckling``.

    There is then no lift-off of the buckled rod to be sought.
    """
    if problem.hole is None:
        return
    least = least_contact(problem, buckling)
    if least.value <= 0.0:
        raise InputError(
            "until",
            None,
            f"must be given: at its critical load {buckling:.8g} B/L² the wall would have to pull the rod at "
            f"s/L = {least.s:.4g}, so that it has left the wall before, and there is no lift-off of the buckled rod",
        )


def lies_between(problem: Problem) -> tuple[Peak | None, Peak | None]:
    """Lowest and highest end force at which the wall need not pull the lying rod, each with where it lifts off first.

    None where there is no such limit. Where the rod lies at no force at all, the lowest is above the highest.
    """
    s = _places(problem)
    for _ in range(2):
        at_rest = lying_contact(problem, 0.0, s)
        slope = lying_contact(problem, 1.0, s) - at_rest
        flat = np.abs(slope) <= 1e-13 * np.max(np.abs(slope), initial=1e-300)
        with np.errstate(divide="ignore", invalid="ignore"):
            limits = -at_rest / slope
        low = np.where(~flat & (slope > 0.0), limits, -np.inf)
        high = np.where(~flat & (slope < 0.0), limits, np.inf)
        first, last = int(np.argmax(low)), int(np.argmin(high))
        near = [np.linspace(s[max(i - 1, 0)], s[min(i + 1, s.size - 1)], 101) for i in (first, last)]
        found = low[first], s[first], high[last], s[last]
        s = np.unique(np.concatenate([s, *near]))
    return (
        Peak(float(found[0]), _round_off(problem, found[0]), float(found[1])) if np.isfinite(found[0]) else None,
        Peak(float(found[2]), _round_off(problem, found[2]), float(found[3])) if np.isfinite(found[2]) else None,
    )


def _round_off(problem: Problem, force: float) -> float:
    """Error of a force in closed form, but for the grid on which its place was sought: the square of its spacing."""
    return float(1e-9 * (abs(force) + load_scale(problem)))

"""Key numbers of an answer: numbers with errors, and what they are."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.state.wall import CylinderLoads
from rodwell.analysis.straight.critical import Mode
from rodwell.analysis.straight.scale import EULER
from rodwell.analysis.straight.without_wall import SpatialMode
from rodwell.answers.result.key_number import KeyNumber, force_scale
from rodwell.case.case import Case
from rodwell.case.hole.cylinder import Cylinder
from rodwell.problem.problem import Problem
from rodwell.problem.words import counted_around
from rodwell.quantities.names import QUANTITIES
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import percent, plain
from rodwell.quantities.value import Peak, Value
from rodwell.strength.cylinder import cylinder_stress
from rodwell.strength.loaded import LoadedRod


def critical_number(mode: Mode, *, kept: bool = False) -> KeyNumber:
    """Critical load of a mode; ``kept``: it is that of a rod kept on the wall, and twist makes it buckle before."""
    symmetry = {1: "even about mid-length", -1: "odd about mid-length", 0: "no symmetry"}[mode.parity]
    label = f"Critical load of mode {mode.number}{' if kept on the wall' if kept else ''}, end force at s = 1"
    scale = force_scale(mode.force) + mode.problem.heaviest
    return KeyNumber(f"critical_load_{mode.number}", label, mode.load, "force", scale, symmetry)


def first_met(mode: Mode | SpatialMode) -> KeyNumber:
    """The load at which a twisted rod that nothing presses to the wall buckles."""
    label = "Load at which the straight rod buckles, end force at s = 1"
    note = "with the wall's help; the critical loads are those of a rod kept on the wall"
    return KeyNumber("first_load_met", label, Value(mode.force, mode.error), "force", _size(mode), note)


def without_wall(mode: SpatialMode) -> KeyNumber:
    """The load at which the straight rod would buckle without the wall's help."""
    label = "First critical load without the wall's help, end force at s = 1"
    return KeyNumber("critical_load_without_wall", label, Value(mode.force, mode.error), "force", _size(mode))


def _size(mode: Mode | SpatialMode) -> float:
    """Size against which the error of such a load is judged."""
    return force_scale(mode.force) + mode.problem.heaviest + 0.25 * mode.problem.twist**2


STANDING = {
    ("clamped", "clamped"): 74.628569,
    ("clamped", "guided"): 18.956266,
    ("clamped", "free"): 7.837347,
}
"""γ at which a vertical rod buckles under its own weight, F = 0 at s = 1, by its ends; the last digit is rounded.

Clamped at both ends: paper, section 4.2. Clamped and guided, and clamped and free (Greenhill 1881): 9/4 of the squares
of the first zeros of the Bessel functions J of order 1/3 and −1/3.
"""

ROUNDED = 5e-7


def critical_length(problem: Problem) -> list[KeyNumber]:
    """Length at which a vertical rod of this stiffness and weight just stands without end force, if it is known."""
    number = STANDING.get(problem.ends)
    if number is None or problem.axial_weight != problem.weight or problem.weight == 0.0 or problem.sections:
        return []
    length = (number / problem.weight) ** (1.0 / 3.0)
    value = Value(length, length * ROUNDED / number / 3.0)
    note = f"L_cr = ∛({plain(number, 8)} B/mg): a longer rod buckles under its own weight, F = 0 at s = 1"
    label = "Critical length under self-weight, vertical"
    return [KeyNumber("critical_length", label, value, "length", length, note)]


def not_held(load: Value | str | None) -> list[KeyNumber]:
    """The load of a string that nothing holds at steps of its stiffness in a bend, where it is known."""
    if load is None or isinstance(load, str):
        return []
    label = "Load at which it buckles if nothing holds it at steps of its stiffness, end force at s = 1"
    return [KeyNumber("buckling_load_not_held", label, load, "force", force_scale(load.value))]


def in_curved_hole(lying: LoadedRod, own: Value | None, tension: Peak | None) -> list[KeyNumber]:
    """What the hole's curvature does: bending of the lying rod, lift-off with own places, where tension lifts it off.

    ``lying`` is the rod before it buckles, ``own`` the lift-off load with every cross-section at its own place.
    """
    bending = lying.largest(lambda f: np.hypot(f["rod_M2"], f["rod_M3"]))
    label = "Largest bending moment in the rod as it lies, from the hole's curvature alone"
    if lying.solution is not None:
        label = "Largest bending moment in the rod as it lies at rest, by the curvature of the hole"
    out = [KeyNumber("hole_bending", label, bending, "moment", bending.value, s=(bending.s,))]
    if own is not None:
        label = "Lift-off load with every cross-section at its own place along the hole, end force at s = 1"
        out.append(KeyNumber("lift_off_load_own_places", label, own, "force", force_scale(own.value)))
    if tension is not None:
        label = "Above this the rod leaves this side of the hole, end force at s = 1"
        load = Value(tension.value, tension.error)
        out.append(KeyNumber("leaves_wall_in_tension", label, load, "force", force_scale(load.value), s=(tension.s,)))
    return out


def real_force(key: KeyNumber, case: Case) -> list[KeyNumber]:
    """The force in the wall of the pipe at s = 1 that belongs to an effective one, where pressures tell them apart."""
    if case.rod is None or case.scales is None:
        return []
    at_top = case.rod if case.string is None else case.string.at_end(bottom=False)
    less = case.fluids.effective_minus_real(at_top, 0.0) / case.scales.factor("force")
    if less == 0.0:
        return []
    label = f"{key.label.split(',')[0]} as real force in the wall of the pipe, at s = 1"
    scale = abs(key.value) + abs(less) + EULER
    real = Value(key.value - less, key.error)
    return [KeyNumber(f"{key.name}_real", label, real, "force", scale, "effective force + pᵢ Aᵢ − pₒ Aₒ")]


def stress_number(state: Solution, cylinder: Cylinder, scales: Scales) -> KeyNumber:
    """Largest equivalent stress in the cylinder in one state, as a multiple of the unit of stress B/L⁴."""
    stress = cylinder_stress(state, cylinder, scales)
    unit = scales.factor("stress")
    used = Value(stress.utilisation, stress.utilisation * stress.error / stress.value)
    note = f"{percent(used)} of the yield strength"
    label = "Largest equivalent (von Mises) stress in the cylinder"
    value = Value(stress.value / unit, stress.error / unit)
    return KeyNumber("cylinder_stress", label, value, "stress", value.value, note, (stress.s,))


RADIAN = 1.0
"""Size of an angle, against which the error of one is judged."""


def rotations(state: Solution) -> list[KeyNumber]:
    """How far the end s = 1 is turned by T₁, in one state and in the straight rod; nothing without T₁."""
    problem = state.problem
    if problem.twist == 0.0:
        return []
    straight = Value(problem.twist / problem.whole_torsion)
    label, note = "Rotation of the end s = 1 about its axis", "positive as T₁ turns it"
    return [
        KeyNumber("end_rotation_straight", f"{label}, straight rod", straight, "angle", RADIAN, "T₁ L/C"),
        KeyNumber("end_rotation", f"{label}, at lift-off", state.end_rotation, "angle", RADIAN, note),
    ]


def state_numbers(state: Solution) -> list[KeyNumber]:
    """Wall and support loads of one state."""
    wall, shortening, end = state.wall, state.number(Measured.SHORTENING), state.problem.ends[1]
    in_rod = state.largest("rod_M2")
    label = "Largest contact force on the wall per length, outward"
    return [
        _largest("largest_wall_force", "contact_pressure", label, wall.contact, wall.contact.value),
        KeyNumber(
            "total_wall_force",
            "Total contact force on the wall, all directions added",
            wall.total,
            "force",
            wall.total.value,
        ),
        *([] if state.problem.hole is None else _bent(state)),
        *([] if wall.cylinder is None else _cylinder_numbers(wall.cylinder, in_rod.value)),
        _largest(
            "largest_bending", "rod_M2", "Largest bending moment in the rod about d₁, |M₂⁽¹⁾|", in_rod, in_rod.value
        ),
        KeyNumber(
            "end_shear",
            f"Sideways force at the end s = 1 ({end}), F₃(1)",
            state.end_reactions["shear"],
            "force",
            force_scale(state.force),
        ),
        KeyNumber(
            "end_moment",
            f"Bending moment at the end s = 1 ({end}), M₂(1)",
            state.end_reactions["moment"],
            "moment",
            in_rod.value,
        ),
        KeyNumber("end_shortening", "Approach of the ends, 1 − z(1)", shortening, "length", shortening.value),
    ]


def _largest(name: str, field: str, label: str, peak: Peak, scale: float) -> KeyNumber:
    return KeyNumber(name, label, peak, QUANTITIES[field].dimension, scale, s=(peak.s,))


def _bent(state: Solution) -> list[KeyNumber]:
    """In a curved hole: which part of the wall is pressed hardest, and how far around the rod lies."""
    wall, farthest = state.wall, state.largest("xi2")
    side, sense = counted_around(state.problem)
    label, note = (
        f"Where around the hole that is, from the {side} side",
        f"positive to the {sense}, looking towards s = 0",
    )
    far = f"Largest angle around the hole from the {side} side, |ξ₂|"
    return [
        KeyNumber("largest_wall_force_angle", label, wall.angle, "angle", RADIAN, note, (wall.contact.s,)),
        _largest("largest_angle", "xi2", far, farthest, RADIAN),
    ]


def _cylinder_numbers(carried: CylinderLoads, in_rod: float) -> list[KeyNumber]:
    """What a straight cylinder carries. μ and λ are differences of moments of the size of the rod's, ``in_rod``."""
    torque = Value(carried.torque.value if carried.needs_torque else 0.0, carried.torque.error)
    balanced = "" if carried.needs_torque else "none: the twisting moment balances itself"
    label, largest = "Torque that the cylinder's support at s = 0 must provide, T₂(0)", carried.twisting
    mu, bent = "Largest bending moment in the cylinder about d₁, |μ|", "Largest bending moment in the cylinder about u₂"
    return [
        _largest("largest_torque", "T2", "Largest twisting moment in the cylinder, |T₂|", largest, largest.value),
        KeyNumber("support_torque", label, torque, "moment", largest.value, balanced),
        _largest("largest_mu", "mu", mu, carried.bending_mu, in_rod),
        _largest("largest_lambda", "cylinder_M3", f"{bent}, |λ cos η|", carried.bending_lambda, in_rod),
    ]

"""The certificate of a solution: the paper's own equations, evaluated on it term by term.

The engine finds y(s); everything else is rebuilt from it. Here the rebuilt fields are put into the paper's fifteen
differential equations, its algebraic relations and its end conditions (:mod:`rodwell.physics.on_wall.equations`), none
of which the engine uses, with derivatives taken numerically from the fields themselves. Each residual is divided by the
largest term of its equation along the rod. A true solution leaves what the mesh leaves; a mistake in engine,
reconstruction or equations leaves something of the order of one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.discrete.family import shape
from rodwell.analysis.state.curved_certificate import residuals
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.analysis.state.fields import element_fields, gauss_calculus, gauss_places
from rodwell.analysis.state.own_places import near_by
from rodwell.analysis.state.ramped_certificate import residuals as ramped
from rodwell.physics.on_wall import equations
from rodwell.physics.on_wall.equations import NAMES, NUMBERS, Fifteen, Load
from rodwell.quantities.arrays import FloatArray

if TYPE_CHECKING:
    from rodwell.problem.problem import Problem

LIMIT = 1e-7
"""Largest certificate of a solution that counts as converged, at tolerances of 1e-8 and below."""

SLACK = 10.0
"""At coarser tolerances the certificate may be this many times the tolerance: it contains derivatives of the fields."""

SMALL = 1e-2
"""Part of the moments it is the difference of, below which T₂ is not known to nine digits of itself."""

_TINY = 1e-300

AT_FIRST_END = ("(B1)", "(B2)", "(B3)", "(B4)", "(B5)", "(B6)")
"""End conditions at s = 0; the others are at s = 1."""


@dataclass(frozen=True)
class Certificate:
    """What is left of each equation when the solution is put into it, divided by the equation's largest term.

    Attributes
    ----------
    residuals
        By number in the paper, or by name: the equations (22)–(27), (32)–(36), (41)–(44), the relations (37)–(39) and
        (52)–(58), the end conditions (B1)–(B15), of a string "moment at steps" (continuity of b ω₂), "T₂ by two routes"
        (distributed torque (33), and moment balance of the whole, relative to the largest T₂), "h by two routes" ((56),
        and force balance along the rod) and "work and energy" (change of stored energy against work of the end loads
        along the branch). In a curved hole the balances of :mod:`rodwell.analysis.state.curved_certificate`.
    limit
        Up to which the largest of them counts as zero.
    """

    residuals: dict[str, float]
    limit: float

    @property
    def worst(self) -> float:
        """The largest residual."""
        return max(self.residuals.values())

    @property
    def worst_equation(self) -> str:
        """Where that is."""
        return max(self.residuals, key=lambda name: self.residuals[name])

    @property
    def passed(self) -> bool:
        """Whether the state solves the paper's equations to within the limit."""
        return self.worst <= self.limit

    def as_dict(self) -> dict[str, Any]:
        """Everything about it, for JSON."""
        return {
            "worst": self.worst,
            "worst_equation": self.worst_equation,
            "limit": self.limit,
            "passed": self.passed,
            "residuals": self.residuals,
        }

    def __repr__(self) -> str:
        return f"<Certificate {self.worst:.1e} at {self.worst_equation}, limit {self.limit:.0e}>"


def load_of(problem: Problem, force: float) -> Load:
    """What the paper's system is given for a problem at an end force.

    For a rod on top ξ₂ is counted from there, and the lateral weight takes the other sign: sin π is not zero in
    floating point, and would make a straight rod on top imperfect.
    """
    return Load(
        force=force,
        twist=problem.twist,
        axial_weight=problem.axial_weight,
        lateral_weight=problem.foundation,
        clearance=problem.clearance,
        C=problem.torsional_stiffness,
        turn=2.0 * np.pi * problem.turns,
        ends=problem.ends,
    )


LOADS = ("F1", "F2", "F3", "M1", "M2", "M3", "T2", "lam", "mu")
"""Variables that are forces or moments: in a section of stiffness b they count in units of b."""


def own_units(problem: Problem, load: Load, s: FloatArray) -> tuple[float | FloatArray, Load]:
    """Stiffness b at ``s`` (m,), and what the paper's system is given there, with forces and moments in units of b.

    A section is a uniform rod; in its own units it has the stiffness 1 that the equations are written for.
    """
    if not problem.sections:
        return 1.0, load
    rod = problem.rod
    b, q = rod.stiffness(s), rod.weight(s)
    offset, rate = rod.lever(s) - q * (s - 1.0), rod.stiffness.derivative
    return b, load._replace(
        force=(load.force + load.axial_weight * offset) / b,
        twist=load.twist / b,
        axial_weight=load.axial_weight * q / b,
        lateral_weight=load.lateral_weight * q / b,
        C=load.C * rod.torsion(s) / b,
        stiffness_rate=rate(s) / b,
        stiffness_bend=rate.derivative(s) / b,
    )


def in_units(x: Fifteen, b: float | FloatArray) -> Fifteen:
    """The fifteen variables with forces and moments in units of b."""
    return x._replace(**{name: getattr(x, name) / b for name in LOADS})


def certificate_of(solution: Equilibrium) -> Certificate:
    """Put a solution into the paper's equations; see :class:`Certificate`."""
    problem = solution.problem
    if problem.hole is not None:
        own = near_by(problem, *solution.levels[1])
        return Certificate(residuals(problem, *own), max(LIMIT, SLACK * solution.meshes.rtol))
    if problem.ramps:
        return Certificate(ramped(problem, *solution.levels[1]), max(LIMIT, SLACK * solution.meshes.rtol))
    half, fields = element_fields(problem, solution.meshes.fine, solution.point.fine)
    derivative = gauss_calculus()[3]
    whole = load_of(problem, solution.force)
    b, load = own_units(problem, whole, gauss_places(solution.meshes.fine.space))
    fields["xi2"] = fields["y"] / whole.clearance

    def inside(name: str) -> FloatArray:
        return fields[name][1:-1]

    def rate(name: str) -> FloatArray:
        return np.asarray(inside(name).reshape(half.size, -1) @ derivative.T / half).ravel()

    x = in_units(Fifteen(*(inside(name) for name in NAMES)), b)
    ends: Any = fields  # Fifteen of numbers
    out: dict[str, float] = {}
    bending_rate = b * rate("omega2")
    rows = zip(NUMBERS, NAMES, Fifteen._fields, equations.right_hand_sides(x, load), strict=True)
    for number, name, symbol, terms in rows:
        # the variable itself counts as a term: where it is constant, its derivative is round-off and has no size
        sizes = (inside(name), bending_rate) if name == "mu" else (inside(name),)
        unit = b if symbol in LOADS else 1.0
        out[number] = _scaled((rate(name), *(-unit * term for term in terms)), sizes)
    for number, terms in equations.moments(x, rate("mu") / b, load).items():
        out[number] = _scaled(tuple(b * term for term in terms), (load.clearance * bending_rate,))
    out |= _strands(x, load, b, inside)
    extent = {k: float(np.max(np.abs(fields[name]))) for k, name in zip(Fifteen._fields, NAMES, strict=True)}
    out |= _end_conditions(problem, whole, [Fifteen(*(ends[name][i] for name in NAMES)) for i in (0, -1)], extent)
    out["T₂ by two routes"] = _torque(fields, problem)
    out["h by two routes"] = _scaled((fields["tangential_balance"],), (fields["rod_F1"],))
    out["work and energy"] = _work_and_energy(solution, whole)
    if problem.sections:
        out["moment at steps"] = _moment_at_steps(solution, extent["M2"])
    return Certificate(out, max(LIMIT, SLACK * solution.meshes.rtol))


def _end_conditions(problem: Problem, whole: Load, ends: list[Fifteen], extent: dict[str, float]) -> dict[str, float]:
    """(B1)–(B15) at both ``ends``, against the largest values of what they are about."""
    units, loads = zip(*(own_units(problem, whole, np.array([s])) for s in (0.0, 1.0)), strict=True)
    first, last = (in_units(x, float(np.squeeze(b))) for x, b in zip(ends, units, strict=True))
    at_first, at_last = (equations.end_conditions(first, last, load) for load in loads)
    out = {}
    for number, there in at_last.items():
        end = 0 if number in AT_FIRST_END else 1
        condition = at_first[number] if end == 0 else there
        unit = float(np.squeeze(units[end])) if condition.against[0] in LOADS else 1.0
        size = max(extent[k] for k in condition.against) + _TINY
        out[number] = unit * abs(float(np.squeeze(condition.residual))) / size
    return out


def _moment_at_steps(solution: Equilibrium, size: float) -> float:
    """Jumps of b ω₂ at steps of the stiffness, where it is continuous, against the largest braid moment."""
    rod = solution.problem.rod
    steps = rod.breaks[1:-1]
    if not steps.size:
        return 0.0
    moments = []
    for places, b in zip((np.nextafter(steps, 0.0), steps), rod.stiffness_sides, strict=True):
        _, y1, y2 = shape(solution.meshes.fine, solution.point.fine, places, 3)
        moments.append(b * y2 / np.sqrt(1.0 - y1**2))
    return float(np.max(np.abs(moments[1] - moments[0]))) / (size + _TINY)


def _scaled(terms: tuple[Any, ...], sizes: tuple[FloatArray, ...] = ()) -> float:
    """Largest size of the sum of the terms, divided by the largest of the terms and of further ``sizes``."""
    stacked = np.empty((len(terms) + len(sizes), max(getattr(term, "size", 1) for term in terms)))
    for row, term in zip(stacked, (*terms, *sizes), strict=True):
        row[:] = term  # some are constants
    left = np.abs(stacked[: len(terms)].sum(axis=0)).max()
    return float(left / (np.abs(stacked, out=stacked).max() + _TINY))


def _strands(x: Fifteen, load: Load, b: float | FloatArray, inside: Any) -> dict[str, float]:
    """(52)–(58): forces of rod and cylinder by force and moment balance, against the paper's expressions."""
    names = {"(52)": "rod_F1", "(53)": "rod_F2", "(54)": "rod_F3", "(56)": "cylinder_F1", "(57)": "cylinder_F2"}
    names |= {"(58)": "cylinder_F3", "(55)": "contact_pressure"}
    s = equations.strands(x, load)
    sums = {"(52)": s.F11, "(53)": s.F12, "(54)": s.F13, "(56)": s.F21, "(57)": s.F22, "(58)": s.F23, "(55)": s.p}
    rod = (inside("rod_F3"),)  # the cylinder's forces are differences F − F⁽¹⁾, (45), and known no better than these
    sizes = {"(56)": rod, "(57)": rod, "(58)": rod}
    return {
        number: _scaled((-inside(name), *(b * term for term in sums[number])), sizes.get(number, ()))
        for number, name in names.items()
    }


def _torque(fields: dict[str, FloatArray], problem: Problem) -> float:
    """Difference of the two routes to T₂, relative to its largest value.

    The second route subtracts moments of the size Δ F₃⁽¹⁾: where T₂ is far smaller, or zero, these set the scale.
    """
    parts = problem.clearance * float(np.max(np.abs(fields["rod_F3"])))
    scale = max(float(np.max(np.abs(fields["T2"]))), parts if problem.lateral_weight == 0.0 else SMALL * parts)
    return float(np.max(np.abs(fields["T2"] - fields["T2_by_moments"]))) / (scale + _TINY)


def _work_and_energy(solution: Equilibrium, load: Load) -> float:
    """Rate of the stored energy (strain and height) along the branch, against the power of the end loads.

    Along a branch the rod moves by u = dy/dλ. The bending moments ω₂, ω₃ work on the curvatures, the weight on the
    height, F on z(1) and T₁ on the turn ξ₁ + ξ₂ of the end; the torsion T₁/C of the rod does not change.
    """
    state = solution.point.fine
    space, rod = state.space, solution.problem.rod
    s = space.points
    b, q, lever = (rod.stiffness(s), rod.weight(s), rod.lever(s)) if solution.problem.sections else (1.0, 1.0, s - 1.0)
    y, y1, y2 = shape(solution.meshes.fine, state, space.points, 3)
    u, u1, u2 = space.at_points(state.tangent)
    cos, D, angle = np.sqrt(1.0 - y1**2), load.clearance, y / load.clearance
    turn = u1 / cos  # δη
    bend = -(u2 + y1 * y2 * u1 / cos**2) / cos  # δω₂ = −(δη)′
    twist = cos - 1.0 + 2.0 * y1**2  # ξ₁′ + ξ₂′ = T₁/C + sin η (1 − cos η)/Δ, derivative by η: cos η − cos 2η
    powers = (
        -b * y2 / cos * bend,  # b ω₂ δω₂
        b * y1**2 / D * 2.0 * y1 * u1 / D,  # b ω₃ δω₃
        q * load.lateral_weight * np.sin(angle) * u,
        -(load.force + load.axial_weight * lever) * (-y1 * turn),  # −F δz(1) + wₐ ∫δz ds
        -load.twist * twist * turn / D,
    )
    totals = [space.weights @ power for power in powers]
    return float(abs(sum(totals))) / (max(float(space.weights @ np.abs(power)) for power in powers) + _TINY)

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

from rodwell.analysis.discrete.measures import shape
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.analysis.state.fields import element_fields, gauss_calculus
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


@dataclass(frozen=True)
class Certificate:
    """What is left of each equation when the solution is put into it, divided by the equation's largest term.

    Attributes
    ----------
    residuals
        By number in the paper, or by name: the equations (22)–(27), (32)–(36), (41)–(44), the relations (37)–(39) and
        (52)–(58), the end conditions (B1)–(B15), "T₂ by two routes" (distributed torque (33), and moment balance
        of the whole, relative to the largest T₂), "h by two routes" ((56), and force balance along the rod)
        and "work and energy" (change of stored energy against work of the end loads along the branch).
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


def certificate_of(solution: Equilibrium) -> Certificate:
    """Put a solution into the paper's equations; see :class:`Certificate`."""
    half, fields = element_fields(solution.problem, solution.meshes.fine, solution.point.fine)
    derivative = gauss_calculus()[3]
    load = load_of(solution.problem, solution.force)
    fields["xi2"] = fields["y"] / load.clearance

    def inside(name: str) -> FloatArray:
        return fields[name][1:-1]

    def rate(name: str) -> FloatArray:
        return np.asarray(inside(name).reshape(half.size, -1) @ derivative.T / half).ravel()

    x = Fifteen(*(inside(name) for name in NAMES))
    ends: Any = fields  # Fifteen of numbers
    first, last = (Fifteen(*(ends[name][i] for name in NAMES)) for i in (0, -1))
    out: dict[str, float] = {}
    bending_rate = rate("omega2")
    for number, name, terms in zip(NUMBERS, NAMES, equations.right_hand_sides(x, load), strict=True):
        # the variable itself counts as a term: where it is constant, its derivative is round-off and has no size
        sizes = (inside(name), bending_rate) if name == "mu" else (inside(name),)
        out[number] = _scaled((rate(name), *(-term for term in terms)), sizes)
    for number, terms in equations.moments(x, rate("mu"), load).items():
        out[number] = _scaled(terms, (load.clearance * bending_rate,))
    out |= _strands(x, load, inside)
    extent = {k: float(np.max(np.abs(fields[name]))) for k, name in zip(Fifteen._fields, NAMES, strict=True)}
    for number, condition in equations.end_conditions(first, last, load).items():
        out[number] = abs(float(condition.residual)) / (max(extent[k] for k in condition.against) + _TINY)
    out["T₂ by two routes"] = _torque(fields, solution.problem)
    out["h by two routes"] = _scaled((fields["tangential_balance"],), (fields["rod_F1"],))
    out["work and energy"] = _work_and_energy(solution, load)
    return Certificate(out, max(LIMIT, SLACK * solution.meshes.rtol))


def _scaled(terms: tuple[Any, ...], sizes: tuple[FloatArray, ...] = ()) -> float:
    """Largest size of the sum of the terms, divided by the largest of the terms and of further ``sizes``."""
    stacked = np.empty((len(terms) + len(sizes), max(np.size(term) for term in terms)))
    for row, term in zip(stacked, (*terms, *sizes), strict=True):
        row[:] = term  # some are constants
    left = np.abs(stacked[: len(terms)].sum(axis=0)).max()
    return float(left / (np.abs(stacked, out=stacked).max() + _TINY))


def _strands(x: Fifteen, load: Load, inside: Any) -> dict[str, float]:
    """(52)–(58): forces of rod and cylinder by force and moment balance, against the paper's expressions."""
    names = {"(52)": "rod_F1", "(53)": "rod_F2", "(54)": "rod_F3", "(56)": "cylinder_F1", "(57)": "cylinder_F2"}
    names |= {"(58)": "cylinder_F3", "(55)": "contact_pressure"}
    s = equations.strands(x, load)
    sums = {"(52)": s.F11, "(53)": s.F12, "(54)": s.F13, "(56)": s.F21, "(57)": s.F22, "(58)": s.F23, "(55)": s.p}
    rod = (inside("rod_F3"),)  # the cylinder's forces are differences F − F⁽¹⁾, (45), and known no better than these
    sizes = {"(56)": rod, "(57)": rod, "(58)": rod}
    return {number: _scaled((-inside(name), *sums[number]), sizes.get(number, ())) for number, name in names.items()}


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
    space = state.space
    y, y1, y2 = shape(solution.meshes.fine, state, space.points, 3)
    u, u1, u2 = space.evaluate(state.tangent, space.points, 3)
    cos, D, angle = np.sqrt(1.0 - y1**2), load.clearance, y / load.clearance
    turn = u1 / cos  # δη
    bend = -(u2 + y1 * y2 * u1 / cos**2) / cos  # δω₂ = −(δη)′
    twist = cos - 1.0 + 2.0 * y1**2  # ξ₁′ + ξ₂′ = T₁/C + sin η (1 − cos η)/Δ, derivative by η: cos η − cos 2η
    powers = (
        -y2 / cos * bend,  # ω₂ δω₂
        y1**2 / D * 2.0 * y1 * u1 / D,  # ω₃ δω₃
        load.lateral_weight * np.sin(angle) * u,
        -(load.force + load.axial_weight * (space.points - 1.0)) * (-y1 * turn),  # −F δz(1) + wₐ ∫δz ds
        -load.twist * twist * turn / D,
    )
    totals = [space.weights @ power for power in powers]
    return float(abs(sum(totals))) / (max(float(space.weights @ np.abs(power)) for power in powers) + _TINY)

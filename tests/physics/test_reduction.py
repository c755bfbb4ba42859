"""From the paper's fifteen equations to one scalar function y(s), and back, exactly.

Units B = 1. The energy density e is that of the theory page; it comes from (30) by eliminating the constraints and
the Routhian of ξ₁. Everything is written in the angle η with sin η = y′, in which the Euler–Lagrange equation is
rational. Zero tests are exact (see ``symbolic``).
"""

from __future__ import annotations

from functools import cache

import sympy as sp
from symbolic import all_vanish, cross, euler, s, vanishes

from rodwell.physics.on_wall import energy

C, D, F, T1, G = sp.symbols("C Delta F T1 G", real=True)  # G: the shear force F₃(1), a constant
wa, wl = sp.symbols("w_a w_l", real=True)  # mg cos α, mg sin α
eta, xi2, z = (sp.Function(n)(s) for n in ("eta", "xi2", "z"))
sin, cos, tan = sp.sin(eta), sp.cos(eta), sp.tan(eta)
N = F + wa * (s - 1)
w1, w2, w3 = -sin * cos / D, -eta.diff(s), sin**2 / D  # (20)
SURFACE = {xi2.diff(s): sin / D, z.diff(s): cos}  # (36), (44)

y, y1, y2 = energy.FIELDS
ROOT = sp.sqrt(1 - y1**2)
AXIAL = energy.force + energy.axial_weight * (energy.s - 1)
DENSITY = (  # the theory's e(s, y, y′, y″)
    y2**2 / (1 - y1**2) / 2
    + y1**4 / energy.clearance**2 / 2
    - energy.clearance * energy.lateral_weight * sp.cos(y / energy.clearance)
    - AXIAL * ROOT
    + energy.twist / energy.clearance * y1 * ROOT
)


def written_out(expression: sp.Expr) -> sp.Expr:
    """Replace the functions that ``energy`` keeps whole by what they stand for."""
    for kept, meaning in (
        (energy.OneMinusCos, lambda x: 1 - sp.cos(x)),
        (energy.CosEta, lambda x: sp.sqrt(1 - x**2)),
        (energy.OneMinusCosEta, lambda x: 1 - sp.sqrt(1 - x**2)),
    ):
        expression = expression.replace(kept, meaning)
    return expression


def in_angles(expression: sp.Expr) -> sp.Expr:
    """Write y, y′, y″ as Δξ₂, sin η, η′ cos η, and the symbols of ``energy`` as those used here."""
    symbols = dict(zip(energy.SYMBOLS, (F, wa, wl, D, T1), strict=False)) | {energy.s: s}
    expression = expression.subs(ROOT, cos).subs({y2: eta.diff(s) * cos, y: D * xi2, y1: sin}, simultaneous=True)
    return expression.subs(1 - sin**2, cos**2).subs(symbols, simultaneous=True)


@cache
def scalar_equation(density: sp.Expr) -> sp.Expr:
    """∂e/∂y − (∂e/∂y′)′ + (∂e/∂y″)″, the fourth-order equation, in the angles."""
    terms = [in_angles(written_out(density).diff(u)) for u in (y, y1, y2)]
    second = terms[2].diff(s).subs(SURFACE).diff(s).subs(SURFACE)
    return terms[0] - terms[1].diff(s).subs(SURFACE) + second


def test_lagrangian_30_with_constraints_eliminated_is_the_energy_density() -> None:
    """Routhian of ξ₁ included; −F·t₁ of a dead axial force is −N z′, which is (90)'s weight term and the end's work."""
    xi1_rate, T2, lam, mu = sp.symbols("xi1_rate T2 lambda mu")
    elastic = (w2**2 + w3**2) / 2 + C * ((w3 - 1 / D) * tan - xi1_rate) ** 2 / 2
    constraints = lam * (w3 - sin**2 / D) + mu * (w2 + eta.diff(s)) + T2 * (xi2.diff(s) - sin / D)
    lagrangian = elastic - N * cos + constraints - D * wl * sp.cos(xi2)  # h multiplies σ' − σ' here, (10)
    torque = lagrangian.diff(xi1_rate)
    solved = T1 / C + w1  # (32)
    assert vanishes(torque.subs(xi1_rate, solved) - T1)  # (31)
    routhian = (lagrangian - T1 * xi1_rate).subs(xi1_rate, solved).subs(SURFACE)
    assert vanishes(routhian - in_angles(DENSITY) + T1**2 / (2 * C))  # a constant
    assert vanishes(-N * cos - (wa * z - (N * z).diff(s)).subs(SURFACE))


def test_the_projects_energy_differs_by_a_null_lagrangian() -> None:
    """−T₁ y′(1 − cos η)/Δ in place of (T₁/Δ) y′ cos η: T₁ works on ξ₁ + ξ₂. The rest is the straight rod's energy."""
    clearance, lateral, twist = energy.clearance, energy.lateral_weight, energy.twist
    difference = written_out(energy.energy_density()) - DENSITY
    assert sp.simplify(difference - (clearance * lateral + AXIAL - twist * y1 / clearance)) == 0
    curve = sp.Function("y")(s)
    null = (clearance * lateral + AXIAL - twist * y1 / clearance).subs({energy.s: s, y1: curve.diff(s)})
    assert euler(null, curve) == 0
    assert vanishes(scalar_equation(energy.energy_density()) - scalar_equation(DENSITY))
    other_sign = DENSITY - 2 * twist / clearance * y1 * ROOT
    assert not vanishes(scalar_equation(energy.energy_density()) - scalar_equation(other_sign))


def test_linearised_scalar_equation_is_64() -> None:
    small, v = sp.Symbol("epsilon"), sp.Function("v")(s)
    equation = scalar_equation(DENSITY).subs({xi2: small * v / D, eta: sp.asin(small * v.diff(s))}).doit()
    linear = equation.diff(small).subs(small, 0).doit()
    printed = v.diff(s, 4) - F * v.diff(s, 2) + wl / D * v - wa * (v.diff(s) + (s - 1) * v.diff(s, 2))
    assert vanishes(linear - printed)
    assert not vanishes(linear - printed - 2 * wa * v.diff(s))


# Reconstruction, theory section 2: vectors along i, j, k; the braid moment is any solution of M' = −t₁ × F.
I, J, K = sp.eye(3).col(0), sp.eye(3).col(1), sp.eye(3).col(2)
d1 = sp.cos(xi2) * I - sp.sin(xi2) * J
u2 = sp.sin(xi2) * I + sp.cos(xi2) * J
t1, u1 = cos * K + sin * u2, cos * u2 - sin * K
FORCE = N * K + G * J
MOMENT = sp.Matrix([sp.Function(f"M_{i}")(s) for i in "xyz"])
SHEAR = w2.diff(s) - w3 * T1 - w1 * w3  # F₃⁽¹⁾
TENSION = (N + SHEAR * sin) / cos  # F₁⁽¹⁾: the axial resultant of the rod is N, that is h = 0
ROD = TENSION * t1 - w2 * (3 * w1 + T1) * d1 + SHEAR * u1
OTHER = FORCE - ROD  # (45)
OTHER_MOMENT = MOMENT - (w2 * d1 + w3 * u1 - T1 * t1) - D * cross(d1, OTHER)
F1, F2, F3 = FORCE.dot(t1), FORCE.dot(d1), FORCE.dot(u1)
M1, M2, M3 = MOMENT.dot(t1), MOMENT.dot(d1), MOMENT.dot(u1)
T2, MU, LAM = OTHER_MOMENT.dot(K), OTHER_MOMENT.dot(d1), OTHER_MOMENT.dot(u2) / cos
RATES = SURFACE | dict(zip(MOMENT.diff(s), -cross(t1, FORCE), strict=True))


def along(expression: sp.Expr) -> sp.Expr:
    """Derivative in s with ξ₂′, z′ and M′ put in; η′, η″, … stay free."""
    return expression.diff(s).subs(RATES)


def fifteen() -> dict[str, sp.Expr]:
    """Residuals of the fifteen equations; (32), (34), (36) and (44) define ξ₁, ω₂, ξ₂ and z."""
    return {
        "(22)": along(F1) + w2 * F3 - w3 * F2 - wa * cos,
        "(23)": along(F2) + w3 * F1 - w1 * F3,
        "(24)": along(F3) + w1 * F2 - w2 * F1 + wa * sin,
        "(25)": along(M1) + w2 * M3 - w3 * M2,
        "(26)": along(M2) + w3 * M1 - w1 * M3 - F3,
        "(27)": along(M3) + w1 * M2 - w2 * M1 + F2,
        "(33)": along(T2) - D * wl * sp.sin(xi2),
        "(35)": along(w3) - 2 * w1 * w2,
        "(41)": along(LAM) + F2 + w2 * (T1 + 3 * w1) + tan * (LAM * w2 - MU / D),
        "(42)": along(MU) - cos / D * ((M1 + T1) * cos - (M3 - w3 + LAM) * sin - T2),
        "(43)": w2.diff(s) - F3 + (M1 + T1 * cos**2) / D - w1 * (w3 - LAM) - T2 * cos / D,
    }


def fourth_derivative() -> dict[sp.Expr, sp.Expr]:
    """Return η‴ from the fourth-order equation, which is linear in it."""
    equation = scalar_equation(DENSITY)
    third = eta.diff(s, 3)
    slope = equation.diff(third)
    return {third: -equation.subs(third, 0) / slope}


def test_scalar_equation_is_equivalent_to_the_fifteen() -> None:
    """All but one hold whatever y is; (33) is −Δ times the fourth-order equation, whether it holds or not."""
    residuals = fifteen()
    torque = residuals.pop("(33)")
    equation = scalar_equation(DENSITY)
    assert vanishes(torque + D * equation)
    for name, residual in residuals.items():
        assert vanishes(residual), name
    assert vanishes(torque.subs(fourth_derivative()))
    assert not vanishes(torque)
    halved = DENSITY - y1**4 / energy.clearance**2 / 4  # half of the energy of ω₃
    assert not vanishes(torque + D * scalar_equation(halved))


def test_algebraic_relations_and_strand_forces_hold_in_the_reconstruction() -> None:
    """(37)–(40) with h = 0, (52)–(54), (56)–(59)."""
    mu_rate = along(MU)
    relations = [
        M1 - (-T1 + 2 * LAM * sin * cos + D * mu_rate + T2 * cos),
        M2 - (w2 + MU),
        M3 - (w3 + LAM - 2 * LAM * sin**2 - D * mu_rate * tan - T2 * sin),
        (w3 - M3) * cos - (M1 + T1) * sin + LAM * cos,
        ROD.dot(t1) - (F1 + (M3 - w3) / D + LAM * (w3 - 1 / D) + T2 * sin / D),
        ROD.dot(d1) + w2 * (3 * w1 + T1),
        ROD.dot(u1) - (F3 - (M1 + T1) / D - LAM * w1 + T2 * cos / D),
        OTHER.dot(K),
        OTHER.dot(d1) - F2 - w2 * (T1 + 3 * w1),
        OTHER.dot(u2) - ((M1 + T1) * cos - (M3 - w3) * sin - T2) / D,
    ]
    assert all_vanish(relations)


def test_contact_pressure_55_and_the_first_integral_of_the_tension() -> None:
    """(48) along d₁ is (55) and the theory's p, for every y; along t₁ and u₁ the rod is free of load on solutions."""
    weight = wl * I + wa * K
    contact = ROD.diff(s).subs(RATES) - weight
    printed = (
        (T1 + 3 * w1) * ((M1 + T1 * cos**2) / D - F3 - w1 * (w3 - LAM) - T2 * cos / D)
        + T2 * sin / D**2 - 3 * sp.cos(2 * eta) / D * w2**2 + w1 * ((M1 + T1) / D - F3)
        + w3 * (F1 + M3 / D) - w3**2 / D - wl * sp.cos(xi2)
    )  # fmt: skip
    rate = -w2.diff(s) * (3 * w1 + T1) - 3 * (1 - 2 * sin**2) * w2**2 / D
    own = rate + w3 * TENSION - w1 * SHEAR - wl * sp.cos(xi2)
    assert vanishes(contact.dot(d1) - own)
    assert vanishes(printed - own)
    assert not vanishes(contact.dot(u1))
    held = fourth_derivative()
    assert vanishes(contact.dot(t1).subs(held))
    assert vanishes(contact.dot(u1).subs(held))
    integral = TENSION + (w2**2 + w3**2) / 2 + D * wl * sp.cos(xi2) - wa * z
    assert vanishes(along(integral).subs(held))
    assert not vanishes(along(integral - 2 * wa * z).subs(held))

"""The paper's appendix, word for word: from the Lagrangian (90) to the fifteen equations.

Equation numbers are the paper's; B and C are kept. All zero tests are exact (see ``symbolic``). Two printed
formulas that are not right as they stand, and one statement, have a test each that says so.
"""

from __future__ import annotations

import sympy as sp
from symbolic import all_vanish, cross, euler, s, vanishes

B, C, D, mg, alpha, h = sp.symbols("B C Delta mg alpha h", positive=True)  # h is a constant, see (7)
w2, w3, eta, xi1, xi2 = (sp.Function(n)(s) for n in ("omega2", "omega3", "eta", "xi1", "xi2"))
lam, mu, T2, T1 = (sp.Function(n)(s) for n in ("lambda", "mu", "T2", "T1"))
x, y, z = (sp.Function(n)(s) for n in "xyz")
t1, d1, u1 = (sp.Matrix([sp.Function(f"{v}1{i}")(s) for i in "xyz"]) for v in "tdu")
L1, L2, L3 = force = sp.Matrix([sp.Function(f"lambda{i}")(s) for i in (1, 2, 3)])
mus = [sp.Function(f"mu{i}")(s) for i in range(1, 10)]
mu_d, mu_u, mu_t = sp.Matrix(mus[:3]), sp.Matrix(mus[3:6]), sp.Matrix(mus[6:])
sin, cos, tan = sp.sin(eta), sp.cos(eta), sp.tan(eta)
w1 = (w3 - 1 / D) * tan  # (6)₁, what ω₁ is shorthand for in (90)
WEIGHT = -D * mg * sp.sin(alpha) * sp.cos(xi2)

LAGRANGIAN = (  # (90), line by line
    B * (w2**2 + w3**2) / 2 + C * ((w3 - 1 / D) * tan - xi1.diff(s)) ** 2 / 2 + h * (1 - D * w3) / cos
    + lam * (w3 - sin**2 / D) + mu * (w2 + eta.diff(s)) + T2 * (xi2.diff(s) - sin / D)
    + WEIGHT + mg * z * sp.cos(alpha)
    + L1 * (x.diff(s) - t1[0]) + L2 * (y.diff(s) - t1[1]) + L3 * (z.diff(s) - t1[2])
    + sum(m * e for m, e in zip(mu_d, d1.diff(s) - w1 * u1 + w3 * t1, strict=True))
    + sum(m * e for m, e in zip(mu_u, u1.diff(s) + w1 * d1 - w2 * t1, strict=True))
    + sum(m * e for m, e in zip(mu_t, t1.diff(s) - w3 * d1 + w2 * u1, strict=True))
)  # fmt: skip

F1, F2, F3 = t1.dot(force), d1.dot(force), u1.dot(force)  # (94)
M1 = u1.dot(mu_d) - d1.dot(mu_u)  # (95)
M2 = t1.dot(mu_u) - u1.dot(mu_t)
M3 = -t1.dot(mu_d) + d1.dot(mu_t)

ON_CYLINDER = {w3: sin**2 / D}  # (20)₃
# (92), (93) and (91), solved for the derivatives, as printed
DERIVATIVES = dict(
    zip(
        [*force.diff(s), *mu_d.diff(s), *mu_u.diff(s), *mu_t.diff(s), *t1.diff(s), *d1.diff(s), *u1.diff(s)],
        [0, 0, mg * sp.cos(alpha), *(w1 * mu_u - w3 * mu_t), *(w2 * mu_t - w1 * mu_d),
         *(w3 * mu_d - w2 * mu_u - force), *(w3 * d1 - w2 * u1), *(-w3 * t1 + w1 * u1), *(w2 * t1 - w1 * d1)],
        strict=True,
    )
)  # fmt: skip


def test_frame_equations_91_are_those_of_the_multipliers() -> None:
    """∂L/∂μᵢ = 0 gives (91), ∂L/∂λᵢ = 0 the tangent."""
    printed = [*(-w3 * t1 + w1 * u1), *(w2 * t1 - w1 * d1), *(w3 * d1 - w2 * u1)]
    for multiplier, vector, rate in zip(mus, [*d1, *u1, *t1], printed, strict=True):
        assert vanishes(euler(LAGRANGIAN, multiplier) - (vector.diff(s) - rate))
        assert not vanishes(euler(LAGRANGIAN, multiplier) - (vector.diff(s) + rate))
    for multiplier, place, tangent in zip(force, (x, y, z), t1, strict=True):
        assert vanishes(euler(LAGRANGIAN, multiplier) - (place.diff(s) - tangent))


def test_multiplier_equations_92_and_93() -> None:
    kinematic = [x, y, z, *d1, *u1, *t1]
    for variable, (rate, printed) in zip(kinematic, list(DERIVATIVES.items())[:12], strict=True):
        assert vanishes(euler(LAGRANGIAN, variable) - (printed - rate))
    flipped = LAGRANGIAN - 2 * mus[3] * (w1 * d1[0])  # the sign of one term with μ₄
    assert not vanishes(euler(flipped, d1[0]) - (w1 * mus[3] - w3 * mus[6] - mus[0].diff(s)))


def test_identifications_94_and_95_give_the_balance_equations() -> None:
    """(22)–(27), by differentiating and (91)–(93) alone, but for cos η and −sin η: the frame's components along k."""
    rate = {v: v.diff(s).subs(DERIVATIVES) for v in (*force, *mus, *t1, *d1, *u1)}

    def derivative(e: sp.Expr) -> sp.Expr:
        return sum(sp.diff(e, v) * r for v, r in rate.items())

    weight = mg * sp.cos(alpha)
    balance = [
        derivative(F1) + w2 * F3 - w3 * F2 - weight * t1[2],  # (22), t₁·k = cos η
        derivative(F2) + w3 * F1 - w1 * F3 - weight * d1[2],  # (23), d₁·k = 0
        derivative(F3) + w1 * F2 - w2 * F1 - weight * u1[2],  # (24), u₁·k = −sin η
        derivative(M1) + w2 * M3 - w3 * M2,  # (25)
        derivative(M2) + w3 * M1 - w1 * M3 - F3,  # (26)
        derivative(M3) + w1 * M2 - w2 * M1 + F2,  # (27)
    ]
    assert all_vanish(balance)
    assert not vanishes(balance[4] + 2 * F3)
    assert not vanishes(balance[5] - 2 * F2)


def test_frame_in_the_angles_obeys_91_and_has_the_components_used_in_22_to_24() -> None:
    """(1) with {t₂, d₂, v₂} = {k, i, j} and (2): curvatures (16)–(20), and t₁ = r₁'."""
    turn = sp.Matrix([[1, 0, 0], [0, sp.cos(xi2), -sp.sin(xi2)], [0, sp.sin(xi2), sp.cos(xi2)]])
    tilt = sp.Matrix([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    fixed = sp.Matrix([[0, 1, 0], [0, 0, 1], [1, 0, 0]])  # columns k, i, j
    frame = fixed * turn.T * tilt.T  # R₁₁ = R₂₂ R₁(ξ₂)ᵀ R₂(η)ᵀ
    assert all_vanish(frame[2, :] - sp.Matrix([[cos, 0, -sin]]))
    skew = frame.T * frame.diff(s)
    found = [skew[2, 1], skew[0, 2], skew[1, 0]]
    assert all_vanish(a - b for a, b in zip(
        found, [-xi2.diff(s) * cos, -eta.diff(s), xi2.diff(s) * sin], strict=True))  # fmt: skip
    on_surface = {xi2.diff(s): sin / D}
    assert all_vanish(a.subs(on_surface) - b for a, b in zip(
        found, [-sin * cos / D, -eta.diff(s), sin**2 / D], strict=True))  # fmt: skip
    place = sp.Matrix([-D * sp.cos(xi2), D * sp.sin(xi2), z])
    assert all_vanish(place.diff(s).subs({**on_surface, z.diff(s): cos}) - frame[:, 0])  # and z' = cos η, (44)


def test_equations_31_to_36() -> None:
    assert vanishes(LAGRANGIAN.diff(xi1))  # (31)₁
    torque = LAGRANGIAN.diff(xi1.diff(s))
    assert vanishes(torque + C * ((w3 - 1 / D) * tan - xi1.diff(s)))  # (31)₂
    assert vanishes(torque.subs(xi1.diff(s), T1 / C + w1) - T1)  # (32)
    assert vanishes(euler(LAGRANGIAN, xi2) - (D * mg * sp.sin(alpha) * sp.sin(xi2) - T2.diff(s)))  # (33)
    assert vanishes(euler(LAGRANGIAN, mu) - (eta.diff(s) + w2))  # (34)
    assert vanishes(euler(LAGRANGIAN, lam) - (w3 - sin**2 / D))  # (35)₂
    rate = (sin**2 / D).diff(s).subs(eta.diff(s), -w2)
    assert vanishes(rate - 2 * w1.subs(ON_CYLINDER) * w2)  # (35)₃
    assert vanishes(euler(LAGRANGIAN, T2) - (xi2.diff(s) - sin / D))  # (36)


def constitutive() -> list[sp.Expr]:
    """Return right-hand sides of (37)–(39)."""
    return [
        -T1 - D * h * sin + 2 * lam * sin * cos + D * mu.diff(s) + T2 * cos,
        B * w2 + mu,
        B * w3 - D * h * cos + lam - 2 * lam * sin**2 - D * mu.diff(s) * tan - T2 * sin,
    ]


def test_equations_of_the_curvatures_and_the_angle_give_37_to_39() -> None:
    """The rearrangement: ε_η = 0 is (37) − M₁ over Δ, ε_ω₃ = 0 is (39) − M₃ plus tan η times that of (37)."""
    surface = {xi1.diff(s): T1 / C + w1}

    def residual(variable: sp.Expr) -> sp.Expr:
        return euler(LAGRANGIAN, variable).subs(surface).subs(ON_CYLINDER)

    m1, m2, m3 = (a - b for a, b in zip(constitutive(), (M1, M2, M3), strict=True))
    assert vanishes(residual(w2) - m2.subs(ON_CYLINDER))
    assert vanishes(-D * residual(eta) - m1.subs(ON_CYLINDER))
    assert vanishes(residual(w3) - (m3 + tan * m1).subs(ON_CYLINDER))
    assert not vanishes(residual(w3) - m3.subs(ON_CYLINDER))


def test_middle_expression_of_13_has_the_wrong_sign() -> None:
    """(11) and (13): with ∂η/∂ω₃ from (6)₁ at fixed ω₁, M₃ = ∂f/∂ω₃ + (∂η/∂ω₃) ε_η(f); the paper prints a minus.

    The last expression of (13), which is the one used, is right.
    """
    shape = w1 - sp.Symbol("omega1")
    by_w1 = 1 / shape.diff(eta)
    by_w3 = -shape.diff(w3) / shape.diff(eta)
    assert vanishes(by_w1 - D * cos**2 / (D * w3 - 1))
    factor = -D * sin * cos / (D * w3 - 1)  # of ε_η(f) in the last expression
    assert vanishes(by_w3 - factor)
    assert not vanishes(-by_w3 - factor)
    m1, _, m3 = constitutive()  # f of (30), with ω₃ and ξ₁' as they are on solutions
    f = LAGRANGIAN.subs(dict.fromkeys([*mus, *force], 0)) - mg * z * sp.cos(alpha)
    angle = euler(f, eta).subs(xi1.diff(s), T1 / C + w1)
    plain = f.diff(w3).subs(xi1.diff(s), T1 / C + w1)
    assert vanishes((by_w1 * angle - m1).subs(ON_CYLINDER))
    assert vanishes((plain + factor * angle - m3).subs(ON_CYLINDER))
    assert not vanishes((plain - factor * angle - m3).subs(ON_CYLINDER))


MOMENTS = sp.Matrix([sp.Function(f"M{i}")(s) for i in (1, 2, 3)])
FORCES = sp.Matrix([sp.Function(f"F{i}")(s) for i in (1, 2, 3)])
LAMBDA_RATE = -FORCES[1] - w2 * (T1 + 3 * B * w1) - tan * (lam * w2 - mu / D)  # (41)
MU_RATE = cos / D * ((MOMENTS[0] + T1) * cos - (MOMENTS[2] - B * w3 + lam) * sin - T2)  # (42)
OMEGA2_RATE = (  # (43)
    FORCES[2] - (MOMENTS[0] + T1 * cos**2) / D + w1 * (B * w3 - lam) + T2 * cos / D
) / B
HEAD = ((B * w3 - MOMENTS[2]) * cos - (MOMENTS[0] + T1) * sin + lam * cos) / D  # (40)


def test_constitutive_relations_give_40_to_43() -> None:
    m1, m2, m3 = constitutive()
    assert vanishes(HEAD.subs({MOMENTS[0]: m1, MOMENTS[2]: m3}) - h)  # (40)
    assert vanishes((m1.subs(h, HEAD) - MOMENTS[0] - D * (mu.diff(s) - MU_RATE)).subs(ON_CYLINDER))  # (42), out of (37)
    w = sp.Matrix([w1, w2, w3])
    moment_rates = dict(zip(MOMENTS.diff(s), -cross(w, MOMENTS) - cross(sp.Matrix([1, 0, 0]), FORCES), strict=True))
    rates = {**moment_rates, w3.diff(s): 2 * w1 * w2, eta.diff(s): -w2, lam.diff(s): LAMBDA_RATE, T1.diff(s): 0}
    assert vanishes(HEAD.diff(s).subs(rates).subs(MOMENTS[1], m2).subs(ON_CYLINDER))  # (41): h is constant
    wrong = {**rates, lam.diff(s): LAMBDA_RATE + 2 * tan * mu / D}
    assert not vanishes(HEAD.diff(s).subs(wrong).subs(MOMENTS[1], m2).subs(ON_CYLINDER))
    bending = (moment_rates[MOMENTS[1].diff(s)] - MU_RATE) / B  # (38) differentiated, with (26) and (42)
    assert vanishes((bending - OMEGA2_RATE).subs(ON_CYLINDER))  # (43)


def test_weight_as_an_external_force_adds_terms_to_22_to_24_and_none_to_the_torque() -> None:
    """The appendix's last paragraph: mg x sin α in place of −Δ mg sin α cos ξ₂.

    Then λ₁' = mg sin α, and (22)–(24) get mg sin α times t₁·i, d₁·i and u₁·i on the right. T₂ loses its source:
    ε_ξ₂ = 0 reads T₂' = 0, so the multiplier is zero under (B9) and can be left out.
    """
    lagrangian = LAGRANGIAN - WEIGHT + mg * x * sp.sin(alpha)
    assert vanishes(euler(lagrangian, x) - (mg * sp.sin(alpha) - L1.diff(s)))
    assert vanishes(euler(lagrangian, xi2) + T2.diff(s))
    rate = {**DERIVATIVES, L1.diff(s): mg * sp.sin(alpha)}
    for left, right, axis in ((F1, w3 * F2 - w2 * F3, t1), (F2, w1 * F3 - w3 * F1, d1), (F3, w2 * F1 - w1 * F2, u1)):
        added = left.diff(s).subs(rate) - right - mg * sp.cos(alpha) * axis[2]
        assert vanishes(added - mg * sp.sin(alpha) * axis[0])


def test_twisting_moment_of_the_cylinder_depends_on_where_the_weight_is_put() -> None:
    """(45)–(51) without friction: M₁⁽²⁾' = Δ mg sin α sin ξ₂ with the weight inside the braid, and 0 with it outside.

    So "the twisting moment in the cylinder would have been computed as M₁⁽²⁾" does not give T₂: a normal pressure
    passes through the axis and cannot twist the cylinder. T₂ is the moment in a cylinder that also bears the
    counter-force of the rod's weight, (50). The equations of the rod itself (48) are the same either way.
    """
    i, j, k = sp.eye(3).col(0), sp.eye(3).col(1), sp.eye(3).col(2)
    chord = sp.cos(xi2) * i - sp.sin(xi2) * j
    tangent = cos * k + sin * (sp.sin(xi2) * i + sp.cos(xi2) * j)
    whole, rod = (sp.Matrix([sp.Function(f"{n}{a}")(s) for a in "xyz"]) for n in ("F", "R"))  # braid, first strand
    pressure, lateral = sp.Function("p")(s), mg * sp.sin(alpha)
    rod_rate = pressure * chord + lateral * i + mg * sp.cos(alpha) * k  # (48)₁
    for outside, expected in ((0, D * lateral * sp.sin(xi2)), (lateral, 0)):
        whole_rate = outside * i + mg * sp.cos(alpha) * k
        other, other_rate = whole - rod, whole_rate - rod_rate
        # (45)₂ differentiated, M' = −t₁ × F, and (49)₁ with m⁽¹⁾ = 0
        moment_rate = (
            -cross(tangent, whole)
            + cross(tangent, rod)
            - D * cross(chord.diff(s), other)
            - D * cross(chord, other_rate)
        ).subs(xi2.diff(s), sin / D)
        assert vanishes(moment_rate.dot(k) - expected)
        assert vanishes(moment_rate.dot(k)) == (outside != 0)


def test_h_is_a_constant_and_not_one_of_the_varied_multipliers() -> None:
    """∂L/∂h = σ', which cannot vanish: "for all variables" leaves h out, as (7) does; it is constant by (41)."""
    assert vanishes(LAGRANGIAN.diff(h).subs(ON_CYLINDER) - cos)

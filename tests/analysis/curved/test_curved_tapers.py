"""Strings that taper in curved holes, against collocation of their equation, stairs, scaling, and balance in space."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.polynomial import chebyshev
from scipy.linalg import eigvals

from rodwell import Problem, critical_loads, follow, lying_rod, sensitivities, tensile_loads
from rodwell.analysis.straight.lying import lying_contact, lying_steps
from rodwell.problem.profile import powers

WHOLE = Problem(15.0, 60.0, clearance=0.02, build=0.3, sections=((1.0, (1.0, 0.6, 0.45), (1.0, 0.7)),))
TIP = Problem(15.0, 60.0, build=0.3, sections=((0.6, 1.0, 1.0), (0.4, (1.0, 0.6, 0.4), (1.0, 0.6))))


def collocated(problem: Problem, points: int = 24) -> np.ndarray:
    """Critical loads, clamped, of (b v″)″ − ((N − 2bκᵣ²) v′)′ + (P/Δ) v = 0 by Chebyshev polynomials.

    P = q w sin α(s) − κᵣ(N − bκᵣ²) + b″κᵣ is the contact of the lying rod, N = F − w ∫ₛ¹ q cos α(s); in an arc κᵣ =
    k₁/(1 + Δk₁) and α(s) = α − κᵣ(s − ½).
    """
    (section,) = problem.sections
    b, q = (np.polynomial.Polynomial(powers(section[k])) for k in (1, 2))  # type: ignore[arg-type]
    bent = problem.build / (1.0 + problem.clearance * problem.build)
    x = np.cos(math.pi * (np.arange(points) + 0.5) / points)
    s = 0.5 * (x + 1.0)
    nodes, weights = np.polynomial.legendre.leggauss(20)

    def climb(at: np.ndarray) -> np.ndarray:
        return np.asarray(np.cos(math.radians(problem.alpha) - bent * (at - 0.5)))

    hung = np.array([0.5 * (1 - y) * weights @ (q(t := y + 0.5 * (1 - y) * (nodes + 1)) * climb(t)) for y in s])
    across = np.sin(math.radians(problem.alpha) - bent * (s - 0.5))
    columns = points + 4
    t = []
    for order in range(5):
        rows = [chebyshev.chebder(np.eye(columns)[k], order) if order else np.eye(columns)[k] for k in range(columns)]
        t.append(2.0**order * np.stack([chebyshev.chebval(x, row) for row in rows], axis=1))
    bending = b(s)[:, None] * t[4] + 2.0 * b.deriv()(s)[:, None] * t[3] + b.deriv(2)(s)[:, None] * t[2]
    axial, axial_rate = -problem.weight * hung - 2.0 * b(s) * bent**2, problem.weight * q(s) * climb(s)
    axial_rate = axial_rate - 2.0 * b.deriv()(s) * bent**2
    pressed = q(s) * problem.weight * across - bent * (-problem.weight * hung - b(s) * bent**2)
    pressed = pressed + b.deriv(2)(s) * bent
    stiff = bending - axial[:, None] * t[2] - axial_rate[:, None] * t[1] + pressed[:, None] / problem.clearance * t[0]
    by_force = -t[2] - bent / problem.clearance * t[0]
    ends = []
    for end in (-1.0, 1.0):
        ends.append([chebyshev.chebval(end, np.eye(columns)[k]) for k in range(columns)])
        ends.append([chebyshev.chebval(end, chebyshev.chebder(np.eye(columns)[k])) for k in range(columns)])
    left, right = np.vstack([stiff, ends]), np.vstack([by_force, np.zeros((4, columns))])
    found = eigvals(left, -right)
    real = found[np.isfinite(found) & (np.abs(found.imag) < 1e-6 * np.abs(found))].real
    return np.sort(real)


def test_critical_loads_of_both_signs_are_those_of_the_equation() -> None:
    found = collocated(WHOLE)
    assert critical_loads(WHOLE, 2).forces == pytest.approx(found[found < 0.0][:-3:-1], rel=1e-8)
    assert tensile_loads(WHOLE, 1).forces == pytest.approx(found[found > 0.0][:1], rel=1e-8)


def test_a_hole_that_is_nearly_straight_has_the_loads_of_a_straight_one() -> None:
    straight = critical_loads(TIP.but(build=0.0), 2).forces
    near = [critical_loads(TIP.but(build=k), 2).forces for k in (1e-6, -1e-6)]
    assert 0.5 * (near[0] + near[1]) == pytest.approx(straight, rel=1e-9)


def test_stairs_come_to_the_taper() -> None:
    """A taper cut into n steps of its mean is off by n⁻²; extrapolated from 8 and 16."""

    def stairs(n: int) -> float:
        b, q = (np.polynomial.Polynomial(powers(TIP.sections[1][k])) for k in (1, 2))  # type: ignore[arg-type]
        means = [[float(n * (f.integ()((i + 1) / n) - f.integ()(i / n))) for f in (b, q)] for i in range(n)]
        return critical_loads(TIP.but(sections=((0.6, 1.0, 1.0), *((0.4 / n, *one) for one in means))), 1)[0].force

    few, more, most = (stairs(n) for n in (8, 16, 32))
    expected = most + (most - more) / 3.0
    assert abs(most - more) < 0.3 * abs(more - few)
    assert critical_loads(TIP, 1)[0].force == pytest.approx(expected, rel=2e-6)


def test_a_string_seen_from_its_other_end_is_the_same() -> None:
    turned = TIP.turned_round
    assert critical_loads(turned, 2).forces == pytest.approx(critical_loads(TIP, 2).forces - TIP.hung_weight, rel=1e-9)


def test_weight_hangs_as_high_as_it_rises() -> None:
    """w ∫ q dz over the arc, κᵣ and α(s) in closed form."""
    bent = 0.3 / (1.0 + 0.01 * 0.3)
    s, weights = np.polynomial.legendre.leggauss(40)
    total = 0.0
    for low, high, q in ((0.0, 0.6, lambda x: 1.0 + 0.0 * x), (0.6, 1.0, lambda x: 1.0 - (x - 0.6))):
        at = low + 0.5 * (high - low) * (s + 1.0)
        total += 0.5 * (high - low) * float(weights @ (q(at) * np.cos(math.radians(60.0) - bent * (at - 0.5))))
    assert TIP.hung_weight == pytest.approx(15.0 * total, rel=1e-12)


def test_contact_of_the_lying_string_and_what_it_needs_at_a_kink() -> None:
    """P = q w sin α − κᵣ(N − bκᵣ²) + b″κᵣ, and the force [b′]κᵣ towards the axis, in an arc."""
    bent = 0.3 / (1.0 + 0.01 * 0.3)
    force, s = -80.0, np.array([0.7, 0.9])
    (b, q) = (np.polynomial.Polynomial(powers(TIP.sections[1][k])) for k in (1, 2))  # type: ignore[arg-type]
    x = (s - 0.6) / 0.4
    angle = math.radians(60.0) - bent * (s - 0.5)
    nodes, weights = np.polynomial.legendre.leggauss(30)
    hung = []
    for place in s:
        at = place + 0.5 * (1.0 - place) * (nodes + 1.0)
        climb = np.cos(math.radians(60.0) - bent * (at - 0.5))
        hung.append(0.5 * (1.0 - place) * float(weights @ (q((at - 0.6) / 0.4) * climb)))
    n = force - 15.0 * np.array(hung)
    expected = q(x) * 15.0 * np.sin(angle) - bent * (n - b(x) * bent**2) + b.deriv(2)(x) / 0.4**2 * bent
    assert lying_contact(TIP, force, s) == pytest.approx(expected, rel=1e-9)
    couple, radial = lying_steps(TIP, force)
    assert couple == pytest.approx([0.0], abs=1e-12)
    assert radial == pytest.approx([b.deriv()(0.0) / 0.4 * bent], rel=1e-9)


def test_buckled_strings_that_taper_balance_in_space() -> None:
    """The certificate; and F₁, from what drives the rod along the hole, with the energy that b′ and w′ leave behind."""
    turning = lying_rod(TIP.but(build=0.1, walk=0.1), rtol=1e-8)
    x = np.linspace(-0.5, 0.5, 41)
    curve = np.stack([x, 0.0 * x, 0.15 * x**2 + 0.08 * x**3], axis=1)
    curve /= float(np.sum(np.linalg.norm(np.diff(curve, axis=0), axis=1)))
    bending = follow(Problem(15.0, axis=curve.tolist(), sections=TIP.sections), rtol=1e-9)
    for state in (follow(TIP, rtol=1e-9, until=-180.0)[-1], turning.last, bending[-1]):
        assert state.certificate.passed, state.certificate
        f = state.own_places.fields(np.linspace(0.01, 0.99, 301))
        size = float(np.max(np.abs(f["rod_F1"])))
        assert np.max(np.abs(f["tangential_balance"])) < 1e-9 * size


def test_derivatives_by_all_that_is_given_add_up() -> None:
    """Loads are homogeneous in stiffness and weight; a taper's are by a factor on all of it."""
    for load in sensitivities(TIP, rtol=1e-9):
        first, tip = load.sections
        whole = first["stiffness"].value + tip["stiffness_factor"].value
        whole += 15.0 * load.derivatives["weight"].value
        known = 1e-10 if "critical" in load.name else 1e-6
        assert whole == pytest.approx(load.force, rel=known)
        by_weight = first["weight"].value + tip["weight_factor"].value
        assert by_weight == pytest.approx(15.0 * load.derivatives["weight"].value, abs=known * abs(load.force))

"""Certified loads: against the engine, closed forms, 40-digit Rayleigh–Ritz, and what the proofs rest on."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
import scipy.linalg
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell import NotConvergedError, Problem, certify, critical_loads
from rodwell.analysis.proof import inertia as counting
from rodwell.analysis.proof.inertia import EnclosedRod, UndecidedError, inertia
from rodwell.analysis.proof.roots import Counter, _enclosed, critical_values
from rodwell.physics import exact
from rodwell.problem.ends import ENDS

CLAMPED = ("clamped", "clamped")

PROBLEMS = [
    Problem(15.0),
    Problem(15.0, on_top=True),
    Problem(60.0, alpha=35.0),
    Problem(140.0, alpha=60.0),
    Problem(40.0, alpha=20.0, on_top=True, ends=("pinned", "clamped")),
    Problem(100.0, alpha=0.0),
    Problem(8.7668),  # a pair of loads 4e-5 apart
    Problem(1e4, clearance=1e-3),
    *(Problem(25.0, alpha=50.0, clearance=0.02, ends=ends) for ends in itertools.product(ENDS, ENDS)),
    *(Problem(0.0, ends=ends) for ends in (CLAMPED, ("clamped", "free"), ("free", "free"), ("guided", "pinned"))),
]


@pytest.mark.parametrize("problem", PROBLEMS, ids=str)
def test_the_engine_lies_inside(problem: Problem) -> None:
    certified, loads = certify(problem, 3, digits=18), critical_loads(problem, 3)
    for proved, mode in zip(certified, loads, strict=True):
        assert proved.number == mode.number
        assert proved.multiplicity == 1
        assert proved.digits >= 18
        assert proved.force.within(mode.force, mode.error)


@settings(max_examples=15)
@given(
    st.just(0.0) | st.floats(1e-3, 300.0), st.sampled_from([0.0, 90.0]) | st.floats(0.1, 89.9),
    st.floats(5e-3, 0.05), st.booleans(), st.sampled_from(ENDS), st.sampled_from(ENDS),
)  # fmt: skip
def test_the_engine_lies_inside_for_any_problem(
    weight: float, alpha: float, clearance: float, top: bool, first: str, last: str
) -> None:
    problem = Problem(weight, alpha=alpha, clearance=clearance, ends=(first, last))
    problem = problem.but(on_top=top and problem.holds_angle)
    for proved, mode in zip(certify(problem, 2, digits=15), critical_loads(problem, 2), strict=True):
        assert proved.multiplicity == 1
        assert proved.force.within(mode.force, mode.error)


def ritz_loads(problem: Problem, size: int, count: int) -> list[mpmath.mpf]:
    """Second method, 60 digits: Rayleigh–Ritz with s²(1−s)²sᵏ, integrals exact; bounds from above for −F."""
    with mpmath.workdps(60):
        angle = mpmath.mpf(repr(problem.alpha)) * mpmath.pi / 180
        weight, gap = mpmath.mpf(repr(problem.weight)), mpmath.mpf(repr(problem.clearance))
        axial, b = weight * mpmath.cos(angle), weight * mpmath.sin(angle) / gap * (-1 if problem.on_top else 1)
        basis = [{k + 2: 1, k + 3: -2, k + 4: 1} for k in range(size)]

        def derivative(p: dict[int, int]) -> dict[int, int]:
            return {e - 1: c * e for e, c in p.items() if e}

        def moment(p: dict[int, int], q: dict[int, int], power: int = 0) -> Fraction:
            return sum((Fraction(a * c, d + e + power + 1) for d, a in p.items() for e, c in q.items()), Fraction(0))

        first = [derivative(p) for p in basis]
        second = [derivative(p) for p in first]
        k, g = mpmath.matrix(size), mpmath.matrix(size)
        for i in range(size):
            for j in range(size):
                bend, slope, down, press = (
                    moment(second[i], second[j]), moment(first[i], first[j]),
                    moment(first[i], first[j], 1), moment(basis[i], basis[j]),
                )  # fmt: skip
                exact_k = [mpmath.mpf(x.numerator) / x.denominator for x in (bend, down - slope, press, slope)]
                k[i, j], g[i, j] = exact_k[0] + axial * exact_k[1] + b * exact_k[2], exact_k[3]
        lower = mpmath.cholesky(g)
        inverse = lower**-1
        values = mpmath.eigsy(inverse * k * inverse.T, eigvals_only=True)
        return [-values[i] for i in range(count)]


@pytest.mark.parametrize(
    "problem", [Problem(60.0, alpha=35.0), Problem(30.0, alpha=70.0, on_top=True), Problem(100.0, alpha=0.0)], ids=str
)
def test_inclined_loads_against_rayleigh_ritz_with_60_digits(problem: Problem) -> None:
    """Ritz loads lie on the far side of the exact ones, by less than 1e-20 with 26 polynomials."""
    for proved, ritz in zip(certify(problem, 2), ritz_loads(problem, 26, 2), strict=True):
        with mpmath.workdps(60):
            high = mpmath.mpf(proved.force.high.numerator) / proved.force.high.denominator
            assert ritz <= high
            assert abs(ritz - high) < mpmath.mpf(10) ** -18
        assert proved.digits >= 30


@pytest.mark.parametrize("on_top", [False, True])
@pytest.mark.parametrize("ends", [CLAMPED, ("clamped", "pinned"), ("guided", "clamped"), ("pinned", "pinned"),
                                  ("pinned", "guided")])  # fmt: skip
@pytest.mark.parametrize("weight", [0.7, 33.0])
def test_closed_forms_lie_inside(weight: float, ends: tuple[str, str], on_top: bool) -> None:
    certified = certify(Problem(weight, clearance=0.02, on_top=on_top, ends=ends), 4, digits=12)
    for proved, load in zip(certified, exact.horizontal_loads(weight / 0.02, 4, ends, on_top=on_top), strict=True):
        assert proved.force.within(load, 1e-13 * (abs(load) + weight / 0.02 / 9.0))
    equation = "on top, section 4.3" if on_top else "(77)"
    equation += "" if ends == CLAMPED else ", twice the length"
    assert {proved.closed_form for proved in certified} == {equation if "clamped" in ends else ""}


@pytest.mark.parametrize("ends", list(itertools.product(ENDS, ENDS)))
def test_weightless_columns(ends: tuple[str, str]) -> None:
    certified = certify(Problem(0.0, ends=ends), 3, digits=12)
    for proved, load in zip(certified, exact.weightless_loads(3, ends), strict=True):
        assert proved.force.within(load, 1e-13 * abs(load) + 1e-13)


@settings(max_examples=40)
@given(
    st.floats(0.0, 400.0), st.floats(0.0, 90.0), st.booleans(), st.sampled_from(ENDS), st.sampled_from(ENDS),
    st.floats(-900.0, 300.0),
)  # fmt: skip
def test_counts_are_those_of_polynomials(
    weight: float, alpha: float, top: bool, first: str, last: str, force: float
) -> None:
    """Number of negative eigenvalues of K + FG on Legendre polynomials that meet the ends' conditions."""
    axial, b = weight * math.cos(math.radians(alpha)), weight * math.sin(math.radians(alpha)) / 0.02
    b = -b if top else b
    low = sum({"clamped": 2, "pinned": 1, "guided": 1, "free": 0}[end] for end in (first, last))
    degree = 44
    nodes, w = np.polynomial.legendre.leggauss(60)
    basis = [np.polynomial.legendre.Legendre.basis(k) for k in range(degree)]
    held = [
        [p.deriv(d)(x) if d else p(x) for p in basis]
        for end, x in ((first, -1.0), (last, 1.0))
        for d in {"clamped": (0, 1), "pinned": (0,), "guided": (1,), "free": ()}[end]
    ]
    space = scipy.linalg.null_space(np.array(held)) if low else np.eye(degree)
    values = [np.array([(p.deriv(d) if d else p)(nodes) for p in basis]) * 2.0**d for d in range(3)]
    s = 0.5 * (nodes + 1.0)
    form = (values[2] * w) @ values[2].T + (values[1] * w * (force + axial * (s - 1.0))) @ values[1].T
    form = space.T @ (form + b * (values[0] * w) @ values[0].T) @ space
    mass = space.T @ ((values[1] * w) @ values[1].T + (values[0] * w) @ values[0].T) @ space
    eigenvalues = scipy.linalg.eigh(form, mass, eigvals_only=True)
    if np.min(np.abs(eigenvalues)) < 1e-6:
        return
    with ctx.workprec(400):
        found = inertia(EnclosedRod(arb(force), arb(axial), arb(b), (first, last))).negative
    assert found == np.sum(eigenvalues < 0.0)


@pytest.mark.parametrize("which", range(4))
def test_bound_of_the_tail_holds_where_the_series_is_cut_early(which: int) -> None:
    """y⁗ = −κ²y'': 1, ξ, (1 − cos κξ)/κ², (κξ − sin κξ)/κ³ at ξ = 1. y⁗ = 9(ξy')': y' = ₀F₁(2/3; ξ³)."""
    kappa = 7.0
    with ctx.workprec(200):
        k = arb(kappa)
        truth = [arb(1), arb(1), (1 - k.cos()) / k**2, (k - k.sin()) / k**3][which]
        right = counting._solution(which, -k * k, arb(0), arb(0), cut=1e-2)[1]
        assert right[0].contains(truth)
        if which > 1:
            assert right[0].rad() > 1e-9
        airy = counting._solution(1, arb(0), arb(9), arb(0), cut=1e-1)[1][1]
        assert airy.contains(arb(1).hypgeom([], [arb(2) / 3]))


def test_element_matrices_are_symmetric_and_beams() -> None:
    """K = Kᵀ with axial weight; without loads 12/h³, 6/h², 4/h, 2/h, as in any text on beam elements."""
    with ctx.workprec(120):
        heavy = counting._element(arb(-30), arb(80), arb(500), 1, 3)
        beam = counting._element(arb(0), arb(0), arb(0), 0, 2)
    for i, j in itertools.combinations(range(4), 2):
        assert heavy[i, j].overlaps(heavy[j, i])
        assert heavy[i, j].rad() < 1e-20
    assert [round(float(beam[0, j]), 9) for j in range(4)] == [96.0, 24.0, -96.0, 24.0]
    assert [round(float(beam[1, j]), 9) for j in range(1, 4)] == [8.0, -24.0, 4.0]


def test_intervals_are_believed_only_after_counts_at_their_ends() -> None:
    counter = Counter(lambda x: EnclosedRod(-x, arb(0), arb(0), CLAMPED))
    with pytest.raises(NotConvergedError, match="lost"):
        _enclosed(counter, 2, Fraction(30), Fraction(50), 10)
    with pytest.raises(NotConvergedError, match="before it"):
        critical_values(counter, Fraction(50), Fraction(10), 1, 10)
    assert _enclosed(counter, 1, Fraction(30), Fraction(50), 10).enclosure.within(4.0 * math.pi**2, 1e-12)


def test_no_count_at_a_critical_load() -> None:
    """Where the answer jumps, none is given: F = 0 of a free rod is exact."""
    with ctx.workprec(200), pytest.raises(UndecidedError):
        inertia(EnclosedRod(arb(0), arb(0), arb(0), ("pinned", "free")))
    load = certify(Problem(0.0, ends=("pinned", "free")), 1)[0].force
    assert 0.0 in load


def test_long_elements_are_refused() -> None:
    """Interiors must be proved positive: one element at −F beyond 4π² is not enough."""
    rod = EnclosedRod(arb(-50), arb(0), arb(0), CLAMPED)
    with pytest.raises(UndecidedError, match="short"):
        counting._check_interiors(rod, 1)
    with pytest.raises(UndecidedError, match="short"):
        counting._check_interiors(EnclosedRod(arb(0), arb(0), arb(-600), CLAMPED), 1)
    counting._check_interiors(rod, 2)


def test_double_loads_are_counted_twice() -> None:
    """At γ_c = 9π⁴Δ, (78): two loads in one enclosure, the first two; −F = 10π²."""
    counter = Counter(lambda x: EnclosedRod(-x, arb(0), 9 * arb.pi() ** 4, CLAMPED))
    double, third = critical_values(counter, Fraction(-2), Fraction(40), 3, 25)
    assert (double.number, double.multiplicity, third.number) == (1, 2, 3)
    assert 10.0 * math.pi**2 == pytest.approx(float(double.enclosure), rel=1e-15)

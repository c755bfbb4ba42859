"""Enclosures of certified loads: their text, decimals, wrong input, values as printed; and pairs of modes."""

from __future__ import annotations

import math
from fractions import Fraction

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell import InputError, NotConvergedError, Problem, certify, paper_values
from rodwell.analysis.proof.certify import ClosedForm, check_sign_change
from rodwell.analysis.proof.enclosures import Enclosure
from rodwell.analysis.proof.paper_values import self_weights
from rodwell.analysis.straight.modes import mode_pairs, switching_table
from rodwell.physics import exact


def test_paper_values_are_as_printed_but_one() -> None:
    """54 values; the second root of (87) is 157.032780…, not 157.032783."""
    values = paper_values()
    assert len(values) == 54
    assert [value.printed for value in values if not value.agrees] == ["157.032783"]
    assert all(value.value.digits >= 30 for value in values)
    assert sum(value.equation.startswith("Table 1") for value in values) == 40
    by_quantity = {value.quantity: value.value for value in values}
    with mpmath.workdps(40):
        for first, root in ((4.7, 5.0056), (7.9, 38.0354), (11.0, 146.1763)):
            x = mpmath.findroot(lambda y: mpmath.cos(y) - mpmath.sech(y), first)
            (found,) = [v.value for v in values if v.printed == str(root)]
            assert abs(mpmath.mpf(found.low.numerator) / found.low.denominator - x**4 / 100) < mpmath.mpf(10) ** -27
        sway = by_quantity["γ at F = 0, free to sway"]
        zero = mpmath.findroot(lambda x: mpmath.besselj(mpmath.mpf(1) / 3, x), 2.9)
        assert abs(mpmath.mpf(sway.low.numerator) / sway.low.denominator - zero**2 * 9 / 4) < mpmath.mpf(10) ** -28


def test_self_weights_to_many_digits() -> None:
    """More digits only add digits."""
    few, many = self_weights(2, 12), self_weights(2, 60)
    for a, b in zip(few, many, strict=True):
        assert a.low <= b.low <= b.high <= a.high
        assert b.digits >= 60


def test_a_wrong_closed_form_is_noticed() -> None:
    place = certify(Problem(15.0), 1, digits=10)[0].force
    with pytest.raises(NotConvergedError, match="wrong"):
        check_sign_change(ClosedForm("wrong", lambda force: force), place, 10)


def test_numbers_are_taken_as_decimals() -> None:
    """(77) with b = 1500 exactly, by mpmath at 40 digits: 0.01 is 1/100."""
    proved = certify(Problem(15.0, clearance=0.01), 1)[0].force
    with mpmath.workdps(40):
        c = mpmath.sqrt(1500)
        q = mpmath.findroot(lambda q: q * mpmath.sin(mpmath.sqrt(q * q + c)) - mpmath.sqrt(q * q + c) * mpmath.sin(q),
                            2.9)  # fmt: skip
        value = -(4 * q * q + 2 * c)
        for bound in (proved.low, proved.high):
            assert abs(mpmath.mpf(bound.numerator) / bound.denominator - value) < mpmath.mpf(10) ** -28


def test_input() -> None:
    for bad in ({"digits": 2}, {"digits": 301}, {"modes": 0}, {"modes": 51}, {"modes": 2.5}):
        with pytest.raises(InputError):
            certify(Problem(15.0), **bad)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="turns"):
        certify(Problem(15.0, turns=1))
    with pytest.raises(NotConvergedError, match="elements"):
        certify(Problem(1e9, alpha=0.0), 1)


def test_enclosures() -> None:
    third = Enclosure(Fraction(1, 3), Fraction(1, 3))
    assert third.text(5) == ("0.33333", "3.4e-06")
    assert Enclosure(Fraction(-3), Fraction(-2)).text(1) == ("-2", "1.0e+00")
    assert Enclosure(Fraction(-2001, 1000), Fraction(-1999, 1000)).digits == 3
    assert Enclosure(Fraction("157.0327801"), Fraction("157.0327802")).rounds_to("157.032780")
    assert not Enclosure(Fraction("157.0327801"), Fraction("157.0327802")).rounds_to("157.032783")
    assert Enclosure(Fraction("-1.25"), Fraction("-1.24")).rounds_to("−1.2")
    assert not Enclosure(Fraction("1.2"), Fraction("1.3")).rounds_to("1.2")
    assert 1.25 in Enclosure(Fraction("1.2"), Fraction("1.3"))
    assert 1.31 not in Enclosure(Fraction("1.2"), Fraction("1.3"))
    assert Enclosure(Fraction("1.2"), Fraction("1.3")).within(1.4, 0.11)
    assert not Enclosure(Fraction("1.2"), Fraction("1.3")).within(1.4, 0.09)


@given(st.floats(-1e6, 1e6), st.integers(1, 40))
def test_text_of_an_enclosure_bounds_it(value: float, digits: int) -> None:
    place = Enclosure(Fraction(value), Fraction(value) + Fraction(1, 10**9))
    text, radius = place.text(digits)
    assert Fraction(text) - Fraction(radius) <= place.low
    assert place.high <= Fraction(text) + Fraction(radius)


@given(st.floats(0.0, 1e5), st.integers(1, 4))
def test_mode_pairs_agree_with_the_loads(weight: float, pair: int) -> None:
    """Which is first, from (78), as the loads have it; switchings on either side of the weight."""
    found = mode_pairs(weight, 0.01, pairs=pair)[-1]
    loads = exact.horizontal_loads(weight / 0.01, 2 * pair)
    assert list(found.forces) == pytest.approx(loads[-2:], rel=1e-14)
    assert found.after.weight > weight
    assert found.before is None or found.before.weight <= weight
    assert found.after.pair == pair
    if found.forces[0] - found.forces[1] > 1e-9 * abs(found.forces[0]):
        even, odd = exact.pair_loads(pair, math.sqrt(weight / 0.01))
        assert found.parities == ((1, -1) if even > odd else (-1, 1))


def test_mode_pairs_lie_inside_enclosures_and_switch_as_printed() -> None:
    """γ = 15: switched once at 8.7668, next at 62.3418 (paper, after Table 1)."""
    first, second = mode_pairs(15.0, pairs=2)
    proved = certify(Problem(15.0), 4, digits=20)
    for load, force in zip(proved, (*first.forces, *second.forces), strict=True):
        assert load.force.within(force, second.error)
    assert first.before is not None
    assert (f"{first.before.weight:.4f}", f"{first.after.weight:.4f}") == ("8.7668", "62.3418")
    assert (first.parities, first.switched, second.switched) == ((-1, 1), 1, 0)
    table = switching_table(12)
    assert len(table) == 30
    assert table[-1].weight == pytest.approx(100 * 144 * math.pi**4 * 0.01, rel=1e-14)
    for bad in (2, 201):
        with pytest.raises(InputError, match="largest"):
            switching_table(bad)
    with pytest.raises(InputError, match="clearance"):
        switching_table(10, 0.0)
    with pytest.raises(InputError, match="pairs"):
        mode_pairs(15.0, pairs=0)

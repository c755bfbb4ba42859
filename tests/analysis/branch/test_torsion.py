"""Twist at the lift-off load: the sense that settles the rod, and the second lift-off (paper, section 4.2)."""

from __future__ import annotations

import pytest

from rodwell import InputError, Problem, critical_loads, follow, torsion


@pytest.mark.parametrize(("weight", "mode"), [(15.0, 1), (30.0, 1), (5.0, 2)])
def test_odd_modes_settle_with_one_sense_on_each_arm(weight: float, mode: int) -> None:
    """T₁ > 0 on the arm ω₂(1) > 0, T₁ < 0 on the other: y(s) → −y(s) turns T₁ round."""
    lower, upper = (torsion(Problem(weight), mode, mirror=mirror) for mirror in (False, True))
    assert (lower.sense, upper.sense) == (-1, 1)
    assert upper.rates == pytest.approx([-rate for rate in lower.rates], rel=1e-6)


@pytest.mark.parametrize(("weight", "mode"), [(5.0, 1), (15.0, 2), (70.0, 1)])
def test_even_modes_lift_off_with_either_sense(weight: float, mode: int) -> None:
    """They touch last at two places, s and 1 − s; y(s) → −y(1 − s) swaps the places, so their rates are opposite."""
    found = torsion(Problem(weight), mode)
    assert found.sense == 0
    assert len(found.rates) == 2
    assert found.rates[0] == pytest.approx(-found.rates[1], rel=1e-6)
    assert "either sign" in found.meaning
    for twist in (0.1, -0.1):  # and so the twisted rod lifts off at a lower load
        lift = follow(Problem(weight, twist=twist), mode).lift_off
        assert lift is not None
        assert lift.force > found.prepared.force


def test_rates_are_those_of_the_twisted_rod() -> None:
    """Against the contact pressure of the rod twisted first and compressed afterwards."""
    found = torsion(Problem(15.0))
    force, h = found.prepared.force, 1e-3
    p = [follow(Problem(15.0, twist=t), until=force)[-1].fields([0.5])["contact_pressure"][0] for t in (-h, h)]  # type: ignore[arg-type]
    assert found.rates[0] == pytest.approx((p[1] - p[0]) / (2.0 * h), rel=1e-4)
    assert found.rates[0] == pytest.approx(
        -torsion(Problem(15.0), mirror=True).rates[0], abs=2.0 * found.rate_errors[0]
    )
    assert found.rate_errors[0] < 1e-4 * abs(found.rates[0])


def test_second_lift_off_is_a_lift_off_of_the_twisted_rod() -> None:
    """Round the other way: the rod twisted by that much lifts off at that load."""
    found = torsion(Problem(30.0))
    assert found.again is not None
    assert found.again.s == pytest.approx((0.0, 1.0), abs=1e-6)
    twisted = follow(Problem(30.0, twist=found.again.value), until=found.prepared.force)[-1]
    top, error, _ = twisted.highest_pressure
    assert abs(top) <= 10.0 * error + 1e-5


@pytest.mark.parametrize(("weight", "twist"), [(15.5, -62.812961), (16.5, -37.4611751), (17.6, -29.681445)])
def test_light_rods_lift_off_again(weight: float, twist: float) -> None:
    """Below the corner of Fig. 11 at γ = 17.703, too: near mid-length, the later the lighter the rod is."""
    again = torsion(Problem(weight)).again
    assert again is not None
    assert again.value == pytest.approx(twist, abs=1e-6)
    assert again.error <= 1e-6
    assert all(0.4 < s < 0.6 for s in again.s)


def test_twist_does_not_buckle_a_straight_rod() -> None:
    plain = critical_loads(Problem(15.0, alpha=60.0), 4).forces
    assert critical_loads(Problem(15.0, alpha=60.0, twist=7.0), 4).forces == pytest.approx(plain, rel=1e-14)


@pytest.mark.parametrize(
    ("problem", "field"),
    [
        (Problem(15.0, twist=1.0), "twist"),
        (Problem(15.0, ends=("clamped", "free")), "twist"),
        (Problem(0.0), "weight"),
        (Problem(15.0, on_top=True), "weight"),
    ],
    ids=str,
)
def test_what_cannot_be_prepared(problem: Problem, field: str) -> None:
    with pytest.raises(InputError, match=f"^{field} = "):
        torsion(problem)

"""What the page on convergence says of orders and error estimates."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.fixture(scope="module")
def page() -> Any:
    sys.path.insert(0, str(DOCS))
    try:
        return importlib.import_module("make_convergence")
    finally:
        sys.path.remove(str(DOCS))


def test_observed_orders_are_those_of_theory(page: Any) -> None:
    """H²: p − 1; contact pressure: p − 2 (Céa's lemma and approximation by splines)."""
    for degree in (4, 5, 6):
        assert page.orders()[degree].slopes(degree)[:2] == pytest.approx((degree - 1, degree - 2), abs=0.2)


def test_order_at_the_degree_of_the_program(page: Any) -> None:
    """It comes down to theory from above; round-off ends the way at 1e-12."""
    errors = page.orders()[9]
    h2, pressure, _ = errors.slopes(9)
    assert 7.8 < h2 < 8.8
    assert pressure == pytest.approx(7.0, abs=0.3)
    assert errors.h2[-1] < 1e-11
    assert errors.pressure[-1] < 1e-9


def test_critical_loads_converge_with_twice_the_order(page: Any) -> None:
    """2(p − 1), towards a load enclosed with proof; from above, as Rayleigh quotients do; degree 9 is at round-off."""
    for degree in (4, 5, 6):
        errors = page.orders()[degree]
        assert errors.slopes(degree)[2] == pytest.approx(2 * (degree - 1), rel=0.05)
    assert page.orders()[9].load[-1] < 1e-12


def test_estimates_cover_the_true_errors(page: Any) -> None:
    """On the program's meshes always; elsewhere nearly always, and never far off where the estimate is good."""
    found = page.estimates()
    assert found.claimed.size > 700
    assert found.ratio[found.share == 1.0].max() <= 0.5
    assert found.ratio[found.share == 0.7].max() <= 1.0
    assert np.mean(found.ratio <= 1.0) > 0.98
    good = found.claimed < 1e-4
    assert np.mean(found.ratio[good] <= 1.0) > 0.99
    assert found.ratio[good].max() < 4.0


def test_estimates_are_not_empty_caution(page: Any) -> None:
    """They fall with the error over ten orders of magnitude, and are not merely large."""
    found = page.estimates()
    median = [np.median(found.claimed[found.share == share]) for share in (1.0, 0.7, 0.5, 0.35)]
    assert np.all(np.diff(median) > 0.0)
    logs = np.log10(np.maximum([found.claimed, found.true], 1e-15))
    assert np.corrcoef(logs)[0, 1] > 0.85
    assert np.median(found.ratio) > 1e-4


def test_located_lift_off_loads(page: Any) -> None:
    claimed, true = page.lift_offs()
    assert np.all(true <= claimed)
    assert np.median(true / claimed) > 1e-5


def test_loads_against_the_roots_of_77(page: Any) -> None:
    claimed, true = page.loads()
    assert np.all(true <= claimed)
    assert claimed.max() < 1e-9

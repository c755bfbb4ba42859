"""Watching the softest eigenvalues: against dense linear algebra, and what counts as a dip through zero."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh

from rodwell import Problem, diagram, follow
from rodwell.numerics.continuation import walk
from rodwell.numerics.continuation.softest import SoftestEigenvalues, _dip, hidden_change

PLACE = np.array([-1.0, 0.0, 1.0])


@pytest.mark.parametrize("values", [[1.0, 0.2, 1.0], [-1.0, -0.1, -3.0], [0.5, 0.1, 0.5]])
def test_a_deep_minimum_may_be_a_dip(values: list[float]) -> None:
    """At unequal distances the parabola through the last three goes below half of the middle value, or below zero."""
    assert _dip(np.array([-1.0, 0.0, 0.2]), np.array(values)) is not None


def test_a_dip_is_where_the_parabola_has_its_minimum() -> None:
    watch = SoftestEigenvalues(values=[((x - 0.03) ** 2 - 1e-4, 1.0) for x in (-0.2, 0.0, 0.3)], places=[0.0, 0.2, 0.5])
    assert watch.dips() == pytest.approx([0.03 / 0.3])
    watch = SoftestEigenvalues(values=[((x + 0.05) ** 2 - 1e-4, 1.0) for x in (-0.2, 0.0, 0.3)], places=[0.0, 0.2, 0.5])
    assert watch.dips() == pytest.approx([-0.05 / 0.2])


@pytest.mark.parametrize("scale", [0.2, 1.0, 7.0])
def test_a_dip_is_deep_where_the_parabola_loses_half_of_the_middle_value(scale: float) -> None:
    """Of a (x − 0.1)² + h the middle value is 0.01 a + h, the least h."""
    for h, deep in ((0.009, True), (0.011, False)):
        found = _dip(PLACE, [scale * ((x - 0.1) ** 2 + h) for x in PLACE])
        assert (found == pytest.approx(0.1)) if deep else (found is None)


def test_points_that_are_taken_back_are_forgotten() -> None:
    watch = SoftestEigenvalues(values=[(float(k), 1.0) for k in range(5)], places=[0.0, 0.1, 0.2, 0.3, 0.4])
    watch.forget(2)
    assert watch == SoftestEigenvalues(values=[(0.0, 1.0), (1.0, 1.0), (2.0, 1.0)], places=[0.0, 0.1, 0.2])


@pytest.mark.parametrize("values", [[1.0, 0.95, 1.0], [3.0, 2.0, 1.0], [1.0, -0.1, 1.0], [1.0, 2.0, 1.0]])
def test_what_is_no_dip(values: list[float]) -> None:
    """Shallow, falling, of two signs (a change that counting sees), or a maximum."""
    assert _dip(PLACE, np.array(values)) is None


def dense(band: np.ndarray) -> np.ndarray:
    out = np.zeros((len(band), len(band)))
    for k in range(band.shape[1]):
        i = np.arange(len(band) - k)
        out[i + k, i] = out[i, i + k] = band[: len(i), k]
    return out


def test_softest_eigenvalues_against_dense_ones() -> None:
    branch = follow(Problem(15.0), until=-340.0)
    meshes, point = branch.last
    watch = SoftestEigenvalues()
    for _ in range(12):
        watch.add(meshes, point, 0.0)
    family = meshes.coarse
    hessian = dense(family.held.free_part(family.assemble(point.coarse.c, point.coarse.lam)[2]))
    values, vectors = eigh(hessian, dense(family.held.free_part(family.space.slope_gram)))
    parity = np.array([np.sign(v @ v[::-1]) for v in vectors.T])
    expected = [min(values[parity == p], key=abs) for p in (1, -1)]
    assert watch.values[-1] == pytest.approx(expected, rel=1e-4)


def test_a_branch_is_looked_at_between_points_where_an_eigenvalue_dips(monkeypatch: pytest.MonkeyPatch) -> None:
    """With twist 0.5 the secondary branch has index 1 → 0 → 1 within 0.006 of load, far less than a step."""
    seen = []

    def counted(*arguments: Any) -> bool:
        seen.append(hidden_change(*arguments))
        return seen[-1]

    monkeypatch.setattr(walk, "hidden_change", counted)
    diagram(Problem(15.0, twist=0.5), modes=1, until=-450.0, largest_step=0.04)
    assert any(seen)

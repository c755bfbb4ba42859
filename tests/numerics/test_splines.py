"""B-splines against SciPy, and their defining properties."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BSpline

from rodwell.numerics.splines.held import Ends
from rodwell.numerics.splines.spaces import Prolongation, SplineSpace, graded_mesh

DEGREES = st.integers(4, 9)
MESHES = st.lists(st.floats(0.02, 1.0), min_size=2, max_size=9).map(
    lambda steps: np.concatenate([[0.0], np.cumsum(steps)[:-1] / np.sum(steps), [1.0]])
)


@given(MESHES, DEGREES, st.integers(0, 2**31))
def test_values_and_derivatives_agree_with_scipy(mesh: np.ndarray, degree: int, seed: int) -> None:
    space = SplineSpace(mesh, degree)
    c = np.random.default_rng(seed).standard_normal(space.size)
    s = np.linspace(0.0, 1.0, 37)
    values = space.evaluate(c, s, 4)
    reference = BSpline(space.knots, c, degree)
    for order in range(4):
        expected = reference(s) if order == 0 else reference.derivative(order)(s)
        assert values[order] == pytest.approx(expected, rel=1e-9, abs=1e-11 * np.max(np.abs(expected)))


@given(MESHES, DEGREES, st.integers(0, 2**31), st.data())
def test_refinement_does_not_change_a_spline(mesh: np.ndarray, degree: int, seed: int, data: st.DataObject) -> None:
    space = SplineSpace(mesh, degree)
    marked = np.array(data.draw(st.lists(st.booleans(), min_size=space.elements, max_size=space.elements)))
    fine = space.refined(marked)
    c = np.random.default_rng(seed).standard_normal(space.size)
    s = np.linspace(0.0, 1.0, 51)
    assert fine.elements == space.elements + np.sum(marked)
    assert fine.evaluate(Prolongation(space, fine)(c), s, 1) == pytest.approx(space.evaluate(c, s, 1), abs=1e-12)


def test_tables_kept_for_places_serve_other_splines_and_do_not_pile_up() -> None:
    space = SplineSpace(np.array([0.0, 0.1, 0.35, 0.8, 1.0]), 6)
    rng = np.random.default_rng(2)
    for places in [rng.random(40) for _ in range(9)] * 2:
        for c in rng.standard_normal((2, space.size)):
            one_by_one = np.hstack([space.evaluate(c, places[i : i + 1], 4) for i in range(places.size)])
            np.testing.assert_allclose(space.evaluate(c, places, 4), one_by_one, rtol=1e-11, atol=1e-9)
    assert len(space._tables) <= 6
    kept, few = space.tabulated(places, 4), space.tabulated(places[:8], 4)
    assert all(one is other for one, other in zip(space.tabulated(places, 4), kept, strict=True))
    assert space.tabulated(places[:8], 4)[0] is not few[0]  # of few places none is kept


def test_quadrature_table_is_the_basis_at_the_points() -> None:
    space = SplineSpace(np.array([0.0, 0.1, 0.35, 0.8, 1.0]), 6)
    c = np.random.default_rng(1).standard_normal(space.size)
    assert space.at_points(c) == pytest.approx(space.evaluate(c, space.points, 3), rel=1e-11, abs=1e-11)


def test_projection_reproduces_a_polynomial_with_clamped_ends() -> None:
    space = SplineSpace(np.linspace(0.0, 1.0, 6), 7)
    s = space.points
    c = space.project(s**2 * (1.0 - s) ** 2, Ends((2, 2)))
    places = np.linspace(0.0, 1.0, 23)
    assert space.evaluate(c, places, 1)[0] == pytest.approx(places**2 * (1.0 - places) ** 2, abs=1e-14)


def test_graded_mesh_follows_the_wavenumber() -> None:
    s = np.linspace(0.0, 1.0, 1001)
    mesh = graded_mesh(10.0 + 90.0 * (1.0 - s), s, per_radian=1.0)
    phase = 100.0 * mesh - 45.0 * mesh**2  # ∫k ds from 0, 55 in all
    assert mesh[0] == 0.0
    assert mesh[-1] == 1.0
    assert len(mesh) == 57  # one element a radian, rounded up to an even number
    assert np.diff(phase) == pytest.approx(np.full(56, 55.0 / 56.0), rel=1e-4)


KINKS = np.array([0.2, 0.55])


def _kinked() -> SplineSpace:
    return SplineSpace(np.array([0.0, 0.1, 0.2, 0.4, 0.55, 0.8, 1.0]), 5, kinks=KINKS)


def _bent(s: np.ndarray) -> np.ndarray:
    """A cubic with steps of the second derivative at the kinks: value, slope, bend, (3, m)."""
    parts = [np.maximum(s - kink, 0.0) for kink in KINKS]
    return np.array(
        [
            s**3 + 3.0 * parts[0] ** 2 - parts[1] ** 2,
            3.0 * s**2 + 6.0 * parts[0] - 2.0 * parts[1],
            6.0 * s + 6.0 * (parts[0] > 0.0) - 2.0 * (parts[1] > 0.0),
        ]
    )


def test_kinks_hold_what_has_a_step_of_the_second_derivative():
    space = _kinked()
    assert space.size == space.elements + space.degree + 2 * (space.degree - 2)
    c = space.project(_bent(space.points)[0], Ends((0, 0)))
    s = np.array([0.0, 0.15, np.nextafter(0.2, 0.0), 0.2001, 0.3, 0.55 - 1e-12, 0.56, 1.0])
    assert space.evaluate(c, s, 3) == pytest.approx(_bent(s), abs=1e-9)
    plain = SplineSpace(space.breaks, 5)
    assert plain.evaluate(plain.project(_bent(plain.points)[0], Ends((0, 0))), s, 3) != pytest.approx(
        _bent(s), abs=1e-2
    )


def test_kinks_stay_on_finer_meshes_and_in_pieces():
    space = _kinked()
    c = np.random.default_rng(0).standard_normal(space.size)
    s = np.linspace(0.0, 1.0, 101)
    finer = space.refined(np.array([True, False, False, True, False, True]))
    assert np.array_equal(finer.kinks, KINKS)
    assert finer.evaluate(Prolongation(space, finer)(c), s, 4) == pytest.approx(
        space.evaluate(c, s, 4), rel=1e-9, abs=1e-9
    )
    for elements, functions, knots, grid, table in space.pieces:
        piece = SplineSpace(space.breaks[elements.start : elements.stop + 1], 5)  # only for its number of samples
        assert grid.size == piece.samples[0].size
        assert knots.size == functions.stop - functions.start + space.degree + 1
        first = np.repeat(space.starts[elements], 3)
        values = [table[j, 2] @ c[i : i + 6] for j, i in enumerate([*first, first[-1]])]
        assert values == pytest.approx(space.evaluate(c, grid, 3)[2], rel=1e-9, abs=1e-9)


def test_kinks_must_be_mesh_points():
    with pytest.raises(ValueError, match="mesh points"):
        SplineSpace(np.linspace(0.0, 1.0, 5), 5, kinks=np.array([0.3]))

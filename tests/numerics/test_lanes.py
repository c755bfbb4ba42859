"""Formulas on lanes of vector registers, and products in them, against the same in NumPy and in many digits."""

from __future__ import annotations

from typing import Any, NamedTuple

import mpmath
import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell.numerics.splines.lanes import on_lanes
from rodwell.numerics.splines.products import add_element, congruence, dots, subtract
from rodwell.physics.on_wall.model import RodOnCylinder

ULP = np.finfo(float).eps


class Anything(NamedTuple):
    """A model of which only the class counts."""

    field: int = 0


class TwoFields(NamedTuple):
    """The same with two fields."""

    first: int = 0
    second: int = 0


ONE = Anything()


def compiled(formula: Any, model: Any) -> Any:
    """Function of rows (k, m), parameters, and rows to write, for m places at once."""
    apply = on_lanes(formula)

    @numba.njit
    def run(tag: Any, rows: Any, uniforms: Any, out: Any) -> None:
        apply(model, tag, rows, uniforms, out)

    return lambda rows, uniforms, out: run((0,) * rows.shape[1], np.ascontiguousarray(rows), uniforms, out)


TURNS = compiled(lambda _: lambda rows: [np.sin(rows[0]), np.cos(rows[0])], Anything())


@given(st.lists(st.one_of(st.floats(-10.0, 10.0), st.floats(-1e6, 1e6)), min_size=7, max_size=7))
def test_sine_and_cosine_are_those_of_many_digits(angles: list[float]) -> None:
    out = np.empty((2, 7))
    TURNS(np.array([angles]), (), out)
    for x, sine, cosine in zip(angles, *out, strict=True):
        with mpmath.workdps(40):
            assert float(abs(mpmath.sin(x) - sine)) <= 1.5 * ULP * max(abs(sine), 1e-3)
            assert float(abs(mpmath.cos(x) - cosine)) <= 1.5 * ULP * max(abs(cosine), 1e-3)


@pytest.mark.parametrize("count", [1, 3, 6, 8])
def test_sine_and_cosine_near_whole_quarter_turns(count: int) -> None:
    for first in range(-20, 20, count):
        angles = 0.5 * np.pi * np.arange(first, first + count)
        out = np.empty((2, count))
        TURNS(angles[None], (), out)
        np.testing.assert_allclose(out, [np.sin(angles), np.cos(angles)], rtol=0.0, atol=1.5 * ULP)


def every_operation(rows: Any, parameters: Any) -> list[Any]:
    """Each instruction that formulas may ask for, with lanes, parameters and plain numbers on either side."""
    x, y, p, number = rows[0], rows[1], parameters[1], np.float64(1.25)
    return [
        x + y - p, 2.0 - x, number + x, number - x, number * x, number / y, x / y / p, 1.0 / p, -x, -p, 3, 0.0 * x,
        x**2, x**3, x**7, p**5 * x, np.sqrt(y), np.sqrt(p), abs(-3.0) * np.absolute(x), np.maximum(x, y),
        np.maximum(x, 0.3), np.maximum(p, x), np.sin(p), np.cos(p) + 0.0 + x, np.add(x, p), x + 0.0, 0.0 + x,
    ]  # fmt: skip


def test_every_operation_is_that_of_numpy() -> None:
    rng = np.random.default_rng(0)
    for count in (1, 2, 5, 8):
        rows, parameters = rng.uniform(0.1, 2.0, (2, count)), rng.uniform(0.1, 2.0, 3)
        expected = [np.broadcast_to(x, count) for x in every_operation(rows, parameters)]
        out = np.empty((len(expected), count))
        compiled(lambda _: every_operation, Anything())(rows, (parameters,), out)
        np.testing.assert_allclose(out, expected, rtol=4.0 * ULP, atol=ULP)


def test_rows_may_be_written_where_they_were_read() -> None:
    rows = np.arange(12.0).reshape(3, 4)
    apply = on_lanes(lambda _: lambda known: [known[0] + known[1], known[1] + known[2]])

    @numba.njit
    def add(tag: Any, values: Any) -> None:
        apply(Anything(), tag, values, (), values[1:])

    add((0,) * 4, rows)
    np.testing.assert_array_equal(rows, [[0, 1, 2, 3], [4, 6, 8, 10], [12, 14, 16, 18]])


@given(st.integers(0, 2**31))
def test_density_and_contact_of_the_rod_are_those_of_numpy(seed: int) -> None:
    rng = np.random.default_rng(seed)
    p = np.array([-300.0, 20.0, 15.0, 0.02, 0.8, 1.0, 0.03]) * rng.uniform(0.5, 1.5, 7)
    rates = rng.standard_normal(7)
    u = np.array([[0.05], [0.3], [4.0], [50.0]]) * rng.uniform(-1.0, 1.0, (4, 6))
    s = rng.random(6)
    model = RodOnCylinder()
    energy, rate, gradient, mixed, hessian = model.density(s, u, [], p, rates)
    expected = [energy, rate, *gradient, *mixed, *(x for row in hessian for x in row), model.observed(s, u, [], p)]
    out = np.empty((18, 6))

    def all_of(rows: Any, parameters: Any, along: Any) -> list[Any]:
        fields = [rows[1 + d] for d in range(4)]
        e, r, g, m, h = RodOnCylinder.density(rows[0], fields, [], parameters, along)
        return [e, r, *g, *m, *(x for row in h for x in row), RodOnCylinder.observed(rows[0], fields, [], parameters)]

    compiled_once(all_of)(np.vstack([s, u]), (p, rates), out)
    for value, known in zip(out, expected, strict=True):
        np.testing.assert_allclose(value, np.broadcast_to(known, 6), rtol=1e-11, atol=1e-11 * np.max(np.abs(known)))


_COMPILED: list[Any] = []


def compiled_once(formula: Any) -> Any:
    """The function compiled from the first formula given."""
    if not _COMPILED:
        _COMPILED.append(compiled(lambda _: formula, RodOnCylinder()))
    return _COMPILED[0]


@pytest.mark.parametrize("model", [Anything(), TwoFields()])
@pytest.mark.parametrize(("local", "count"), [(2, 1), (5, 3), (7, 4), (10, 6), (12, 9)])
def test_sums_of_rows(model: Any, local: int, count: int) -> None:
    rng = np.random.default_rng(local)
    table, c = rng.standard_normal((20, 3, local)), rng.standard_normal(60)
    out = np.full((3, count + 1), np.nan)

    @numba.njit
    def sums(local_tag: Any, count_tag: Any, table: Any, c: Any, out: Any) -> None:
        dots(model, local_tag, count_tag, table, 4, 3, c, 7, out, 2)

    sums((0,) * local, (0,) * count, table, c, out)
    rows = table.reshape(-1, local)[4 : 4 + 3 * count : 3]
    expected = rows @ c[7 : 7 + local * len(model) : len(model)]
    np.testing.assert_allclose(out.ravel()[2 : 2 + count], expected, rtol=1e-13, atol=1e-13)
    assert np.isnan(out.ravel()[:2]).all()
    assert np.isnan(out.ravel()[2 + count :]).all()


def test_a_multiple_subtracted_touches_what_it_should() -> None:
    @numba.njit
    def run(out: Any, x: Any, count: int) -> None:
        subtract(out, 3, 2.0, x, 1, count)

    for count in range(12):
        out, x = np.arange(20.0), np.random.default_rng(count).standard_normal(20)
        expected = out.copy()
        expected[3 : 3 + count] -= 2.0 * x[1 : 1 + count]
        run(out, x, count)
        np.testing.assert_allclose(out, expected, rtol=1e-14)


@pytest.mark.parametrize(("local", "points"), [(5, 3), (10, 8)])
def test_products_over_an_element_and_where_they_are_added(local: int, points: int) -> None:
    rng = np.random.default_rng(local)
    table, terms = rng.standard_normal((4 * points, 3, local)), rng.standard_normal((17, points))
    terms[8:] = (terms[8:] + terms[8:].reshape(3, 3, points).transpose(1, 0, 2).reshape(9, points)) / 2.0
    product, start = np.full((local + 2, local), np.nan), 6
    known = rng.standard_normal((2, 40)), rng.standard_normal((40, local))
    (gradient, mixed), band = known[0].copy(), known[1].copy()

    @numba.njit
    def run(tags: Any, first: int, to: int, table: Any, terms: Any, product: Any, sums: Any, band: Any) -> None:
        congruence(ONE, tags, table, first, terms, 0, 0, product)
        add_element(tags, product, to, sums[0], sums[1], band)

    run(((0,) * local, (0,) * points), 2 * points, start, table, terms, product, (gradient, mixed), band)
    own = table[2 * points : 3 * points]
    hessian = np.einsum("qda,dkq,qkb->ab", own, terms[8:].reshape(3, 3, points), own)
    above = np.triu_indices(local)
    np.testing.assert_allclose(product[:local][above], hessian[above], rtol=1e-12, atol=1e-12)
    for row, rows, before, after in ((0, terms[2:5], known[0][0], gradient), (1, terms[5:8], known[0][1], mixed)):
        expected = np.einsum("dq,qdb->b", rows, own)
        np.testing.assert_allclose(product[local + row], expected, rtol=1e-12, atol=1e-12)
        before[start : start + local] += expected
        np.testing.assert_allclose(after, before, rtol=1e-12, atol=1e-12)
    for b in range(local):
        known[1][start + b, : local - b] += hessian[b, b:]
    np.testing.assert_allclose(band, known[1], rtol=1e-12, atol=1e-12)

"""Spline spaces: a mesh, a degree, the quadrature on it, and the way to a finer mesh."""

from __future__ import annotations

import itertools
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from rodwell.numerics.splines import assembly, banded, basis
from rodwell.numerics.splines.held import Ends
from rodwell.quantities.arrays import FloatArray, IntArray

SAMPLES_PER_ELEMENT = 3
MESH_SYMMETRY = 1e-12
"""How far a mesh may be from symmetric by round-off."""

TINY = 1e-300

AT_ONCE = 1 << 17
"""Values at quadrature points that are computed at once: a megabyte."""

FEW, KEPT = 32, 6
"""Places fewer than this are not worth a table, and tables kept for each space."""


@lru_cache
def _gauss(count: int) -> tuple[FloatArray, FloatArray]:
    return np.polynomial.legendre.leggauss(count)


class SplineSpace:
    """Splines of one degree on a mesh of [0, 1]: of maximal smoothness, but for kinks, where u″ may jump.

    Parameters
    ----------
    breaks
        Mesh points, increasing from 0 to 1, shape (elements + 1,).
    degree
        Polynomial degree p; the splines have p − 1 continuous derivatives.
    per_element
        Gauss points in each element: p − 1, unless said otherwise.
    kinks
        Mesh points inside at which only u and u′ are continuous, rising, (k,): where a coefficient of the equations
        jumps. The knot there stands p − 1 times.
    smooth
        Derivatives that are continuous at each kink, (k,), 1 unless said otherwise: the knot stands p − smooth times.

    Attributes
    ----------
    size
        Number of coefficients, elements + degree, and p − 1 − smooth more for each kink.
    starts
        First basis function of each element, (elements,).
    points, weights
        Gauss quadrature, ``per_element`` points in each element in turn. With p − 1 of them φ″φ″ is integrated
        exactly, which keeps the order of the energy.
    """

    def __init__(
        self,
        breaks: FloatArray,
        degree: int,
        per_element: int | None = None,
        kinks: FloatArray | None = None,
        smooth: IntArray | None = None,
    ) -> None:
        self.breaks = np.ascontiguousarray(breaks, dtype=float)
        self.degree = degree
        self.elements = self.breaks.size - 1
        self.kinks = np.empty(0) if kinks is None else np.asarray(kinks, dtype=float)
        self.kink_elements: IntArray = np.searchsorted(self.breaks, self.kinks).astype(np.int64)
        if not np.array_equal(self.breaks[self.kink_elements], self.kinks):
            raise ValueError("kinks must be mesh points")
        times = np.ones(self.elements + 1, dtype=np.int64)
        self.smooth = np.ones(self.kinks.size, dtype=np.int64) if smooth is None else smooth
        times[self.kink_elements] = degree - self.smooth
        self.per_element = degree - 1 if per_element is None else per_element
        self.tags = (0,) * (degree + 1), (0,) * self.per_element  # their lengths: what compiled loops must know
        self._tables: dict[tuple[int, bytes], tuple[FloatArray, NDArray[np.int64]]] = {}
        self.knots = np.concatenate([np.zeros(degree), np.repeat(self.breaks, times), np.ones(degree)])
        self.starts: IntArray = np.cumsum(times[:-1]) - 1
        self.size = int(self.starts[-1]) + degree + 1
        nodes, weights = _gauss(self.per_element)
        half = 0.5 * np.diff(self.breaks)[:, None]
        self.points: FloatArray = (self.breaks[:-1, None] + half * (nodes + 1.0)).ravel()
        self.weights: FloatArray = (half * weights).ravel()

    @cached_property
    def smallest(self) -> float:
        """Length of the smallest element."""
        return float(np.min(np.diff(self.breaks)))

    @cached_property
    def greville(self) -> FloatArray:
        """Greville abscissae (size,): the coefficients of the function s."""
        return np.array([self.knots[i + 1 : i + 1 + self.degree].mean() for i in range(self.size)])

    @cached_property
    def table(self) -> FloatArray:
        """Basis functions and two derivatives at the quadrature points, shape (m, 3, degree + 1)."""
        return np.asarray(basis.tabulate(self.tags[0], self.knots, self.starts, self.points, self.per_element, 3))

    @cached_property
    def samples(self) -> tuple[FloatArray, FloatArray]:
        """Places (k,), a few in each element and both ends, and basis table (k, 4, degree + 1) there."""
        share = np.arange(SAMPLES_PER_ELEMENT) / SAMPLES_PER_ELEMENT
        grid = np.append((self.breaks[:-1, None] + np.diff(self.breaks)[:, None] * share).ravel(), 1.0)
        return grid, np.asarray(basis.tabulate(self.tags[0], self.knots, self.starts, grid, SAMPLES_PER_ELEMENT, 4))

    @cached_property
    def pieces(self) -> tuple[tuple[slice, slice, FloatArray, FloatArray, FloatArray], ...]:
        """The space between kinks, each piece a space of its own: what there is of it, and where to look.

        Elements and coefficients (slices), knots, and :attr:`samples` of the piece. A piece that ends in a kink is
        looked at up to the number just below it: at the kink itself functions have the derivatives of the next piece.
        """
        edges = [0, *self.kink_elements.tolist(), self.elements]
        grid, table = self.samples
        found = []
        for first, last in itertools.pairwise(edges):
            start, end = int(self.starts[first]), int(self.starts[last - 1]) + self.degree + 1
            if last == self.elements:
                looked, values = grid[SAMPLES_PER_ELEMENT * first :], table[SAMPLES_PER_ELEMENT * first :]
            else:
                below = np.nextafter(self.breaks[last], 0.0)
                inside = slice(SAMPLES_PER_ELEMENT * first, SAMPLES_PER_ELEMENT * last)
                looked = np.append(grid[inside], below)
                values = np.concatenate([table[inside], self.tabulated(np.array([below]), 4)[0]])
            knots = self.knots[start : end + self.degree + 1]
            found.append((slice(first, last), slice(start, end), knots, looked, np.ascontiguousarray(values)))
        return tuple(found)

    @cached_property
    def landmarks(self) -> tuple[FloatArray, NDArray[np.int64]]:
        """Basis table (3, 3, degree + 1) at both ends and in the middle, and the elements in which they lie (3,)."""
        table, spans = basis.tabulate_anywhere(self.tags[0], self.knots, np.array([0.0, 0.5, 1.0]), 3)
        return np.asarray(table), np.asarray(spans) - self.degree

    @cached_property
    def slope_gram(self) -> FloatArray:
        """Band (size, degree + 1) of ∫ φᵢ' φⱼ' ds."""
        return self.form(np.array([0.0, 1.0, 0.0]))

    def form(self, density: FloatArray) -> FloatArray:
        """Band of Σ_d ∫ density[d] φᵢ⁽ᵈ⁾ φⱼ⁽ᵈ⁾ ds; ``density`` is (3,) or (3, m) at the quadrature points."""
        full = np.array(np.broadcast_to(np.atleast_2d(density.T).T, (3, self.points.size)), order="C")
        return np.asarray(assembly.assemble_form(self.tags[0], self.table, self.weights, self.starts, full))

    def grams(self, density: FloatArray, block: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Matrices (k, k) of the form with ``density`` (3, m), and of ∫u'v' ds, for functions with coefficients (k, n).

        Formed from values at the quadrature points: squares do not cancel as the entries of a stiffness matrix do.
        """
        energy, slope = np.zeros((2, len(block), len(block)))
        step = max(1, AT_ONCE // (3 * len(block) * self.per_element))
        for first in range(0, self.elements, step):
            count = min(step, self.elements - first)
            here = slice(first * self.per_element, (first + count) * self.per_element)
            values = np.asarray(assembly.values_at_points(self.tags, self.table, self.starts, block, first, count))
            slope += (values[:, 1] * self.weights[here]) @ values[:, 1].T
            factors = density[:, here] * self.weights[here]
            energy += sum((values[:, d] * factors[d]) @ values[:, d].T for d in range(3))
        return energy, slope

    def evaluate(self, coefficients: FloatArray, places: FloatArray, orders: int) -> FloatArray:
        """Derivatives 0 … orders−1, of at most order 3, at ``places`` (m,): shape (orders, m)."""
        table, first = self.tabulated(np.ascontiguousarray(places, dtype=float), orders)
        return np.asarray(basis.combine_all(self.tags[0], table, first, coefficients))

    def tabulated(self, points: FloatArray, orders: int) -> tuple[FloatArray, NDArray[np.int64]]:
        """Basis table and first functions at ``points``: tables of the last few sets of places are kept.

        The states of a branch are all evaluated at the same places, and functions of the basis take ten times as long
        as the sums over them.
        """
        if not 1 <= orders <= basis.MOST_ORDERS:
            raise ValueError(f"orders = {orders}: only values and {basis.MOST_ORDERS - 1} derivatives are known")
        key = orders, points.tobytes()
        found = self._tables.pop(key, None) if points.size >= FEW else None
        if found is None:
            table, spans = basis.tabulate_anywhere(self.tags[0], self.knots, points, orders)
            found = np.asarray(table), np.asarray(spans) - self.degree
        if points.size < FEW:
            return found
        self._tables[key] = found  # the last in order of use
        if len(self._tables) > KEPT:
            del self._tables[next(iter(self._tables))]
        return found

    def forget_tables(self) -> None:
        """Let go of all tables of the basis, most of what a space keeps: they are made again where they are needed."""
        self._tables.clear()
        for name in ("table", "samples", "pieces"):
            vars(self).pop(name, None)

    def at_points(self, coefficients: FloatArray) -> FloatArray:
        """Values and two derivatives at the quadrature points, shape (3, m); (k, 3, m) of a block (k, size)."""
        block = np.ascontiguousarray(np.atleast_2d(coefficients))
        values = np.asarray(assembly.values_at_points(self.tags, self.table, self.starts, block, 0, self.elements))
        return values if coefficients.ndim > 1 else values[0]

    def wavenumber(self, coefficients: FloatArray) -> float:
        """√(∫y''²/∫y'²) of a function, in rad per unit length."""
        _, slope, bend = self.at_points(coefficients)
        return float(np.sqrt((self.weights @ bend**2) / max(self.weights @ slope**2, TINY)))

    def refined(self, marked: NDArray[np.bool_] | None = None) -> SplineSpace:
        """Return the space with the ``marked`` elements (all, by default) halved."""
        middles = 0.5 * (self.breaks[:-1] + self.breaks[1:])
        new = middles if marked is None else middles[marked]
        mesh = np.sort(np.concatenate([self.breaks, new]))
        return SplineSpace(mesh, self.degree, self.per_element, self.kinks, self.smooth)

    def project(self, values: FloatArray, ends: Ends) -> FloatArray:
        """Coefficients of the L² projection of a function known at the quadrature points, (m,), held ends zero."""
        local = np.einsum("eqa,eq->ea", self._element_table[:, :, 0], self._by_element(self.weights * values))
        load = np.zeros(self.size)
        for a in range(self.degree + 1):
            load[self.starts + a] += local[:, a]
        held = ends.among(self.size)
        mass, free = held.free_part(self.form(np.array([1.0, 0.0, 0.0]))), held.gather(load)
        banded.factorise(mass)
        banded.solve(mass, free)
        return held.spread(free)

    @cached_property
    def symmetric(self) -> bool:
        """Whether the mesh is symmetric about the middle, kinks and all."""
        mirrored = self.elements - self.kink_elements[::-1]
        same = np.max(np.abs(self.breaks + self.breaks[::-1] - 1.0)) <= 1e-13
        alike = np.array_equal(self.smooth, self.smooth[::-1])
        return bool(same) and np.array_equal(self.kink_elements, mirrored) and alike

    @property
    def _element_table(self) -> FloatArray:
        return self.table.reshape(self.elements, -1, 3, self.degree + 1)

    def _by_element(self, values: FloatArray) -> FloatArray:
        return values.reshape(self.elements, -1)


class Prolongation:
    """Exact transfer of splines to a space on a finer, nested mesh."""

    def __init__(self, coarse: SplineSpace, fine: SplineSpace) -> None:
        self.coarse, self.fine = coarse, fine
        self._first, self._weights = basis.insertion_weights(coarse.knots, fine.knots, coarse.degree)

    def __call__(self, coefficients: FloatArray) -> FloatArray:
        """Return the coefficients on the finer space."""
        return np.asarray(basis.insert(self._first, self._weights, coefficients))


def running_integral(values: FloatArray, places: FloatArray) -> FloatArray:
    """Integral (m,) of what has ``values`` (m,) at ``places`` (m,), from the first of these on, by trapezia."""
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(places)
    return np.concatenate([[0.0], np.cumsum(steps)])


NOWHERE = np.empty(0)


def graded_mesh(
    wavenumber: FloatArray, places: FloatArray, per_radian: float, least: int = 8, breaks: FloatArray = NOWHERE
) -> FloatArray:
    """Mesh points whose density follows a local wavenumber.

    Parameters
    ----------
    wavenumber, places
        Local wavenumber k(s) > 0 at ``places``, both (m,), from s = 0 to s = 1.
    per_radian
        Elements per radian of ∫ k ds.
    least
        Smallest number of elements: of a stretch between breaks, its part.
    breaks
        Places inside, rising, (k,), that are mesh points, to the last bit.
    """
    phase = running_integral(wavenumber, places)
    ends = np.concatenate([[0.0], breaks, [1.0]])
    at = np.interp(ends, places, phase)
    counts = np.maximum(np.ceil(per_radian * np.diff(at)), np.ceil(least * np.diff(ends))).astype(int)
    middle = (ends[:-1] < 0.5) & (ends[1:] > 0.5)
    counts[middle] += counts[middle] % 2  # a mesh point at s = 1/2 where the wavenumber is symmetric
    stretches = zip(at[:-1], at[1:], counts, strict=True)
    even = np.concatenate([*(np.linspace(low, high, n, endpoint=False) for low, high, n in stretches), at[-1:]])
    mesh = np.interp(even, phase, places)
    mesh[0], mesh[-1] = 0.0, 1.0
    mirrored = 1.0 - mesh[::-1]
    if np.max(np.abs(mesh - mirrored)) <= MESH_SYMMETRY:
        mesh = 0.5 * (mesh + mirrored)
    mesh[np.cumsum(counts)[:-1]] = breaks
    return np.asarray(mesh)

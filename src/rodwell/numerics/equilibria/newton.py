"""Newton's method for equilibria on a hyperplane: the compiled heart of continuation.

Equilibria g(c, λ) = ∂E/∂c = 0 depend on one number λ through the parameters p(λ). A hyperplane
``row·c + row_λ λ = target`` picks one of them; ``row = 0, row_λ = 1`` means "at this λ". With the Hessian H
and m = ∂g/∂λ each iteration solves the bordered system

    ⎡ H    m   ⎤ ⎡δc⎤      ⎡        g        ⎤
    ⎢          ⎥ ⎢  ⎥ = −  ⎢                 ⎥
    ⎣row  row_λ⎦ ⎣δλ⎦      ⎣row·c + … − target⎦

by mixed block elimination, which stays accurate where H is singular but the system is not, at folds: δλ first from
H w = row, then, for what is left, from H b = m. See W. Govaerts, *Numerical Methods for Bifurcations of Dynamical
Equilibria* (2000), section 3.6. The tangent follows from b, the stability index from the pivots of H: one
factorisation gives all three.
Only some unknowns vary; the others are held by the end conditions or follow their neighbour
(:mod:`rodwell.numerics.splines.held`). A ``parity`` of ±1 keeps
increments even or odd about the middle: it removes the round-off in the direction that breaks the symmetry,
which a nearly singular H would blow up near a symmetry-breaking bifurcation. Where there is no symmetry, a
``frozen`` direction does the same.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rodwell.compiling.kernels import inlined, kernel
from rodwell.numerics.splines.assembly import assemble
from rodwell.numerics.splines.banded import factorise, multiply, solve, solve_both
from rodwell.numerics.splines.held import gather, restrict, spread

DEGREE = np.pi / 180.0
STAGNANT = 100.0
NOTHING_LEFT = 1e-13
CONVERGED, NOT_CONVERGED, DIVERGED, OUT_OF_RANGE = 0, 1, 2, 3
PLAIN = 4
"""Rows of a path that is no series."""


@kernel
def symmetrise(x, parity):
    """Replace ``x`` by its even (parity 1) or odd (−1) part about the middle; 0 leaves it."""
    if parity != 0:
        n = x.size
        for i in range((n + 1) // 2):
            part = 0.5 * (x[i] + parity * x[n - 1 - i])
            x[i] = part
            x[n - 1 - i] = parity * part


@kernel
def deflate(x, vector, covector):
    """Remove from ``x`` its part along ``vector``, which ``covector`` measures; empty ones leave it."""
    part = 0.0
    for i in range(vector.size):
        part += covector[i] * x[i]
    for i in range(vector.size):
        x[i] -= part * vector[i]


@kernel
def on_path(path, lam, parameters, rates):
    """Write the parameters p(λ) and their derivatives, see :class:`rodwell.numerics.equilibria.family.Family`."""
    angle = lam * DEGREE
    cos, sin = np.cos(angle), np.sin(angle)
    for i in range(parameters.size):
        parameters[i] = path[0, i] + lam * path[1, i] + cos * path[2, i] + sin * path[3, i]
        rates[i] = path[1, i] + DEGREE * (cos * path[3, i] - sin * path[2, i])
    if path.shape[0] > PLAIN:
        _add_series(path, lam, parameters, rates)


@inlined
def _add_series(path, lam, parameters, rates):
    """Add Chebyshev series and their derivatives: see :mod:`rodwell.numerics.equilibria.series`."""
    x = path[PLAIN, 0] + path[PLAIN, 1] * lam
    inside = min(1.0, max(-1.0, x))
    for i in range(parameters.size):
        value = rate = slope = 0.0
        term, next_term, next_slope = 1.0, inside, 1.0  # of T_k, T_k+1
        for k in range(PLAIN + 1, path.shape[0]):
            value += path[k, i] * term
            rate += path[k, i] * slope
            slope, next_slope = next_slope, 2.0 * next_term + 2.0 * inside * next_slope - slope
            term, next_term = next_term, 2.0 * inside * next_term - term
        parameters[i] += value + rate * (x - inside)
        rates[i] += path[PLAIN, 1] * rate


@kernel
def dot(x, y):
    """Return x·y."""
    total = 0.0
    for i in range(x.size):
        total += x[i] * y[i]
    return total


@inlined
def _solve_within(mesh, factors, x, frozen, covector):
    """Solve H x = b in place for the unknowns of ``x`` (n,), within the symmetry and off the frozen direction."""
    deflate(x, covector, frozen)  # what H would blow up is kept out of the right-hand side ...
    solve(factors, x)
    keep_within(x, mesh.held, mesh.follows, mesh.parity, frozen, covector)  # ... and out of the solution


@inlined
def _solve_both_within(mesh, factors, x, y, frozen, covector):
    """Solve for two right-hand sides as :func:`_solve_within` does."""
    deflate(x, covector, frozen)
    deflate(y, covector, frozen)
    solve_both(factors, x, y)
    keep_within(x, mesh.held, mesh.follows, mesh.parity, frozen, covector)
    keep_within(y, mesh.held, mesh.follows, mesh.parity, frozen, covector)


@kernel
def keep_within(x, held, follows, parity, frozen, covector):
    """Let what is held follow, and keep ``x`` (n,) within the symmetry and off the frozen direction, in place."""
    spread(x, held, follows)
    symmetrise(x, parity)
    deflate(x, frozen, covector)


@inlined
def _move(c, a, b, more_dlam, dlam, gradient, mixed):
    """Add the step δc = a − δλ₂ b to ``c``; return its largest entry and ½ (g + m δλ)·δc.

    The latter is what δc changes the energy by, to second order: g·δc + m·δc δλ + ½ δc·H δc with H δc = −g − m δλ.
    """
    largest = work = 0.0
    for i in range(c.size):
        dc = a[i] - more_dlam * b[i]
        c[i] += dc
        largest = max(largest, abs(dc))
        work += 0.5 * (gradient[i] + mixed[i] * dlam) * dc
    return largest, work


@inlined
def _settles(step, previous):
    """Whether the next Newton step would be below round-off: convergence is quadratic, step = κ previous²."""
    return step < previous < 1.0 and step**3 <= NOTHING_LEFT * previous**2


class Tolerances(NamedTuple):
    """When Newton's method has converged, and the sizes (one metric) in which that is measured.

    Attributes
    ----------
    step
        The first step below this ends the iteration: convergence is quadratic, the error left is about its square.
    most
        Steps at most.
    extra
        Steps after convergence: pivots and tangent belong to the iterate before the last step, and locating a change of
        the index takes them at the solution itself.
    size_c, size_lam
        Of the coefficients, and of λ: steps are measured against them, and λ in the metric.
    size_slope
        Of y′, in the metric (:mod:`rodwell.numerics.equilibria.family`).
    """

    step: float
    most: int
    extra: int
    size_c: float
    size_lam: float
    size_slope: float


@kernel
def newton(mesh, tolerances, path, row, row_lam, target, frozen, covector, c, lam, tangent, new_row):
    """Move ``c`` (n,) in place to the equilibrium on the hyperplane; return what came of it.

    ``mesh`` is a :class:`rodwell.numerics.splines.records.Discretisation`, ``tolerances`` are :class:`Tolerances`. The
    parameters are those of ``path``, see :class:`rodwell.numerics.equilibria.family.Family`.
    Iteration ends with the first step below the tolerance, or with one from
    which as small an error can be foreseen, and fails after too many steps, or as soon as a step is not smaller than
    the one before it, unless both are so small that round-off in a nearly singular H explains it (the two meshes then
    disagree by as much).

    Written: ``tangent`` (n,) of the branch of equilibria, of length one in the metric and towards growing
    ``row·c + row_λ λ``, and its covector ``new_row`` (n,).

    Returns
    -------
    status, λ, λ components of tangent and covector, negative pivots of H, energy, number of steps, last factors of H
    """
    n = c.size
    gradient, mixed = np.empty(n), np.empty(n)
    band = np.empty((n, len(mesh.local) * len(mesh.model)))
    a, b, w = np.zeros(n), np.zeros(n), np.zeros(n)
    parameters, rates = np.empty(path.shape[1]), np.empty(path.shape[1])
    previous = np.inf
    status, negative, energy, settled, iteration = NOT_CONVERGED, -1, np.nan, 0, 0
    while status == NOT_CONVERGED and iteration < tolerances.most + tolerances.extra:
        iteration += 1
        on_path(path, lam, parameters, rates)
        energy, rate = assemble(mesh, c, parameters, rates, gradient, mixed, band)
        if not np.isfinite(energy):
            status = OUT_OF_RANGE
            break
        restrict(band, mesh.held, mesh.follows)
        gather(gradient, mesh.held, mesh.follows)
        gather(mixed, mesh.held, mesh.follows)
        negative = factorise(band)
        gap = target - row_lam * lam - dot(row, c)
        for i in range(n):
            b[i], w[i] = mixed[i], row[i]
        gather(w, mesh.held, mesh.follows)
        _solve_both_within(mesh, band, b, w, frozen, covector)
        first_dlam, lever = gap, row_lam
        for i in range(n):
            first_dlam += w[i] * gradient[i]
            lever -= w[i] * mixed[i]
        first_dlam /= lever
        for i in range(n):
            a[i] = -gradient[i] - mixed[i] * first_dlam
        _solve_within(mesh, band, a, frozen, covector)
        more_dlam = (gap - row_lam * first_dlam - dot(row, a)) / (row_lam - dot(row, b))
        dlam = first_dlam + more_dlam
        largest, work = _move(c, a, b, more_dlam, dlam, gradient, mixed)
        step = max(abs(dlam) / tolerances.size_lam, largest / tolerances.size_c)
        energy += rate * dlam + work
        lam += dlam
        grows = iteration > 1 and step > previous
        settled += int(step <= tolerances.step or settled > 0 or _settles(step, previous) or grows)
        if not np.isfinite(step) or (grows and settled == 1 and max(step, previous) > STAGNANT * tolerances.step):
            status = DIVERGED  # a step that grows, and not in round-off
        elif settled > tolerances.extra:
            status = CONVERGED
        previous = step
    sign = -1.0 if dot(row, b) <= row_lam else 1.0  # the tangent is (−b, 1), towards growing row·c + row_λ λ
    for i in range(n):
        tangent[i] = sign * b[i]
    tangent_lam, new_row_lam = hyperplane(
        mesh.gram, tolerances.size_slope**-2, tolerances.size_lam**-2, tangent, -sign, new_row
    )
    return status, lam, tangent_lam, new_row_lam, negative, energy, iteration, band


@kernel
def inverse_iteration(gram, held, follows, factors, iterations, vector):
    """Turn ``vector`` (n,), in place, towards the H v = μ G v with μ nearest to zero; its largest entry becomes 1.

    ``factors`` are those of H, ``gram`` is the band of G, the integrals of u′v′; what is ``held`` and ``follows`` what
    is that of a :class:`rodwell.numerics.splines.records.Discretisation`.
    """
    for _ in range(iterations):
        new = multiply(gram, vector)
        gather(new, held, follows)
        solve(factors, new)
        largest = 0.0
        for i in range(new.size):
            largest = max(largest, abs(new[i]))
        for i in range(new.size):
            vector[i] = new[i] / largest
        spread(vector, held, follows)


@kernel
def hyperplane(gram, weight_c, weight_lam, tangent_c, tangent_lam, row):
    """Covector of a tangent in the metric ``weight_c cᵀ G c + weight_λ λ²``: normalises the tangent in place.

    Written: ``row`` (n,), and ``tangent_c``, scaled to length one with its λ component. Returns that component and
    ``row_λ``.
    """
    product = multiply(gram, tangent_c)
    square = weight_lam * tangent_lam * tangent_lam
    for i in range(row.size):
        row[i] = weight_c * product[i]
        square += row[i] * tangent_c[i]
    length = np.sqrt(square)
    for i in range(row.size):
        row[i] /= length
        tangent_c[i] /= length
    return tangent_lam / length, weight_lam * tangent_lam / length

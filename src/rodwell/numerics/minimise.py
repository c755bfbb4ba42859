"""Minima of the energy from poor starts: Newton's method, shifted until it goes downhill."""

from __future__ import annotations

import numpy as np

from rodwell.jit import kernel
from rodwell.numerics.assembly import assemble
from rodwell.numerics.banded import factorise, solve
from rodwell.numerics.corrector import CONVERGED, NOT_CONVERGED, OUT_OF_RANGE, held_out, symmetrise


@kernel
def minimise(
    model, local_tag, table, points, weights, gram, first, last, parity, c, parameters, scale_c, tolerance, most
):  # fmt: skip
    """Move ``c`` (n,) in place to a local minimum of the energy at fixed ``parameters``.

    Each step solves (H + σ G) δ = −g with the smallest σ ≥ 0 of a rising sequence that makes the matrix
    positive definite, and is halved until the energy falls (Armijo). It ends with an unshifted, full
    Newton step below ``tolerance`` against ``scale_c``. See J. Nocedal and S. J. Wright, *Numerical
    Optimization* (2006), algorithms 3.2 and 3.3.

    Returns
    -------
    status, number of steps
    """
    n = c.size
    gradient, mixed = np.empty(n), np.empty(n)
    band = np.empty((n, table.shape[2]))
    rates = np.zeros(parameters.size)
    step = np.zeros(n)
    trial = np.empty(n)
    sigma = 0.0
    energy = assemble(model, local_tag, table, points, weights, c, parameters, rates, gradient, mixed, band)
    if not np.isfinite(energy):
        return OUT_OF_RANGE, 0
    for iteration in range(1, most + 1):
        sigma = 0.0 if sigma < 1e-3 else 0.1 * sigma
        while True:
            inner = held_out(band + sigma * gram, first, last)
            if factorise(inner) == 0:
                break
            sigma = max(1.0, 4.0 * sigma)
        step[first:last] = -gradient[first:last]
        solve(inner, step[first:last])
        symmetrise(step, parity)
        size, slope = 0.0, 0.0
        for i in range(n):
            size = max(size, abs(step[i]) / scale_c)
            slope += gradient[i] * step[i] if first <= i < last else 0.0
        length = 1.0
        while True:
            trial[:] = c + length * step
            new = assemble(model, local_tag, table, points, weights, trial, parameters, rates, gradient, mixed, band)
            if np.isfinite(new) and (new <= energy + 1e-4 * length * slope or size < 1e-6):
                break
            length *= 0.5
            if length < 1e-12:
                return NOT_CONVERGED, iteration
        c[:] = trial
        energy = new
        if sigma == 0.0 and length == 1.0 and size <= tolerance:
            return CONVERGED, iteration
    return NOT_CONVERGED, most

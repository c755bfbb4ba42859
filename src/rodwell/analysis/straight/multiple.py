"""Critical loads that coincide: which do, and their modes told apart.

Vectors of equal eigenvalues come as any mixture. Where a reflection maps the problem onto itself, modes are even and
odd. Of the same parity, or without any, those are taken in which ∫y″² and ∫y′² are both diagonal: of a horizontal rod
with pinned and guided ends, single waves.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray

CLOSE = 1e-6
"""Relative difference of values below which vectors are told apart here: farther apart, they come unmixed."""

EQUAL = 1e-12
"""The same below which nothing but round-off tells values apart."""

ONE = 1e-11
"""Relative difference of critical loads, beyond their errors, that count as one: the branch that joins those of both
modes then leaves them at amplitudes of some 1e-6 rad, where round-off hides it."""


def close_to_last(values: FloatArray, count: int) -> int:
    """How many of ``values`` (k,), rising, have to be looked at for the first ``count`` to be told apart."""
    end = count
    while end < len(values) and _apart(values, count - 1, end) < CLOSE:
        end += 1
    return end


def equal_to(values: FloatArray, errors: FloatArray, i: int) -> tuple[int, ...]:
    """Numbers, from 1, of the ``values`` that count as equal to number ``i`` + 1, which is among them."""
    near = errors + errors[i] + ONE * (np.abs(values[i]) + 1.0)
    return tuple(int(k) + 1 for k in np.flatnonzero(np.abs(values - values[i]) <= near))


def told_apart(
    space: SplineSpace, factors: FloatArray, values: FloatArray, vectors: FloatArray, *, symmetric: bool
) -> tuple[FloatArray, FloatArray]:
    """Values (k,), rising, and vectors (k, n) with ∫v′² = 1, of which those that (nearly) coincide are told apart.

    ``factors`` (3, m) are those of v², v′², v″² in the second variation; ``symmetric`` says that turning the rod round
    leaves it as it is. Of equal values the longer waves come first.
    """
    out, values = vectors[: len(values)].copy(), values.copy()
    for i, j in _runs(values, CLOSE):
        parts = _by_parity(space, out[i:j]) if symmetric else [out[i:j]]
        unmixed = np.concatenate([_unmixed(space, factors, part) for part in parts])
        waves = np.array([space.wavenumber(v) for v in unmixed])
        quotients = _form(space, factors, unmixed).diagonal()
        order = np.argsort(quotients)
        for first, last in _runs(quotients[order], EQUAL):
            order[first:last] = order[first:last][np.argsort(waves[order[first:last]])]
        values[i:j], out[i:j] = np.sort(quotients), unmixed[order]
    return values, out


def _apart(values: FloatArray, i: int, j: int) -> float:
    return float((values[j] - values[i]) / (abs(values[i]) + 1.0))


def _runs(values: FloatArray, apart: float) -> Iterator[tuple[int, int]]:
    """Where two or more of the values, rising, lie no farther ``apart`` than that: first and past the last."""
    i = 0
    while i < len(values):
        j = i + 1
        while j < len(values) and _apart(values, i, j) < apart:
            j += 1
        if j > i + 1:
            yield i, j
        i = j


def _form(space: SplineSpace, factors: FloatArray, vectors: FloatArray) -> FloatArray:
    """Gram matrix of vectors (k, n) under a quadratic form with ``factors`` (3, m) of v², v′², v″²."""
    fields = space.at_points(vectors)
    return np.asarray(np.einsum("idm,dm,jdm->ij", fields, factors * space.weights, fields))


def _by_parity(space: SplineSpace, vectors: FloatArray) -> list[FloatArray]:
    """Even and odd mixtures of vectors (k, n), in two blocks of which one may be empty."""
    slopes, mirrored = (space.at_points(np.ascontiguousarray(v))[:, 1] for v in (vectors, vectors[:, ::-1]))
    reflection = (slopes * space.weights) @ mirrored.T
    signs, turn = np.linalg.eigh(0.5 * (reflection + reflection.T))
    return [turn[:, signs > 0.0].T @ vectors, turn[:, signs < 0.0].T @ vectors]


def _unmixed(space: SplineSpace, factors: FloatArray, vectors: FloatArray) -> FloatArray:
    """Mixtures of vectors (k, n) in which the second variation is diagonal and, among equal values, ∫v″² is too."""
    if len(vectors) < 2:
        return vectors
    values, turn = np.linalg.eigh(_form(space, factors, vectors))
    out = turn.T @ vectors
    bending = np.zeros_like(factors)
    bending[2] = 1.0
    for i, j in _runs(values, EQUAL):
        out[i:j] = np.linalg.eigh(_form(space, bending, out[i:j]))[1].T @ out[i:j]
    return out

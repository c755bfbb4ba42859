"""The axis of a hole as a table: a smooth curve by arclength, with its rotation-minimising frame and curvatures."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev

from rodwell.quantities.arrays import FloatArray

DEGREE = 16
"""Of the polynomials between breaks."""

RESOLVED = 1e-13
"""Pieces are halved until the last coefficients of the curve are below this, or until there is nothing to gain."""

MOST_HALVINGS = 5

FARTHER = 0.1
"""Part of the first and of the last piece for which their polynomials go on beyond the ends."""

NODES = -np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
TO_COEFFICIENTS = np.linalg.inv(chebyshev.chebvander(NODES, DEGREE))
INTEGRAL = np.stack(
    [chebyshev.chebval(NODES, chebyshev.chebint(column, lbnd=-1.0)) for column in TO_COEFFICIENTS.T], axis=1
)
"""From values at the nodes to integrals from −1 to each node, (DEGREE + 1, DEGREE + 1)."""

Motion = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""From parameters u (n,) to dX/du and d²X/du², (n, 3) each."""


@dataclass(frozen=True, eq=False)
class Axis:
    """A curve in space by arclength, in pieces of Chebyshev polynomials.

    Attributes
    ----------
    breaks
        Arclengths where pieces meet, (m + 1,), from 0.
    coefficients
        Of k1, k2, then of N1, N2, T and X, of each piece, (DEGREE + 1, m, 14).
    error
        Largest of the last coefficients, of points over a length above 1: how far frames and points may be from those
        of the curve that was tabulated.
    """

    breaks: FloatArray
    coefficients: FloatArray
    error: float

    @property
    def length(self) -> float:
        """Arclength of the whole."""
        return float(self.breaks[-1])

    @cached_property
    def _reach(self) -> tuple[float, float]:
        """Arclengths up to which the polynomials of the first and the last piece are taken."""
        first, last = np.diff(self.breaks)[[0, -1]]
        return -FARTHER * float(first), self.length + FARTHER * float(last)

    def at(self, places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Curvatures (n, 2), frames (n, 3, 3) with rows N1, N2, T, and points (n, 3) at arclengths (n,).

        Beyond either end the curve goes on as its last piece does, for a tenth of that, then as a circle: a rod on
        the outside of a bend reaches a little beyond, and a kink of the curvature there would be one of its contact.
        """
        places = np.atleast_1d(np.asarray(places, dtype=float))
        values = self._values(places, self._by_piece)
        curvatures, frames, points = values[:, :2], values[:, 2:11].reshape(-1, 3, 3), values[:, 11:]
        farther = (places < 0.0) | (places > self.length)
        frames[farther] = _right_angled(frames[farther])
        low, high = self._reach
        for beyond, end in ((places < low, low), (places > high, high)):
            if beyond.any():
                first = int(np.argmax(beyond))
                ahead = places[beyond] - end
                frames[beyond], points[beyond] = circle(curvatures[first], frames[first], points[first], ahead)
        return curvatures, frames, points

    def rates(self, places: FloatArray) -> FloatArray:
        """Derivatives of k1, k2 by arclength, (n, 2), at arclengths (n,); 0 on the circles beyond either end."""
        low, high = self._reach
        beyond = (places < low) | (places > high)
        return np.where(beyond[:, None], 0.0, self._values(places, self._rates_by_piece))

    def _values(self, places: FloatArray, pieces: FloatArray) -> FloatArray:
        """Polynomials at arclengths (n,), (n, k), from their coefficients, (m, terms, k); on circles as they begin."""
        inside = np.clip(places, *self._reach)
        piece = np.searchsorted(self.breaks[1:-1], inside, side="right")
        low, high = self.breaks[piece], self.breaks[piece + 1]
        local = 2.0 * (inside - low) / (high - low) - 1.0
        table = np.ascontiguousarray(chebyshev.chebvander(local, pieces.shape[1] - 1))
        order = None
        if np.any(np.diff(piece) < 0):  # places come in order mostly: then nothing is moved
            order = np.argsort(piece, kind="stable")
            piece, table = piece[order], table[order]
        values = np.empty((piece.size, pieces.shape[2]))
        ends = [*(np.flatnonzero(np.diff(piece)) + 1).tolist(), piece.size]
        begin = 0
        for end in ends:
            np.matmul(table[begin:end], pieces[piece[begin]], out=values[begin:end])
            begin = end
        if order is None:
            return values
        moved = np.empty_like(values)
        moved[order] = values
        return moved

    @cached_property
    def _by_piece(self) -> FloatArray:
        """The coefficients with those of a piece side by side, (m, DEGREE + 1, 14)."""
        return np.ascontiguousarray(np.swapaxes(self.coefficients, 0, 1))

    @cached_property
    def _rates_by_piece(self) -> FloatArray:
        """Those of the derivatives of k1, k2 by arclength, (m, DEGREE, 2)."""
        rates = chebyshev.chebder(self.coefficients[..., :2]) * (2.0 / np.diff(self.breaks))[:, None]
        return np.ascontiguousarray(np.swapaxes(rates, 0, 1))

    def turned(self, angle: float) -> Axis:
        """The same axis with N1, N2 turned by ``angle`` around T, from N1 towards N2."""
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        out = self.coefficients.copy()
        out[..., :2] = out[..., :2] @ turn.T
        normals = out[..., 2:8].reshape(*out.shape[:2], 2, 3)
        out[..., 2:8] = np.einsum("ij,...jc->...ic", turn, normals).reshape(*out.shape[:2], 6)
        return Axis(self.breaks, out, self.error)

    def without(self, curvatures: tuple[int, ...]) -> Axis:
        """The same axis with curvatures of these numbers exactly zero: what is left of them is round-off."""
        out = self.coefficients.copy()
        out[..., list(curvatures)] = 0.0
        return Axis(self.breaks, out, self.error)

    @cached_property
    def samples(self) -> tuple[FloatArray, FloatArray]:
        """Arclengths, rising, and curvatures k1, k2 there, (n,) and (n, 2): eight in every piece, and both ends."""
        inner = (np.arange(8) + 0.5) / 8.0
        places = (self.breaks[:-1, None] + np.diff(self.breaks)[:, None] * inner).ravel()
        places = np.concatenate([[0.0], places, [self.length]])
        return places, self.at(places)[0]


def _right_angled(frames: FloatArray) -> FloatArray:
    """Frames (n, 3, 3) whose rows are unit vectors at right angles but for round-off, which grows beyond an end."""
    tangent = frames[:, 2] / np.linalg.norm(frames[:, 2], axis=1, keepdims=True)
    first = frames[:, 0] - np.sum(frames[:, 0] * tangent, axis=1, keepdims=True) * tangent
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([first, np.cross(tangent, first), tangent], axis=1)


def circle(
    curvatures: FloatArray, frame: FloatArray, start: FloatArray, ahead: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Frames (n, 3, 3) and points (n, 3) of the circle with constant k1, k2 from a frame and a point, in closed form.

    T' = k1 N1 + k2 N2 makes T = T₀ cos κu + k sin(κu)/κ with k = k1 N1 + k2 N2 at u = 0, and Ni' = −ki T makes
    Ni − Ni₀ = −ki (X − X₀).
    """
    kappa = float(np.hypot(*curvatures))
    normal = curvatures @ frame[:2]
    sine = (ahead * np.sinc(kappa * ahead / np.pi))[:, None]
    rise = (0.5 * (ahead * np.sinc(0.5 * kappa * ahead / np.pi)) ** 2)[:, None]
    moved = sine * frame[2] + rise * normal
    tangents = np.cos(kappa * ahead)[:, None] * frame[2] + sine * normal
    normals = frame[:2] - curvatures[:, None] * moved[:, None, :]
    return np.concatenate([normals, tangents[:, None]], axis=1), start + moved


def tabulate(parameters: FloatArray, motion: Motion, start: FloatArray) -> Axis:
    """Table of the curve of ``motion`` from ``start``, over ``parameters`` (m + 1,) between which it is smooth.

    The frame at the beginning is any; that of an axis is turned afterwards (:meth:`Axis.turned`).
    """
    for halving in range(MOST_HALVINGS + 1):
        axis = _tabulated(parameters, motion, start)
        if axis.error < RESOLVED or halving == MOST_HALVINGS:
            break
        middle = 0.5 * (parameters[1:] + parameters[:-1])
        parameters = np.insert(parameters, np.arange(1, parameters.size), middle)
    return axis


def _tabulated(parameters: FloatArray, motion: Motion, start: FloatArray) -> Axis:
    nodes, lengths = _by_arclength(parameters, motion)
    first, second = (part.reshape(*nodes.shape, 3) for part in motion(nodes.ravel()))
    speed = np.linalg.norm(first, axis=-1, keepdims=True)
    tangents = first / speed
    bend = second / speed**2
    bend -= np.sum(bend * tangents, axis=-1, keepdims=True) * tangents
    half = 0.5 * lengths[:, None, None]
    steps = half * np.einsum("ij,mjc->mic", INTEGRAL, tangents)
    points = start + np.concatenate([np.zeros((1, 3)), np.cumsum(steps[:-1, -1], axis=0)])[:, None, :] + steps
    normals = _carried(tangents, bend, half[..., 0])
    curvatures = np.einsum("mjc,mjic->mji", bend, normals)
    whole = np.concatenate(
        [curvatures, normals.reshape(*nodes.shape, 6), tangents, points], axis=-1
    )  # (m, DEGREE + 1, 14)
    coefficients = np.einsum("kj,mjc->kmc", TO_COEFFICIENTS, whole)
    breaks = np.concatenate([[0.0], np.cumsum(lengths)])
    last = np.abs(coefficients[-2:, :, 2:])
    last[..., -3:] /= max(1.0, breaks[-1])
    return Axis(breaks, coefficients, float(last.max()))


def _by_arclength(parameters: FloatArray, motion: Motion) -> tuple[FloatArray, FloatArray]:
    """Parameters at which nodes are equally far along the curve as along the piece, (m, k), and lengths (m,)."""
    low, width = parameters[:-1, None], np.diff(parameters)[:, None]
    wanted = 0.5 * (NODES + 1.0)
    nodes = low + width * wanted
    speed = np.linalg.norm(motion(nodes.ravel())[0], axis=-1).reshape(nodes.shape)
    along = 0.5 * width * (speed @ INTEGRAL.T)
    lengths = along[:, -1]
    rates, sums = speed @ TO_COEFFICIENTS.T, along @ TO_COEFFICIENTS.T
    local = np.broadcast_to(NODES, nodes.shape).copy()
    for _ in range(6):  # Newton's method, whose errors are squared: speeds in a piece differ little
        table = chebyshev.chebvander(local, DEGREE)
        missing = lengths[:, None] * wanted - np.einsum("mjk,mk->mj", table, sums)
        step = missing / (0.5 * width * np.einsum("mjk,mk->mj", table, rates))
        local = np.clip(local + step, -1.0, 1.0)
        if np.max(np.abs(step)) < 1e-14:
            break
    return low + 0.5 * width * (local + 1.0), lengths


def _carried(tangents: FloatArray, bend: FloatArray, half: FloatArray) -> FloatArray:
    """N1, N2 at the nodes, (m, k, 2, 3), carried along without twist.

    In a piece the frame is first turned with the tangent on the shortest way from the piece's beginning a; that way
    twists at the rate −a·(T × T')/(1 + a·T), which is integrated and taken back.
    """
    begin = tangents[:, :1]
    denominator = 1.0 + np.sum(begin * tangents, axis=-1)
    rate = np.sum(begin * np.cross(tangents, bend), axis=-1) / denominator
    angle = half * (rate @ INTEGRAL.T)
    out = np.empty((*angle.shape, 2, 3))
    carried = _any_normals(tangents[0, 0])
    for i in range(len(out)):
        along = np.einsum("ic,jc->ji", carried, tangents[i]) / denominator[i][:, None]
        plain = carried - along[..., None] * (begin[i] + tangents[i])[:, None, :]
        c, s = np.cos(angle[i]), np.sin(angle[i])
        turn = np.stack([np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)], axis=-2)
        out[i] = np.einsum("jab,jbc->jac", turn, plain)
        carried = out[i, -1]
    return out


def _any_normals(tangent: FloatArray) -> FloatArray:
    """Two unit vectors (2, 3) that make a right-handed frame with the tangent as third."""
    least = np.eye(3)[int(np.argmin(np.abs(tangent)))]
    first = least - (least @ tangent) * tangent
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(tangent, first)])

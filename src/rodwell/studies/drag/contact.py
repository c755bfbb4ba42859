"""Contact force per length of a string in a hole, by the local state: straight, sinusoidal or helical.

A string under the effective tension F (compression P = −F) in a hole of curvature κ is pressed to the wall by

    q = √((F κ + w g·N)² + (w g·b)²)

per length (g downwards, N normal and b binormal of the hole; Johancsik 1984). Lying straight that is the contact force.
An endless rod under P and q knows only β = P/√(B q/r): it is straight up to β = 2, then sinusoidal, then helical, and

    n̄ = q f(β)                   sinusoidal, exact
    n̄ = (r P²/4B) g(1/β²)        helical, exact: g → 1 for β → ∞, and q may be nought
    n̄ = q + r P²/4B              helical, as the correlation of practice has it

What is exact comes as tables (:class:`Law`), made by :mod:`rodwell.studies.drag.laws`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rodwell.compiling.kernels import formula
from rodwell.quantities.arrays import FloatArray

STRAIGHT, SINUSOIDAL, HELICAL = 0, 1, 2
NAMES = ("straight", "sinusoidal", "helical")

SMALL = 0.1
"""Angles in rad below have their sines from a series, to the last digit."""

BUCKLES = 2.0
"""β at which the straight rod buckles: Dawson and Paslay's load."""

NO_BUCKLING, CORRELATION, EXACT = 0.0, 1.0, 2.0

PIECE = (
    "length",
    "angle",
    "curvature",
    "cosine",
    "slope",
    "across",
    "weight",
    "ratio",
    "axial",
    "turning",
    "helix_from",
    "stiff",
)
"""What a piece of string in a piece of hole is, from its lower end, all constant along it: its length; the angle of the
arc from the upper station of the course to the lower end; κ; cos α and g·N at that station; g·b; buoyed weight w; B/r;
± μ times the axial part of the slip (positive: friction adds to the tension upwards); μ r_outer times its part around
the string; β from which the string is helical; what bending adds to the contact force of the straight-lying string."""

LENGTH, ANGLE, CURVATURE, COSINE, SLOPE, ACROSS, WEIGHT, RATIO, AXIAL, TURNING, HELIX_FROM, STIFF = range(12)


class Law(NamedTuple):
    """How a local state presses the wall, for kernels.

    Attributes
    ----------
    kind
        (3,): NO_BUCKLING, CORRELATION or EXACT; steps of the two tables in β − 2 and in 1/β².
    sinusoidal, helical
        Values of f and of g and their slopes, times the step, (m, 2), from β = 2 and from 1/β² = 0.
    """

    kind: FloatArray
    sinusoidal: FloatArray
    helical: FloatArray


_NONE = np.array([[1.0, 0.0], [1.0, 0.0]])
WITHOUT_BUCKLING = Law(np.array([NO_BUCKLING, 1.0, 1.0]), _NONE, _NONE)
CORRELATED = Law(np.array([CORRELATION, 1.0, 1.0]), _NONE, _NONE)


@formula
def between(table, x):
    """A cubic through values and slopes at 0, 1, …; beyond the table its last piece."""
    i = min(max(int(x), 0), table.shape[0] - 2)
    t = x - i
    rise = table[i + 1, 0] - table[i, 0]
    bend = (1.0 - t) * (table[i, 1] - rise) - t * (table[i + 1, 1] - rise)
    return table[i, 0] + t * (rise + (1.0 - t) * bend)


@formula
def along(piece, up):
    """Height gained over ``up`` along the hole above the lower end of a piece, in m, and g·N there."""
    half = 0.5 * piece[CURVATURE] * up
    middle = piece[ANGLE] - half
    c, s = np.cos(middle), np.sin(middle)
    if abs(half) < SMALL:
        x = half * half
        sinc = 1.0 - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0)))
        cosine = 1.0 - x / 2.0 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0)))
        sine = half * sinc
    else:
        sine, cosine = np.sin(half), np.cos(half)
        sinc = sine / half
    rise = up * sinc * (piece[COSINE] * c + piece[SLOPE] * s)
    return rise, piece[SLOPE] * (c * cosine + s * sine) - piece[COSINE] * (s * cosine - c * sine)


@formula
def cosine_at(piece, up):
    """Cos α at a height above the lower end of a piece."""
    angle = piece[ANGLE] - piece[CURVATURE] * up
    return piece[COSINE] * np.cos(angle) + piece[SLOPE] * np.sin(angle)


@formula
def in_plane(piece, lateral, force):
    """F κ + w g·N, ``lateral`` is g·N."""
    return force * piece[CURVATURE] + piece[WEIGHT] * lateral


@formula
def pressed(piece, lateral, force):
    """The load q that presses the straight-lying string to the wall."""
    inward, across = in_plane(piece, lateral, force), piece[WEIGHT] * piece[ACROSS]
    return np.sqrt(inward * inward + across * across)


@formula
def state_of(piece, q, force):
    """The local state by the rule of the piece."""
    unit = np.sqrt(piece[RATIO] * q)
    compression = -force
    if compression <= 0.0 or compression < min(BUCKLES, piece[HELIX_FROM]) * unit:
        return STRAIGHT
    return HELICAL if compression >= piece[HELIX_FROM] * unit else SINUSOIDAL


@formula
def contact(piece, law, lateral, force, state, sign):
    """Contact force per length in a given state; ``sign`` is that of F κ + w g·N where the hole stays in a plane."""
    if state == STRAIGHT and piece[ACROSS] == 0.0:
        return sign * in_plane(piece, lateral, force) + piece[STIFF]
    q = pressed(piece, lateral, force)
    if state == STRAIGHT:
        return q + piece[STIFF]
    if law.kind[0] == CORRELATION:
        return q if state == SINUSOIDAL else q + 0.25 * force * force / piece[RATIO]
    if state == SINUSOIDAL:
        beta = -force / np.sqrt(piece[RATIO] * q)
        return q * between(law.sinusoidal, (beta - BUCKLES) / law.kind[1])
    return 0.25 * force * force / piece[RATIO] * between(law.helical, q * piece[RATIO] / (force * force) / law.kind[2])

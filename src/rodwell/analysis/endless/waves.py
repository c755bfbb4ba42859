"""Periodic states of the endless rod as Fourier series, with the wavelength of least energy, by Newton's method.

A state is θ(x) = mφ + Σ aₙ sin nφ, φ = kx: sinusoidal with m = 0 and odd n, helical (one turn per period) with m = 1
and every n. Unknowns are the amplitudes aₙ and log k, for the mean of the energy over a period must be stationary in
both: a rod without ends takes the wavelength of least energy. Means over equidistant places are exact for Fourier
series up to what their truncation leaves out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rodwell.errors import NotConvergedError
from rodwell.physics.on_wall.endless import Density, density, load_derivative
from rodwell.quantities.arrays import FloatArray

SINUSOIDAL, HELICAL = "sinusoidal", "helical"
KINDS = (SINUSOIDAL, HELICAL)

MOST_ITERATIONS, CONVERGED, LONGEST_STEP = 40, 1e-13, 0.3
STALLED = 1e-8
"""Size of a step that may be the last if it is not much less than the one before: near a fold round-off makes it."""


class Basis(NamedTuple):
    """Harmonics of a kind of state on the places of a period.

    ``turns`` is m; ``orders`` (n,) the harmonics; ``phase`` (p,) the places φ; ``values`` (3, p, n) holds sin nφ and
    its first two derivatives by φ.
    """

    turns: float
    orders: FloatArray
    phase: FloatArray
    values: FloatArray


@lru_cache(maxsize=32)
def basis(kind: str, count: int) -> Basis:
    """The first ``count`` harmonics of a kind, on as many places as products of several of them need."""
    numbers = np.arange(1.0, count + 1.0)
    orders = 2.0 * numbers - 1.0 if kind == SINUSOIDAL else numbers
    phase = 2.0 * np.pi * np.arange(16 * count) / (16 * count)
    return Basis(0.0 if kind == SINUSOIDAL else 1.0, orders, phase, harmonics(phase, orders, 2))


def harmonics(phase: FloatArray, orders: FloatArray, most: int) -> FloatArray:
    """Sin nφ and its derivatives up to the order ``most``, (most + 1, p, n)."""
    angle = np.outer(phase, orders)
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.stack([orders**d * (sine, cosine, -sine, -cosine)[d % 4] for d in range(most + 1)])


@dataclass(frozen=True)
class Wave:
    """One periodic state on one set of harmonics.

    Attributes
    ----------
    kind
        ``"sinusoidal"`` or ``"helical"``.
    beta, slope
        β and ε.
    amplitudes
        aₙ (n,), in rad.
    frequency
        k, in rad per ℓ.
    stiffness
        Lowest eigenvalue of the second derivatives of the mean energy by amplitudes and log k: 0 at a fold.
    """

    kind: str
    beta: float
    slope: float
    amplitudes: FloatArray
    frequency: float
    stiffness: float

    def angles(self, phase: FloatArray, most: int = 3) -> FloatArray:
        """θ and its derivatives by x up to the order ``most``, (most + 1, p), at the places φ (p,)."""
        turns, orders, *_ = basis(self.kind, len(self.amplitudes))
        found = harmonics(phase, orders, most) @ self.amplitudes
        found[0] += turns * phase
        if most > 0:
            found[1] += turns
        return np.asarray(found * self.frequency ** np.arange(most + 1.0)[:, None])

    def terms(self) -> Density:
        """The energy per length and its derivatives on the places of the basis."""
        _, _, phase, _ = basis(self.kind, len(self.amplitudes))
        return density(self.angles(phase, 2), self.beta, self.slope)

    def on(self, count: int) -> FloatArray:
        """Amplitudes on another number of harmonics: cut, or filled up with zeros."""
        return np.append(self.amplitudes, np.zeros(max(0, count - len(self.amplitudes))))[:count]

    def finer(self) -> Wave:
        """The same with twice as many harmonics, solved again."""
        return wave(self.kind, self.beta, self.slope, self.on(2 * len(self.amplitudes)), self.frequency)


class _System(NamedTuple):
    """Gradient (n + 1,) and Hessian (n + 1, n + 1) of the mean energy by amplitudes and log k, and ∂gradient/∂β."""

    gradient: FloatArray
    hessian: FloatArray
    by_load: FloatArray


def _system(kind: str, beta: float, slope: float, amplitudes: FloatArray, k: float) -> _System:
    turns, _, phase, values = basis(kind, len(amplitudes))
    angle, rate, bend = np.einsum("dpn,n->dp", values, amplitudes)
    angle, rate, bend = angle + turns * phase, k * (rate + turns), k * k * bend
    e = density(np.stack([angle, rate, bend]), beta, slope)
    # how θ, θ', θ'' change with the amplitudes, and with log k
    a = np.column_stack([values[0], np.zeros_like(phase)])
    r = np.column_stack([k * values[1], rate])
    b = np.column_stack([k * k * values[2], 2.0 * bend])
    mixed = r.T @ (e.rate_bend[:, None] * b)
    hessian = (
        a.T @ (e.angle_angle[:, None] * a) + r.T @ (e.rate_rate[:, None] * r) + b.T @ (e.bend_bend[:, None] * b)
        + mixed + mixed.T
    )  # fmt: skip
    # θ' and θ'' are not linear in log k: θ'' is quadratic in k, so its second derivative is 4θ''
    once = k * values[1].T @ e.by_rate + 2.0 * k * k * values[2].T @ e.by_bend
    hessian[:-1, -1] += once
    hessian[-1, :-1] += once
    hessian[-1, -1] += rate @ e.by_rate + 4.0 * bend @ e.by_bend
    gradient = a.T @ e.by_angle + r.T @ e.by_rate + b.T @ e.by_bend
    return _System(gradient / len(phase), hessian / len(phase), r.T @ load_derivative(rate, slope) / len(phase))


def wave(kind: str, beta: float, slope: float, amplitudes: FloatArray, frequency: float) -> Wave:
    """The state that Newton's method finds from a start.

    Raises
    ------
    NotConvergedError
        If it finds none: most often because there is none near it.
    """
    unknowns = np.append(amplitudes, np.log(frequency))
    before = np.inf
    for _ in range(MOST_ITERATIONS):
        a, k = unknowns[:-1], float(np.exp(unknowns[-1]))
        if not _possible(kind, slope, a, k):
            break
        system = _system(kind, beta, slope, a, k)
        step = _solve(system.hessian, -system.gradient)
        if step is None:
            break
        size = float(np.max(np.abs(step)))
        if size < CONVERGED or 0.1 * before < size < STALLED:
            return Wave(kind, beta, slope, a + step[:-1], k * float(np.exp(step[-1])), _softest(system.hessian))
        unknowns, before = unknowns + step * min(1.0, LONGEST_STEP / size), size
    raise NotConvergedError(f"no {kind} state of the endless rod was found near the start, at beta = {beta:.8g}")


def wave_at_frequency(near: Wave, frequency: float) -> tuple[Wave, float]:
    """The state of a given frequency next to a known one, its load being unknown, and how that changes with log k.

    It serves where the loads of a kind of state turn back: there they are no parameter, but the frequency is.
    """
    kind, slope, a, beta = near.kind, near.slope, near.amplitudes, near.beta
    for _ in range(MOST_ITERATIONS):
        system = _system(kind, beta, slope, a, frequency)
        matrix = np.column_stack([system.hessian[:, :-1], system.by_load])
        both = _solve(matrix, np.column_stack([-system.gradient, -system.hessian[:, -1]]))
        if both is None or not np.max(np.abs(both[:, 0])) < 1e3:
            break
        step, along = both.T
        a, beta = a + step[:-1], beta + float(step[-1])
        if np.max(np.abs(step)) < CONVERGED * max(1.0, beta):
            return Wave(kind, beta, slope, a, frequency, _softest(system.hessian)), float(along[-1])
        if not _possible(kind, slope, a, frequency):
            break
    raise NotConvergedError(f"no {kind} state of the endless rod was found at the frequency {frequency:.8g}")


def _solve(matrix: FloatArray, right: FloatArray) -> FloatArray | None:
    try:
        found = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        return None
    return found if np.all(np.isfinite(found)) else None


def _softest(hessian: FloatArray) -> float:
    return float(np.linalg.eigvalsh(hessian)[0])


def _possible(kind: str, slope: float, amplitudes: FloatArray, k: float) -> bool:
    """Whether the rod is nowhere perpendicular to the axis."""
    turns, _, _, values = basis(kind, len(amplitudes))
    return bool(slope * k * np.max(np.abs(turns + values[1] @ amplitudes)) < 1.0 - 1e-9)

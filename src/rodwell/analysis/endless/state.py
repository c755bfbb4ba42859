"""A periodic state of the endless rod: its numbers, each with an error."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.analysis.endless.bloch import Stability, stability
from rodwell.analysis.endless.following import start
from rodwell.analysis.endless.waves import KINDS, SINUSOIDAL, Wave, basis
from rodwell.errors import InputError
from rodwell.physics.on_wall import endless as formulas
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

ROUND_OFF = 2e-15
"""Part of a number of order one that sums and four derivatives of a series of some ten terms lose."""

GRID, ZOOMS, NARROWED = 192, 4, 16

NUMBERS = (
    "frequency", "amplitude", "energy", "contact_mean", "contact_largest", "contact_least", "rate_largest",
    "curvature_largest", "stress_factor", "shortening",
)  # fmt: skip
"""Names of the numbers of a state."""


@dataclass(frozen=True)
class PeriodicState:
    """A periodic state of the endless rod kept on the wall, of the wavelength of least energy.

    Every number is a :class:`~rodwell.quantities.value.Value`: value and error, from half as many and all harmonics and
    from round-off. Compression is positive here.

    Attributes
    ----------
    fine, coarse
        The state on two sets of harmonics.
    """

    fine: Wave
    coarse: Wave

    @property
    def kind(self) -> str:
        """``"sinusoidal"`` or ``"helical"``."""
        return self.fine.kind

    @property
    def beta(self) -> float:
        """Load β = P/√(Bq/D), P compression."""
        return self.fine.beta

    @property
    def slope(self) -> float:
        """Slope ε = (qD³/B)^¼; 0: small slopes."""
        return self.fine.slope

    @cached_property
    def frequency(self) -> Value:
        """Angular frequency k along the rod in 1/ℓ, ℓ = (BD/q)^¼; the wavelength is 2πℓ/k."""
        return self._value(lambda wave: wave.frequency)

    @cached_property
    def amplitude(self) -> Value:
        """Largest angle round the wall in rad: from the low side, or, of a helix, from uniform winding (ripple)."""
        return self._value(lambda wave: _largest(wave, lambda x: np.abs(wave.angles(x, 0)[0] - _turns(wave) * x)))

    @cached_property
    def energy(self) -> Value:
        """Mean energy per length in qD, the weight's measured from the cylinder's axis: −1 for the straight rod."""
        return self._value(mean_energy)

    @cached_property
    def contact_mean(self) -> Value:
        """Mean contact force per length in q."""
        return self._value(lambda wave: _mean(wave, lambda x: contact(wave, x)))

    @cached_property
    def contact_largest(self) -> Value:
        """Largest contact force per length in q."""
        return self._value(lambda wave: _largest(wave, lambda x: contact(wave, x)))

    @cached_property
    def contact_least(self) -> Value:
        """Least contact force per length in q; below 0 the wall would have to pull: the state exists on paper only."""
        return self._value(least_contact)

    @property
    def in_contact(self) -> bool:
        """Whether the wall presses everywhere: otherwise the state is that of a rod kept on it, on paper only."""
        return self.contact_least.value > -self.contact_least.error

    @cached_property
    def rate_largest(self) -> Value:
        """Largest rate θ' of the angle, in rad per ℓ; the largest slope is sin η = εθ'."""
        return self._value(lambda wave: _largest(wave, lambda x: np.abs(wave.angles(x, 1)[1])))

    @cached_property
    def curvature_largest(self) -> Value:
        """Largest curvature in D/ℓ² = √(qD/B)."""
        return self._value(lambda wave: _largest(wave, lambda x: curvature(wave, x)))

    @property
    def stress_factor(self) -> Value:
        """Largest curvature over that of the weightless helix under the same load, DP/(2B).

        The bending stress is the factor times P·D·OD/(4I), with the outer diameter OD of the rod.
        """
        return self.curvature_largest.times(2.0 / self.beta)

    @cached_property
    def shortening(self) -> Value:
        """Mean axial shortening per length in ε² = √(qD³/B)."""
        return self._value(lambda wave: _mean(wave, lambda x: formulas.shortening(wave.angles(x, 1)[1], wave.slope)))

    @cached_property
    def stability(self) -> Stability:
        """Stability of the rod kept on the wall, against disturbances of every wavelength under dead load."""
        return stability(self.fine)

    def angle(self, x: FloatArray) -> FloatArray:
        """θ in rad at the places ``x`` in ℓ, of any shape: from the low side, θ(0) = 0."""
        places = np.asarray(x, dtype=float)
        return np.asarray(self.fine.angles(self.fine.frequency * places.ravel(), 0)[0].reshape(places.shape))

    def contact(self, x: FloatArray) -> FloatArray:
        """Contact force per length in q at the places ``x`` in ℓ, of any shape."""
        places = np.asarray(x, dtype=float)
        return contact(self.fine, self.fine.frequency * places.ravel()).reshape(places.shape)

    def _value(self, number: Callable[[Wave], float]) -> Value:
        fine, coarse = number(self.fine), number(self.coarse)
        # near a fold or near buckling, where the energy is flat, round-off moves the state
        flat = ROUND_OFF / min(1.0, max(abs(self.fine.stiffness), ROUND_OFF))
        return Value(fine, abs(fine - coarse) + (ROUND_OFF * 64.0 + flat) * max(1.0, abs(fine)))

    def __repr__(self) -> str:
        return (
            f"<{self.kind} state at beta {self.beta:.6g}: frequency {self.frequency.value:.6g}, amplitude "
            f"{self.amplitude.value:.6g} rad, mean contact {self.contact_mean.value:.6g} q>"
        )


def periodic_state(kind: str, beta: float, slope: float = 0.0) -> PeriodicState:
    """The state of a kind at a load, both checked already.

    Raises
    ------
    NotConvergedError
        If there is none, or none was found.
    """
    if kind not in KINDS:
        raise InputError("state", kind, f"must be {' or '.join(KINDS)}")
    return on_two(start(kind, beta, slope))


def on_two(wave: Wave) -> PeriodicState:
    """A state on its harmonics and on twice as many."""
    return PeriodicState(wave.finer(), wave)


def contact(wave: Wave, phase: FloatArray) -> FloatArray:
    """Contact force per length in q at the places φ (p,)."""
    return formulas.contact(wave.angles(phase), wave.beta, wave.slope)


def least_contact(wave: Wave) -> float:
    """Least contact force per length in q."""
    return -_largest(wave, lambda x: -contact(wave, x))


def mean_energy(wave: Wave) -> float:
    """Mean energy per length in qD."""
    return float(np.mean(wave.terms().energy))


def curvature(wave: Wave, phase: FloatArray) -> FloatArray:
    """Curvature in D/ℓ² at the places φ (p,)."""
    _, rate, bend = wave.angles(phase, 2)
    return formulas.curvature(rate, bend, wave.slope)


def _turns(wave: Wave) -> float:
    return 0.0 if wave.kind == SINUSOIDAL else 1.0


def _mean(wave: Wave, number: Callable[[FloatArray], FloatArray]) -> float:
    return float(np.mean(number(basis(wave.kind, len(wave.amplitudes)).phase)))


def _largest(wave: Wave, number: Callable[[FloatArray], FloatArray]) -> float:
    """Largest value over a period: the best of many places, then of ever closer ones round it."""
    return float(number(np.array([highest(number)]))[0])


def highest(number: Callable[[FloatArray], FloatArray]) -> float:
    """Phase φ of the largest value over half a period, to which all others are images."""
    phase = np.linspace(0.0, np.pi, GRID + 1)
    for _ in range(ZOOMS):
        best, width = phase[int(np.argmax(number(phase)))], phase[1] - phase[0]
        phase = best + np.linspace(-width, width, 2 * NARROWED + 1)
    return float(phase[int(np.argmax(number(phase)))])

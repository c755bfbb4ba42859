"""Stability of periodic states: the second variation of the energy under disturbances of every wavelength.

A disturbance of the angle is a Bloch wave v = e^{iνφ} × (a function of the state's period), φ = kx, 0 ≤ ν ≤ ½: these
are all the bounded ones of a rod without ends. For each ν the second variation

    ∫ e_θ″θ″ v″² + 2 e_θ′θ″ v′v″ + e_θ′θ′ v′² + e_θθ v² dx

is a Hermitian matrix of Fourier coefficients; its lowest eigenvalue is of the disturbance that costs least. Load: dead.
Contact is kept: disturbances that leave the wall cost energy of first order wherever the contact force is positive.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.endless.waves import Wave
from rodwell.physics.on_wall.endless import density
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

WAVENUMBERS = 48
"""How many ν are looked at, dense towards 0, where the eigenvalue itself vanishes with ν² (the state moved along)."""

LONGEST = 0.01
"""Smallest ν looked at: a modulation over a hundred periods. Below, the eigenvalue is a multiple of ν²."""


@dataclass(frozen=True)
class Stability:
    """What the second variation says of a state kept on the wall.

    Attributes
    ----------
    stable
        Whether no disturbance lowers the energy by more than the error.
    softest
        Lowest eigenvalue of the second variation over ν², per length in qD for disturbances of mean square 1: negative
        where the state is unstable. Moving the state along, or turning its phase slowly, costs ∝ ν²; that is divided
        out.
    wavenumber
        The ν of that disturbance, in parts of the state's frequency; 0: long waves.
    """

    stable: bool
    softest: Value
    wavenumber: float


def stability(wave: Wave) -> Stability:
    """Stability of a state against Bloch waves of ``WAVENUMBERS`` wavelengths from two periods to a hundred."""
    wavenumbers = LONGEST + (0.5 - LONGEST) * np.linspace(0.0, 1.0, WAVENUMBERS) ** 2
    count = 2 * len(wave.amplitudes)
    lowest = _lowest(wave, wavenumbers, count) / wavenumbers**2
    best = int(np.argmin(lowest))
    nu = wavenumbers[best]
    coarse = _lowest(wave, wavenumbers[best : best + 1], count // 2)[0] / nu**2
    error = abs(coarse - lowest[best]) + 1e-14 * (1.0 + wave.frequency**4) * count / nu**2
    softest = Value(float(lowest[best]), float(error))
    return Stability(bool(softest.value > -softest.error), softest, 0.0 if best == 0 else float(nu))


def _lowest(wave: Wave, wavenumbers: FloatArray, count: int) -> FloatArray:
    """Lowest eigenvalue for each ν (v,), with harmonics −count … count."""
    places = 8 * count
    phase = 2.0 * np.pi * np.arange(places) / places
    e = density(wave.angles(phase, 2), wave.beta, wave.slope)
    orders = np.arange(-count, count + 1)
    apart = orders[:, None] - orders[None, :]
    constant, slant, rate, bend = (
        np.fft.fft(term)[apart % places] / places for term in (e.angle_angle, e.rate_bend, e.rate_rate, e.bend_bend)
    )
    found = []
    for nu in wavenumbers:
        q = 1j * wave.frequency * (orders + nu)
        left, right = np.conj(q)[:, None], q[None, :]
        matrix = (
            constant
            + left * rate * right
            + left**2 * bend * right**2
            + left * slant * right**2
            + left**2 * slant * right
        )
        found.append(np.linalg.eigvalsh(matrix)[0])
    return np.array(found)

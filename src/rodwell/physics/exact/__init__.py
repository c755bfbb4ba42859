"""Closed forms of critical loads, by cylinder: what the numerical solution is audited against.

Plain functions in double precision. Certified enclosures of the same numbers: :mod:`rodwell.analysis.proof.certify`.
"""

from __future__ import annotations

from rodwell.physics.exact.columns import infinite_load, weightless_loads
from rodwell.physics.exact.helix import (
    STEEPEST,
    Helix,
    coil_energy,
    equal_energy_load,
    least_equal_energy_load,
    weightless_helix,
)
from rodwell.physics.exact.horizontal import (
    Switching,
    buckling_equation,
    even_factor,
    even_factor_on_top,
    even_first,
    horizontal_loads,
    load_of_p_on_top,
    load_of_q,
    odd_factor,
    odd_factor_on_top,
    pair_loads,
    sine_loads,
    switching,
    switchings,
    wavenumbers,
    weights_on_top,
)
from rodwell.physics.exact.vertical import (
    as_float,
    chord_slope,
    critical_length,
    scorer_determinant,
    self_weights,
    sway_bessel,
    sway_determinant,
    sway_weights,
    tangent_slope,
)

__all__ = [
    "STEEPEST",
    "Helix",
    "Switching",
    "as_float",
    "buckling_equation",
    "chord_slope",
    "coil_energy",
    "critical_length",
    "equal_energy_load",
    "even_factor",
    "even_factor_on_top",
    "even_first",
    "horizontal_loads",
    "infinite_load",
    "least_equal_energy_load",
    "load_of_p_on_top",
    "load_of_q",
    "odd_factor",
    "odd_factor_on_top",
    "pair_loads",
    "scorer_determinant",
    "self_weights",
    "sine_loads",
    "sway_bessel",
    "sway_determinant",
    "sway_weights",
    "switching",
    "switchings",
    "tangent_slope",
    "wavenumbers",
    "weightless_helix",
    "weightless_loads",
    "weights_on_top",
]

"""Units that most cases are written in: the registry of all units takes longer to start than a case to be computed.

What stands here is exact by definition (SI; international yard and pound). The rest, and what is wrong with a text that
is no unit of its kind, the registry knows (:mod:`rodwell.quantities.units`).
"""

from __future__ import annotations

import math
import re
from functools import cache
from typing import NamedTuple

LBF, FOOT, INCH, GALLON = 4.4482216152605, 0.3048, 0.0254, 231.0 * 0.0254**3
"""Units of the field in SI, exact by definition: pound-force, foot, inch, US gallon."""

POUND = 0.45359237


class Known(NamedTuple):
    """A unit: its size in SI units, and the powers of metre, kilogram, second and radian in it."""

    size: float
    powers: tuple[int, int, int, int]


_M, _KG, _S, _RAD, _N, _PA = (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1), (1, 1, -2, 0), (-1, 1, -2, 0)

_PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "": 1.0, "c": 1e-2, "m": 1e-3, "µ": 1e-6}

_NAMES = {
    **{f"{prefix}m": Known(_PREFIXES[prefix], _M) for prefix in ("", "k", "c", "m", "µ")},
    **{f"{prefix}N": Known(_PREFIXES[prefix], _N) for prefix in ("", "M", "k", "m")},
    **{f"{prefix}Pa": Known(_PREFIXES[prefix], _PA) for prefix in ("", "G", "M", "k")},
    "kg": Known(1.0, _KG), "g": Known(1e-3, _KG), "s": Known(1.0, _S), "h": Known(3600.0, _S),
    "rad": Known(1.0, _RAD), "deg": Known(math.pi / 180.0, _RAD), "bar": Known(1e5, _PA),
    "in": Known(INCH, _M), "ft": Known(FOOT, _M), "lb": Known(POUND, _KG), "gal": Known(GALLON, (3, 0, 0, 0)),
    "lbf": Known(LBF, _N), "klbf": Known(1e3 * LBF, _N), "psi": Known(LBF / INCH**2, _PA),
    "ksi": Known(1e3 * LBF / INCH**2, _PA), "ppg": Known(POUND / GALLON, (-3, 1, 0, 0)),
    "sg": Known(1e3, (-3, 1, 0, 0)),
    "french_size": Known(1e-3 / 3.0, _M),
    "ten_meters": Known(10.0, _M), "thirty_meters": Known(30.0, _M),
    "hundred_meters": Known(100.0, _M), "hundred_feet": Known(100.0 * FOOT, _M),
}  # fmt: skip
"""Names as :func:`rodwell.quantities.written.plain_unit` leaves them."""

_FACTOR = re.compile(r"([A-Za-zµ_]+)(?:\^(\d))?")


@cache
def known(unit: str) -> Known | None:
    """Return a product of units from here, over one of them or not: lbf/ft, kg/m^3, N*m; None for any other text."""
    above, slash, below = unit.partition("/")
    factors = [(factor, 1) for factor in re.split(r"\s*\*\s*|\s+", above.strip())]
    size, powers = 1.0, (0, 0, 0, 0)
    for text, sign in [*factors, (below.strip(), -1)] if slash else factors:
        found = _FACTOR.fullmatch(text)
        one = _NAMES.get(found[1]) if found else None
        if found is None or one is None:
            return None
        power = sign * int(found[2] or 1)
        size *= one.size**power
        m, kg, s, rad = (have + power * more for have, more in zip(powers, one.powers, strict=True))
        powers = (m, kg, s, rad)
    return Known(size, powers)


def in_si(number: float, unit: str, other: str) -> float | None:
    """Return a number of ``unit`` in the SI unit ``other``; None where that needs the registry."""
    first, second = known(unit), known(other)
    if first is None or second is None or first.powers != second.powers:
        return None
    return number * first.size

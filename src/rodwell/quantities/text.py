"""Numbers as text: as many digits as their errors allow, engineering prefixes, a true minus sign.

How many digits that is depends on what stands beside them. In a sentence there is no error: every digit must be
:func:`certain`. In a table the error stands in the next column: the digits go down to the place of its first digit, so
that the last one is in doubt and the next would say nothing (:func:`supported`). So 123.456 ± 0.3 is "123" in a
sentence, "123.5" in a table. Both rules are that of :func:`_down_to`, with another last place.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from rodwell.quantities.value import Value

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))


def readable(value: float, unit: str, digits: int = 4) -> str:
    """Return ``value`` with an engineering prefix: ``readable(-12345, "N")`` is "−12.35 kN"."""
    if value == 0.0 or not math.isfinite(value):
        return minus(f"{value:g} {unit}")
    scale, prefix = prefix_for(value)
    return minus(f"{plain(value / scale, digits)} {prefix}{unit}")


def prefix_for(value: float) -> tuple[float, str]:
    """Return factor and letter of the engineering prefix that suits ``value``."""
    size = abs(value)
    for scale, prefix in _PREFIXES:
        if size >= scale * (1.0 - 1e-9):
            return scale, prefix
    return _PREFIXES[-1] if size > 0.0 else (1.0, "")


def plain(number: float, digits: int = 4) -> str:
    """Return ``number`` rounded to ``digits`` significant digits, without an exponent where twelve places will do."""
    if math.isfinite(number):
        number = float(f"{number:.{digits}g}")
    return f"{number:.{max(digits, 12)}g}"


def certain(number: Value, digits: int) -> int:
    """Return how many of the first ``digits`` significant digits the error allows; 0 if not even the first.

    A digit is allowed if half a unit of it is no less than the error: rounding then hides more than the error changes.
    """
    return _down_to(lambda error: math.ceil(math.log10(2.0 * error) - 1e-9), number, digits)


def supported(number: Value, digits: int) -> int:
    """Return how many of the first ``digits`` significant digits a table shows beside the error; 0 if none.

    The last one shown stands where the first digit of the error does: it is in doubt.
    """
    return _down_to(lambda error: math.floor(math.log10(error)), number, digits)


def _down_to(last_place: Callable[[float], int], number: Value, digits: int) -> int:
    """Significant digits down to the power of ten that ``last_place`` gives for the error; all if there is no error."""
    if not number.error > 0.0 or number.value == 0.0:
        return digits
    if not math.isfinite(number.error):
        return 0
    first = math.floor(math.log10(abs(number.value)))
    return max(0, min(digits, first - last_place(number.error) + 1))


def amount(number: Value, digits: int = 4) -> str:
    """A number rounded to the digits that its error allows; with the error beside it where it allows none."""
    count = certain(number, digits)
    return minus(plain(number.value, count) if count else f"{plain(number.value, 1)} ± {plain(number.error, 1)}")


def percent(part: Value, digits: int = 3) -> str:
    """A part of 1 in percent, rounded like :func:`amount`."""
    return f"{amount(part.times(100.0), digits)} %"


def minus(text: str) -> str:
    """Typographic minus signs."""
    return text.replace("-", "−")

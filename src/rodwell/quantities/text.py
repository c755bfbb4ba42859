"""Numbers as text: one way to write them, everywhere.

Digits as the errors allow, thousands set apart by a narrow space, a true minus sign, powers of ten written out
(6.4 × 10⁻⁵), engineering prefixes. Pages, tables, figures and the terminal take their numbers from here; data files
(JSON, CSV, NetCDF) have theirs as machines read them.

How many digits that is depends on what stands beside them. In a sentence there is no error: every digit must be
:func:`certain`. In a table the error stands in the next column: the digits go down to the place of its first digit, so
that the last one is in doubt and the next would say nothing (:func:`supported`). So 123.456 ± 0.3 is "123" in a
sentence, "123.5" in a table. Both rules are that of :func:`_down_to`, with another last place. Zeros at the end are
digits like others where a number has an error ("12.0 %"), and left out where it is exact as it was given ("30 m").
"""

from __future__ import annotations

import math
from collections.abc import Callable

from rodwell.quantities.value import Value

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p"))

SEPARATOR = "\u202f"
"""Narrow space between thousands (ISO 80000-1), which never means a decimal mark; case files may have it too."""

APART = 1e4
"""Numbers from here on have their thousands set apart."""

LEAST, MOST = 1e-4, 1e7
"""Below the first, and above the second where digits would be made up, a number is written with a power of ten."""


def readable(value: float, unit: str, digits: int = 4, *, zeros: bool = False) -> str:
    """Return ``value`` with an engineering prefix: ``readable(-12345, "N")`` is "−12.35 kN"."""
    if value == 0.0 or not math.isfinite(value):
        return f"{plain(value)} {unit}"
    scale, prefix = prefix_for(float(f"{value:.{digits}g}"))
    return f"{plain(value / scale, digits, zeros=zeros)} {prefix}{unit}"


def prefix_for(value: float) -> tuple[float, str]:
    """Return factor and letter of the engineering prefix that suits ``value``."""
    size = abs(value)
    for scale, prefix in _PREFIXES:
        if size >= scale * (1.0 - 1e-9):
            return scale, prefix
    return _PREFIXES[-1] if size > 0.0 else (1.0, "")


def plain(number: float, digits: int = 4, *, zeros: bool = False) -> str:
    """Return ``number`` rounded to ``digits`` significant digits; ``zeros`` keeps those at the end."""
    if not math.isfinite(number):
        return minus(f"{number:g}")
    if number == 0.0:
        return "0"
    mantissa, _, power = f"{number:.{max(digits, 1) - 1}e}".partition("e")
    exponent = int(power)
    if abs(number) < LEAST or (abs(number) >= MOST and exponent >= digits):
        return minus(f"{_trimmed(mantissa, zeros)} × 10{raised(exponent)}")
    rounded = f"{float(f'{mantissa}e{exponent}'):.{max(digits - 1 - exponent, 0)}f}"
    return minus(separated(_trimmed(rounded, zeros)))


def signed(number: float, digits: int = 4, *, zeros: bool = False) -> str:
    """The same with its sign, + as well."""
    return f"+{plain(number, digits, zeros=zeros)}" if number > 0.0 else plain(number, digits, zeros=zeros)


def separated(text: str) -> str:
    """A number without exponent with its thousands set apart from 10 000 on."""
    sign = text[: len(text) - len(text.lstrip("+-−"))]
    whole, point, rest = text[len(sign) :].partition(".")
    if len(whole) > 4:
        head = len(whole) % 3
        parts = [whole[:head]] if head else []
        whole = SEPARATOR.join([*parts, *(whole[i : i + 3] for i in range(head, len(whole), 3))])
    return f"{sign}{whole}{point}{rest}"


def raised(exponent: int) -> str:
    """A whole number above the line."""
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def _trimmed(text: str, zeros: bool) -> str:
    return text if zeros or "." not in text else text.rstrip("0").rstrip(".")


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
    if count:
        return plain(number.value, count, zeros=number.error > 0.0)
    return f"{plain(number.value, 1)} ± {plain(number.error, 1)}"


def number_text(number: Value, digits: int = 10) -> str:
    """A number with the digits that its error supports, for a place where the error stands beside it."""
    count = supported(number, digits)
    return plain(number.value, count, zeros=number.error > 0.0) if count else "0"


def error_digit(error: float) -> str:
    """An error of one digit."""
    return plain(error, 1)


def with_error(number: Value, digits: int = 10) -> str:
    """A number with its sign and its error: "−111.2334402 ± 2 × 10⁻¹²"; without one where it is exact."""
    text = ("+" if number.value > 0.0 else "") + number_text(number, digits)
    return text if number.error == 0.0 else f"{text} ± {error_digit(number.error)}"


def percent(part: Value, digits: int = 3) -> str:
    """A part of 1 in percent, rounded like :func:`amount`."""
    return f"{amount(part.times(100.0), digits)} %"


def minus(text: str) -> str:
    """Typographic minus signs."""
    return text.replace("-", "−")

"""Numbers with proved bounds, free of the library that proved them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rodwell.errors import checked_whole

FEWEST_DIGITS, MOST_DIGITS = 3, 300

Ball = Any
"""A real number with a bound of its error: flint.arb."""


@dataclass(frozen=True)
class Enclosure:
    """A real number proved to lie between two others.

    Attributes
    ----------
    low, high
        Exact rational bounds.
    """

    low: Fraction
    high: Fraction

    @property
    def middle(self) -> Fraction:
        """Mid-point of the bounds, exact."""
        return (self.low + self.high) / 2

    @property
    def half_width(self) -> Fraction:
        """Half the distance of the bounds, exact."""
        return (self.high - self.low) / 2

    @property
    def digits(self) -> int:
        """Decimal digits proved: the half-width is at most 10^(−digits) of the number, or of 1 if that is more."""
        if self.half_width == 0:
            return MOST_DIGITS
        size = max(abs(self.middle), Fraction(1))
        digits = math.floor(math.log10(size.numerator / size.denominator)) - _exponent(self.half_width)
        while self.half_width * 10**digits > size:
            digits -= 1
        return digits

    def __contains__(self, value: float | Fraction) -> bool:
        return self.low <= Fraction(value) <= self.high

    def __float__(self) -> float:
        return float(self.middle)

    def within(self, value: float, error: float) -> bool:
        """Whether ``value`` ± ``error`` meets the enclosure."""
        return Fraction(value) - Fraction(error) <= self.high and self.low <= Fraction(value) + Fraction(error)

    def rounds_to(self, printed: str) -> bool:
        """Whether a decimal as printed, "−111.2334", is the number rounded to as many places."""
        text = printed.replace("−", "-")
        half = Fraction(1, 2) / 10 ** len(text.partition(".")[2])
        return bool(Fraction(text) - half <= self.low and self.high <= Fraction(text) + half)

    def text(self, digits: int = 30) -> tuple[str, str]:
        """Decimal with so many digits (places, for numbers below 1), and a bound of its distance from the number."""
        size = abs(self.middle)
        places = digits if size < 1 else max(digits - 1 - _exponent(size), 0)
        rounded = Fraction(round(self.middle * 10**places), 10**places)
        return _decimal(rounded, places), _upper(max(rounded - self.low, self.high - rounded))


def _exponent(value: Fraction) -> int:
    """⌊log₁₀⌋ of a positive rational."""
    guess = len(str(value.numerator)) - len(str(value.denominator))
    return guess if value >= Fraction(10) ** guess else guess - 1


def _decimal(value: Fraction, places: int) -> str:
    """Exact decimal of a rational with so many places."""
    scaled = str(abs(round(value * 10**places))).rjust(places + 1, "0")
    sign = "-" if value < 0 else ""
    return sign + (f"{scaled[:-places]}.{scaled[-places:]}" if places else scaled)


def _upper(value: Fraction) -> str:
    """Upper bound with two digits, like 3.1e-30."""
    if value <= 0:
        return "0"
    exponent = _exponent(value)
    mantissa = math.ceil(value / Fraction(10) ** (exponent - 1))
    if mantissa == 100:
        mantissa, exponent = 10, exponent + 1
    return f"{mantissa // 10}.{mantissa % 10}e{exponent:+03d}"


def enclosure(ball: Ball) -> Enclosure:
    """Bounds of a ball, exact."""
    return Enclosure(_rational(ball.lower()), _rational(ball.upper()))


def _rational(ball: Ball) -> Fraction:
    """An exact ball as a rational."""
    mantissa, exponent = ball.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def exact(value: float) -> Fraction:
    """The decimal that a number is written as: 0.01 is 1/100, not the binary number next to it."""
    return Fraction(repr(float(value)))


def checked_digits(digits: object) -> int:
    """Return the number of digits, or raise an InputError."""
    return checked_whole("digits", digits, FEWEST_DIGITS, MOST_DIGITS)


def bits(digits: int) -> int:
    """Working precision for so many digits, with some to spare."""
    return math.ceil(digits * math.log2(10.0)) + 80

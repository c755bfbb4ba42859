"""Critical values of one parameter, enclosed and numbered by certified counts.

``count`` tells how many critical values lie on one side of a value: a whole number that is right. Values are dyadic
rationals, so that nothing is lost between one precision and the next.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from rodwell.analysis.proof.enclosures import Enclosure, bits
from rodwell.analysis.proof.inertia import EnclosedRod, Inertia, UndecidedError, elements, inertia
from rodwell.errors import NotConvergedError

Ball = Any
"""A real number with a bound of its error: flint.arb."""

MOST_REFINEMENTS = 200
OFF_CENTRE = Fraction(127, 256)
"""Where intervals are cut: not at places that a problem's symmetry makes special, such as a load of exactly zero."""
NEAR_ZERO = 40
"""Values are cut to an eighth of their size, or of this, before secants start."""
PRECISIONS = (1, 2, 4)
BITS_PER_ELEMENT = 4
"""What balls lose from one element to the next: about 3 bits, measured; too few cost time only."""


@dataclass(frozen=True)
class Critical:
    """Critical values number ``number`` … ``number + multiplicity − 1`` in one enclosure."""

    number: int
    enclosure: Enclosure
    multiplicity: int


@dataclass
class Counter:
    """Counts of critical values below a value of the parameter x, which they are counted along.

    Parameters
    ----------
    rod
        From x, a ball, to the rod there, in balls; its index may not fall as x grows.
    """

    rod: Callable[[Ball], EnclosedRod]
    known: dict[Fraction, Inertia] = field(default_factory=dict)

    def at(self, x: Fraction, precision: int, elements: int = 0) -> Inertia:
        """Inertia at x, on at least so many elements; the precision is raised while a sign is undecided."""
        from flint import arb, ctx, fmpq  # noqa: PLC0415

        precision += BITS_PER_ELEMENT * max(self.elements(x), elements)
        for factor in PRECISIONS:
            with ctx.workprec(precision * factor):
                try:
                    return inertia(self.rod(arb(fmpq(x.numerator, x.denominator))), elements)
                except UndecidedError as error:
                    reason = error
        raise NotConvergedError(f"certified counts: {reason} cannot be decided with {precision * PRECISIONS[-1]} bits")

    def elements(self, x: Fraction) -> int:
        """How many elements are needed at x."""
        from flint import arb, fmpq  # noqa: PLC0415

        return elements(self.rod(arb(fmpq(x.numerator, x.denominator))))

    def count(self, x: Fraction) -> int:
        """Number of critical values below x."""
        if x not in self.known:
            self.known[x] = self.at(x, 100)
        return self.known[x].negative


def critical_values(counter: Counter, start: Fraction, step: Fraction, count: int, digits: int) -> list[Critical]:
    """The first ``count`` critical values above ``start``, enclosed to so many digits, and numbered.

    Raises
    ------
    NotConvergedError
        If a sign cannot be decided, or ``start`` has critical values below it.
    """
    if counter.count(start):
        raise NotConvergedError("certified counts: the first value looked at has critical values before it")
    while counter.count(start + step) < count:
        step *= 2
    found: list[Critical] = []
    while (number := sum(item.multiplicity for item in found) + 1) <= count:
        low, high = _isolated(counter, number, digits)
        found.append(_enclosed(counter, number, low, high, digits))
    return found


def _isolated(counter: Counter, number: int, digits: int) -> tuple[Fraction, Fraction]:
    """Interval that holds the critical value ``number`` alone, or those that cannot be told apart at these digits."""
    while True:
        low = max(x for x, known in counter.known.items() if known.negative < number)
        high = min(x for x, known in counter.known.items() if known.negative >= number)
        alone = counter.count(low) == number - 1 and counter.count(high) == number
        close = high - low <= max(abs(low), abs(high), Fraction(NEAR_ZERO)) / 8
        if (alone and close) or high - low <= _width(low, high, digits):
            return low, high
        counter.count(_dyadic(low + (high - low) * OFF_CENTRE, high - low))


def _width(low: Fraction, high: Fraction, digits: int) -> Fraction:
    """Width of an enclosure with so many digits."""
    return max(min(abs(low), abs(high)), Fraction(1)) / Fraction(10) ** digits


def _dyadic(x: Fraction, scale: Fraction) -> Fraction:
    """Round x to a binary fraction, by much less than ``scale``."""
    shift = max(scale.denominator.bit_length() - scale.numerator.bit_length() + 12, 0)
    return Fraction(round(x * (1 << shift)), 1 << shift)


def _enclosed(counter: Counter, number: int, low: Fraction, high: Fraction, digits: int) -> Critical:
    """Narrow an interval to so many digits, and prove what it holds by counts at its ends."""
    multiplicity = counter.count(high) - counter.count(low)
    if multiplicity == 1:
        low, high = _narrowed(counter, low, high, digits)
    before, after = (counter.at(x, bits(digits)).negative for x in (low, high))
    if before != number - 1 or after != number - 1 + multiplicity:
        raise NotConvergedError(f"certified counts: critical value {number} was lost on the way to {digits} digits")
    return Critical(number, Enclosure(low, high), multiplicity)


def _narrowed(counter: Counter, low: Fraction, high: Fraction, digits: int) -> tuple[Fraction, Fraction]:
    """Narrow an interval with one critical value: secants on the determinant, kept in the interval by the counts.

    The determinant on a given number of elements is analytic and has a simple zero at the critical value. Where secants
    hardly move, it is tried whether the zero is there; if not (the determinant may grow exponentially), or if the
    interval was not halved by three of them, the interval is cut.
    """
    precision, before = bits(digits), counter.count(low)
    elements = max(counter.elements(x) for x in (low, high))

    def inertia_at(x: Fraction) -> Inertia:
        nonlocal low, high
        found = counter.at(x, precision, elements)
        if found.negative == before:
            low = max(low, x)
        else:
            high = min(high, x)
        return found

    old, new, halved = (low, inertia_at(low)), (high, inertia_at(high)), [high - low] * 3
    for _ in range(MOST_REFINEMENTS):
        goal, place = _width(low, high, digits), _secant(old, new)
        if high - low <= goal:
            return low, high
        slow = high - low > halved[-3] / 2
        halved.append(high - low)
        if place is None or not low < place < high or (slow and len(halved) > 6):
            place, halved = low + (high - low) * OFF_CENTRE, halved[:3]
        elif abs(place - new[0]) < goal / 8:
            for x in (_dyadic(place - goal / 2, goal), _dyadic(place + goal / 2, goal)):
                if low < x < high:
                    inertia_at(x)
            if high - low <= goal:
                return low, high
            place = low + (high - low) * OFF_CENTRE
        place = _dyadic(place, goal)
        try:
            old, new = new, (place, inertia_at(place))
        except NotConvergedError:  # a value hit exactly, as zero may be
            return max(low, place - goal / 2), min(high, place + goal / 2)
    raise NotConvergedError(f"certified counts: {digits} digits were not reached")


def _secant(old: tuple[Fraction, Inertia], new: tuple[Fraction, Inertia]) -> Fraction | None:
    """Zero of the secant through two values of the determinant."""
    (x0, f0), (x1, f1) = old, new
    ratio = f1.determinant.mid() / (f1.determinant.mid() - f0.determinant.mid())
    if x0 == x1 or not ratio.is_finite():
        return None
    mantissa, exponent = ratio.mid().man_exp()
    return x1 - (x1 - x0) * Fraction(int(mantissa)) * Fraction(2) ** int(exponent)

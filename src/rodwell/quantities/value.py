"""Numbers with what is known of them: the estimate of their error, and the place where they are reached."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Value:
    """A number and the estimate of its error, in one unit; error 0: exact.

    ``value, error = solution.number(which)`` takes it apart. It is no tuple: twice a pair would be two pairs, and
    nothing would say so.
    """

    value: float
    error: float = 0.0

    def __iter__(self) -> Iterator[float]:
        yield self.value
        yield self.error

    def as_dict(self) -> dict[str, float]:
        """Number and error as plain data."""
        return {"value": self.value, "error": self.error}

    def times(self, factor: float) -> Value:
        """The number in another unit, or with the other sign."""
        return Value(self.value * factor, self.error * abs(factor))

    def within(self, rtol: float, scale: float) -> bool:
        """Whether the error is at most ``rtol`` of ``scale``, the size of what the number is one of."""
        return self.error <= rtol * scale


@dataclass(frozen=True, slots=True)
class Peak(Value):
    """A largest value along the rod, and the (first) place s/L where it is reached.

    ``value, error, s = solution.largest(name)`` takes it apart: three parts, where a :class:`Value` has two.
    """

    s: float = 0.0

    def __iter__(self) -> Iterator[float]:
        yield self.value
        yield self.error
        yield self.s

    def times(self, factor: float) -> Peak:
        """The largest value in another unit; its place stays."""
        return Peak(self.value * factor, self.error * abs(factor), self.s)

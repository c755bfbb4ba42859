"""How a page says a force: at one end, with one sign.

A case with dimensions is told as engineers count: compression, with that word, at the end at which the case file gives
its loads (``load.at``), the other end in brackets where the rod's weight makes the two differ. A dimensionless case is
told as research does: the end force F at s = 1, tension positive.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import amount, plain
from rodwell.quantities.value import Value

NAMED = re.compile(r"F = (-?[\d.]+(?:e[-+]?\d+)?) B/L²")
"""How the engine, which knows no units, names an end force in a message."""


@dataclass(frozen=True)
class Forces:
    """Forces of one case in words. Every force that is taken is the end force F at s = 1 in B/L², tension positive."""

    scales: Scales | None
    weight: float

    @property
    def bottom(self) -> bool:
        """Whether they are shown at the end s = 0, the lower one unless the hole climbs."""
        return self.scales is not None and self.scales.bottom

    @property
    def end(self) -> str:
        """The end at which forces are shown: "the bottom", "the top", "s = 1"; "either end" where they are the same.

        In a hole that climbs an end is called by its s, not by where it is.
        """
        if self.scales is None:
            return "s = 1"
        return "either end" if self.weight == 0.0 else end_name(self.scales, bottom=self.bottom)

    @property
    def at_end(self) -> str:
        """The same after a noun, " at the bottom"; nothing where both ends bear the same."""
        return "" if self.scales is not None and self.weight == 0.0 else f" at {self.end}"

    @property
    def convention(self) -> str:
        """Sign and end, for the head of a page or table."""
        if self.scales is None:
            return "End force F at s = 1, tension positive"
        if self.weight == 0.0:
            return "Compression positive, the same at both ends"
        return f"Compression positive, at {self.end}"

    @property
    def axis(self) -> str:
        """What an axis of a figure says of the forces on it."""
        return "end compression −F at s = 1" if self.scales is None else f"compression{self.at_end}"

    def drawn(self, force: FloatArray | float) -> FloatArray | float:
        """The compression at the end shown of many end forces, in B/L², for figures."""
        return (self.weight if self.bottom else 0.0) - force

    def label(self, force: float) -> str:
        """A load for the legend of a figure: "29 110 lbf", or "F = −114.2 B/L²"."""
        if self.scales is None:
            return f"F = {plain(force)} B/L²"
        return self.scales.text(float(self.drawn(force)), "force")

    @property
    def legend(self) -> str:
        """The title of such a legend."""
        if self.scales is None:
            return "end force at s = 1\n(tension positive)"
        return self.axis.replace(" at ", "\nat ")

    def compression(self, force: Value) -> Value:
        """The compression at the end shown, in B/L²."""
        return Value((self.weight if self.bottom else 0.0) - force.value, force.error)

    def size(self, force: Value) -> str:
        """The force at the end shown without its sign: "29 110 lbf", "114.243 B/L²"."""
        return self._size(self.compression(force))

    def other(self, force: Value) -> str:
        """The force at the other end in brackets, " (24 820 lbf at the top)"; nothing where it is the same."""
        if self.scales is None or self.weight == 0.0:
            return ""
        there = Value((0.0 if self.bottom else self.weight) - force.value, force.error)
        same = (there.value < 0.0) == (self.compression(force).value < 0.0)
        word = "" if same else " of tension" if there.value < 0.0 else " of compression"
        return f" ({self._size(there)}{word} at {end_name(self.scales, bottom=not self.bottom)})"

    def load(self, force: Value, *, other: bool = False) -> str:
        """A load with its sign and its end: "29 110 lbf of compression at the bottom", "−114.243 B/L² at s = 1"."""
        if self.scales is None:
            return f"the end force {amount(force, 6)} B/L² at s = 1"
        word = "tension" if self.compression(force).value < 0.0 else "compression"
        return f"{self.size(force)} of {word}{self.at_end}{self.other(force) if other else ''}"

    def below(self, force: Value) -> str:
        """What keeps a load from being reached: "the compression at the bottom below 29 110 lbf (…)"."""
        if self.scales is None:
            return f"the end force at s = 1 above {amount(force, 6)} B/L²"
        if self.compression(force).value < 0.0:
            return f"the tension{self.at_end} above {self.size(force)}{self.other(force)}"
        return f"the compression{self.at_end} below {self.size(force)}{self.other(force)}"

    def retold(self, message: str) -> str:
        """A message of the engine with every end force that it names said as here."""
        return NAMED.sub(lambda found: self._named(float(found[1])), message)

    def _named(self, force: float) -> str:
        return self.label(force) if self.scales is None else self.load(Value(force))

    def _size(self, compression: Value) -> str:
        size = Value(abs(compression.value), compression.error)
        return f"{amount(size, 6)} B/L²" if self.scales is None else self.scales.amount(size, "force")


def end_name(scales: Scales | None, *, bottom: bool) -> str:
    """What an end is called in a case: the bottom, s = 0, or the top; by its s where the hole climbs."""
    if scales is not None and scales.climbs:
        return f"s = {0 if bottom else 1}"
    return "the bottom" if bottom else "the top"

"""What follows from the inputs of a case on the way to the dimensionless problem, for the report."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.practice.units import System


@dataclass(frozen=True)
class Fact:
    """A conversion: label, SI value with its dimension (or text), and where it comes from."""

    label: str
    value: float | str
    dimension: str = "1"
    note: str = ""

    def text(self, system: System) -> str:
        """Value in the units of ``system`` and note."""
        value = self.value if isinstance(self.value, str) else system.text(self.value, self.dimension, 6)
        return f"{value} ({self.note})" if self.note else value

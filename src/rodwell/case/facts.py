"""What follows from the inputs of a case on the way to the dimensionless problem, for the report."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rodwell.quantities.units import SI, System


@dataclass(frozen=True)
class Fact:
    """A conversion: label, SI value with its dimension (or text), and where it comes from."""

    label: str
    value: float | str
    dimension: str = "1"
    note: str = ""

    def text(self, system: System) -> str:
        """Value in the units of ``system``."""
        return self.value if isinstance(self.value, str) else system.text(self.value, self.dimension, 6)

    def short(self, system: System) -> str:
        """Label and number for a summary; nothing for text."""
        return "" if isinstance(self.value, str) else f"{self.label}: {system.text(self.value, self.dimension)}"

    def as_dict(self) -> dict[str, Any]:
        """Everything about it, for JSON: value in SI."""
        unit = {} if isinstance(self.value, str) else {"unit": SI.unit(self.dimension)[1]}
        return {"label": self.label, "value": self.value, **unit, "note": self.note}

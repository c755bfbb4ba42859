"""A key figure: a number with its error, and what it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rodwell.analysis.straight.critical import EULER
from rodwell.case.case import Case
from rodwell.quantities.names import SI_UNITS, UNITS
from rodwell.quantities.text import supported
from rodwell.quantities.units import SI


@dataclass(frozen=True)
class Figure:
    """A number of the answer: value and error estimate in units B = L = 1, and what it is.

    ``scale`` is the size of its kind, against which the error is judged.
    """

    name: str
    label: str
    value: float
    error: float
    dimension: str
    scale: float
    note: str = ""

    def physical(self, case: Case) -> tuple[float, float, str] | None:
        """Value, error and unit in SI, or None for a case without dimensions."""
        if case.scales is None:
            return None
        factor = case.scales.factor(self.dimension)
        return self.value * factor, self.error * factor, SI_UNITS[self.dimension]

    def text(self, case: Case, digits: int = 6) -> str:
        """Value in the case's units with the digits that its error supports, or nothing for one without dimensions."""
        if case.scales is None:
            return ""
        count = supported(self.value, self.error, digits)
        return case.scales.text(self.value if count else 0.0, self.dimension, max(count, 1))

    def as_dict(self, case: Case) -> dict[str, Any]:
        """Everything about the number, for JSON."""
        out: dict[str, Any] = {
            "label": self.label, "value": self.value, "error": self.error, "unit": UNITS[self.dimension],
        }  # fmt: skip
        physical = self.physical(case)
        if physical is not None:
            out["si"] = {"value": physical[0], "error": physical[1], "unit": physical[2]}
        if case.scales is not None and case.scales.system != SI:
            out[case.scales.system.name] = case.scales.shown(self.value, self.error, self.dimension)
        if self.note:
            out["note"] = self.note
        return out


def force_scale(force: float) -> float:
    """Size against which the error of a force is judged."""
    return abs(force) + EULER

"""A key number: a number with its error, and what it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rodwell.analysis.straight.scale import EULER
from rodwell.case.case import Case
from rodwell.quantities.names import SI_UNITS, UNITS
from rodwell.quantities.units import SI
from rodwell.quantities.value import Value


@dataclass(frozen=True)
class KeyNumber:
    """A number of the answer in units B = L = 1, and what it is.

    ``scale`` is the size of its kind, against which the error is judged; ``s`` holds the places s/L that it belongs to.
    """

    name: str
    label: str
    number: Value
    dimension: str
    scale: float
    note: str = ""
    s: tuple[float, ...] = ()

    @property
    def remark(self) -> str:
        """Places and note in one text, for data."""
        places = ", ".join(f"{s:.6g}" for s in self.s)
        return "; ".join(filter(None, (f"at s/L = {places}" if places else "", self.note)))

    @property
    def value(self) -> float:
        """The number."""
        return self.number.value

    @property
    def error(self) -> float:
        """Estimate of its error."""
        return self.number.error

    def physical(self, case: Case) -> tuple[float, float, str] | None:
        """Value, error and unit in SI, or None for a case without dimensions."""
        if case.scales is None:
            return None
        number = self.number.times(case.scales.factor(self.dimension))
        return number.value, number.error, SI_UNITS[self.dimension]

    def text(self, case: Case, digits: int = 6) -> str:
        """Value in the case's units with the digits that its error supports, or nothing for one without dimensions."""
        return "" if case.scales is None else case.scales.beside_error(self.number, self.dimension, digits)

    def as_dict(self, case: Case) -> dict[str, Any]:
        """Everything about the number, for JSON."""
        scales = case.scales
        out: dict[str, Any] = {
            "label": self.label, "value": self.value, "error": self.error, "unit": UNITS[self.dimension],
        }  # fmt: skip
        if scales is not None:
            out["si"] = scales.si(self.number, self.dimension)
            if scales.system != SI:
                out[scales.system.name] = scales.shown(self.number, self.dimension)
        if self.remark:
            out["note"] = self.remark
        return out


def force_scale(force: float) -> float:
    """Size against which the error of a force is judged."""
    return abs(force) + EULER

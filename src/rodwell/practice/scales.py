"""From units B = L = 1 to SI and back, for one rod."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.analysis.nomenclature import POWERS, QUANTITIES, SI_UNITS


@dataclass(frozen=True)
class Scales:
    """Length L in m and bending stiffness B in N m² of the rod: they carry every unit.

    ``radius`` is the rod's outer radius in m where it is known. The theory does not need it, pictures do.
    """

    length: float
    stiffness: float
    radius: float | None = None

    def factor(self, dimension: str) -> float:
        """SI value of one dimensionless unit of ``dimension`` (see ``nomenclature.UNITS``)."""
        stiffness, length = POWERS[dimension]
        return float(self.stiffness**stiffness * self.length**length)

    def of(self, name: str) -> tuple[float, str]:
        """SI factor and unit of a quantity of the nomenclature."""
        dimension = QUANTITIES[name].dimension
        return self.factor(dimension), SI_UNITS[dimension]

"""From units B = L = 1 to SI and back, for one rod, and on to the units in which results are shown."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.quantities.names import POWERS, QUANTITIES, SI_UNITS
from rodwell.quantities.units import SI, System
from rodwell.quantities.value import Value


@dataclass(frozen=True)
class Scales:
    """Length L in m and bending stiffness B in N m² of the rod: they carry every unit.

    ``radius`` is the rod's outer radius in m where it is known. The theory does not need it, pictures do. ``system``
    says in which units summaries, reports and figures show results; data files stay in SI. ``bottom`` says that they
    show end forces at the end s = 0, where the case gives its loads, and not at s = 1; ``climbs`` that s = 1 is the
    lower end.
    """

    length: float
    stiffness: float
    radius: float | None = None
    system: System = SI
    bottom: bool = False
    climbs: bool = False

    def factor(self, dimension: str) -> float:
        """SI value of one dimensionless unit of ``dimension`` (see :data:`rodwell.quantities.names.UNITS`)."""
        stiffness, length = POWERS[dimension]
        return float(self.stiffness**stiffness * self.length**length)

    def of(self, name: str) -> tuple[float, str]:
        """SI factor and unit of a quantity of the nomenclature."""
        dimension = QUANTITIES[name].dimension
        return self.factor(dimension), SI_UNITS[dimension]

    def text(self, value: float, dimension: str, digits: int = 4, *, zeros: bool = False) -> str:
        """A number in units B = L = 1 as text in the units of ``system``."""
        return self.system.text(value * self.factor(dimension), dimension, digits, zeros=zeros)

    def amount(self, number: Value, dimension: str, digits: int = 4) -> str:
        """A number in units B = L = 1 as text in the units of ``system``, with the digits that its error allows."""
        return self.system.amount(number.times(self.factor(dimension)), dimension, digits)

    def beside_error(self, number: Value, dimension: str, digits: int = 6) -> str:
        """A number in units B = L = 1 as text for a table that has its error, in the units of ``system``."""
        return self.system.beside_error(number.times(self.factor(dimension)), dimension, digits)

    def si(self, number: Value, dimension: str) -> dict[str, float | str]:
        """A number in units B = L = 1 with its error in SI units, for JSON."""
        return _plain(number.times(self.factor(dimension)), SI_UNITS[dimension])

    def shown(self, number: Value, dimension: str) -> dict[str, float | str]:
        """The same in the units of ``system``."""
        unit, text = self.system.unit(dimension)
        text = SI_UNITS[dimension] if self.system.name == "si" else text
        return _plain(number.times(self.factor(dimension) / unit), text)


def _plain(number: Value, unit: str) -> dict[str, float | str]:
    return {"value": number.value, "error": number.error, "unit": unit}

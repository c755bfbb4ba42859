"""The rods of a map: a problem or a case in which some parameters take other values from cell to cell."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.errors import InputError, checked_number
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import LARGEST_FORCE
from rodwell.studies.maps.numbers import NUMBERS, MapNumber

LOAD = "load"
"""Name of the end force that acts, at s = 1 in B/L², tension positive, beside the data of a problem."""

OF_PROBLEM = ("weight", "alpha", "clearance", "twist", "poisson", "torsion", "ends", LOAD)
"""Parameters of a problem that may vary."""


@dataclass(frozen=True)
class Rods:
    """What all cells of a map share; it travels to where they are computed.

    Attributes
    ----------
    quantity
        A key of ``numbers.NUMBERS``.
    given
        Data of the problem with its load, by name; or the sections of a case file.
    names
        What varies, in the order of the values of a cell: parameters of the problem, or "section.key".
    rtol
        Relative tolerance of the numbers: that of the case, where there is one.
    folder
        From which catalogue files of a case are sought; None for a problem.
    """

    quantity: str
    given: Mapping[str, Any]
    names: tuple[str, ...]
    rtol: float
    folder: str | None = None

    @property
    def number(self) -> MapNumber:
        """What is computed."""
        return NUMBERS[self.quantity]

    def case(self, values: Sequence[Any]) -> Case:
        """The case of a cell.

        Raises
        ------
        InputError
            If the values do not make one.
        """
        pairs = dict(zip(self.names, values, strict=True))
        case = self._of_problem(pairs) if self.folder is None else self._of_file(pairs)
        if self.number.at_load and len(case.applied) != 1:
            name = LOAD if self.folder is None else "load.applied"
            raise InputError(name, None, f"{self.quantity} belongs to a load: give one")
        return case

    def _of_problem(self, pairs: dict[str, Any]) -> Case:
        data = {**self.given, **pairs}
        load = data.pop(LOAD, None)
        applied: tuple[AppliedLoad, ...] = ()
        if load is not None:
            force = checked_number(LOAD, load, -LARGEST_FORCE, LARGEST_FORCE, "an end force in B/L², tension positive")
            applied = (AppliedLoad(force, force),)
        return Case("", Problem(**data), None, 1, None, self.rtol, {}, applied=applied)

    def _of_file(self, pairs: dict[str, Any]) -> Case:
        single = {k: dict(v) if isinstance(v, Mapping) else v for k, v in self.given.items()}
        for name, value in pairs.items():
            section, _, key = name.partition(".")
            single.setdefault(section, {})[key] = value
        return Case.from_dict(single, folder=Path(self.folder or "."))


def data_of(problem: Problem) -> dict[str, Any]:
    """A problem as plain data, by name: every field of it, so that nothing that it holds is left out of a map."""
    problem.refuse_curved("maps are computed")
    problem.refuse_bridges("maps")
    data = {field.name: getattr(problem, field.name) for field in fields(problem)}
    return data | {"ends": "-".join(problem.ends), "sections": [list(section) for section in problem.sections]}

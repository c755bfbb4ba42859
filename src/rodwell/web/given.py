"""The case that is explored, as it was given: what can be moved in it, and the case with other numbers.

Light to import: what a page is told first does not wait for what computes.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rodwell._version import __version__
from rodwell.case.case import Case
from rodwell.problem.clearances import refuse_ramps
from rodwell.web.inputs import DEFAULT, ENDS, MOST_MODES, controls, moved


class Given:
    """A case to begin with.

    Parameters
    ----------
    data
        Content of the case file; None: :data:`rodwell.web.inputs.DEFAULT`.
    folder
        From which files that the case names are sought.
    source
        Name of the case in messages.

    Raises
    ------
    InputError
        If it is no case.
    """

    def __init__(self, data: dict[str, Any] | None, folder: str = ".", source: str = "case") -> None:
        self.data: dict[str, Any] = DEFAULT if data is None else data
        self._folder, self._source = Path(folder), source
        self.case = self.case_of(self.data)
        self.controls = controls(self.data, self.case)

    def case_of(self, data: Mapping[str, Any]) -> Case:
        """Return the case of other content, with as many modes as a page shows."""
        case = Case.from_dict(data, source=self._source, folder=self._folder)
        refuse_ramps(case.problem, "pictures in space, which `rodwell explore` shows,")
        if case.modes > MOST_MODES:
            data = {**data, "analysis": {**data.get("analysis", {}), "modes": MOST_MODES}}
            case = Case.from_dict(data, source=self._source, folder=self._folder)
        return case

    def moved(self, inputs: Mapping[str, Any] | None) -> tuple[dict[str, Any], Case]:
        """Return content and case with other numbers, ends, modes and sections."""
        data = moved(self.data, self.controls, dict(inputs or {}))
        return data, self.case_of(data)

    def hello(self) -> dict[str, Any]:
        """What the page needs to begin: what can be moved, and where it stands."""
        ends = "-".join(self.case.problem.ends)
        return {
            "kind": "hello",
            "version": __version__,
            "title": self.case.title,
            "physical": self.case.scales is not None,
            "controls": [vars(control) for control in self.controls],
            "sections": self.data["dimensionless"].get("sections", "") if "dimensionless" in self.data else None,
            "ends": ends,
            "all_ends": [ends, *(each for each in ENDS if each != ends)],
            "modes": min(self.case.modes, MOST_MODES),
            "most_modes": MOST_MODES,
        }

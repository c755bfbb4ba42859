"""What a problem refuses where something is asked for that is not computed of rods or holes like its own."""

from __future__ import annotations

from typing import Any

from rodwell.errors import InputError
from rodwell.problem.clearances import refuse_clearances


class Refusals:
    """Of :class:`rodwell.problem.problem.Problem`: methods that raise an :class:`rodwell.InputError`, or do nothing."""

    def refuse_curved(self: Any, what: str) -> None:
        """Raise in a curved hole: ``what`` is computed in straight ones."""
        if self.hole is not None:
            name = "axis" if self.axis else "build" if self.build != 0.0 else "walk"
            value = f"{len(self.axis)} points" if self.axis else getattr(self, name)
            raise InputError(name, value, f"must be left out: {what} in straight holes only")

    def refuse_bridges(self: Any, what: str) -> None:
        """Raise where a string leaves the wall by itself, or the clearance varies.

        ``what`` are computed of rods that stay on a wall of one clearance.
        """
        refuse_clearances(self, what)

    def refuse_tapers(self: Any, what: str) -> None:
        """Raise where a section tapers: ``what`` are computed of sections of one stiffness and weight each."""
        if self.tapered:
            raise InputError(
                "sections", "tapered", f"must have one stiffness, weight and torsion in each: {what} are not "
                "computed of sections that taper",
            )  # fmt: skip

"""What a problem refuses where something is asked for that is not computed of rods or holes like its own."""

from __future__ import annotations

from typing import Any

from rodwell.errors import InputError


class Refusals:
    """Of :class:`rodwell.problem.problem.Problem`: methods that raise an :class:`rodwell.InputError`, or do nothing."""

    def refuse_curved(self: Any, what: str) -> None:
        """Raise in a curved hole: ``what`` is computed in straight ones."""
        if self.hole is not None:
            name = "axis" if self.axis else "build" if self.build != 0.0 else "walk"
            value = f"{len(self.axis)} points" if self.axis else getattr(self, name)
            raise InputError(name, value, f"must be left out: {what} in straight holes only")

    def refuse_bridges(self: Any, what: str) -> None:
        """Raise where a string leaves the wall by itself: ``what`` are computed of rods that stay on the wall."""
        if self.bridges and not self.rod.clearance_steps.size:
            ratios = " + ".join(f"{section[2]}" for section in self.sections[:6])
            raise InputError(
                "sections", f"weight ratios {ratios}" + (" + …" if len(self.sections) > 6 else ""),
                f"must all sink or all float: {what} are those of a rod that stays on the wall, and where a string "
                "begins to float it leaves one side of the hole for the other. How it lies there, and when it buckles: "
                "`rodwell run` of a case; `rodwell path`, `rodwell critical`, rodwell.load_path",
            )  # fmt: skip
        if self.bridges:
            ratios = " + ".join(f"{section[3]:g}" for section in self.sections[:6])
            raise InputError(
                "sections", f"clearance ratios {ratios}" + (" + …" if len(self.sections) > 6 else ""),
                f"must have one clearance: {what} are those of a rod that stays on the wall, and a string bridges "
                "steps of the clearance, off the wall. How it lies there, and when it buckles: `rodwell run` "
                "of a case; `rodwell path`, `rodwell critical`, rodwell.load_path",
            )  # fmt: skip

    def refuse_tapers(self: Any, what: str) -> None:
        """Raise where a section tapers: ``what`` are computed of sections of one stiffness and weight each."""
        if self.tapered:
            raise InputError(
                "sections", "tapered", f"must have one stiffness, weight and torsion in each: {what} are not "
                "computed of sections that taper",
            )  # fmt: skip

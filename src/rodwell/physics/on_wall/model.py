"""The rod on a cylinder as a model that numerics can solve: see :mod:`rodwell.numerics.splines.assembly`."""

from __future__ import annotations

from typing import Any, NamedTuple

from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.parameters import RAMP
from rodwell.physics.on_wall.sections import GIVEN, of_section, section_density
from rodwell.physics.on_wall.strand import towards_lift_off


class RodOnCylinder(NamedTuple):
    """A heavy rod kept on a cylinder: one field, y = Δ ξ₂. The entry only counts."""

    y: int = 0

    @staticmethod
    def given() -> tuple[str, ...]:
        """Names of the coefficients that vary along s: none."""
        return ()

    @staticmethod
    def out_of_range() -> str:
        """What an energy that is no number means."""
        return "the rod turned across the cylinder (|η| = 90°): the load is beyond the theory's range"

    @staticmethod
    def density(s: Any, u: Any, _given: Any, parameters: Any, rates: Any) -> Any:
        """Energy density and its derivatives at ``s``, where y less the ramp has the value and derivatives ``u``."""
        ramp = parameters[RAMP]
        return rod_density(s, u[0] + ramp * s, u[1] + ramp, u[2], parameters, rates)

    @staticmethod
    def observed(s: Any, u: Any, _given: Any, parameters: Any) -> Any:
        """Return the contact pressure, negative in contact, at ``s``, from ``u`` with the third derivative."""
        ramp = parameters[RAMP]
        return towards_lift_off(s, u[0] + ramp * s, u[1] + ramp, u[2], u[3], parameters)


class RodOfSections(NamedTuple):
    """A rod of sections kept on a cylinder: see :mod:`rodwell.physics.on_wall.sections`. The entry only counts."""

    y: int = 0

    @staticmethod
    def given() -> tuple[str, ...]:
        """Names of the coefficients that vary along s, by steps."""
        return GIVEN

    @staticmethod
    def out_of_range() -> str:
        """What an energy that is no number means."""
        return RodOnCylinder.out_of_range()

    @staticmethod
    def density(s: Any, u: Any, given: Any, parameters: Any, rates: Any) -> Any:
        """Energy density and its derivatives at ``s``, in the section whose data are ``given``."""
        ramp = parameters[RAMP]
        return section_density(s, u[0] + ramp * s, u[1] + ramp, u[2], given, parameters, rates)

    @staticmethod
    def observed(s: Any, u: Any, given: Any, parameters: Any) -> Any:
        """Return the contact pressure, negative in contact, at ``s``, from ``u`` with the third derivative."""
        ramp, own = parameters[RAMP], of_section(given, parameters)
        return towards_lift_off(s, u[0] + ramp * s, u[1] + ramp, u[2], u[3], own, given[0])

"""The rod on a cylinder as a model that compiled numerics can call: see :mod:`rodwell.jit`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from numba import types
from numba.extending import overload

from rodwell.jit import contact, density
from rodwell.physics._kernels import rod_density
from rodwell.physics.parameters import RAMP
from rodwell.physics.strand import towards_lift_off


class RodOnCylinder(NamedTuple):
    """A heavy rod kept on a cylinder: one field, y = Δ ξ₂. The entry only counts."""

    y: int = 0


def _is_rod(model: Any) -> bool:
    return isinstance(model, types.BaseNamedTuple) and getattr(model, "instance_class", None) is RodOnCylinder


@overload(density)
def _density(  # type: ignore[no-untyped-def]
    model, s, u, parameters, rates, gradient, hessian, mixed
) -> Callable[..., tuple[float, float]] | None:
    if not _is_rod(model):
        return None

    def rod(model, s, u, parameters, rates, gradient, hessian, mixed):  # type: ignore[no-untyped-def]
        u[0] += parameters[RAMP] * s
        u[1] += parameters[RAMP]
        return rod_density(s, u, parameters, rates, gradient, hessian, mixed)

    return rod


@overload(contact)
def _contact(model, s, u, parameters) -> Callable[..., float] | None:  # type: ignore[no-untyped-def]
    if not _is_rod(model):
        return None

    def rod(model, s, u, parameters):  # type: ignore[no-untyped-def]
        ramp = parameters[RAMP]
        return towards_lift_off(s, u[0] + ramp * s, u[1] + ramp, u[2], u[3], parameters)

    return rod

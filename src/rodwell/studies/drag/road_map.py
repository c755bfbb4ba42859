"""The road map of a well: hook load and torque against the depth of the bit, for several friction factors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.case.well.hole_sections import checked_friction
from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.studies.drag.laws import contact_named
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.run import Run, run
from rodwell.studies.drag.well_case import Operation, Well, check_weight_on_bit

RULE = "early"
"""Where two local states are stable the map takes the one with more contact: it stands for a limit."""


@dataclass(frozen=True)
class Curve:
    """One operation with one friction.

    Attributes
    ----------
    kind, label
        The operation; the friction, as it was asked for.
    friction
        Friction factors of the hole's sections.
    hook_load, torque, error
        Along the depths, (n,): effective force at surface in N, tension positive, without the block; torque in N m;
        error of the force in N. NaN where the string locks up or the push does not suffice.
    possible
        Where the operation is possible, (n,).
    """

    kind: str
    label: str
    friction: tuple[float, ...]
    hook_load: FloatArray
    torque: FloatArray
    error: FloatArray
    possible: FloatArray


@dataclass(frozen=True)
class RoadMap:
    """Curves over the depths of the bit in m, (n,)."""

    well: Well
    depths: FloatArray
    curves: tuple[Curve, ...]


def road_map(well: Well, progress: Callable[[str, float], None] | None = None) -> RoadMap | None:
    """Compute the road map that the well asks for; None if it does not ask for one.

    Raises
    ------
    InputError
        For depths outside of the well or the string, or friction that is none.
    """
    asked = well.settings.road_map
    if asked is None:
        return None
    cutter = Cutter(well)
    deepest = min(well.end, float(cutter.string_ends[-1]))
    last = deepest if asked.to is None else asked.to
    first = last / asked.depths if asked.from_ is None else asked.from_
    if last > deepest * (1.0 + 1e-12):
        raise InputError("well.road_map.to", f"{last:g} m", f"is below what survey and string reach, {deepest:g} m")
    if not 0.0 < first < last:
        raise InputError(
            "well.road_map.from", f"{first:g} m", f"must be more than 0 m and less than well.road_map.to, {last:g} m"
        )
    check_weight_on_bit("well.road_map.bit_force", asked.bit_force or 0.0)
    depths = np.linspace(first, last, asked.depths)
    tell = progress or (lambda _what, _done: None)
    curves = []
    frictions = _frictions(well)
    for i, (label, friction) in enumerate(frictions):
        for kind in asked.kinds:
            tell(f"road map, {kind}", i / len(frictions))
            curves.append(_curve(well, Cutter(well, friction), kind, label, friction, depths))
    return RoadMap(well, depths, tuple(curves))


def _frictions(well: Well) -> list[tuple[str, tuple[float, ...]]]:
    """Labels and friction factors of the hole's sections."""
    asked = well.settings.road_map
    assert asked is not None
    own = tuple(part.friction for part in well.hole)
    if asked.friction is not None:
        if asked.friction_times is not None:
            what = "contradicts well.road_map.friction: give only one of the two"
            raise InputError("well.road_map.friction_times", None, what)
        key = "well.road_map.friction"
        return [(f"{mu:g}", tuple(checked_friction(key, mu) for _ in own)) for mu in asked.friction]
    if asked.friction_times is not None:
        key = "well.road_map.friction_times"
        return [(f"× {k:g}", tuple(checked_friction(key, k * mu) for mu in own)) for k in asked.friction_times]
    return [(f"{own[0]:g}" if len(set(own)) == 1 else "as given", own)]


def _curve(well: Well, cutter: Cutter, kind: str, label: str, friction: tuple[float, ...], depths: FloatArray) -> Curve:
    """One curve; each depth is computed twice, and the coarser one tells the error."""
    asked = well.settings.road_map
    assert asked is not None
    force = (asked.bit_force or 0.0) if kind in ("slide", "drill") else 0.0
    model = next((one for one in well.operations if one.kind == kind), Operation(kind, kind, float(depths[-1]), force))
    if kind in ("ream", "back-ream") and model.speed == 0.0:
        what = f"needs speed and rpm: give a [[well.operation]] of kind {kind!r} with them, or leave it out"
        raise InputError("well.road_map.kinds", kind, what)
    model = replace(model, bit_force=force if asked.bit_force is not None or kind not in ("slide", "drill")
                    else model.bit_force)  # fmt: skip
    contact = contact_named(well.settings.contact)

    def at(depth: float, crude: bool) -> Run:
        return run(cutter, model, contact, RULE, depth=depth, coarse=True, record=False, crude=crude)

    hook, torque, error = (np.full(len(depths), np.nan) for _ in range(3))
    possible = np.zeros(len(depths), dtype=bool)
    for i, depth in enumerate(depths):
        one, rough = at(float(depth), False), at(float(depth), True)
        if not one.arrived:
            continue
        hook[i], torque[i] = one.force, one.torque
        error[i] = abs(one.force - rough.force) + 1e-12 * abs(one.force) if rough.arrived else np.inf
        possible[i] = one.force >= -well.push
    return Curve(kind, label, friction, hook, torque, error, possible)

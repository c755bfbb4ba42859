"""What each support must bear in one state, against what it can bear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.state.balance import end_loads
from rodwell.analysis.state.compared import compared
from rodwell.case.schema import Supports
from rodwell.quantities.scales import Scales
from rodwell.quantities.value import Peak
from rodwell.strength.loaded import Fields, LoadedRod, OnMesh

WHAT = {"force": "force", "moment": "bending moment", "torque": "torque"}
"""Kinds of capacity, as they are called."""

ENDS = np.array([0.0, 1.0])


@dataclass(frozen=True, slots=True, kw_only=True)
class Support(Peak):
    """The most that one of the supports exerts: value and error in N or N m, of what, and where.

    ``on`` is "rod" or "cylinder", ``s`` 0.0 or 1.0; ``utilisation`` is the part of the capacity.
    """

    kind: str
    on: str
    capacity: float

    @property
    def utilisation(self) -> float:
        """Part of the capacity."""
        return self.value / self.capacity

    @property
    def text(self) -> str:
        """Which support, and which load."""
        return f"{WHAT[self.kind]} on the {self.on} at s = {self.s:g}"


def support_loads(state: LoadedRod, capacities: Supports, scales: Scales) -> tuple[Support, ...]:
    """The most loaded support for each capacity that is given."""
    sizes = [_sizes(fields(ENDS)) for fields in state.along]
    out = []
    for kind in WHAT:
        capacity = getattr(capacities, kind)
        if capacity is None:
            continue
        unit = scales.factor("force" if kind == "force" else "moment")
        on, s = max(sizes[-1][kind], key=sizes[-1][kind].__getitem__)
        value, error = compared(*(level[kind][on, s] * unit for level in (sizes[0], sizes[-1])))
        error += state.error * unit if kind == "force" else 0.0
        out.append(Support(value, error, s, kind=kind, on=on, capacity=capacity))
    return tuple(out)


def most_used(along: OnMesh, capacities: Supports, scales: Scales) -> float:
    """Largest part of a capacity that a support uses, from the fields of a state on one mesh."""
    units = {"force": scales.factor("force")}
    parts = []
    for kind, sizes in _sizes(along(ENDS)).items():
        capacity = getattr(capacities, kind)
        if capacity is not None:
            parts.append(max(sizes.values()) * units.get(kind, scales.factor("moment")) / capacity)
    return float(max(parts))


def _sizes(f: Fields) -> dict[str, dict[tuple[str, float], float]]:
    """Size of each kind of load at each support in units B = L = 1: force, moment across the axis, torque about it."""
    loads = end_loads(f)
    return {
        "force": {place: float(np.linalg.norm(force)) for place, (force, _) in loads.items()},
        "moment": {place: float(np.hypot(*moment[:2])) for place, (_, moment) in loads.items()},
        "torque": {place: float(abs(moment[2])) for place, (_, moment) in loads.items()},
    }

"""A load path in sentences."""

from __future__ import annotations

from collections.abc import Sequence

from rodwell.analysis.path.events import CRITICAL, LIFT_OFF, LOADING, SNAP, UNLOADING, PathPoint
from rodwell.quantities.text import amount


def sentences(events: Sequence[PathPoint]) -> tuple[str, ...]:
    """What happens on loading and on unloading, in a few sentences; compression at s = 1 in B/L²."""
    out = []
    up, down = ([one for one in events if one.leg == leg] for leg in (LOADING, UNLOADING))
    parts = [_clause(one) for one in up if one.kind in (CRITICAL, LIFT_OFF, SNAP)]
    if parts:
        out.append("Under growing compression the rod " + "; ".join(parts) + ".")
    parts = [_clause(one) for one in down if one.kind in (CRITICAL, LIFT_OFF, SNAP)]
    if parts:
        out.append("When the load is taken off it " + "; ".join(parts) + ".")
    return tuple(out)


def _clause(event: PathPoint) -> str:
    load = amount(event.force.times(-1.0), 6)
    if event.kind == CRITICAL:
        return f"buckles at {load} B/L²" if event.leg == LOADING else f"is straight again at {load} B/L²"
    if event.kind == LIFT_OFF:
        return f"lifts off the wall at {load} B/L²"
    assert event.to is not None
    if event.to.kind == "straight":
        return f"falls back to the straight shape at {load} B/L²"
    turns = f" of {abs(event.to.turns)} turn{'s' if abs(event.to.turns) != 1 else ''}" if event.to.turns else ""
    return f"snaps at {load} B/L² to {_NAMES.get(event.to.kind, 'another state of partial contact')}{turns}"


_NAMES = {"helix": "a helix", "sinusoidal": "a sinusoidal shape on the wall"}

"""The table of the page on the rod off the wall: reference values beside computed ones."""

from __future__ import annotations

from pathlib import Path

from shown import table

import rodwell

EVENTS = (
    ("buckles", "critical", "loading", "−111.23344016"),
    ("lifts off, s = ½", "lift_off", "loading", "−123.173074"),
    ("two more gaps open", "gap_opens", "loading", "−124.1911865"),
    ("stretches become points", "contact_point", "loading", "≈ −144.52"),
    ("contact at the ends lost", "contact_lost", "loading", "≈ −144.84"),
    ("limit point, snap", "fold", "loading", "−147.1580802"),
    ("the helix lifts off", "lift_off", "unloading", "−109.8311707"),
    ("its limit point, back to straight", "fold", "unloading", "−103.6731326"),
)

STATES = (
    (-124.24036601, "−0.00121700", None),
    (-125.41829806, "−0.00145016", "8.077165e-5"),
    (-125.99602743, "−0.00157218", "1.55479e-4"),
    (-129.09905442, "−0.00231622", "1.26829e-3"),
    (-135.48955152, "−0.00436417", "1.03458e-2"),
    (-141.83481098, "−0.00722313", "3.84133e-2"),
    (-148.5, "−0.062934371", None),
)


def pages(_out: Path) -> dict[str, str]:
    """The table, computed now."""
    path = rodwell.load_path(rodwell.Problem(15), until=-150.0, unload_to=-100.0)
    rows = []
    for name, kind, leg, known in EVENTS:
        event = path.first(kind, leg)
        assert event is not None
        rows.append((name, known, _number(event.force.value, 9), f"{event.force.error:.0e}".replace("-", "−")))
    for force, energy, gap in STATES:
        state = path.at(force)[0].state
        at = _number(force, 8).rstrip("0").rstrip(".")
        rows.append((f"energy at F = {at}", energy, _number(state.energy.value, 11), _error(state.energy.error)))
        if gap is not None:
            middle = min(state.gaps, key=lambda one: abs(one.at - 0.5)).largest
            rows.append((f"gap at mid-length at F = {at}", gap, f"{middle.value:.8e}", _error(middle.error)))
    return {"off-wall.md": table(("What", "Reference", "Computed", "± error"), rows)}


def _number(value: float, digits: int) -> str:
    return f"{value:.{digits}f}".replace("-", "−")


def _error(error: float) -> str:
    return f"{error:.0e}".replace("-", "−")

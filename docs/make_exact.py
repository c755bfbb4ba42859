"""Tables of the page on certified loads: the paper's closed-form values, and loads beside those of the engine.

Called by ``make_pages``.
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from shown import table

import rodwell


def pages(_out: Path) -> dict[str, str]:
    """The tables by file name."""
    return {"exact-paper.md": paper_table(), "exact-engine.md": engine_table()}


def paper_table() -> str:
    """The paper's closed-form values, enclosed."""
    rows = []
    for item in rodwell.paper_values():
        value, _ = item.value.text(30)
        verdict = "yes" if item.agrees else "**no**"
        rows.append((item.equation, item.quantity, item.printed, value, verdict, item.proof))
    return table(("Where", "Quantity", "Printed", "Exact, 30 digits", "As printed", "Proof"), rows)


def engine_table() -> str:
    """Certified first loads beside those of the engine."""
    clamped, rows = ("clamped", "clamped"), []
    for weight, alpha, ends, on_top in (
        (60, 35, clamped, False),
        (140, 60, clamped, False),
        (125, 2, clamped, False),
        (60, 35, ("pinned", "free"), False),
        (60, 35, ("guided", "clamped"), False),
        (40, 70, clamped, True),
    ):
        problem = rodwell.Problem(weight, alpha=alpha, ends=ends, on_top=on_top)
        proved, mode = rodwell.certify(problem, 1)[0], rodwell.critical_loads(problem, 1)[0]
        if not proved.force.within(mode.force, mode.error):
            raise RuntimeError(f"docs: {problem}: {mode.force} ± {mode.error} lies outside its enclosure")
        share = abs(float(proved.force.middle - Fraction(mode.force))) / mode.error
        engine = f"{mode.force:.12f} ± {mode.error:.0e}".replace("-", "−")
        exact = proved.force.text(30)[0].replace("-", "−")
        place = f"{'–'.join(ends)}{', on top' if on_top else ''}"
        rows.append((str(weight), f"{alpha}°", place, exact, engine, f"{share:.2f}"))
    return table(("γ", "α", "Ends", "F, 30 digits proved", "Engine", "Error / estimate"), rows)

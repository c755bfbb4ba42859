"""Error estimates beside true errors on the page on convergence: read from the campaign that is kept with the sources.

``benchmarks/campaigns/errors.py`` wrote it; ``tests/validation/test_errors_hold.py`` asserts what the page says.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from shown import DPI, table

from rodwell.plots.style import GREY, INK, MODES, RC, new_axes

CAMPAIGNS = Path(__file__).resolve().parents[1] / "benchmarks" / "campaigns"

KINDS = {
    "lift_off": "lift-off loads",
    "touch_down": "touch-down loads",
    "fold": "loads of folds",
    "branch_point": "loads of branch points",
    "p_max": "largest contact pressure",
    "energy": "energy",
    "shortening": "approach of the ends",
    "omega2_0": "ω₂ at s = 0",
    "omega2_1": "ω₂ at s = 1",
    "angle_mid": "angle at mid-length",
    "torque_0": "support torque",
}
"""What was compared, as the table calls it."""

LEAST = 1e-19
"""True errors below this are drawn there: exact to the digits of the second method."""


@cache
def result() -> dict[str, Any]:
    """Summary of the campaign."""
    data: dict[str, Any] = json.loads((CAMPAIGNS / "errors.json").read_text(encoding="utf-8"))
    return data


@cache
def rows() -> list[tuple[str, float, float]]:
    """Kind, estimate and true error of every number, relative to its scale."""
    lines = (CAMPAIGNS / "errors.jsonl").read_text(encoding="utf-8").splitlines()
    return [(kind, claimed, true) for line in lines for kind, _, claimed, true in json.loads(line)["rows"]]


def pages(out: Path) -> dict[str, str]:
    """Draw the figure into ``out``; return sentences and tables."""
    with mpl.rc_context(RC):
        draw(out / "convergence-campaign.png")
    return {
        "convergence-campaign.md": sentences(),
        "convergence-by-kind.md": kinds_table(),
        "convergence-by-tolerance.md": tolerance_table(),
        "convergence-left-out.md": left_out(),
    }


def draw(path: Path) -> None:
    """Estimate and true error of every number."""
    ax = new_axes(size=(7.2, 5.2))
    line = np.array([1e-13, 1.0])
    ax.fill_between(line, line, 1.0, color="#fdecea", lw=0.0)
    ax.loglog(line, line, color=INK, lw=0.9)
    groups = (
        ("the other six numbers of a state", GREY, [k for k in KINDS if k not in LOADS]),
        ("largest contact pressure", MODES[0], ["p_max"]),
        ("lift-off and touch-down loads", MODES[2], ["lift_off", "touch_down"]),
        ("folds and branch points", MODES[1], ["fold", "branch_point"]),
    )
    for label, color, kinds in groups:
        part = np.array([(claimed, max(true, LEAST)) for kind, claimed, true in rows() if kind in kinds])
        ax.plot(part[:, 0], part[:, 1], ".", color=color, ms=3.5, label=label)
    ax.set_xlim(1e-13, 1e-5)
    ax.set_ylim(LEAST, 1e-5)
    ax.text(1.5e-13, 1e-7, "true error above the estimate", color="#b3261e", fontsize=8.5)
    ax.set_xlabel("error estimate, relative to the load or the scale of the number")
    ax.set_ylabel("true error, likewise")
    ax.legend(loc="lower right", fontsize=8.0)
    ax.figure.savefig(path, dpi=DPI)


LOADS = ("p_max", "lift_off", "touch_down", "fold", "branch_point")
"""What the campaign asks most of."""


def _share(part: dict[str, Any]) -> str:
    return "all" if part["above"] == 0 else f"{100.0 * part['within']:.2f} %"


def _cells(part: dict[str, Any]) -> tuple[str, ...]:
    caution = f"{part['median_caution']:.0f}" if part["median_caution"] < 1e6 else "mostly exact"
    estimate = f"{part['median_estimate']:.0e}".replace("-", "−")
    return str(part["numbers"]), estimate, _share(part), f"{part['worst']:.2f}", caution


HEAD = ("Numbers", "Median estimate", "True error within it", "Largest true/estimate", "Median estimate/true")


def sentences() -> str:
    """How many numbers, how many within their estimates, how far off the worst."""
    data = result()
    loads, everything = data["special_points_and_largest_pressures"], data["all"]
    return (
        f"{data['problems']} problems, seed {data['seed']}, {data['date']}, {data['machine']}. Farther off than "
        f"estimated: {loads['above']} of {loads['numbers']} located loads and largest pressures, the worst "
        f"{loads['worst']:.2f} times its estimate; in the median the estimate is {loads['median_caution']:.0f} "
        f"times too large. Of all {everything['numbers']} numbers: {everything['above']}, the worst by a factor of "
        f"{everything['worst']:.2f}.\n"
    )


def kinds_table() -> str:
    """By what was compared."""
    found = result()["by_kind"]
    return table(("Number", *HEAD), [(name, *_cells(found[kind])) for kind, name in KINDS.items() if kind in found])


def tolerance_table() -> str:
    """By the tolerance asked for."""
    rows = []
    for low, part in result()["by_tolerance"].items():
        rows.append((f"{float(low):.0e} to {10.0 * float(low):.0e}".replace("-", "−"), *_cells(part)))
    return table(("rtol", *HEAD), rows)


def left_out() -> str:
    """What could not be compared, and why."""
    return table(("Not compared, or a branch that ended early", "Problems"),
                 [(text, str(count)) for text, count in result()["not_compared"].items()])  # fmt: skip

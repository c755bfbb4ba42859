"""Table and figure of the page on tubing in packers, called by ``make_pages``: everything is computed here."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib as mpl
from shown import DPI, table

import rodwell
from rodwell.formulas.pushing import tubing_shortening
from rodwell.plots.style import RC
from rodwell.plots.wells.packer import plot_packer
from rodwell.studies.packer.lengths import Conditions, Tubing, effective_compression, total
from rodwell.studies.packer.motion import Moved, Stops, moved

COMMANDS = {"packer": "packer examples/tubing-packer.toml --out results/packer"}

CASE = Path(__file__).resolve().parent.parent / "examples" / "tubing-packer.toml"

TUBING = Tubing(
    length=120e3, angle=0.0, modulus=30e6, poisson=0.3, expansion=6.9e-6, inertia=1.61, area=1.81, inner_area=4.68,
    outer_area=6.49, clearance=1.61, seal_area=8.30, ratio=1.178,
)  # fmt: skip
"""The tubing of 1962, in inches, pounds and °F, rounded as printed."""


def _weight(inside: float, outside: float) -> float:
    return 6.5 / 12.0 + TUBING.inner_area * inside - TUBING.outer_area * outside


LANDED = Conditions(_weight(0.0317, 0.0317), 0.0, 0.0, 0.0317, 0.0317)
SQUEEZED = Conditions(_weight(0.0649, 0.0317), 5000.0, 1000.0, 0.0649, 0.0317, -20.0)
SLACKED_OFF = 20e3


def pages(out: Path) -> dict[str, str]:
    """Return the table, and draw the figure into ``out``."""
    with mpl.rc_context(RC):
        ax = plot_packer(rodwell.packer(rodwell.Case.read(CASE)))
        ax.figure.savefig(out / "packer.png", dpi=DPI)
    found, small = _found(), _small_slopes()
    printed = {"in all": "−165.2", "slack-off of 20,000 lbf": "49.7"}
    exact = {kind: change.value for kind, change in found.changes.items()}
    exact |= {"in all": total(found.changes).value, "slack-off of 20,000 lbf": found.landed.value}
    rows = [(what, _inch(small[what]), printed.get(what, ""), _inch(value)) for what, value in exact.items()]
    head = ("change of length [in]", "their formulas, small slopes", "as printed", "exact helix")
    return {"packer-1962.md": table(head, rows)}


def _found() -> Moved:
    return moved(TUBING, LANDED, SQUEEZED, Stops(math.inf, 0.0), -SLACKED_OFF)


def _small_slopes() -> dict[str, float]:
    """The same with r²F²/(8EIw) for the helix, in inches."""
    out = {kind: change.value for kind, change in _found().changes.items()}
    out["buckling"] = -_helix(SQUEEZED, effective_compression(TUBING, SQUEEZED, 0.0))
    out["in all"] = sum(out.values())
    stretch = SLACKED_OFF * TUBING.length / (TUBING.modulus * TUBING.area)
    return out | {"slack-off of 20,000 lbf": stretch + _helix(LANDED, SLACKED_OFF)}


def _helix(state: Conditions, compression: float) -> float:
    return abs(float(tubing_shortening(TUBING.stiffness, state.weight, TUBING.clearance, compression)))


def _inch(value: float) -> str:
    return f"{value:.2f}".replace("-", "−")


def numbers() -> dict[str, str]:
    """Numbers that the page quotes."""
    small, exact = _small_slopes()["buckling"], _found().changes["buckling"].value
    return {"packer_small": _inch(-small), "packer_percent": f"{100.0 * (exact / small - 1.0):.2f}"}

"""Table and figure of the page on long strings, called by ``make_pages``: everything is computed here."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import matplotlib as mpl
import numpy as np
from shown import DPI, table

import rodwell
from rodwell.analysis.state.extent import buckled_to
from rodwell.plots.style import GREY, MODES, RC, new_axes

COMMANDS = {"long-string": "run examples/long-string.toml --no-path --out results/long-string"}

LENGTHS = (30.0, 50.0, 80.0, 120.0, 200.0, 300.0, 600.0, 1000.0, 3000.0)
DRAWN = tuple(float(x) for x in np.geomspace(25.0, 1000.0, 45))
CASE = Path(__file__).resolve().parent.parent / "examples" / "long-string.toml"

AIRY = 2.338107410459767


@dataclass(frozen=True)
class Loads:
    """Compressions at the lower end in kN of a string of length L in m, errors, and where its first mode is."""

    length: float
    buckles: float
    buckles_error: float
    lifts: float
    lifts_error: float
    dawson_paslay: float
    corrected: float
    reach: float
    half_wave: float


@cache
def loads(length: float, lift_off: bool = True) -> Loads:
    """The example's string, with another length."""
    case = rodwell.Case.read(CASE)
    whole = case.scales.factor("length")
    part = length / whole
    rod = case.problem.but(weight=case.problem.weight * part**3, clearance=case.problem.clearance / part)
    unit = case.scales.factor("force") / part**2 / 1e3
    mode = rodwell.critical_loads(rod, 1)[0]
    lift = rodwell.follow(rod, mode).lift_off if lift_off else None
    b = rod.lateral_weight / rod.clearance
    paslay = 2.0 * math.sqrt(b)
    return Loads(
        length,
        (rod.axial_weight - mode.force) * unit,
        mode.error * unit,
        math.nan if lift is None else (rod.axial_weight - lift.force) * unit,
        math.nan if lift is None else lift.error * unit,
        paslay * unit,
        (paslay + AIRY * (4.0 * rod.axial_weight**2) ** (1.0 / 3.0)) * unit,
        buckled_to(mode) * length,
        math.pi / b**0.25 * length,
    )


def pages(out: Path) -> dict[str, str]:
    """Return the table, and draw the figure into ``out``."""
    rows = []
    for length in LENGTHS:
        x = loads(length)
        share, lift = x.buckles / x.dawson_paslay, x.lifts / x.dawson_paslay
        reach = "the whole" if x.reach > 0.5 * length else f"{x.reach:.1f} m"
        cells = (f"{length:g} m", f"{x.buckles:.6f} ± {x.buckles_error:.0e}", f"{x.lifts:.5f} ± {x.lifts_error:.0e}")
        rows.append((*(c.replace("e-", "e−") for c in cells), f"{share:.4f}", f"{lift:.4f}", reach))
    head = ("L", "buckles at [kN]", "lifts off at [kN]", "buckling / DP", "lift-off / DP", "buckled part")
    with mpl.rc_context(RC):
        _draw(out / "long-strings.png")
    return {"long-strings.md": table(head, rows)}


def _draw(path: Path) -> None:
    ax = new_axes()
    lengths = np.array(DRAWN)
    found = [loads(length) for length in DRAWN]
    paslay = found[0].dawson_paslay
    ax.semilogx(lengths, [x.buckles / paslay for x in found], color=MODES[0], lw=2.2, label="exact, buckling")
    ax.semilogx(lengths, [x.lifts / paslay for x in found], color=MODES[1], lw=2.2, label="exact, lift-off of mode 1")
    lines = {
        "Dawson–Paslay": 1.0,
        "with the weight's first correction": found[0].corrected / paslay,
        "Chen–Lin–Cheatham": math.sqrt(2.0),
        "Wu–Juvkam-Wold": 2.0 * math.sqrt(2.0) - 1.0,
    }
    for (name, level), style in zip(lines.items(), ("-", "--", "-.", ":"), strict=True):
        ax.axhline(level, color=GREY, lw=1.2, ls=style, label=name)
    ax.set_xlim(lengths[0], lengths[-1])
    ax.set_ylim(0.9, 2.45)
    ticks = [length for length in (30, 100, 300, 1000, 3000) if lengths[0] <= length <= lengths[-1]]
    ax.set_xticks(ticks, [f"{length:g}" for length in ticks])
    ax.minorticks_off()
    ax.set_xlabel("length of the string  [m]")
    ax.set_ylabel("compression at the lower end\nover $2\\sqrt{B w \\sin\\alpha/r}$")
    ax.legend(loc="upper right")
    ax.figure.savefig(path, dpi=DPI)


def numbers() -> dict[str, str]:
    """Numbers that the page quotes."""
    x, short = loads(LENGTHS[-1]), loads(LENGTHS[0])
    return {
        "long_buckles": f"{x.buckles:.2f}",
        "long_lifts": f"{x.lifts:.2f}",
        "long_paslay": f"{x.dawson_paslay:.2f}",
        "long_corrected": f"{x.corrected:.2f}",
        "long_correction_error": f"{100.0 * abs(x.corrected / x.buckles - 1.0):.2g}",
        "long_paslay_error": f"{100.0 * (x.buckles / x.dawson_paslay - 1.0):.1f}",
        "long_short_error": f"{100.0 * (short.buckles / short.dawson_paslay - 1.0):.0f}",
        "long_reach": f"{x.reach:.1f}",
        "long_half_wave": f"{x.half_wave:.1f}",
    }

"""Tables and figures of the pages on formulas of practice, called by ``make_pages``: everything is computed here."""

from __future__ import annotations

import json
import math
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from shown import DPI, number, table

import rodwell
from rodwell.answers.comparison.exact_loads import PLACES, critical, exact_loads
from rodwell.formulas import FORMULAS, LEFT_OUT, inclined
from rodwell.plots.audit import COLOURS, LEVELS, plot_dellinger, plot_error_map, plot_hanging
from rodwell.plots.style import INK, RC
from rodwell.quantities.text import minus
from rodwell.studies.audit.audit import audit
from rodwell.studies.audit.error_map import error_map, hanging_coefficients

COMMANDS = {"audit": "audit examples/inclined-pipe.toml --no-chart --out results/audit"}

SIZES = (6.0, 8.0, 10.0, 14.0, 20.0, 30.0, 50.0, 100.0)
CLAMPED, PINNED, HANGING = ("clamped", "clamped"), ("pinned", "pinned"), ("pinned", "free")


def pages(out: Path) -> dict[str, str]:
    """Return the tables by file name, and draw the figures into ``out``."""
    with mpl.rc_context(RC):
        plot_error_map(error_map(rodwell.Problem(280, alpha=60))).savefig(out / "formulas-chart.png", dpi=DPI)
        dellinger(out / "dellinger.png")
        hanging(out / "hanging.png")
        in_builds(out / "formulas-builds.png")
    return {
        "formulas-places.md": places_table(),
        "formulas-dellinger.md": dellinger_table(),
        "formulas-helical.md": helical_table(),
        "formulas-ends.md": ends_table(),
        "formulas-list.md": list_table(),
        "formulas-left-out.md": table(("What", "Formula", "Why"), [(x.name, x.text, x.reason) for x in LEFT_OUT]),
        "lubinski.md": lubinski_table(),
        "lubinski-ends.md": lubinski_ends_table(),
    }


def dellinger(path: Path) -> None:
    """Fig. 13 of the paper, with more inclinations."""
    chart = error_map(rodwell.Problem(1), np.linspace(1.0, 300.0, 60), (10.0, 30.0, 60.0, 90.0))
    ax = plot_dellinger(chart)
    ax.set_ylim(-50.0, 450.0)
    ax.figure.savefig(path, dpi=DPI)


IN_BUILDS = Path(__file__).parent.parent / "benchmarks" / "results" / "curved_formulas.json"


def in_builds(path: Path) -> None:
    """Errors of formulas in a build section over its rate and the length of the pipe, from stored exact loads."""
    stored = json.loads(IN_BUILDS.read_text(encoding="utf-8"))
    rates, lengths = (np.array(stored[name]) for name in ("rates", "lengths"))
    exact = np.array(stored["compression"], dtype=float)
    pipe = stored["stiffness"], stored["weight"], 90.0, stored["clearance"]
    bends = np.radians(rates) / 30.0
    loads = {
        "He–Kyllingstad, with the curvature": [FORMULAS["he_kyllingstad"].function(*pipe, b, 0.0) for b in bends],
        "Dawson–Paslay, without it": [FORMULAS["dawson_paslay"].function(*pipe)] * rates.size,
    }
    figure = Figure(figsize=(9.6, 3.9), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    colours = mpl.colors.ListedColormap(COLOURS[1:-1]).with_extremes(under=COLOURS[0], over=COLOURS[-1])
    norm = mpl.colors.BoundaryNorm(LEVELS, len(COLOURS) - 2)
    for ax, (title, load), at in zip(axes, loads.items(), (FINE, LEVELS), strict=True):
        percent = np.ma.masked_invalid(100.0 * (np.array(load)[:, None] / exact - 1.0)).T
        shown = ax.contourf(rates, lengths, percent, LEVELS, cmap=colours, norm=norm, extend="both")
        lines = ax.contour(rates, lengths, percent, at, colors=INK, linewidths=0.8, linestyles="solid")
        ax.clabel(lines, fmt=lambda level: minus(f"{level:g} %"), fontsize=8)
        ax.set_yscale("log")
        ax.set_yticks([12, 20, 30, 50, 100, 200], [12, 20, 30, 50, 100, 200], minor=False)
        ax.minorticks_off()
        ax.grid(visible=False)
        ax.set_title(title, loc="left", fontsize=9.5)
        ax.set_xlabel("build rate  [°/30 m]")
    axes[0].set_ylabel("length of the pipe  [m]")
    figure.colorbar(shown, ax=axes, ticks=LEVELS, label="formula / exact − 1  [%]", shrink=0.95, pad=0.015)
    figure.savefig(path, dpi=DPI)


FINE = (-50.0, -25.0, -10.0, -5.0, -2.0, -1.0)
"""Errors in percent at which lines are drawn."""


def hanging(path: Path) -> None:
    """Coefficient of the bit load over the length of the string."""
    sizes = np.geomspace(2.2, 100.0, 60)
    pinned = hanging_coefficients(sizes, PINNED, 2)[0]
    curves = {
        "pinned–pinned, first load": (sizes, pinned[:, 0]),
        "pinned–pinned, second load": (sizes, pinned[:, 1]),
        "pinned bit, top free to move sideways": (sizes, hanging_coefficients(sizes, HANGING, 1)[0][:, 0]),
        "clamped–clamped, first load": (sizes, hanging_coefficients(sizes, CLAMPED, 1)[0][:, 0]),
    }
    ax = plot_hanging(curves, {"1.94": 1.94, "2.55": 2.55, "1.0188": 1.018793, "3.75": 3.75})
    ax.set_ylim(0.0, 6.0)
    ax.set_xticks([3, 5, 10, 20, 50, 100], ["3", "5", "10", "20", "50", "100"])
    ax.figure.savefig(path, dpi=DPI)


def places_table() -> str:
    """Exact critical compression over Dawson–Paslay's load, by place."""
    rows = []
    for alpha, weights in ((90, (40, 140, 280, 1000, 16000)), (60, (140, 280)), (30, (140, 280)), (10, (280,))):
        for weight in weights:
            load = critical(rodwell.Problem(weight, alpha=alpha))
            formula = inclined.dawson_paslay(1.0, weight, alpha, 0.01)
            ratios = [f"{load.at(place) / formula:.3f}" for place in PLACES]
            rows.append((f"{alpha}°", str(weight), number(load.force), number(formula, 2), *ratios))
    return table(("α", "γ", "exact F at s = 1, tension positive", "formula", "at the top", "middle", "bottom"), rows)


def dellinger_table() -> str:
    """Dellinger's fit beside the exact load at the top."""
    rows = []
    for weight, alpha in ((40, 90), (140, 90), (280, 90), (140, 60), (280, 60), (140, 30), (280, 30)):
        load = critical(rodwell.Problem(weight, alpha=alpha))
        fit, exact = inclined.dellinger(1.0, weight, alpha, 0.01), load.at("top")
        rows.append((f"{alpha}°", str(weight), f"{exact:.1f}", f"{fit:.1f}", _percent(fit / exact)))
    return table(("α", "γ", "exact, at s = 1", "(89)", "error"), rows)


def _percent(ratio: float) -> str:
    return f"{100.0 * (ratio - 1.0):+.1f} %".replace("-", "−")


def helical_table() -> str:
    """Helical loads of practice beside what the exact theory has: lift-off, equal energy, unloading of the coil."""
    rows = []
    for weight in (15, 280, 1000, 10000):
        loads, missing = exact_loads(rodwell.Problem(weight))
        if missing:
            raise RuntimeError(f"docs: {missing}")
        unit = 2.0 * math.sqrt(weight / 0.01)
        exact = {load.name: f"{load.at('top') / unit:.3f}" for load in loads}
        names = ("critical", "touch_down", "equal_energy", "lift_off")
        rows.append((str(weight), f"{unit:.1f}", *(exact[name] for name in names)))
    head = ("γ", "F_sin in B/L²", "first critical load", "coil leaves the wall, unloaded", "equal energy", "lift-off")
    return table(head, rows)


def ends_table() -> str:
    """Exact first critical load over Dawson–Paslay's by end conditions, horizontal."""
    rows = []
    for ends in ("clamped-clamped", "clamped-pinned", "pinned-pinned", "pinned-free", "free-free"):
        ratios = []
        for weight in (40, 280, 1000, 16000):
            load = critical(rodwell.Problem(weight, ends=ends))
            ratios.append(f"{load.at('top') / inclined.dawson_paslay(1.0, weight, 90.0, 0.01):.3f}")
        rows.append((ends.replace("-", "–"), *ratios))
    return table(("ends", "γ = 40", "280", "1000", "16000"), rows)


def list_table() -> str:
    """Every formula: what it is, where it holds, how it is known."""
    rows = []
    for f in FORMULAS.values():
        rows.append((f"`{f.key}`", f.name, f.text, f.place or "–", f.holds, f"{f.source}; {f.evidence}"))
    return table(("Key", "Name", "Formula", "Force at", "Holds", "Source and evidence"), rows)


def lubinski_table() -> str:
    """First and second coefficients of a pinned string over its length."""
    values, errors = hanging_coefficients(SIZES, PINNED, 2)
    if errors.max() > 1e-7:
        raise RuntimeError("docs: coefficients are not known to seven digits")
    rows = [(f"{x:g}", f"{v[0]:.4f}", f"{v[1]:.4f}") for x, v in zip(SIZES, values, strict=True)]
    return table(("X = L/(B/w)^⅓", "first", "second"), rows)


def lubinski_ends_table() -> str:
    """First coefficients of strings with other ends."""
    columns = [("pinned", "pinned"), ("clamped", "pinned"), ("pinned", "free"), ("clamped", "free")]
    values = [hanging_coefficients(SIZES, ends, 1)[0][:, 0] for ends in columns]
    rows = [(f"{x:g}", *(f"{column[i]:.4f}" for column in values)) for i, x in enumerate(SIZES)]
    return table(("X", *(f"{below} below, {above} above" for below, above in columns)), rows)


def _solve(target: float, order: int, low: float, high: float) -> float:
    """Length X at which a coefficient of the pinned string, which falls with X, has a value."""
    for _ in range(40):
        middle = math.sqrt(low * high)
        value = hanging_coefficients((middle,), PINNED, order)[0][0, order - 1]
        low, high = (middle, high) if value > target else (low, middle)
    return low


def numbers() -> dict[str, str]:
    """Numbers that the pages quote in their text."""
    best = (4.0 * math.pi**2) ** (1.0 / 3.0)
    exact = hanging_coefficients((best,), PINNED, 1)[0][0, 0]
    second = _solve(3.75, 2, 10.0, 200.0)
    unit = (30e6 * math.pi / 64.0 * (5.0**4 - 4.276**4) / (19.5 / 12.0 * (1.0 - 10.0 / 65.5))) ** (1.0 / 3.0)  # in
    tilted = rodwell.Problem(50.0**3, alpha=0.5, clearance=1.75 / (50.0 * unit), ends=PINNED)
    case = audit(rodwell.Case.read(Path(__file__).parent.parent / "examples" / "inclined-pipe.toml"))
    paslay = case.row("dawson_paslay")
    bottom, top = paslay.beside("critical", "bottom"), paslay.beside("critical", "top")
    if bottom is None or top is None or bottom.percent is None or top.percent is None:
        raise RuntimeError("docs: no comparison")
    return {
        "size_194": f"{_solve(1.94, 1, 4.0, 20.0):.2f}",
        "size_375": f"{second:.1f}",
        "first_at_375": f"{hanging_coefficients((second,), PINNED, 1)[0][0, 0]:.3f}",
        "best_length": f"{best:.3f}",
        "energy_sine": f"{0.75 * best:.4f}",
        "exact_at_best": f"{exact:.4f}",
        "over_best": f"{100.0 * (0.75 * best / exact - 1.0):.1f} %",
        "energy_helix": f"{0.75 * (16.0 * math.pi**2) ** (1.0 / 3.0):.4f}",
        "helix_555": f"{1.5 * (16.0 * math.pi**2) ** (1 / 3) - 0.75 * best:.4f}",
        "natural_length": f"{0.0254 * unit:.1f} m",
        "short_string": f"{6 * 0.0254 * unit:.0f}",
        "long_string": f"{10 * 0.0254 * unit:.0f}",
        "longest_string": f"{50 * 0.0254 * unit:.0f} m",
        "first_at_50": f"{hanging_coefficients((50.0,), PINNED, 1)[0][0, 0]:.2f}",
        "tilted": f"{critical(tilted).at('bottom') / 2500.0:.2f}",
        "formulas_count": str(len(FORMULAS)),
        "pipe_bottom": f"{abs(bottom.percent):.0f} %",
        "pipe_top": f"{abs(top.percent):.0f} %",
    }

"""Tables and figures of the how-to pages on branches, curves, coils, twist and end conditions.

Called by ``make_pages``: everything is computed while the documentation is built, at the default tolerance.
"""

from __future__ import annotations

import io
import math
from pathlib import Path

import matplotlib as mpl
import matplotlib.image
import numpy as np
from shown import DPI, number, save, table

import rodwell
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.discrete.measures import Measured
from rodwell.plots.bifurcation import plot_bifurcation
from rodwell.plots.curves import plot_curves
from rodwell.plots.cylinder import plot_cylinder_moments, plot_shapes
from rodwell.plots.rod3d import plot_rod
from rodwell.plots.style import RC
from rodwell.problem.ends import ENDS

COMMANDS = {
    "diagram": "diagram --weight 15 --alpha 90 --until -700",
    "diagram-inclined": "diagram --weight 15 --alpha 80 --modes 2 --until -500 --out results/inclined",
    "diagram-off-wall": "diagram --weight 15 --alpha 90 --modes 1 --until -165 --off-wall --out results/off-wall",
    "diagram-coil": "diagram --weight 15 --alpha 90 --turns 1 --out results/coil",
    "curve-critical": "curve critical --over weight --from 0 --to 70 --alpha 90 --modes 2 --out results/critical",
    "curve-lift-off": "curve lift-off --over alpha --from 0 --to 90 --weight 15 --out results/lift-off",
    "twist-odd": "twist --weight 30 --alpha 90",
    "twist-even": "twist --weight 15 --alpha 90 --mode 2",
    "curve-twist": "curve twist --over weight --from 40 --to 18.5 --alpha 90 --out results/twist",
    "path": "path --weight 15 --alpha 90 --until -160 --unload-to -90 --at -125.41829806,-146.9 --out results/path",
    "critical-untouched": "critical --weight 0 --alpha 0 --twist 5 --modes 1",
    "critical-twist": "critical --weight 15 --alpha 90 --twist 5 --modes 2",
    "critical-ends": "critical --weight 15 --alpha 60 --ends clamped-pinned --modes 3",
    "critical-on-top": "critical --weight 65 --alpha 90 --on-top --modes 3",
    "certify": "certify --weight 60 --alpha 35 --modes 3",
    "modes": "modes --weight 15 --pairs 2 --table 4",
    "liftoff-outside": "liftoff --weight 15 --alpha 90 --outside --on-top",
    "verify": "verify examples/drill-string.toml --at -140kN --rtol 1e-6",
    "sensitivity": "sensitivity --weight 15 --alpha 90",
    "critical-build": "critical --weight 15 --alpha 90 --build 0.2 --modes 3",
    "critical-drop": "critical --weight 15 --alpha 90 --build -0.4 --modes 2",
    "liftoff-build": "liftoff --weight 15 --alpha 90 --build 0.2",
    "path-build": "path --weight 15 --alpha 90 --build 0.2 --until -360 --at -340 --out results/path-build",
    "path-drop": "path --weight 15 --alpha 90 --build -0.5 --until -45",
    "run-build": "run examples/build-section.toml --out results/build",
    "run-surveyed": "run examples/surveyed-well.toml --out results/surveyed",
    "liftoff-sections": "liftoff --weight 15 --alpha 60 --sections 0.6:1:1,0.4:0.3:0.5",
    "critical-varying": "critical --weight 60 --alpha 60 --sections 0.2:1,0.5:1:1:1~1.1,0.3:1:1:1.1 --modes 3",
    "critical-taper": "critical --weight 15 --alpha 60 --sections 0.6:1:1,0.4:1/0.5/0.2:1/0.6 --modes 3",
    "critical-steps": "critical --weight 1000 --alpha 90 --sections 0.3:1:1:1,0.4:1:1:0.6,0.3:1:1:1 "
    "--out results/critical-steps",
    "two-casings": "run examples/tubing-two-casings.toml --out results/two-casings",
    "string": "run examples/bottom-hole-assembly.toml --no-path --out results/string",
    "export": "export examples/drill-string.toml --to results/space/rod.glb --to results/space/rod.png",
}
"""Output shown on the pages, by name of the file; run in the order given."""


def pages(out: Path) -> dict[str, str]:
    """Return the tables by file name, and draw the figures into ``out``."""
    with mpl.rc_context(RC):
        coils(out / "energies.png")
        pair(out / "pair.png")
        veering(out)
        on_top(out / "on-top.png")
        wall_tables = wall(out)
    twisted_coil(out / "coil-3d.png")
    return wall_tables | {
        "switching.md": switching_table(),
        "coils.md": coil_table(),
        "torsion.md": torsion_table(),
        "untouched.md": untouched_table(),
        "ends-critical.md": ends_table(lift_off=False),
        "ends-lift-off.md": ends_table(lift_off=True),
        "columns.md": column_table(),
    }


def untouched_table() -> str:
    """Loads of a weightless clamped rod under twist: without the wall, with its help, kept on it."""
    rows = []
    for twist in (0.0, 2.0, 5.0, 8.0, 10.0, 12.0, 15.0):
        loads = rodwell.critical_loads(rodwell.Problem(0.0, alpha=0.0, twist=twist), 1)
        touch = loads.without_wall.at_wall
        assert touch is not None
        needs = "no" if touch.moves_inward else "yes"
        numbers = (loads.without_wall.forces[0], touch.force, loads[0].force)
        rows.append((f"{twist:g}", *(number(force) for force in numbers), needs))
    head = ("T₁", "F without the wall", "F with its help", "F kept on the wall", "needs the wall")
    return table(head, rows)


def coils(path: Path) -> None:
    """Energies of buckled and coiled states, relative to the straight rod."""
    flat = rodwell.diagram(rodwell.Problem(15), modes=2, until=-260.0, secondary=False)
    coil = rodwell.coil(rodwell.Problem(15, turns=1), until=-260.0)
    ax = plot_bifurcation([*flat, coil], flat.critical, ordinate=Measured.ENERGY)
    save(ax, path)


def wall(out: Path) -> dict[str, str]:
    """Torque of the first modes, certificate of a state; shapes of the branch without symmetry; moments at lift-off."""
    rows = []
    problem = rodwell.Problem(15)
    for mode, force in ((1, -130.0), (2, -130.0), (3, -240.0), (4, -260.0)):
        state = rodwell.follow(problem, mode, until=force)[-1]
        shape = {1: "even", -1: "odd"}[state.point.fine.symmetry]
        load = state.wall
        support = number(load.torque.value, 5) if load.needs_torque else "0"
        rows.append((str(mode), f"{force:g}".replace("-", "−"), shape, f"{load.twisting.value:.5f}", support))
    head = ("Mode", "F", "Shape", "Largest |T₂|", "T₂(0), at the support")
    diagram = rodwell.diagram(problem, modes=2, until=-400.0)
    branch = diagram["secondary 1"]
    step = max(1, len(branch) // 8)
    save(plot_shapes([*list(branch)[:-1:step], branch[-1]]), out / "fig4.png")
    lift = diagram.branches[0].lift_off
    assert lift is not None
    save(plot_cylinder_moments(lift.solution), out / "cylinder.png")
    certificate = lift.solution.certificate
    worst = sorted(certificate.residuals.items(), key=lambda item: -item[1])[:6]
    shown = [(name, f"{value:.1e}".replace("-", "−")) for name, value in worst]
    return {
        "torque_table.md": table(head, rows),
        "certificate_table.md": table(("Equation of the paper", "What is left, at most"), shown),
    }


def pair(path: Path) -> None:
    """Critical loads, lift-off and secondary bifurcation of the first pair of modes against weight."""
    rod, limits = rodwell.Problem(0), (0.0, 65.0)
    curves = [
        *rodwell.critical_curves(rod, "weight", limits, modes=2),
        *(rodwell.lift_off_curve(rod, "weight", limits, mode=mode) for mode in (1, 2)),
        rodwell.secondary_curve(rod, (62.0, 8.0)),
    ]
    ax = plot_curves(curves)
    ax.set_ylim(0, 500)
    ax.legend(loc="center right", bbox_to_anchor=(1.0, 0.68))
    save(ax, path)


def veering(out: Path) -> None:
    """Critical loads against weight: horizontal and inclined cylinder."""
    for alpha in (90, 60):
        curves = rodwell.critical_curves(rodwell.Problem(0, alpha=alpha), "weight", (0.0, 300.0))
        save(plot_curves(curves), out / f"critical-{alpha}.png")


def on_top(path: Path) -> None:
    """Critical loads of a rod on top of the cylinder against weight."""
    rod = rodwell.Problem(0, on_top=True)
    ax = plot_curves(rodwell.critical_curves(rod, "weight", (0.0, 160.0), modes=3))
    ax.axhline(0.0, color="#1f2933", lw=0.8)
    save(ax, path)


def twisted_coil(path: Path) -> None:
    """A coil without and with end twist, below each other."""
    pictures = []
    for twist in (0.0, 3.0):
        state = rodwell.equilibrium(rodwell.Problem(15, turns=1, twist=twist), -140.0)
        file = io.BytesIO()
        plot_rod(state).figure.savefig(file, dpi=DPI)
        file.seek(0)
        pictures.append(mpl.image.imread(file))
    mpl.image.imsave(path, np.concatenate(pictures))


def switching_table() -> str:
    """The rows of the paper's Table 1 as double points of the critical load curves, in the order of m."""
    curves = rodwell.critical_curves(rodwell.Problem(0), "weight", (0.0, 6300.0), modes=8)
    marks = {mark.x: mark for curve in curves for mark in curve.marks}.values()
    rows = []
    for m in range(3, 11):
        for n in range(2 - m % 2, m - 1, 2):
            weight, force = n**2 * m**2 * math.pi**4 * 0.01, -(n**2 + m**2) * math.pi**2
            mark = min(marks, key=lambda item: abs(item.x / weight - 1.0) + abs(item.value / force - 1.0))
            gap = abs(mark.x / weight - 1.0)
            if gap > 1e-9:
                raise RuntimeError(f"docs: no double point for n = {n}, m = {m}")
            found = f"{mark.x:.6f}", number(mark.value, 6), mark.note.removeprefix("modes ").removesuffix(" switch")
            rows.append((str(n), str(m), *found, f"{gap:.0e}".replace("-", "−")))
    return table(("n", "m", "γ of the double point", "F in B/L²", "modes", "relative distance from (78)"), rows)


def _load(point: SpecialPoint | None) -> str:
    return "–" if point is None else number(point.force)


def _first(branch: rodwell.Branch, kind: str) -> SpecialPoint | None:
    return next((p for p in branch.special_points if p.kind == kind), None)


def coil_table() -> str:
    """Loads of coils of one and two turns."""
    rows: dict[str, list[str]] = {
        name: []
        for name in (
            "same energy as the straight rod",
            "contact complete (leaves the wall when load is taken off)",
            "loses its symmetry (stable until there)",
            "symmetric coil leaves the wall under more compression",
            "coil without symmetry leaves the wall",
        )
    }
    for turns in (1, 2):
        result = rodwell.diagram(rodwell.Problem(15, turns=turns))
        coil, other = result.primary[0], result.secondary[0]
        found = (
            _first(coil, "equal_energy"),
            _first(coil, "touch_down"),
            _first(coil, "branch_point"),
            _first(coil, "lift_off"),
            _first(other, "lift_off"),
        )
        for row, point in zip(rows.values(), found, strict=True):
            row.append(_load(point))
    return table(("F in B/L²", "n = 1", "n = 2"), [(name, *row) for name, row in rows.items()])


def torsion_table() -> str:
    """What twist does at the lift-off load, for modes of both symmetries."""
    rows = []
    for weight, mode in ((5, 1), (5, 2), (15, 1), (15, 2), (30, 1), (60, 1), (100, 1), (100, 2)):
        result = rodwell.torsion(rodwell.Problem(weight), mode, until=40.0)
        parity = "even" if result.prepared.solution.point.fine.symmetry > 0 else "odd"
        places = ", ".join(f"{s:.3g}" for s in result.prepared.s)
        good = {1: "T₁ > 0", -1: "T₁ < 0", 0: "none"}[result.sense]
        again = "–" if result.sense == 0 else "none up to 40"
        if result.again is not None:
            again = f"{number(result.again.value)} at s = {', '.join(f'{s:.3g}' for s in result.again.s)}"
        rates = ", ".join(f"{rate:+.3g}".replace("-", "−") for rate in result.rates)
        rows.append((f"{weight}, {mode}", parity, number(result.prepared.force), places, rates, good, again))
    head = ("γ, mode", "y", "lift-off F", "at s", "dp/dT₁ there", "presses", "second lift-off T₁")
    return table(head, rows)


def ends_table(*, lift_off: bool) -> str:
    """First critical loads, or lift-off loads with their places, of all pairs of end conditions."""
    rows = []
    for first in ENDS:
        row = [f"**{first}**"]
        for last in ENDS:
            problem = rodwell.Problem(15, alpha=60, ends=(first, last))
            mode = rodwell.critical_loads(problem, 1)[0]
            if not lift_off:
                row.append(number(mode.force))
                continue
            lift = rodwell.follow(problem, mode).lift_off
            if lift is None:
                raise RuntimeError(f"docs: no lift-off with ends {first}-{last}")
            row.append(
                f"{number(lift.force)} at {', '.join(f'{s:.3g}' for s in lift.s)}".replace(" ", "\N{NO-BREAK SPACE}")
            )
        rows.append(row)
    return table(("s = 0 \\ s = 1", *ENDS), rows)


def column_table() -> str:
    """The weightless rod: critical loads as multiples of π², where ends may be exchanged."""
    rows = []
    for i, first in enumerate(ENDS):
        for last in ENDS[i:]:
            loads = rodwell.critical_loads(rodwell.Problem(0, ends=(first, last)), 3).forces
            multiples = (abs(load) / math.pi**2 for load in loads)
            rows.append((f"{first}–{last}", *(f"{x:.6f}" for x in multiples)))
    return table(("Ends", "−F₁/π²", "−F₂/π²", "−F₃/π²"), rows)


def numbers() -> dict[str, str]:
    """Numbers that the how-to pages quote in their text."""
    coil = rodwell.coil(rodwell.Problem(15, turns=1))
    rod = rodwell.follow(rodwell.Problem(15)).lift_off
    if rod is None:
        raise RuntimeError("docs: no lift-off")
    out = {"rod_lift_off": number(rod.force)}
    for kind in ("equal_energy", "touch_down", "branch_point", "lift_off"):
        out[f"coil_{kind}"] = _load(_first(coil, kind))
    (switch,) = rodwell.lift_off_curve(rodwell.Problem(15), "alpha", (90.0, 20.0)).marks
    out["switch_alpha"], out["switch_force"] = f"{switch.x:.4f}", number(switch.value)
    closest = rodwell.critical_curves(rodwell.Problem(0, alpha=60), "weight", (0.0, 40.0), modes=2)[0].marks[0]
    out["veering_weight"], out["veering_note"] = f"{closest.x:.4f}", closest.note
    return out

"""Torque and drag against depth, depth downwards; hook load against the depth of the bit."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from rodwell.plots.style import GREY, INK, MODES, RC, WARN
from rodwell.studies.drag.calibration import Calibration
from rodwell.studies.drag.contact import BUCKLES, NAMES
from rodwell.studies.drag.drag import Drag, OperationResult
from rodwell.studies.drag.limits import limit_compression
from rodwell.studies.drag.road_map import RoadMap
from rodwell.studies.drag.well_case import Well
from rodwell.studies.drag.words import units

SHADES = {1: "#f3d9b8", 2: "#eab5a8"}
"""Behind sinusoidal and helical intervals."""

DASHES = ("-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (5, 2, 1.5, 2)), (0, (8, 3)), (0, (3, 1)))


def plot_forces(found: Drag) -> Figure:
    """Draw inclination, and the effective force of every operation with the limits of buckling, against depth."""
    m, depth = units(found.well)["depth"]
    with mpl.rc_context(RC):
        figure = _figure((7.6, 6.4))
        left, right = figure.subplots(1, 2, sharey=True, width_ratios=(1, 3.6))
        _inclination(left, found.well, m, depth)
        _lines(right, found)
        figure.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=3)
        figure.suptitle(found.well.title, x=0.01, ha="left", fontsize=10)
        return figure


def plot_drag(found: Drag, ax: Any) -> Any:
    """Draw the effective force of every operation on ``ax``, depth downwards; return it."""
    m, depth = units(found.well)["depth"]
    _lines(ax, found)
    ax.set_ylabel(f"measured depth  [{depth}]")
    ax.set_ylim(max(one.operation.bit_depth for one in found.operations) / m, 0.0)
    ax.set_title(found.well.title, loc="left", fontsize=10)
    ax.legend()
    return ax


def _lines(ax: Any, found: Drag) -> None:
    """Effective force of every operation, and the limits of buckling for the one with the deepest bit."""
    by = units(found.well)
    (m, _), (n, force) = by["depth"], by["force"]
    for i, one in enumerate(found.operations):
        ax.plot(one.run.forces / n, one.run.measured_depth / m, color=MODES[i % len(MODES)], lw=1.7,
                ls=DASHES[i % len(DASHES)], label=one.operation.name)  # fmt: skip
    _limits(ax, found, max(found.operations, key=lambda one: one.operation.bit_depth), n, m)
    ax.axvline(0.0, color=GREY, lw=0.8)
    ax.set_xlabel(f"effective force, tension positive  [{force}]")
    lowest = min(_lowest(one) for one in found.operations)
    _range(ax, np.concatenate([one.run.forces for one in found.operations]) / n, lowest / n)


def plot_operation(found: Drag, one: OperationResult) -> Figure:
    """Draw force, contact force and torque or stress of one operation against depth; buckled intervals are shaded."""
    by = units(found.well)
    (m, depth), (n, force), (q, per), (nm, torque), (pa, stress) = by.values()
    run, md = one.run, one.run.measured_depth / m
    with mpl.rc_context(RC):
        figure = _figure((7.6, 5.4))
        forces, contact, last = figure.subplots(1, 3, sharey=True, width_ratios=(1.7, 1, 1))
        forces.plot(run.forces / n, md, color=MODES[0], lw=1.8, label="effective")
        if _differ(one.strength.true_force, run.forces):
            forces.plot(one.strength.true_force / n, md, color=MODES[1], lw=1.2, ls=DASHES[1], label="in the wall")
        _limits(forces, found, one, n, m)
        forces.axvline(0.0, color=GREY, lw=0.8)
        forces.set_xlabel(f"force, tension positive  [{force}]")
        forces.set_ylabel(f"measured depth  [{depth}]")
        lowest = _lowest(one)
        if run.arrived:
            lowest = min(lowest, float(np.nanmin(np.append(one.strength.true_force, 0.0))))
        _range(forces, np.concatenate([run.forces, one.strength.true_force]) / n, lowest / n)
        shown = run.forces >= _lowest(one)
        contact.plot(run.contacts / q, md, color=MODES[2], lw=1.5)
        contact.set_xlabel(f"contact force  [{per}]")
        contact.set_xlim(0.0, _top(run.contacts[shown] / q))
        if one.operation.rotating:
            last.plot(run.torques / nm, md, color=MODES[3], lw=1.5)
            last.set_xlabel(f"torque  [{torque}]")
        elif np.any(np.isfinite(one.strength.von_mises)):
            last.plot(one.strength.von_mises / pa, md, color=MODES[3], lw=1.5)
            last.set_xlabel(f"von Mises stress  [{stress}]")
            last.set_xlim(0.0, _top(one.strength.von_mises[shown] / pa))
        for ax in (forces, contact, last):
            _shade(ax, one, m)
        forces.set_ylim(one.operation.bit_depth / m, 0.0)
        handles, labels = forces.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3)
        figure.suptitle(f"{one.operation.name}, bit at {one.operation.bit_depth / m:.6g} {depth}", x=0.01, ha="left",
                        fontsize=10)  # fmt: skip
        return figure


def plot_road_map(found: RoadMap) -> Figure:
    """Draw hook load, and torque where the string turns, against the depth of the bit."""
    by = units(found.well)
    (m, depth), (n, force), (nm, torque) = by["depth"], by["force"], by["torque"]
    turning = [curve for curve in found.curves if np.nanmax(np.abs(curve.torque), initial=0.0) > 0.0]
    labels, kinds = (list(dict.fromkeys(getattr(c, a) for c in found.curves)) for a in ("label", "kind"))
    with mpl.rc_context(RC):
        figure = _figure((7.6, 5.6))
        axes = figure.subplots(1, 2, sharey=True, width_ratios=(2, 1)) if turning else [figure.subplots()]
        for curve in found.curves:
            style: dict[str, Any] = {"color": MODES[kinds.index(curve.kind) % len(MODES)], "lw": 1.6,
                                     "ls": DASHES[labels.index(curve.label) % len(DASHES)]}  # fmt: skip
            possible = np.where(curve.possible, curve.hook_load, np.nan) / n
            axes[0].plot(possible, found.depths / m, label=f"{curve.kind}, {curve.label}", **style)
            beyond = np.where(curve.possible, np.nan, curve.hook_load) / n
            axes[0].plot(beyond, found.depths / m, color=style["color"], lw=0.8, ls=style["ls"])
            if curve in turning:
                axes[1].plot(curve.torque / nm, found.depths / m, **style)
        axes[0].axvline(0.0, color=GREY, lw=0.8)
        axes[0].set_xlabel(f"hook load, tension positive  [{force}]")
        axes[0].set_ylabel(f"depth of the bit  [{depth}]")
        if turning:
            axes[1].set_xlabel(f"torque at surface  [{torque}]")
        axes[0].set_ylim(found.depths[-1] / m, 0.0)
        figure.legend(loc="outside lower center", ncols=3, title="operation, friction")
        figure.suptitle(found.well.title, x=0.01, ha="left", fontsize=10)
        return figure


def plot_calibration(found: Calibration) -> Figure:
    """Draw measured and computed hook loads, and torques where there are any, against the depth of the bit."""
    by = units(found.well)
    (m, depth), (n, force), (nm, torque) = by["depth"], by["force"], by["torque"]
    with_torque = any(np.isfinite(one.torque) for one in found.measured)
    kinds = list(dict.fromkeys(one.operation.kind for one in found.measured))
    with mpl.rc_context(RC):
        figure = _figure((7.6, 5.2))
        axes = figure.subplots(1, 2, sharey=True, width_ratios=(2, 1)) if with_torque else [figure.subplots()]
        for i, kind in enumerate(kinds):
            colour = MODES[i % len(MODES)]
            rows = sorted((k for k, one in enumerate(found.measured) if one.operation.kind == kind),
                          key=lambda k: found.measured[k].operation.bit_depth)  # fmt: skip
            at = np.array([found.measured[k].operation.bit_depth for k in rows]) / m
            for j, (ax, unit) in enumerate(zip(axes, (n, nm), strict=False)):
                given = np.array([(found.measured[k].hook_load, found.measured[k].torque)[j] for k in rows])
                ax.plot(given / unit, at, "o", color=colour, ms=4.0, label=f"{kind}, measured" if j == 0 else None)
                ax.plot((given - found.residuals[rows, j]) / unit, at, color=colour, lw=1.4,
                        label=f"{kind}, computed" if j == 0 else None)  # fmt: skip
        axes[0].set_xlabel(f"hook load, tension positive  [{force}]")
        axes[0].set_ylabel(f"depth of the bit  [{depth}]")
        axes[0].set_ylim(found.well.end / m, 0.0)
        if with_torque:
            axes[1].set_xlabel(f"torque at surface  [{torque}]")
        figure.legend(loc="outside lower center", ncols=3)
        return figure


def _figure(size: tuple[float, float]) -> Figure:
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _inclination(ax: Any, well: Well, m: float, depth: str) -> None:
    ax.plot(well.survey.inclination, well.survey.md / m, color=INK, lw=1.5)
    ax.set_xlabel("inclination from\nthe vertical  [deg]")
    ax.set_ylabel(f"measured depth  [{depth}]")
    ax.set_xlim(left=0.0)
    ax.set_ylim(well.end / m, 0.0)


def _limits(ax: Any, found: Drag, one: OperationResult, n: float, m: float) -> None:
    """Where the string buckles and where it is helical at the latest, as negative forces."""
    contact = found.contact
    late = contact.late if np.isfinite(contact.late) else 2.0 * np.sqrt(2.0)
    for beta, label, dashes in (
        (BUCKLES, "limit: buckles", DASHES[2]),
        (late, "limit: helical at the latest", DASHES[1]),
    ):
        ax.plot(-limit_compression(one.run, beta) / n, one.run.measured_depth / m, color=WARN, lw=1.1, ls=dashes,
                label=label)  # fmt: skip


def _shade(ax: Any, one: OperationResult, m: float) -> None:
    told = set()
    for low, high, state in one.run.buckled:
        label = NAMES[state] if state not in told and ax.get_subplotspec().colspan.start == 0 else None
        ax.axhspan(high / m, low / m, color=SHADES[state], lw=0, zorder=0, label=label)
        told.add(state)


def _differ(true: Any, effective: Any) -> bool:
    """Whether the force in the wall is known and another than the effective one."""
    known = np.isfinite(true)
    return bool(np.any(np.abs(true[known] - effective[known]) > 1e-6 * np.max(np.abs(effective), initial=1.0)))


def _range(ax: Any, values: Any, low: float) -> None:
    """A range of forces that what decides fills, from ``low`` on."""
    known = values[np.isfinite(values)]
    high = max(float(np.max(known)), 0.0)
    room = 0.06 * (high - low)
    ax.set_xlim(low - room, high + room)


def _lowest(one: OperationResult) -> float:
    """Lowest force in N that is drawn of an operation: where it locks up, some times the limit of buckling."""
    lowest = min(float(np.min(one.run.forces)), 0.0)
    if one.run.arrived:
        return lowest
    limits = limit_compression(one.run, CUT)
    return max(lowest, -float(np.median(limits[limits > 0.0])))


CUT = 8.0
"""β at which the compression of a string that locks up is cut in figures."""


def _top(values: Any) -> float:
    """Where an axis from 0 ends."""
    known = values[np.isfinite(values)]
    return 1.08 * float(np.max(known, initial=0.0)) or 1.0

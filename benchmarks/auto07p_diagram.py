"""Fig. 3(c) by AUTO-07p: primary branches, secondary bifurcations, secondary branches, w = 15."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from auto07p_model import END_CURVATURE, TORQUE, F
from auto07p_runs import LOCATING, Rod, Run

HORIZONTAL = (-20.0, 0.0, 0.0, 15.0, 0.01, 0.3)
END = -700.0
MESH = 50
STEP = 20.0
BEFORE = {1: -340.0, 2: -150.0, 4: -395.0}
"""End force shortly before the secondary bifurcation of a mode, from where AUTO-07p looks for it in small steps."""
SEARCHES = [LOCATING | {"dsmax": step, "ds": 0.1, "epsl": tol, "epsu": tol} for step, tol in ((2.0, 1e-7), (1.0, 1e-6))]
NEAR_ZERO = (0.002, 0.004, 0.006)
"""Values of ±ω₂(1) between which F is interpolated."""
LOW_TORQUES = {2: (3e-4, 6e-4, 9e-4), 4: (2e-3, 4e-3, 6e-3)}
"""Values of ±T₂(0) on the secondary branch that starts at a mode, near its other end or this one."""


@dataclass(frozen=True)
class Fig3c:
    """What AUTO-07p found. ``runs`` are those that the diagram takes, ``failed`` counts searches without result."""

    critical: list[float]
    primary: dict[int, Run]
    found: dict[int, Any]
    secondary: dict[int, Run]
    runs: list[Run]
    failed: int


def fig_3c(mesh: int = MESH) -> Fig3c:
    rod = Rod(HORIZONTAL)
    straight = rod.trivial(-260.0)
    points = straight.branch_points()
    primary, found, runs, failed = {}, {}, [straight], 0
    for mode, point in enumerate(points, start=1):
        asked = {"uzr": {F + 1: [BEFORE[mode]]}} if mode in BEFORE else {}
        primary[mode] = rod.onward(point, END, mesh, STEP, switch=True, **asked)
        runs.append(primary[mode])
        for search in SEARCHES if mode in BEFORE else ():
            start = primary[mode].at(F, BEFORE[mode])[0]
            run = rod.onward(start, BEFORE[mode] - 40.0, mesh, stop=["BP1"], **search)
            if mode != 1:  # secondary branch 1 comes back to it
                runs.append(run)
            if run.branch_points():
                found[mode] = run.branch_points()[0]
                break
            failed += 1
    secondary = {mode: _secondary(rod, mode, found[mode], mesh) for mode in (2, 4) if mode in found}
    return Fig3c([p.parameters[F] for p in points], primary, found, secondary, [*runs, *secondary.values()], failed)


def _secondary(rod: Rod, mode: int, point: Any, mesh: int = MESH, tolerance: float = 1e-8) -> Run:
    """Follow the branch without symmetry: AUTO-07p's own switch, or else the tangent that it left at the point.

    At a pitchfork the tangent saved with the point may already be that of the branch that crosses; the switch then
    leads back onto the symmetric one.
    """
    low = [sign * t for t in LOW_TORQUES[mode] for sign in (1.0, -1.0)]
    for switch in (True, False):
        more = {"nmx": 115} if mode == 2 else {}  # goes on past F = −362.63, onto its own mirror image
        run = rod.onward(point, END, mesh, STEP, switch=switch, uzr={TORQUE + 1: low}, rl1=BEFORE[mode] + 14.0,
                         epsl=tolerance, epsu=tolerance, **more)  # fmt: skip
        if any(run.at(TORQUE, t) for t in low):
            return run
    raise RuntimeError(f"AUTO-07p did not get onto the secondary branch of mode {mode}")


def load_by_curvature(mesh: int) -> float:
    """Secondary bifurcation of mode 2: F where ω₂(1) = 0, interpolated between points at small ω₂(1)."""
    rod = Rod(HORIZONTAL)
    point = rod.trivial(-130.0).branch_points()[1]
    values = [sign * v for v in NEAR_ZERO for sign in (1.0, -1.0)]
    run = rod.onward(point, -170.0, mesh, 2.0, switch=True, uzr={END_CURVATURE + 1: values})
    past = [(p.all_parameters[END_CURVATURE], p.parameters[F]) for v in values for p in run.at(END_CURVATURE, v)]
    past = [(v, f) for v, f in past if f < -156.0]  # ω₂(1) grows and comes back to zero
    curvatures, loads = np.array(past).T
    return float(np.polyfit(curvatures / NEAR_ZERO[0], loads, len(past) - 1)[-1])


def load_by_torque(mode: int, point: Any) -> float:
    """F where the secondary branch from a mode's branch point meets an antisymmetric branch.

    There T₂(0) = 0, and F is even in T₂(0). Taken on a finer mesh, and on one side: next to the point the equations
    are nearly singular, and past it AUTO-07p is off by 1e-5.
    """
    run = _secondary(Rod(HORIZONTAL), mode, point, 100, 1e-10)
    for sign in (1.0, -1.0):
        low = [p for t in LOW_TORQUES[mode] for p in run.at(TORQUE, sign * t)[:1]]
        if len(low) == len(LOW_TORQUES[mode]):
            squares = np.array([p.all_parameters[TORQUE] ** 2 for p in low]) / LOW_TORQUES[mode][0] ** 2
            return float(np.polyfit(squares, [p.parameters[F] for p in low], 2)[-1])
    raise RuntimeError(f"AUTO-07p did not bring the secondary branch of mode {mode} near T₂(0) = 0")

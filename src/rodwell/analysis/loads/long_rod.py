"""Exact loads of a long straight rod at an inclination: what decides locally, at a station of a well.

The rod starts at the station, its lower end, and goes uphill in a straight hole of the station's inclination. With
force at the lower end its loads tend to limits as it grows longer: upwards the axial weight takes the compression away.
The length is counted in half waves of the long-rod wave, π √(2B/F), which is π (B r/(w sin α))^¼ at the load F of a
long rod. In a horizontal hole, where the approach is slowest, n half waves between clamped ends add 2/n² of the load.

In a hole that builds or drops the rod lies along an arc of the station's curvature, which begins with the station's
inclination, and F is the load of He and Kyllingstad (``planar_load`` in :mod:`rodwell.formulas.path`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rodwell.analysis.branch.follow import follow
from rodwell.analysis.straight.critical import critical_loads
from rodwell.analysis.straight.lying import least_contact
from rodwell.analysis.straight.lying_slopes import beside
from rodwell.errors import InputError, NotConvergedError
from rodwell.formulas.path import SINUSOIDAL, planar_load
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Value

HALF_WAVES = 20
"""Length for the critical load, within 1 % of the limit (0.5 % for clamped ends in a horizontal hole)."""

LIFT_OFF_HALF_WAVES = 12
"""Length for lift-off, which happens near the lower end: within about 1 % of twice the length."""

LONGEST = 240.0
"""Length at most, in (B/w)^⅓: near the vertical the half wave grows without limit."""

RTOL_CRITICAL, RTOL_LIFT_OFF = 1e-6, 1e-4
"""Relative tolerances of the two exact loads."""


MOST_TURN = 1.0
"""By how many radians the arc of a local rod turns at most."""

HANGS = "no force keeps the pipe on this side of the bend, along which it hangs"
"""Why there may be no load in a bend."""

STEP = 0.15
"""Longest step of the branch that is followed to lift-off, which is located exactly whatever the steps."""


@dataclass(frozen=True)
class PipeString:
    """The pipe and its clearance: B in N m², w in N/m (in its fluid), r in m; end conditions of the local rod."""

    stiffness: float
    weight: float
    clearance: float
    ends: tuple[str, str] = ("clamped", "clamped")

    def length(self, alpha: float, half_waves: float = HALF_WAVES, build: float = 0.0) -> float:
        """Length of the local rod in m at an inclination in degrees, in a hole with a build in 1/m."""
        longest = LONGEST * (self.stiffness / self.weight) ** (1.0 / 3.0) * half_waves / HALF_WAVES
        if build != 0.0:
            longest = min(longest, MOST_TURN / abs(build))
        lateral = self.weight * math.sin(math.radians(alpha))
        load = float(planar_load(SINUSOIDAL, self.stiffness, lateral, self.clearance, build))
        if load == 0.0:
            return float(longest)
        return float(min(half_waves * math.pi * math.sqrt(2.0 * self.stiffness / load), longest))

    def problem(self, alpha: float, half_waves: float = HALF_WAVES, build: float = 0.0) -> tuple[Problem, float]:
        """The local rod at an inclination from 0 to 90 degrees, and its unit of force B/L² in N."""
        length = self.length(alpha, half_waves, build)
        weight, unit = self.weight * length**3 / self.stiffness, self.stiffness / length**2
        rod = Problem(weight, alpha, self.clearance / length, ends=self.ends)
        if build == 0.0:
            return rod, unit
        bent = rod.but(build=build * length)
        turned = 0.5 * bent.build / (1.0 + bent.clearance * bent.build)  # from the lower end to mid-length
        return beside(bent, "alpha", -math.degrees(turned)), unit


@dataclass(frozen=True)
class LocalLoad:
    """A compression in N at the lower end of the local rod, positive, with its error estimate; or why there is none."""

    compression: Value | None
    reason: str = ""


def critical_compression(
    string: PipeString, alpha: float, half_waves: float = HALF_WAVES, build: float = 0.0
) -> LocalLoad:
    """First critical load: compression −N(0) at the lower end, in N, in a hole with a build in 1/m.

    Its error is that of this length's load.
    """
    try:
        problem, unit = string.problem(alpha, half_waves, build)
        mode = critical_loads(problem, 1, rtol=RTOL_CRITICAL)[0]
    except NotConvergedError as error:
        return LocalLoad(None, reason=HANGS if build != 0.0 else str(error))
    except InputError as error:
        if build == 0.0:
            raise
        return LocalLoad(None, reason=str(error))
    if problem.hole is not None and least_contact(problem, mode.force).value < 0.0:
        return LocalLoad(None, reason="the curve takes the pipe off the wall before it buckles")
    return LocalLoad(Value((problem.hung_weight - mode.force) * unit, mode.error * unit))


def lift_off_compression(string: PipeString, alpha: float, half_waves: float = LIFT_OFF_HALF_WAVES) -> LocalLoad:
    """Lift-off of the first mode, compression at the lower end in N; in a vertical hole it coincides with buckling."""
    problem, unit = string.problem(alpha, half_waves)
    if problem.lateral_weight == 0.0:
        return critical_compression(string, alpha)
    try:
        branch = follow(problem, 1, rtol=RTOL_LIFT_OFF, largest_step=STEP)
    except (InputError, NotConvergedError) as error:
        return LocalLoad(None, reason=str(error))
    lift = branch.lift_off
    if lift is None:
        return LocalLoad(None, reason=f"lift-off was not found: {branch.ending}")
    return LocalLoad(Value((problem.axial_weight - lift.force) * unit, lift.error * unit))


def length_effect(string: PipeString, alpha: float, whole: LocalLoad | None = None) -> float:
    """How far the critical load of this length is from that of an endless rod, relative: an estimate.

    From the load at half the length, and that at the ``whole`` length if it is known. The gap falls with the square of
    the length in a horizontal hole and faster in an inclined one; in a vertical hole with the length, or slower.
    """
    whole = critical_compression(string, alpha) if whole is None else whole
    half = critical_compression(string, alpha, 0.5 * HALF_WAVES)
    if half.compression is None or whole.compression is None or whole.compression.value == 0.0:
        return math.nan
    at_longest = string.length(alpha) >= 0.999 * string.length(0.0)
    return abs(half.compression.value / whole.compression.value - 1.0) / (1.0 if at_longest else 3.0)

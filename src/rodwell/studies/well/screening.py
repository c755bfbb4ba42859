"""Screening a well: exact local loads at every station of a survey, beside the formulas' and the string's force."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from rodwell.analysis.loads.by_inclination import Loads, Precision, loads_at
from rodwell.analysis.loads.long_rod import (
    LocalLoad,
    PipeString,
    critical_compression,
    length_effect,
    lift_off_compression,
)
from rodwell.case.case import Case
from rodwell.errors import InputError, NotConvergedError
from rodwell.quantities.arrays import FloatArray
from rodwell.studies.well.in_build import COUNTS, formula_at, loads_in_build
from rodwell.survey.survey import Survey

CRITICAL_PRECISION = Precision(1e-3, 6)
LIFT_OFF_PRECISION = Precision(1e-2, 7)
"""Relative errors to which loads are interpolated where there are many inclinations; lift-off jumps where the place
that lifts off changes."""


class Beside(NamedTuple):
    """How a formula of practice that is set beside the exact loads is called: in full, and at the head of a column."""

    name: str
    head: str


BESIDE = {
    "dawson_paslay": Beside("Dawson–Paslay, sinusoidal", "Dawson–P."),
    "chen_lin_cheatham": Beside("Chen–Lin–Cheatham, helical", "Chen"),
    "he_kyllingstad": Beside("He–Kyllingstad, sinusoidal, curved", "He–K."),
}
"""Formulas of practice that are set beside the exact loads, by key, in the order of columns."""

Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class Screening:
    """What :func:`screen` found. Compression is **positive** here, in N, at the station.

    Attributes
    ----------
    case, survey
        String and hole; the well.
    string
        B, w, r and the ends of the local rod.
    critical, lift_off
        Exact loads with errors in a straight hole: compression at the local rod's lower end, which is the station.
    bent
        Exact critical loads in an arc of the station's build, where that counts; elsewhere NaN, and so where there is
        none, with the reason.
    formulas
        Loads of the formulas by key, (n,) each.
    compression
        Effective compression of the string at the stations (n,), or None if no force was given.
    length_effect
        Largest relative gap, estimated, between the critical load of the local rod's length and that of an endless
        rod, by inclination in degrees at the steepest and the flattest stations.
    """

    case: Case
    survey: Survey
    string: PipeString
    critical: Loads
    lift_off: Loads
    bent: Loads
    formulas: dict[str, FloatArray]
    compression: FloatArray | None
    length_effect: dict[float, float]

    @cached_property
    def local(self) -> FloatArray:
        """Inclination of the local rods in degrees, (n,), 0 to 90; a hole of 91° is one of 89° that goes uphill."""
        return np.minimum(self.survey.inclination, 180.0 - self.survey.inclination)

    @cached_property
    def lengths(self) -> FloatArray:
        """Length of the local rod for the critical load in m, (n,)."""
        return np.array([self.string.length(float(alpha)) for alpha in self.local])

    @cached_property
    def limit(self) -> tuple[FloatArray, FloatArray]:
        """Exact critical load with the station's build, where that counts and there is one, and errors, (n,) each.

        Elsewhere that of the straight hole. Along the arc the build of the station goes on over the whole local rod; a
        hole that builds for less than that does not hold the rod as well: there the build counts as much as where it
        counts least beside the local rod.
        """
        known, depth = np.isfinite(self.bent.values), self.survey.md
        gain = np.where(known, self.bent.values / self.critical.values, 1.0)
        least = gain.copy()
        for i in np.flatnonzero(known):
            uphill = 1.0 if self.survey.inclination[i] > 90.0 else -1.0
            length = self.string.length(float(self.local[i]), build=float(self.survey.build[i]))
            first, end = np.searchsorted(depth, sorted((depth[i], depth[i] + uphill * length)))
            least[i] = np.fmin.reduce(gain[first:end], initial=gain[i])  # where the straight load is not known: NaN
        errors = np.where(known, self.bent.errors, self.critical.errors)
        return np.where(known, self.critical.values * least, self.critical.values), errors

    @cached_property
    def utilisation(self) -> FloatArray | None:
        """Compression as a part of the critical compression, (n,); 0 in tension, NaN without a critical load."""
        if self.compression is None:
            return None
        return np.asarray(np.maximum(self.compression, 0.0) / self.limit[0])

    @cached_property
    def dropping(self) -> FloatArray:
        """Whether the hole's curvature takes the pipe off the low side, (n,): straight-hole loads are then too high.

        Judged by He–Kyllingstad below Dawson–Paslay by more than one percent.
        """
        return np.asarray(self.formulas["he_kyllingstad"] < (1.0 - COUNTS) * self.formulas["dawson_paslay"])

    @cached_property
    def turning(self) -> FloatArray:
        """Whether the hole's turn, which is in no exact load, counts by He–Kyllingstad, (n,)."""
        planar = formula_at(self.string, "he_kyllingstad", self.survey, turn=False)
        counts = np.abs(self.formulas["he_kyllingstad"] - planar) > COUNTS * planar
        return np.asarray((self.survey.turn != 0.0) & counts)

    @property
    def weakest(self) -> int:
        """The station where least compression buckles the pipe."""
        return int(np.nanargmin(self.limit[0]))

    @property
    def worst(self) -> int | None:
        """The station with the largest utilisation; None without forces, or if all is in tension."""
        used = self.utilisation
        known = None if used is None else np.nan_to_num(used, nan=0.0)
        return None if known is None or not np.max(known) > 0.0 else int(np.argmax(known))

    @property
    def missed(self) -> dict[str, list[str]]:
        """Loads that miss the tolerance to which they were to be interpolated, with their errors, by kind."""
        kinds = {"critical load": self.critical, "lift-off load": self.lift_off, "load in the curvature": self.bent}
        return {
            kind: [
                f"{kind} at station {i + 1} ± {100.0 * loads.errors[i] / abs(loads.values[i]):.2g} %"
                for i in loads.missed
            ]
            for kind, loads in kinds.items()
        }

    def remarks(self, i: int) -> str:
        """What must be known of a station."""
        parts = [f"critical load: {self.critical.reasons[i]}"] if i in self.critical.reasons else []
        parts += [f"lift-off: {self.lift_off.reasons[i]}"] if i in self.lift_off.reasons else []
        if self.local[i] == 0.0:
            parts.append(
                "vertical: no lateral weight, lift-off coincides with buckling, and the load falls with length"
            )
        if i in self.bent.reasons:
            parts.append(f"no exact load in the hole's curvature ({self.bent.reasons[i]}): He–Kyllingstad has it")
        if self.dropping[i]:
            parts.append("hole curvature takes the pipe off the low side: the straight-hole loads are too high here")
        if self.turning[i]:
            parts.append("the hole turns, which is not in the exact loads: He–Kyllingstad has it")
        if self.survey.inclination[i] > 90.0:
            parts.append("uphill: the local rod's lower end is towards the surface")
        return "; ".join(parts)


def screen(
    case: Case,
    survey: Survey,
    *,
    bit_force: float | None = None,
    hook_force: float | None = None,
    signs_meant: bool = False,
    progress: Progress | None = None,
) -> Screening:
    """Screen a well station by station: where would the string buckle, where leave the wall, under which compression.

    At every station the exact problem of a long straight rod is solved: its lower end is the station, it goes uphill at
    the station's inclination, with the string's B, weight and clearance and the ends of the case; 20 half
    waves of the long-rod wave long, 12 for lift-off. Where the hole builds or drops so much that it counts, the same is
    solved along an arc of that curvature besides, and its critical load is the one that decides. Turns of the hole,
    friction and pressure do not enter; lift-off is that of a straight hole.

    Parameters
    ----------
    case
        String and hole with dimensions; its length, inclination and loads are not used.
    survey
        The well. If it has forces, those are the string's.
    bit_force, hook_force
        Effective axial force at the last station or at the first in N, **tension positive**. Along the well it changes
        by the weight per length of the case times vertical depth (no friction). At most one of the two.
    signs_meant
        Whether a bit in tension or a hook that pushes is meant; without it they are refused.
    progress
        Called with what is being done and how much is done.

    Raises
    ------
    InputError
        If the case has no dimensions or no weight, forces are given twice, or a sign contradicts the force's name.
    NotConvergedError
        If no station at all has a critical load; single ones that lack a load say why in ``reasons``.
    """
    tell = progress or (lambda _what, _done: None)
    string = _string(case)
    if not signs_meant:
        _question(bit_force, hook_force)
    compression = _compression(string, survey, bit_force, hook_force)
    local = [float(a) for a in np.minimum(survey.inclination, 180.0 - survey.inclination)]
    known: dict[float, LocalLoad] = {}

    def buckles(alpha: float) -> LocalLoad:
        if alpha not in known:
            known[alpha] = critical_compression(string, alpha)
        return known[alpha]

    critical = loads_at(
        local,
        buckles,
        CRITICAL_PRECISION,
        lambda done: tell("critical loads", 0.3 * done),
    )
    if len(critical.reasons) == len(survey):
        raise NotConvergedError(f"no station has a critical load: {critical.reasons[0]}")
    lift_off = loads_at(
        local,
        lambda alpha: buckles(alpha) if alpha == 0.0 else lift_off_compression(string, alpha),
        LIFT_OFF_PRECISION,
        lambda done: tell("lift-off loads", 0.3 + 0.6 * done),
    )
    formulas = {key: formula_at(string, key, survey) for key in BESIDE}
    bent = loads_in_build(string, survey, local, lambda done: tell("loads in the hole's curvature", 0.9 + 0.09 * done))
    effect = {alpha: length_effect(string, alpha, buckles(alpha)) for alpha in (min(local), max(local))}
    return Screening(case, survey, string, critical, lift_off, bent, formulas, compression, effect)


def _question(bit_force: float | None, hook_force: float | None) -> None:
    """Refuse a bit in tension and a hook that pushes, unless they are said to be meant."""
    meant = "; if that is meant, give signs_meant=True"
    if bit_force is not None and bit_force > 0.0:
        what = f"puts the bit in tension: for weight on bit write {-bit_force:g}, compression is negative{meant}"
        raise InputError("bit_force", bit_force, what)
    if hook_force is not None and hook_force < 0.0:
        what = f"pushes at the hook: for a pull write {-hook_force:g}, tension is positive{meant}"
        raise InputError("hook_force", hook_force, what)


def _string(case: Case) -> PipeString:
    if not isinstance(case, Case):
        raise InputError("case", case, "must be a rodwell.Case")
    if case.scales is None:
        raise InputError("case", case.source, "must have dimensions to be set into a well: give [rod] and [hole]")
    problem, scales = case.problem, case.scales
    if problem.weight == 0.0:
        raise InputError("case", case.source, "has a weightless rod: nothing presses it to the wall of a well")
    weight = problem.weight * scales.factor("force_per_length")
    return PipeString(scales.stiffness, weight, problem.clearance * scales.length, problem.ends)


def _compression(
    string: PipeString, survey: Survey, bit_force: float | None, hook_force: float | None
) -> FloatArray | None:
    """Effective compression at the stations in N."""
    given = {"a force column": survey.force, "bit_force": bit_force, "hook_force": hook_force}
    names = [name for name, value in given.items() if value is not None]
    if len(names) > 1:
        raise InputError("forces", None, f"are given twice: {' and '.join(names)}; give only one")
    for name, value in (("bit_force", bit_force), ("hook_force", hook_force)):
        if value is not None and not math.isfinite(value):
            raise InputError(name, value, "must be finite, in N, tension positive")
    if survey.force is not None:
        return -survey.force
    hanging = string.weight * survey.tvd
    if bit_force is not None:
        return np.asarray(-bit_force - (hanging[-1] - hanging))
    if hook_force is not None:
        return np.asarray(hanging - hook_force)
    return None

"""How a screened well stands: every line with what it says of buckling, the worst first."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rodwell.quantities.arrays import BoolArray
from rodwell.quantities.text import amount, percent, plain
from rodwell.quantities.units import in_unit_of
from rodwell.quantities.value import Value
from rodwell.studies.well.screening import Screening

NO_FORCE, TENSION, STRAIGHT, UNJUDGED, CLOSE, EXPECTED, BUCKLES = range(7)
"""What a line says of buckling, the milder first: nothing, since no force is given; in tension throughout; straight by
the exact loads; not all stations can be judged; at the critical load within its error; expected by the formula
that has the hole's curvature; past the exact critical load."""

LEVELS = {
    NO_FORCE: "no force given",
    TENSION: "in tension",
    STRAIGHT: "straight by the exact loads",
    UNJUDGED: "not judged everywhere",
    CLOSE: "at the critical load, within its error",
    EXPECTED: "buckling expected from the hole's curvature",
    BUCKLES: "buckles",
}


@dataclass(frozen=True)
class Line:
    """A sentence, and what it says of buckling: one of the levels above."""

    level: int
    text: str


@dataclass(frozen=True)
class Found:
    """Which stations say what, (n,) of truth values each; all False without forces.

    Attributes
    ----------
    past
        Compression above the exact critical load, with the hole's curvature where that counts; or above the lift-off
        load of a straight hole.
    close
        Compression within the error of that load.
    curved
        Compression above He–Kyllingstad where the hole's curvature takes the pipe off the low side, and no exact load
        has it.
    unjudged
        In compression, but without an exact load.
    """

    past: BoolArray
    close: BoolArray
    curved: BoolArray
    unjudged: BoolArray

    @property
    def level(self) -> int:
        """The worst of what the stations say."""
        signs = ((BUCKLES, self.past), (EXPECTED, self.curved), (CLOSE, self.close), (UNJUDGED, self.unjudged))
        return next((level for level, stations in signs if np.any(stations)), STRAIGHT)


def found(screening: Screening) -> Found:
    """Judge every station by all that is known of it."""
    (exact, errors), lift = screening.limit, screening.lift_off
    bent = np.isfinite(screening.bent.values)
    force = np.zeros(len(screening.survey)) if screening.compression is None else screening.compression
    pushed = force > 0.0
    dropping: BoolArray = screening.dropping.astype(bool)
    past = pushed & ((force > exact) | (~bent & (force > lift.values)))
    close = pushed & ~past & (force >= exact - errors)
    curved = pushed & dropping & ~bent & (force > screening.formulas["he_kyllingstad"])
    return Found(past, close, curved, pushed & ~past & np.isnan(exact))


def level_of(screening: Screening) -> int:
    """What is said of the whole well: the worst of its stations."""
    if screening.compression is None:
        return NO_FORCE
    return TENSION if not np.any(screening.compression > 0.0) else found(screening).level


def verdict_lines(screening: Screening) -> list[Line]:
    """What becomes of the string, the worst line first; none without forces."""
    if screening.compression is None:
        return []
    if not np.any(screening.compression > 0.0):
        return [Line(TENSION, _in_tension(screening))]
    judged = found(screening)
    lines = [_by_exact_loads(screening, judged), *_past(screening, judged), *_curved(screening, judged)]
    lines += _unjudged(screening, judged)
    return sorted((line for line in lines if line is not None), key=lambda line: -line.level)


def _in_tension(screening: Screening) -> str:
    text = "The string is in tension at every station: it does not buckle."
    if screening.survey.force is not None:
        text += " (The file's forces are taken as tension positive; turn their signs if they count compression.)"
    return text


def _by_exact_loads(screening: Screening, judged: Found) -> Line | None:
    """The station that uses most of its exact critical load."""
    worst, force = screening.worst, screening.compression
    if worst is None or force is None:
        return None
    at, load, (exact, errors) = place(screening), amount_of(screening), screening.limit
    bent = np.any(np.isfinite(screening.bent.values))
    by = "the exact loads, with the hole's build," if bent else "the straight-hole loads"
    level = BUCKLES if np.any(judged.past) else CLOSE if np.any(judged.close) else STRAIGHT
    verdict = {
        BUCKLES: "The string buckles",
        CLOSE: "The string buckles or comes so close to it that the error of the load does not tell",
        STRAIGHT: f"By {by} the string does not buckle",
    }[level]
    if level == STRAIGHT and np.any(judged.unjudged):
        verdict += " at the stations that have one"
    return Line(
        level,
        f"{verdict}: the largest utilisation is {percent(used_part(screening, worst))} at {at(worst)}, where it bears "
        f"{load(float(force[worst]))} and buckles at {load(float(exact[worst]), float(errors[worst]))}.",
    )


def _past(screening: Screening, judged: Found) -> list[Line]:
    over = np.flatnonzero(judged.past)
    if not over.size or screening.compression is None:
        return []
    at, count = place(screening), len(screening.survey)
    text = f"{over.size} of {count} stations are past buckling, from {at(int(over[0]))} to {at(int(over[-1]))}"
    straight = np.isnan(screening.bent.values)
    lifted = int(np.sum(straight & (screening.compression > screening.lift_off.values)))
    text += f"; {lifted} are past lift-off"
    unknown = int(np.sum(np.isnan(screening.lift_off.values[over])))
    return [Line(BUCKLES, f"{text}; at {unknown} of them lift-off is not known." if unknown else f"{text}.")]


def _curved(screening: Screening, judged: Found) -> list[Line]:
    """Stations at which the formula that has the hole's curvature says buckling."""
    bent, force = np.flatnonzero(judged.curved), screening.compression
    if not bent.size or force is None:
        return []
    limit = screening.formulas["he_kyllingstad"]
    worst = int(max(bent, key=lambda i: force[i] - limit[i]))
    load = amount_of(screening)
    stations = "At 1 station" if bent.size == 1 else f"At {bent.size} stations"
    return [
        Line(
            EXPECTED,
            f"Expect the string to buckle where the hole drops or turns. {stations} where the hole's curvature takes "
            "the pipe off the low side, the compression is above He–Kyllingstad, which has the curvature: "
            f"at {place(screening)(worst)} it bears {load(float(force[worst]))}, He–Kyllingstad says "
            f"{load(float(limit[worst]))}.",
        )
    ]


def _unjudged(screening: Screening, judged: Found) -> list[Line]:
    lost = np.flatnonzero(judged.unjudged)
    if not lost.size:
        return []
    stations = "1 station" if lost.size == 1 else f"{lost.size} stations"
    text = f"Not every station can be judged: {stations} in compression, the first at {place(screening)(int(lost[0]))},"
    return [Line(UNJUDGED, f"{text} lack an exact load; the table says why.")]


FORCE_UNITS = {"m": "kN", "ft": "klbf"}
"""Unit of forces in tables and figures, by the survey's unit of depth."""


def units(screening: Screening) -> tuple[str, float, str, float]:
    """Unit of depth and its size in m, unit of force and its size in N."""
    depth = screening.survey.depth_unit
    force = FORCE_UNITS[depth]
    return depth, in_unit_of(1.0, depth, "m"), force, in_unit_of(1.0, force, "N")


def place(screening: Screening) -> Callable[[int], str]:
    """How a station is named."""
    depth, metre, _, _ = units(screening)
    survey = screening.survey
    return lambda i: f"{plain(survey.md[i] / metre, 6)} {depth}, {plain(survey.inclination[i], 3)}° from the vertical"


def amount_of(screening: Screening) -> Callable[..., str]:
    """How a load in N is written, with its error."""
    _, _, force, newton = units(screening)
    return lambda value, error=0.0: f"{amount(Value(value / newton, error / newton))} {force}"


def used_part(screening: Screening, i: int) -> Value:
    """Utilisation at a station; its error is that of the exact load."""
    assert screening.utilisation is not None
    used = float(screening.utilisation[i])
    return Value(used, abs(used) * float(screening.limit[1][i] / screening.limit[0][i]))

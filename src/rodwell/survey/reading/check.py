"""What depths and angles of a survey must be, told in the units in which they were given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rodwell.errors import InputError

STEEPEST = 120.0
"""Largest inclination in degrees from the vertical that is taken for one; beyond 90 the hole goes uphill."""

WIDEST = 720.0
"""Largest size of an azimuth in degrees: more is a missing value or another quantity."""


@dataclass(frozen=True)
class Written:
    """How values were given: units of depth and angles, and their sizes in m and degrees."""

    depth: str = "m"
    metre: float = 1.0
    angle: str = "deg"
    degree: float = 1.0


def check_stations(
    md: Sequence[float],
    inclination: Sequence[float],
    azimuth: Sequence[float] | None,
    wheres: Sequence[str],
    written: Written,
) -> None:
    """Depth (m) rises from station to station, from 0 or more; inclination and azimuth (degrees) are angles.

    Raises
    ------
    InputError
        Naming the station, its value in its own unit, and what is allowed.
    """

    def depth_of(i: int) -> str:
        return f"{md[i] / written.metre:.10g} {written.depth}"

    def angle_of(value: float) -> str:
        return f"{value / written.degree:.6g} {written.angle}"

    for i, where in enumerate(wheres):
        if md[i] < 0.0:
            raise InputError(f"{where}, measured depth", depth_of(i), "must not be negative")
        if i and not md[i] > md[i - 1]:
            what = (f"must be larger than that of the station before, {depth_of(i - 1)}: sort stations, remove "
                    "repeated ones")  # fmt: skip
            several = "; if another well begins here, give each its name in a column Well, or a file of its own"
            raise InputError(f"{where}, measured depth", depth_of(i), what + (several if md[i] <= md[0] else ""))
        if not 0.0 <= inclination[i] <= STEEPEST:
            what = f"must be from 0 to {STEEPEST:g} degrees from the vertical"
            hint = "; is it measured from the horizontal?" if -90.0 <= inclination[i] < 0.0 else ""
            raise InputError(f"{where}, inclination", angle_of(inclination[i]), what + hint)
        if azimuth is not None and not abs(azimuth[i]) <= WIDEST:
            what = f"must be from {-WIDEST:g} to {WIDEST:g} degrees; leave a missing one empty"
            raise InputError(f"{where}, azimuth", angle_of(azimuth[i]), what)

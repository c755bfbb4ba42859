"""A survey of a well: stations of measured depth, inclination and azimuth, and the path that follows from them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.studies.well.survey_file import read_columns

STEEPEST = 120.0
"""Largest inclination in degrees from the vertical that is taken for one; beyond 90 the hole goes uphill."""


@dataclass(frozen=True)
class Survey:
    """Stations of a well, from the top down.

    Attributes
    ----------
    md
        Measured depth in m, (n,), strictly increasing.
    inclination
        Angle from the vertical in degrees, (n,), 0 to 120; above 90 the hole goes uphill.
    azimuth
        In degrees, (n,), or None: then the well is taken to stay in one vertical plane.
    force
        Effective axial force of the string at the stations in N, (n,), **tension positive**, or None.
    source
        File name, or "survey".
    depth_unit
        "m" or "ft": what the file had, for figures and tables.
    ignored
        Columns of the file that were not used.
    """

    md: FloatArray
    inclination: FloatArray
    azimuth: FloatArray | None = None
    force: FloatArray | None = None
    source: str = "survey"
    depth_unit: str = "m"
    ignored: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.md)

    @classmethod
    def read(
        cls,
        path: str | Path,
        *,
        depth_unit: str | None = None,
        angle_unit: str | None = None,
        force_unit: str | None = None,
    ) -> Survey:
        """Read a CSV file of measured depth, inclination and, if there, azimuth and force.

        The first line names the columns ("MD [m],Inc [deg],Azi [deg]" and many like it). Units stand in the header, in
        a line of units below it, or are given here, which counts more than the header. Angles without a unit are
        in degrees. Lines that start with # are left out.

        Raises
        ------
        InputError
            Naming the line and the column, what is allowed, and what to do.
        """
        file = Path(path)
        given = {"md": depth_unit, "inclination": angle_unit, "azimuth": angle_unit, "force": force_unit}
        table = read_columns(file, given)
        columns, wheres = table.values, [f"{file.name}, line {line}" for line in table.lines]
        _check(columns["md"], columns["inclination"], wheres)
        arrays = {key: np.array(values) for key, values in columns.items()}
        return cls(
            arrays["md"], arrays["inclination"], arrays.get("azimuth"), arrays.get("force"),
            file.name, table.depth_unit, table.ignored,
        )  # fmt: skip

    @classmethod
    def of(
        cls,
        md: Sequence[float] | FloatArray,
        inclination: Sequence[float] | FloatArray,
        azimuth: Sequence[float] | FloatArray | None = None,
        force: Sequence[float] | FloatArray | None = None,
    ) -> Survey:
        """Make a survey from arrays (n,): m, degrees, degrees, N (tension positive). Errors as in :meth:`read`."""
        arrays = {"md": md, "inclination": inclination, "azimuth": azimuth, "force": force}
        made = {}
        for name, values in arrays.items():
            if values is None:
                continue
            try:
                made[name] = np.array(values, dtype=float)
            except (TypeError, ValueError):
                raise InputError(name, values, "must be numbers, one for each station") from None
            if made[name].shape != (len(made["md"]),) or made["md"].ndim != 1 or len(made["md"]) < 2:
                raise InputError(name, None, "must be a row of numbers, one for each of at least two stations")
            if not np.all(np.isfinite(made[name])):
                raise InputError(name, None, "must be finite at every station")
        _check(made["md"].tolist(), made["inclination"].tolist(), [f"station {i + 1}" for i in range(len(made["md"]))])
        return cls(made["md"], made["inclination"], made.get("azimuth"), made.get("force"))

    @cached_property
    def tvd(self) -> FloatArray:
        """True vertical depth below the first station in m, (n,), by minimum curvature."""
        angle = np.radians(self.inclination)
        turn = np.zeros(len(self) - 1) if self.azimuth is None else np.radians(np.diff(self.azimuth))
        a, b = angle[:-1], angle[1:]
        half = np.sin(0.5 * (b - a)) ** 2 + np.sin(a) * np.sin(b) * np.sin(0.5 * turn) ** 2
        dogleg = 2.0 * np.arcsin(np.sqrt(np.clip(half, 0.0, 1.0)))
        small = dogleg < 1e-4
        ratio = np.where(small, 1.0 + dogleg**2 / 12.0, np.tan(0.5 * dogleg) / np.where(small, 1.0, 0.5 * dogleg))
        steps = 0.5 * np.diff(self.md) * (np.cos(a) + np.cos(b)) * ratio
        return np.concatenate([[0.0], np.cumsum(steps)])

    @cached_property
    def build(self) -> FloatArray:
        """dα/ds in rad/m, (n,), positive where inclination grows downwards: across the stations on either side."""
        return self._rate(np.radians(self.inclination))

    @cached_property
    def turn(self) -> FloatArray:
        """Sin α dφ/ds in rad/m, (n,), φ azimuth; 0 without azimuths."""
        if self.azimuth is None:
            return np.zeros(len(self))
        rate = self._rate(np.unwrap(np.radians(self.azimuth)))
        return np.asarray(np.sin(np.radians(self.inclination)) * rate)

    def _rate(self, values: FloatArray) -> FloatArray:
        """Rate of change along the hole, from the neighbours; at the ends from the one there is."""
        low = np.maximum(np.arange(len(self)) - 1, 0)
        high = np.minimum(np.arange(len(self)) + 1, len(self) - 1)
        return np.asarray((values[high] - values[low]) / (self.md[high] - self.md[low]))


def _check(md: Sequence[float], inclination: Sequence[float], wheres: Sequence[str]) -> None:
    """Depth rises from station to station, from 0 or more; inclination is an angle from the vertical."""
    for i, (depth, angle, where) in enumerate(zip(md, inclination, wheres, strict=True)):
        if depth < 0.0:
            raise InputError(f"{where}, measured depth", f"{depth:g} m", "must not be negative")
        if i and not depth > md[i - 1]:
            what = (
                f"must be larger than that of the station before, {md[i - 1]:g} m: sort stations, remove repeated ones"
            )
            raise InputError(f"{where}, measured depth", f"{depth:g} m", what)
        if not 0.0 <= angle <= STEEPEST:
            what = f"must be from 0 to {STEEPEST:g} degrees from the vertical"
            hint = "; is it measured from the horizontal?" if -90.0 <= angle < 0.0 else ""
            raise InputError(f"{where}, inclination", f"{math.trunc(angle * 1e6) / 1e6:g} deg", what + hint)

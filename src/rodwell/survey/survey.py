"""A survey of a well: stations of measured depth, inclination and azimuth, and the path that follows from them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.survey.reading.check import Written, check_stations
from rodwell.survey.reading.read import Options, read_well, read_wells
from rodwell.survey.reading.stations import Stations


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
    well
        Name of the well, if the file has it.
    notes
        What must be known of how the file was read, a sentence each: columns taken for something, stations left out,
        azimuths interpolated or not there.
    """

    md: FloatArray
    inclination: FloatArray
    azimuth: FloatArray | None = None
    force: FloatArray | None = None
    source: str = "survey"
    depth_unit: str = "m"
    ignored: tuple[str, ...] = ()
    well: str = ""
    notes: tuple[str, ...] = ()

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
        columns: Mapping[str, str | int] | None = None,
        well: str | None = None,
        decimal: str | None = None,
    ) -> Survey:
        """Read a survey from a file: CSV or other text, XLSX, LAS, or a Petrel deviation file.

        Measured depth and inclination are needed; azimuth and force are taken if they are there. Units stand
        in the header, in a line of units below it, or are given here, which counts more. Angles without a unit are in
        degrees. Missing values are empty, "NaN", −999.25 and the like: a station without depth or inclination is
        left out, and ``notes`` says so.

        Parameters
        ----------
        path
            The file, at most 50 MB and 100,000 stations.
        depth_unit, angle_unit, force_unit
            Units, for example "m" or "ft", "deg" or "rad", "kN" or "klbf".
        columns
            Columns whose names are not understood, by meaning (``"md"``, ``"inclination"``, ``"azimuth"``, ``"force"``,
            ``"well"``): text of the header, number from 1, or ``"none"`` to leave one out.
        well
            Which well, if the file holds several; :func:`read_surveys` reads all.
        decimal
            "point" or "comma", where numbers such as 1,234 do not tell.

        Raises
        ------
        InputError
            Naming the line and the column, in the file's own units, what is allowed, and what to do.
        """
        options = Options(depth_unit, angle_unit, force_unit, columns, decimal)
        return _made(read_well(Path(path), options, well))

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
        names = [f"station {i + 1}" for i in range(len(made["md"]))]
        azimuths = made["azimuth"].tolist() if "azimuth" in made else None
        check_stations(made["md"].tolist(), made["inclination"].tolist(), azimuths, names, Written())
        return cls(made["md"], made["inclination"], made.get("azimuth"), made.get("force"))

    @cached_property
    def dogleg(self) -> FloatArray:
        """Angle between the directions of the hole at neighbouring stations in rad, (n − 1,)."""
        a, b, turn = self._angles()
        half = np.sin(0.5 * (b - a)) ** 2 + np.sin(a) * np.sin(b) * np.sin(0.5 * turn) ** 2
        return np.asarray(2.0 * np.arcsin(np.sqrt(np.clip(half, 0.0, 1.0))))

    @cached_property
    def tvd(self) -> FloatArray:
        """True vertical depth below the first station in m, (n,), by minimum curvature."""
        a, b, _ = self._angles()
        return self._sums(np.cos(a) + np.cos(b))

    @cached_property
    def north(self) -> FloatArray:
        """Distance to the north of the first station in m, (n,), by minimum curvature; azimuth 0 without azimuths."""
        a, b, _ = self._angles()
        to = self._directions()
        return self._sums(np.sin(a) * np.cos(to[:-1]) + np.sin(b) * np.cos(to[1:]))

    @cached_property
    def east(self) -> FloatArray:
        """Distance to the east of the first station in m, (n,), by minimum curvature."""
        a, b, _ = self._angles()
        to = self._directions()
        return self._sums(np.sin(a) * np.sin(to[:-1]) + np.sin(b) * np.sin(to[1:]))

    def _angles(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Inclination at the upper and lower station of every course, and the change of azimuth, in rad, (n − 1,)."""
        angle = np.radians(self.inclination)
        turn = np.zeros(len(self) - 1) if self.azimuth is None else np.radians(np.diff(self.azimuth))
        return angle[:-1], angle[1:], turn

    def _directions(self) -> FloatArray:
        return np.zeros(len(self)) if self.azimuth is None else np.radians(self.azimuth)

    def _sums(self, sides: FloatArray) -> FloatArray:
        """Coordinate at the stations (n,) from the sums of its direction cosines at both ends of the courses.

        The ratio factor of minimum curvature, tan(θ/2)/(θ/2), θ dogleg, makes a circle of every course.
        """
        dogleg = self.dogleg
        small = dogleg < 1e-4
        ratio = np.where(small, 1.0 + dogleg**2 / 12.0, np.tan(0.5 * dogleg) / np.where(small, 1.0, 0.5 * dogleg))
        return np.concatenate([[0.0], np.cumsum(0.5 * np.diff(self.md) * sides * ratio)])

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


def read_surveys(
    path: str | Path,
    *,
    depth_unit: str | None = None,
    angle_unit: str | None = None,
    force_unit: str | None = None,
    columns: Mapping[str, str | int] | None = None,
    decimal: str | None = None,
) -> dict[str, Survey]:
    """Read the surveys of all wells in a file, by name of the well, in the order of the file.

    Wells are told apart by a column (Well, UWI, Wellbore, …) or stand on sheets of their own. A file of one well that
    does not name it gives one survey, called "". Parameters and errors as in :meth:`Survey.read`.
    """
    options = Options(depth_unit, angle_unit, force_unit, columns, decimal)
    return {found.well: _made(found) for found in read_wells(Path(path), options)}


def _made(found: Stations) -> Survey:
    arrays = found.values
    return Survey(
        arrays["md"], arrays["inclination"], arrays.get("azimuth"), arrays.get("force"),
        found.source, found.depth_unit, found.ignored, found.well, found.notes,
    )  # fmt: skip

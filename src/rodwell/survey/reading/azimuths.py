"""Missing azimuths: where the hole is vertical they mean nothing; elsewhere they are put in, and that is said."""

from __future__ import annotations

import numpy as np

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray

VERTICAL = 0.5
"""Inclination in degrees below which a station has no direction worth the name."""

MOST_MISSING = 0.5
"""Part of the inclined stations that may lack an azimuth."""


def without_gaps(
    source: str, md: FloatArray, inclination: FloatArray, azimuth: FloatArray, names: list[str]
) -> tuple[FloatArray | None, list[str]]:
    """Azimuths (n,) in degrees without NaN, or None if there are none at all, and what must be told.

    At stations below :data:`VERTICAL` the direction is that of the next station that has one: no turn arises that was
    not measured. Elsewhere azimuths are interpolated in measured depth, the shorter way round, and held beyond
    the last one known.

    Raises
    ------
    InputError
        If more than half of the inclined stations have none.
    """
    missing = np.isnan(azimuth)
    if not missing.any():
        return azimuth, []
    if missing.all():
        return None, ["No station has an azimuth: the well is taken to lie in one vertical plane."]
    inclined = inclination >= VERTICAL
    lost = np.flatnonzero(missing & inclined)
    if len(lost) > MOST_MISSING * np.sum(inclined):
        what = (f"is missing at {len(lost)} of {int(np.sum(inclined))} inclined stations: fill it in, or leave "
                "azimuths out, --column azimuth=none; the well is then taken to lie in one vertical plane")  # fmt: skip
        raise InputError(f"{source}, azimuth", None, what)
    out = azimuth.copy()
    known = np.flatnonzero(~missing)
    turned = np.unwrap(azimuth[known], period=360.0)
    out[lost] = np.interp(md[lost], md[known], turned)
    have = np.flatnonzero(~np.isnan(out))
    empty = np.flatnonzero(np.isnan(out))
    after = np.minimum(np.searchsorted(have, empty), len(have) - 1)
    out[empty] = out[have[after]]
    if not len(lost):
        return out, []
    where = some(len(lost), [names[i] for i in lost[:6]])
    of = f"{len(lost)} of {int(np.sum(inclined))} inclined stations"
    return out, [f"Azimuth is missing at {of} and interpolated there, the shorter way round: {where}."]


def some(count: int, names: list[str]) -> str:
    """A few names of ``count``, and how many more there are."""
    shown = names[:5]
    return ", ".join(shown) + (f" and {count - len(shown)} more" if count > len(shown) else "")

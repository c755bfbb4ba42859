"""Two cases that are right, and the same with one key changed or gone."""

from __future__ import annotations

import copy
import math
from typing import Any

import pytest

NAN, INF = math.nan, math.inf

PHYSICAL: dict[str, Any] = {
    "rod": {
        "length": "30 m",
        "outer_diameter": "10 cm",
        "youngs_modulus": "200 GPa",
        "density": "7800 kg/m^3",
    },
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}
PLAIN: dict[str, Any] = {"dimensionless": {"weight": 16.5}}
GONE = object()


def changed(base: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """Return a copy of a case with ``section__key = value`` changed, added, or (GONE) taken away."""
    out = copy.deepcopy(base)
    for path, value in changes.items():
        *sections, key = path.split("__")
        place = out
        for section in sections:
            place = place.setdefault(section, {})
        if value is GONE:
            del place[key]
        else:
            place[key] = value
    return out


def physical(name: str, key: str, *phrases: str, **changes: Any) -> Any:
    return pytest.param(changed(PHYSICAL, **changes), key, phrases, id=name)


def plain(name: str, key: str, *phrases: str, **changes: Any) -> Any:
    return pytest.param(changed(PLAIN, **changes), key, phrases, id="plain-" + name)

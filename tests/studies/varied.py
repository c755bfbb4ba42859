"""A string of pipe that studies vary."""

from __future__ import annotations

import copy
from typing import Any

STRING: dict[str, Any] = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "60 deg"},
}


def string(**changes: Any) -> dict[str, Any]:
    data = copy.deepcopy(STRING)
    for key, value in changes.items():
        section, name = key.split("__")
        data.setdefault(section, {})[name] = value
    return data

"""A pipe and a bar whose strength is looked at, as cases."""

from __future__ import annotations

from typing import Any

from rodwell import Answer, Case, answer

G = 9.80665
PIPE = {
    "rod": {"outer_diameter": "127 mm", "inner_diameter": "108.6 mm", "length": "90 m", "material": "steel"},
    "hole": {"diameter": "8.5 in", "angle_from_vertical": "30 deg"},
    "analysis": {"modes": 1},
}
BAR = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
    "analysis": {"modes": 1},
}


def case(base: dict[str, Any], **more: dict[str, Any]) -> Case:
    return Case.from_dict({**base, **{k: {**base.get(k, {}), **v} for k, v in more.items()}})


def plain(load: dict[str, Any], weight: float = 15.0, **problem: Any) -> Answer:
    given = {"dimensionless": {"weight": weight, **problem}, "load": load, "analysis": {"modes": 1, "rtol": 1e-7}}
    return answer(Case.from_dict(given))

"""Rods that float: refused in case files, with the case that is the same rod upside down and from its other end."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from rodwell import Case, InputError, Problem, critical_loads, follow

HOLE = {"diameter": "150 mm", "angle_from_vertical": "62 deg"}
ROD = {"length": "12 m", "outer_diameter": "60 mm", "inner_diameter": "56 mm", "youngs_modulus": "70 GPa"}
"""An empty pipe of aluminium in brine: it weighs 9.65 N/m in air and displaces 33.3 N/m."""


def case(rod: dict[str, Any], **more: Any) -> Case:
    return Case.from_dict({"rod": {**ROD, **rod}, "hole": HOLE, **more})


def floating() -> InputError:
    with pytest.raises(InputError) as caught:
        case({"density": "2700 kg/m^3", "ends": "clamped-pinned"}, mud={"outside": "1200 kg/m^3"})
    return caught.value


def test_a_rod_that_floats_is_refused_with_the_case_that_it_is() -> None:
    """Buoyed weight by hand: ρ g A of the metal, less that of the brine that the outer circle displaces."""
    error = floating()
    assert error.field == "mud.outside"
    metal, circle = 0.25 * np.pi * (0.060**2 - 0.056**2), 0.25 * np.pi * 0.060**2
    lift = 9.80665 * (1200.0 * circle - 2700.0 * metal)
    found = re.search(r'weight_per_length = "([0-9.]+) N/m"', str(error))
    assert found is not None
    assert float(found.group(1)) == pytest.approx(lift, rel=1e-9)
    assert "ends in reverse order" in str(error)


def test_that_case_is_the_rod_seen_upside_down() -> None:
    """With its weight upwards a rod at α is, upside down, one with its weight downwards at 180° − α: the same loads.

    The case that the message writes is that rod seen from its other end, where the end force is F − γ cos α.
    """
    found = re.search(r'weight_per_length = "([0-9.]+ N/m)"', str(floating()))
    assert found is not None
    written = case({"weight_per_length": found.group(1), "ends": "pinned-clamped"}).problem
    upside_down = Problem(written.weight, 180.0 - 62.0, clearance=written.clearance, ends=("clamped", "pinned"))
    mine, theirs = critical_loads(written, 3), critical_loads(upside_down, 3)
    hung = written.axial_weight  # compression at the lower end of the one is that at the upper end of the other
    assert mine.forces - hung == pytest.approx(theirs.forces, abs=1e-7)
    lift, other = (follow(rod).labelled("lift_off 1") for rod in (written, upside_down))
    assert lift.force - hung == pytest.approx(other.force, abs=lift.error + other.error + 1e-9)

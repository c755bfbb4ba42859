"""Holes that climb: inclined beyond horizontal, where the end s = 1 is the lower one.

From its other end such a rod is one at 180° − α with its ends exchanged, and its end force acts at the other end.
"""

from __future__ import annotations

from typing import Any

import pytest

from rodwell import Case, InputError, answer, critical_loads, follow
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.wording import forces_of
from rodwell.plots.sketch import plot_sketch

ROD = {"length": "12 m", "outer_diameter": "60 mm", "inner_diameter": "50 mm", "youngs_modulus": "70 GPa",
       "density": "2700 kg/m^3"}  # fmt: skip


def case(angle: dict[str, str], ends: str, at: str = "top", **more: Any) -> Case:
    return Case.from_dict({
        "rod": {**ROD, "ends": ends}, "hole": {"diameter": "150 mm", **angle}, "analysis": {"off_wall": False},
        "load": {"applied": "-2 kN", "at": at}, **more,
    })  # fmt: skip


def climbing(**more: Any) -> Case:
    return case({"angle_from_vertical": "118 deg"}, "clamped-pinned", **more)


def from_its_other_end(**more: Any) -> Case:
    return case({"angle_from_vertical": "62 deg"}, "pinned-clamped", **more)


def test_loads_are_those_of_the_rod_from_its_other_end() -> None:
    mine, other = climbing(), from_its_other_end(at="bottom")
    hung = other.problem.axial_weight
    assert mine.problem.axial_weight == -hung
    assert mine.applied[0].force == pytest.approx(other.applied[0].force - hung, rel=1e-12)
    loads, theirs = critical_loads(mine.problem, 3), critical_loads(other.problem, 3)
    assert loads.forces == pytest.approx(theirs.forces - hung, abs=1e-7)
    lift, its = (follow(one.problem).labelled("lift_off 1") for one in (mine, other))
    assert lift.force == pytest.approx(its.force - hung, abs=lift.error + its.error + 1e-9)
    assert case({"angle_from_horizontal": "-28 deg"}, "clamped-pinned").problem == mine.problem


def test_ends_are_called_by_their_s() -> None:
    found = answer(climbing())
    text = " ".join(sentences(found))
    assert "The end s = 1 is the lower one" in text
    assert "Compression is largest at s = 1" in text
    assert "of compression at s = 1" in text
    assert "the bottom" not in text
    assert "the top" not in text
    assert forces_of(found.case).end == "s = 1"
    names = [one.get_text() for one in plot_sketch(found.case).axes[0].texts]
    assert any("bottom, s = 1" in name for name in names)
    other = answer(from_its_other_end(at="bottom"))
    mine, its = (one.key_numbers["largest_wall_force"].number for one in (found, other))
    assert mine.value == pytest.approx(its.value, rel=1e-7)
    stress, its_stress = (one.assessment.stress(one.assessment.at_buckling) for one in (found, other))
    assert stress is not None
    assert its_stress is not None
    assert stress.value == pytest.approx(its_stress.value, rel=1e-6)


def test_without_dimensions() -> None:
    assert Case.from_dict({"dimensionless": {"weight": 15.0, "alpha": 120.0}}).problem.alpha == 120.0


def test_what_is_no_inclination() -> None:
    for angle in ({"angle_from_vertical": "181 deg"}, {"angle_from_horizontal": "-91 deg"}):
        with pytest.raises(InputError, match="s = 1 is the lower end"):
            case(angle, "clamped-clamped")

"""Rods that float: lighter than the fluid around them, pressed to the upper side of the hole.

Upside down such a rod is one with its weight downwards at 180° − α; from its other end, one at α with its ends
exchanged and the load at the other end.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from rodwell import Case, InputError, Problem, answer, certify, critical_loads, follow, sensitivities
from rodwell.answers.result.bridged import bridged_answer
from rodwell.answers.words.bridged import bridged_sentences
from rodwell.answers.words.meaning import sentences
from rodwell.plots.sketch import plot_sketch
from rodwell.problem.hole import Hole
from rodwell.report.reports.front import inputs_in_words
from rodwell.strength.section import RodSection

HOLE = {"diameter": "150 mm", "angle_from_vertical": "62 deg"}
ROD = {"length": "12 m", "outer_diameter": "60 mm", "inner_diameter": "56 mm", "youngs_modulus": "70 GPa"}
"""An empty pipe of aluminium in brine: it weighs 9.65 N/m in air and displaces 33.3 N/m."""

METAL, CIRCLE = 0.25 * np.pi * (0.060**2 - 0.056**2), 0.25 * np.pi * 0.060**2
LIFT = 9.80665 * (1200.0 * CIRCLE - 2700.0 * METAL)
"""Buoyed weight by hand: that of the brine that the outer circle displaces, less ρ g A of the metal."""


def case(rod: dict[str, Any], **more: Any) -> Case:
    return Case.from_dict({"rod": {**ROD, **rod}, "hole": HOLE, **more})


def floating(**more: Any) -> Case:
    return case({"density": "2700 kg/m^3", "ends": "clamped-pinned"}, mud={"outside": "1200 kg/m^3"}, **more)


def upright(**more: Any) -> Case:
    """The same rod upside down and from its other end: its weight acts downwards."""
    return case({"weight_per_length": f"{LIFT:.17g} N/m", "ends": "pinned-clamped"}, **more)


def test_the_problem_by_hand() -> None:
    found = floating()
    assert found.problem.floats
    assert found.scales is not None
    assert found.problem.weight * found.scales.factor("force_per_length") == pytest.approx(LIFT, rel=1e-12)
    assert found.problem.alpha == 62.0
    assert found.problem.axial_weight == pytest.approx(-found.problem.weight * np.cos(np.radians(62.0)), rel=1e-14)


def test_loads_are_those_of_the_rod_upside_down_and_from_its_other_end() -> None:
    """Compression at the top of the one is compression at the bottom of the other."""
    mine, other = floating().problem, upright().problem
    hung = other.axial_weight
    assert critical_loads(mine, 3).forces == pytest.approx(critical_loads(other, 3).forces - hung, abs=1e-7)
    lift, theirs = (follow(rod).labelled("lift_off 1") for rod in (mine, other))
    assert lift.force == pytest.approx(theirs.force - hung, abs=lift.error + theirs.error + 1e-9)
    assert sorted(1.0 - s for s in lift.s) == pytest.approx(sorted(theirs.s), abs=1e-6)


def test_a_load_at_either_end() -> None:
    """From the bottom to the top the force falls by what lifts the rod: N(0) = N(1) + lift L cos α."""
    top, bottom = (floating(load={"applied": "-1 kN", "at": at}) for at in ("top", "bottom"))
    assert top.scales is not None
    less = (top.applied[0].force - bottom.applied[0].force) * top.scales.factor("force")
    assert less == pytest.approx(LIFT * 12.0 * np.cos(np.radians(62.0)), rel=1e-12)


def test_what_varies_with_the_inclination() -> None:
    """Derivatives by α against differences, and branches followed in α."""
    problem = Problem(30.0, 60.0, floats=True)
    (load, *_) = sensitivities(problem)
    low, high = (critical_loads(problem.but(alpha=60.0 + h), 1).forces[0] for h in (-1e-3, 1e-3))
    assert load.derivatives["alpha"].value == pytest.approx((high - low) / 2e-3, rel=1e-6)
    state = follow(problem, until=-150.0)[-1]
    there = follow(problem, start=state, parameter="alpha", until=61.0)[-1]
    assert there.number("energy").value == pytest.approx(
        follow(there.problem, until=-150.0)[-1].number("energy").value, rel=1e-8
    )


def test_loads_with_proof() -> None:
    problem = Problem(30.0, 0.0, ends="pinned-clamped", floats=True)  # type: ignore[arg-type]
    (proved,) = certify(problem, 1)
    assert float(proved.force.middle) == pytest.approx(critical_loads(problem, 1).forces[0], abs=1e-9)


def test_the_rod_is_drawn_at_the_top() -> None:
    problem = Problem(30.0, 60.0, floats=True)
    state = follow(problem, until=-150.0)[-1]
    rod, other = state.geometry(41), equilibrium_upside_down(problem).geometry(41)
    assert rod.centreline[0] == pytest.approx([problem.clearance, 0.0, 0.0], abs=1e-12)
    turned = np.array([-1.0, -1.0, 1.0])  # by half a turn about the hole's axis
    for name in ("centreline", "t1", "d1", "u1", "d0", "v1"):
        assert getattr(rod, name) == pytest.approx(turned * getattr(other, name), abs=1e-9)


def equilibrium_upside_down(problem: Problem) -> Any:
    return follow(problem.but(floats=False, alpha=180.0 - problem.alpha), until=-150.0)[-1]


def test_the_answer_in_the_users_words() -> None:
    found = answer(floating(load={"applied": "-0.5 kN"}, analysis={"off_wall": False}))
    text = " ".join(sentences(found))
    assert "presses on the upper side of the hole" in text
    assert "Compression is largest at the top" in text
    assert found.assessment.formulas == ()
    assert found.assessment.local is None
    assert found.converged
    other = answer(upright(load={"applied": "-0.5 kN", "at": "bottom"}, analysis={"off_wall": False}))
    mine, theirs = (one.key_numbers["largest_wall_force"].number for one in (found, other))
    assert mine.value == pytest.approx(theirs.value, rel=1e-7)
    assert "upwards: the rod floats" in dict(inputs_in_words(found.case))["Weight per length"]
    assert plot_sketch(found.case).axes[0].texts


def test_round_a_drop() -> None:
    """Heights for the pressures from the hole in space as it was given; words on which side the rod lies."""
    hole = {**HOLE, "build": "-10 deg/30 m"}
    found = answer(Case.from_dict({
        "rod": {**ROD, "density": "2700 kg/m^3", "ends": "clamped-pinned"}, "hole": hole,
        "mud": {"outside": "1200 kg/m^3"},
    }))  # fmt: skip
    state, section = found.at_lift_off, found.assessment.section
    assert state is not None
    assert isinstance(section, RodSection)
    s, bend = np.linspace(0.0, 1.0, 9), -math.radians(10.0) * 12.0 / 30.0
    fields, axis = state.fields(s), Hole.arc(62.0, bend)
    place = 0.5 - 0.5 / (1.0 - found.case.problem.clearance * bend) + fields["z"]
    n1, n2, _ = axis.frame(place).transpose(1, 0, 2)
    angle = fields["xi2"][:, None]
    height = (axis.points(place) + found.case.problem.clearance * (np.cos(angle) * n1 - np.sin(angle) * n2))[:, 2]
    assert np.ptp(section.drop(fields) / 12.0 + height) < 1e-9
    assert section.drop(found.assessment.at_buckling.fields(np.array([1.0])))[0] == pytest.approx(0.0, abs=1e-12)
    text = " ".join(sentences(found))
    assert "the rod leaves the high side at the bottom, pressed away from it by the curve" in text
    assert "of the high side; the rod lies up to" in text
    assert plot_sketch(found.case).axes[0].texts


def test_without_dimensions() -> None:
    data = {"dimensionless": {"weight": -15.0, "alpha": 60.0}, "load": {"applied": -90.0}}
    found = Case.from_dict(data).problem
    assert (found.weight, found.floats) == (15.0, True)


def test_what_stays_refused() -> None:
    with pytest.raises(InputError, match="floats=True"):
        Problem(-15.0, 60.0)


SECTION = {"outer_diameter": "60 mm", "youngs_modulus": "70 GPa", "length": "6 m", "density": "2700 kg/m^3"}


def in_part(**more: Any) -> Case:
    """Heavy pipe, empty pipe, heavy pipe, in brine."""
    heavy, light = ({**SECTION, "inner_diameter": bore} for bore in ("0 mm", "56 mm"))
    hole = {**HOLE, "diameter": "80 mm", **more}
    return Case.from_dict({"string": [heavy, light, heavy], "hole": hole, "mud": {"outside": "1200 kg/m^3"}})


def test_a_string_that_floats_in_part() -> None:
    """Weights by hand; where it lies, and when it buckles, in words."""
    found = in_part()
    sinks = 9.80665 * (2700.0 - 1200.0) * CIRCLE
    assert found.scales is not None
    assert found.problem.weight * found.scales.factor("force_per_length") == pytest.approx(sinks, rel=1e-12)
    ratios = [section[2] for section in found.problem.sections]
    assert ratios == pytest.approx([1.0, -LIFT / sinks, 1.0], rel=1e-12)
    text = bridged_sentences(bridged_answer(found))
    assert "leaves the lower side of the hole where it begins to float, and buckles sideways at" in text[0]
    assert "it lies on the lower side from 0 m to " in text[1]
    assert "on the upper side at 9.00" in text[1]  # hardly unlike from both ends
    assert "Not computed where some sections sink and others float" in " ".join(text)


def test_what_is_not_computed_of_a_string_that_floats_in_part() -> None:
    given = {"angle_from_vertical": "100 deg", "wall_stiffness": "1 MPa", "walk": "1 deg/30 m"}
    why = {"walk": "must have one sign of weight in a hole that leaves the vertical plane"}
    for key, value in given.items():
        with pytest.raises(InputError, match=why.get(key, "where some sections sink and others float")) as caught:
            in_part(**{key: value})
        assert caught.value.field == ("string" if key in why else f"hole.{key}")

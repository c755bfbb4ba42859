"""Sections of [[string]] that taper: what they make, against formulas of the diameter at each place."""

from __future__ import annotations

import copy
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.patches import Polygon

from rodwell import Case, critical_loads
from rodwell.case.case import CaseError
from rodwell.case.catalogue import Catalogue
from rodwell.case.schema import StringInput
from rodwell.case.well.string_sections import string_sections
from rodwell.errors import InputError
from rodwell.plots.sections import plot_string
from rodwell.report.reports.sections import string_section
from rodwell.strength.section import RodSection, StringSections, rod_section
from rodwell.strength.stress import section_of
from rodwell.strength.validity import validity

EXAMPLE = Path(__file__).parents[2] / "examples" / "tapered-guidewire.toml"

MM, E, RHO, G = 1e-3, 200e9, 7850.0, 9.80665

DATA: dict[str, Any] = {
    "rod": {"ends": "pinned-pinned"},
    "string": [
        {"length": "0.2 m", "outer_diameter": "0.5 mm", "youngs_modulus": "200 GPa", "density": "7850 kg/m^3"},
        {"name": "taper", "length": "0.3 m", "outer_diameter": "0.5 mm", "outer_diameter_at_top": "0.35 mm",
         "inner_diameter": "0.1 mm", "inner_diameter_at_top": "0.2 mm", "youngs_modulus": "200 GPa",
         "density": "7850 kg/m^3", "poisson": 0.25, "yield_strength": "1500 MPa"},
    ],
    "hole": {"clearance": "2 mm", "angle_from_vertical": "90 deg"},
}  # fmt: skip

CORE = {"length": "0.3 m", "outer_diameter": "0.9 mm", "core_diameter": "0.2 mm", "core_diameter_at_top": "0.6 mm",
        "material": "steel", "weight_per_length": "0.03 N/m"}  # fmt: skip
"""A ground core in a coil of one diameter."""


def case(*sections: dict[str, Any], **changes: Any) -> Case:
    """The string above, or one of these sections, with sections of the file changed."""
    return Case.from_dict(copy.deepcopy(DATA) | ({"string": [*sections]} if sections else {}) | changes)


def taper(**changes: Any) -> dict[str, Any]:
    """The section that tapers, with keys changed, or left out."""
    return {key: value for key, value in (DATA["string"][1] | changes).items() if value is not None}


PART = np.linspace(0.0, 1.0, 23)[1:-1]
OUTER, INNER = (0.5 - 0.15 * PART) * MM, (0.1 + 0.1 * PART) * MM


def test_stiffness_and_weight_are_those_of_the_diameter_at_each_place() -> None:
    found = case()
    assert found.string is not None
    assert found.scales is not None
    rod, s = found.problem.rod, 0.4 + 0.6 * PART
    unit = E * math.pi / 64.0 * ((0.5 * MM) ** 4 - (0.1 * MM) ** 4)  # of the longest, at its lower end
    stiffness = E * math.pi / 64.0 * (OUTER**4 - INNER**4)
    assert rod.stiffness(s) * unit == pytest.approx(stiffness, rel=1e-13)
    assert rod.torsion(s) / rod.torsion(np.zeros(1)) == pytest.approx(
        stiffness / 1.25 / (E * math.pi / 64.0 * (0.5 * MM) ** 4 / 1.3), rel=1e-12
    )
    weight = RHO * G * math.pi / 4.0 * (OUTER**2 - INNER**2)
    mean = found.problem.weight * found.scales.factor("force_per_length")
    assert rod.weight(s) * mean == pytest.approx(weight, rel=1e-12)
    assert rod.whole_weight == pytest.approx(1.0, rel=1e-13)


def test_fluids_lift_each_place_by_what_it_displaces() -> None:
    found = case(taper(), mud={"inside": "1000 kg/m^3", "outside": "1060 kg/m^3"})
    assert found.scales is not None
    weight = G * math.pi / 4.0 * (RHO * (OUTER**2 - INNER**2) + 1000.0 * INNER**2 - 1060.0 * OUTER**2)
    mean = found.problem.weight * found.scales.factor("force_per_length")
    assert found.problem.rod.weight(PART) * mean == pytest.approx(weight, rel=1e-12)


def test_a_cone_buckles_as_in_closed_form() -> None:
    """π² E I₀ (d₁/d₀)²/L²: J. M. Gere and W. O. Carter, J. Struct. Div. ASCE 88 (1962) 1–11, both ends pinned."""
    cone = taper(inner_diameter=None, inner_diameter_at_top=None, density=None, weight_per_length="0 N/m",
                 weight_per_length_at_top="0 N/m")  # fmt: skip
    found = case(cone)
    assert found.scales is not None
    load = -critical_loads(found.problem, 1)[0].force * found.scales.factor("force")
    inertia = math.pi / 64.0 * (0.5 * MM) ** 4
    assert load == pytest.approx(math.pi**2 * E * inertia * (0.35 / 0.5) ** 2 / 0.3**2, rel=1e-9)


def test_measured_values_go_in_a_straight_line() -> None:
    found = case({"length": "0.3 m", "pipe": "0.035 in guidewire", "bending_stiffness": "1400 N mm^2",
                  "bending_stiffness_at_top": "200 N mm^2", "torsional_stiffness": "900 N mm^2",
                  "weight_per_length": "0.04 N/m", "weight_per_length_at_top": "0.02 N/m"})  # fmt: skip
    rod = found.problem.rod
    assert rod.stiffness(PART) == pytest.approx(1.0 - PART * 6.0 / 7.0, rel=1e-13)
    assert rod.torsion(PART) == pytest.approx(np.ones(PART.size), rel=1e-13)
    assert rod.weight(PART) == pytest.approx((0.04 - 0.02 * PART) / 0.03, rel=1e-13)


def test_a_core_bears_alone_and_the_clearance_is_that_of_what_is_around_it() -> None:
    found = case(CORE, hole={"diameter": "6 mm", "angle_from_vertical": "90 deg"}, mud={"outside": "1060 kg/m^3"})
    assert found.scales is not None
    core = (0.2 + 0.4 * PART) * MM
    assert found.problem.rod.stiffness(PART) == pytest.approx((core / (0.2 * MM)) ** 4, rel=1e-12)
    assert found.problem.clearance * 0.3 == pytest.approx(2.55 * MM)
    assert found.string is not None
    section = section_of(found.string.members[0].rod)
    assert section is not None
    assert section.outer == pytest.approx(0.1 * MM)
    assert found.problem.weight * found.scales.factor("force_per_length") == pytest.approx(
        0.03 - 1060.0 * G * math.pi / 4.0 * (0.9 * MM) ** 2
    )


def fields(s: np.ndarray, bending: float, force: float, torque: float) -> dict[str, np.ndarray]:
    """Fields of a rod on the wall that has the same in it everywhere."""
    same = np.ones(s.shape)
    return {"s": s, "z": s, "xi2": 0.0 * s, "rod_F1": force * same, "rod_M1": torque * same, "rod_M2": bending * same,
            "rod_M3": 0.0 * s}  # fmt: skip


@pytest.mark.parametrize("cored", [False, True])
def test_stress_is_that_of_the_diameter_where_it_is(cored: bool) -> None:
    """N/A, M r/I and T r/J of the ring, or the core, at each place; the safety factor is to the largest."""
    found = case(CORE | {"yield_strength": "1 GPa"}) if cored else case()
    assert found.scales is not None
    sections, s = rod_section(found), PART if cored else 0.4 + 0.6 * PART
    assert isinstance(sections, StringSections)
    outer, inner = ((0.2 + 0.4 * PART) * MM, 0.0 * PART) if cored else (OUTER, INNER)
    stress = sections.stresses(fields(s, 3.0, -2.0, 0.5))
    unit, force = found.scales.factor("moment"), found.scales.factor("force")
    inertia = math.pi / 64.0 * (outer**4 - inner**4)
    assert stress.axial == pytest.approx(-2.0 * force / (math.pi / 4.0 * (outer**2 - inner**2)), rel=1e-12)
    assert stress.bending == pytest.approx(3.0 * unit * 0.5 * outer / inertia, rel=1e-12)
    assert stress.torsion == pytest.approx(0.25 * unit * 0.5 * outer / inertia, rel=1e-12)
    last = sections.members[-1]
    state: Any = SimpleNamespace(
        fields=lambda places: fields(places, 3.0, -2.0, 0.5), straight=False, error=0.0,
        largest=lambda size: SimpleNamespace(value=float(np.max(size(fields(s, 3.0, -2.0, 0.5)))), error=0.0, s=s[-1]),
    )  # fmt: skip
    assert isinstance(last, RodSection)
    largest = last.largest(state)
    assert largest.value == pytest.approx(np.max(stress.von_mises))
    assert largest.safety.value == pytest.approx((1e9 if cored else 1.5e9) / largest.value)  # type: ignore[union-attr]


def test_strain_is_that_of_the_diameter_where_it_is() -> None:
    """The axial one as at the thinner end; that in bending as M r/B where the moment is, here at s = 1."""
    found = case()
    assert found.scales is not None
    at_top = np.array([1.0])
    state: Any = SimpleNamespace(
        straight=False, problem=found.problem, force=-2.0, error=0.0, name="buckled",
        shortening=SimpleNamespace(value=0.0, error=0.0),
        largest=lambda size: SimpleNamespace(
            value=float(size(fields(at_top, 3.0, -2.0, 0.5) | {"eta": 0.0 * at_top})[0]), error=0.0
        ),
    )  # fmt: skip
    numbers = {one.name: one.number.value for one in validity(found, [state], [], 1.0).measures if one.number}
    outer, inner = 0.35 * MM, 0.2 * MM
    moment, force = 3.0 * found.scales.factor("moment"), 2.0 * found.scales.factor("force")
    assert numbers["bending_strain"] == pytest.approx(
        moment * 0.5 * outer / (E * math.pi / 64.0 * (outer**4 - inner**4)), rel=1e-12
    )
    assert numbers["axial_strain"] == pytest.approx(force / (E * math.pi / 4.0 * (outer**2 - inner**2)), rel=1e-12)


def test_the_string_is_drawn_with_its_taper_and_its_core() -> None:
    found = Case.read(EXAMPLE)
    assert found.string is not None
    axes = plot_string(found)
    shapes = [patch.get_xy() for patch in axes.patches if isinstance(patch, Polygon)]
    heights = [(shape[3, 1] - shape[0, 1], shape[2, 1] - shape[1, 1]) for shape in shapes]
    of = [value for one in found.string.members for value in (one.rod.outer_diameter, one.rods[-1].outer_diameter)]
    cores = [one.core_diameter for member in found.string.members for one in (member.rods[0], member.rods[-1])]
    assert np.ravel(heights[::2]) == pytest.approx(np.array(of, dtype=float) / MM)
    assert np.ravel(heights[1::2]) == pytest.approx(np.array(cores, dtype=float) / MM)
    about: Any = SimpleNamespace(case=found, applied=(), at_lift_off=None, at_buckling=None, section=None)
    table = string_section(about)[0].blocks[1]
    rows = dict(zip(table.head, np.transpose(table.rows), strict=True))
    assert " to " in rows["Core"][1]
    assert " to " in rows["Stiffness EI"][1]
    assert "to" not in rows["Core"][0]


@pytest.mark.parametrize(
    ("section", "field", "words"),
    [
        (taper(outer_diameter=None), "string 1 (taper).outer_diameter", "is missing: outer_diameter_at_top needs it"),
        (taper(inner_diameter_at_top="0.4 mm"), "string 1 (taper).inner_diameter_at_top",
         "must be below the outer diameter"),
        (taper(length=None, joints=2, joint_length="0.2 m"), "string 1 (taper).joints", "a taper is one piece"),
        (taper(tool_joint_diameter="0.6 mm"), "string 1 (taper).tool_joint_diameter", "a taper is one piece"),
        (taper(youngs_modulus=None, bending_stiffness="600 N mm^2"), "string 1 (taper).bending_stiffness",
         "give bending_stiffness_at_top too, or material"),
        (taper(density=None, weight_per_length="0.01 N/m"), "string 1 (taper).weight_per_length",
         "give weight_per_length_at_top too"),
        (taper(pipe="0.035 in guidewire"), "string 1 (taper).outer_diameter_at_top", "contradicts pipe"),
        (taper(outer_diameter_at_top="20 m"), "string 1 (taper).outer_diameter_at_top", "is not plausible"),
        (taper(outer_diameter=["0.5 mm", "0.3 mm"]), "string 1.outer_diameter",
         "a taper as outer_diameter and outer_diameter_at_top, its values at lower and upper end"),
        (CORE | {"core_diameter_at_top": "1 mm"}, "string 1.core_diameter_at_top", "at most the outer diameter of"),
        (CORE | {"inner_diameter": "0.1 mm"}, "string 1.core_diameter", "a core is solid"),
        (CORE | {"weight_per_length": None}, "string 1.weight_per_length", "the core and what is around it"),
        (CORE | {"outer_diameter": None}, "string 1.outer_diameter", "core_diameter is that of a core within it"),
    ],
)  # fmt: skip
def test_what_is_no_taper_names_section_value_and_remedy(section: dict[str, Any], field: str, words: str) -> None:
    given = {key: value for key, value in section.items() if value is not None}
    with pytest.raises(CaseError) as caught:
        case(given)
    told = str(caught.value).replace(" (section 1)", "")
    assert field in told
    assert words in told


def test_a_taper_of_the_outer_diameter_has_one_clearance_only_if_it_is_given() -> None:
    with pytest.raises(CaseError, match=r"string 2 \(taper\)\.outer_diameter_at_top = '0.35 mm': lets the clearance"):
        case(hole={"diameter": "5 mm", "angle_from_vertical": "90 deg"})
    narrowing = taper(outer_diameter_at_top=None)
    found = case(narrowing, hole={"diameter": "5 mm", "angle_from_vertical": "90 deg"})
    assert found.problem.tapered
    assert not found.problem.bridges


def test_a_taper_that_lies_in_two_parts_of_a_hole_is_two_of_one_taper() -> None:
    narrowing = taper(outer_diameter_at_top=None)
    parts = [{"from": "0 m", "to": "0.1 m", "diameter": "4 mm"}, {"from": "0.1 m", "to": "0.3 m", "diameter": "5 mm"}]
    found = case(narrowing, hole={"angle_from_vertical": "90 deg", "section": parts})
    one = case(narrowing).problem.rod
    assert found.problem.bridges
    assert found.problem.rod.stiffness(PART) == pytest.approx(one.stiffness(PART), rel=1e-12)
    assert found.problem.rod.weight(PART) == pytest.approx(one.weight(PART), rel=1e-12)
    assert list(found.problem.rod.breaks) == pytest.approx([0.0, 2.0 / 3.0, 1.0])


def test_torque_and_drag_takes_no_tapers() -> None:
    with pytest.raises(InputError, match=r"outer_diameter_at_top = .*makes a taper, which torque and drag does not"):
        string_sections([StringInput.model_validate(taper())], G, None, None, Catalogue())

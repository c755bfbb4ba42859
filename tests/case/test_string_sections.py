"""[[string]] of a case file: what it makes, and what is said of one that cannot be."""

from __future__ import annotations

import copy
import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rodwell import Case, answer, critical_loads
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.state import contact_state
from rodwell.analysis.path.bridging import bridged
from rodwell.answers.result.beyond import StateBeyond
from rodwell.answers.result.bridged import TOOL_JOINT, Bridged
from rodwell.answers.words.bridged import ENDLESS, bridged_sentences, limits
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.verdict import verdict
from rodwell.case.case import CaseError
from rodwell.errors import InputError
from rodwell.plots.paths.bridging import plot_bridging
from rodwell.quantities.value import Value
from rodwell.report.reports.case import case_report
from rodwell.report.reports.sections import string_section
from rodwell.strength.section import StringSections
from rodwell.studies.audit.audit import audit
from rodwell.studies.sweep.varied import varied_inputs

EXAMPLE = Path(__file__).parents[2] / "examples" / "bottom-hole-assembly.toml"

PSI = 6894.757293168361

DATA: dict[str, Any] = {
    "rod": {"ends": "clamped-pinned"},
    "string": [
        {"name": "collar", "length": "12 m", "outer_diameter": "6 in", "inner_diameter": "2 in", "material": "steel",
         "yield_strength": "750 MPa"},
        {"joints": 2, "joint_length": "9 m", "outer_diameter": "5 in", "inner_diameter": "4.276 in",
         "youngs_modulus": "200 GPa", "density": "7850 kg/m^3", "grade": "S-135"},
    ],
    "hole": {"clearance": "1.5 in", "angle_from_vertical": "50 deg"},
}  # fmt: skip


def case(**changes: Any) -> Case:
    """The string above, with sections of the file changed, or (by number) keys of its sections."""
    data = copy.deepcopy(DATA)
    for name, change in changes.items():
        if name.startswith("of_"):
            for key, value in change.items():
                data["string"][int(name[3:]) - 1].pop(key, None)
                if value is not None:
                    data["string"][int(name[3:]) - 1][key] = value
        else:
            data[name] = change
    return Case.from_dict(data)


def refused(**changes: Any) -> str:
    with pytest.raises(CaseError) as caught:
        case(**changes)
    return str(caught.value)


def test_a_string_is_the_problem_of_its_sections() -> None:
    """Lengths, stiffnesses and weights from the dimensions, by hand."""
    found = case()
    inch, (_, pipe) = 0.0254, found.string.members  # type: ignore[union-attr]
    collar_b = 30e6 * PSI * math.pi / 64.0 * ((6 * inch) ** 4 - (2 * inch) ** 4)
    pipe_b = 200e9 * math.pi / 64.0 * ((5 * inch) ** 4 - (4.276 * inch) ** 4)
    pipe_w = 7850.0 * 9.80665 * math.pi / 4.0 * ((5 * inch) ** 2 - (4.276 * inch) ** 2)
    (l1, b1, q1, d1, c1), (l2, b2, q2, _, c2) = found.problem.sections
    assert (l1, l2) == pytest.approx((0.4, 0.6))
    assert (b2, d1, c2) == (1.0, 1.0, 1.0)
    assert b1 == pytest.approx(collar_b / pipe_b, rel=1e-12)
    assert pipe.weight == pytest.approx(pipe_w, rel=1e-12)
    assert l1 * q1 + l2 * q2 == pytest.approx(1.0, rel=1e-12)
    assert found.problem.weight * q2 == pytest.approx(pipe_w * 30.0**3 / pipe_b, rel=1e-12)
    assert c1 == pytest.approx(b1, rel=1e-12)
    assert found.problem.ends == ("clamped", "pinned")
    assert found.problem.clearance == pytest.approx(1.5 * inch / 30.0)


PIPE = {"pipe": "5 in 19.5 lb/ft drill pipe", "joints": 3, "joint_length": "9 m", "tool_joint_diameter": "6.625 in",
        "tool_joint_length": "0.5 m", "tool_joint_bore": "3.25 in", "grade": "S-135"}  # fmt: skip


def jointed(**changes: Any) -> Case:
    """Three joints of drill pipe with tool joints in a hole of 8.5 in."""
    one = {key: value for key, value in (PIPE | changes).items() if value is not None}
    return Case.from_dict({"string": [one], "hole": {"diameter": "8.5 in", "angle_from_vertical": "90 deg"}})


def test_tool_joints_stand_between_bodies_half_of_one_at_either_end() -> None:
    """By hand: 8.5 m of body of plain-end weight, 0.5 m of tool joint of the same steel, each with its clearance."""
    found, inch = jointed(), 0.0254
    assert found.string is not None
    assert [member.rod.length for member in found.string.members] == [0.25, 8.5, 0.5, 8.5, 0.5, 8.5, 0.25]
    joint, body = found.string.members[:2]
    assert body.weight == pytest.approx(17.93 * 4.4482216152605 / 0.3048)
    area = math.pi / 4.0 * ((6.625 * inch) ** 2 - (3.25 * inch) ** 2)
    assert joint.weight == pytest.approx(area * 7848.77 * 9.80665, rel=1e-4)
    stiffness, _, clearance = (np.array(found.problem.sections)[:, k] for k in (1, 2, 3))
    assert stiffness[0] == pytest.approx((6.625**4 - 3.25**4) / (5.0**4 - 4.276**4))
    assert clearance[::2] == pytest.approx((8.5 - 6.625) / (8.5 - 5.0))
    assert found.problem.clearance * 27.0 == pytest.approx(1.75 * inch)
    assert (body.rod.yield_strength, joint.rod.yield_strength) == (pytest.approx(135000.0 * PSI), None)
    assert [fact.label for fact in found.facts if "tool joint" in fact.label].count(
        "string 1 (5 in 19.5 lb/ft drill pipe, tool joint): material"
    ) == 1


def test_what_a_string_on_tool_joints_rests_on_is_told_in_users_words() -> None:
    """Joints between clamped ends: six edges, those beside the ends levered; weight alone is on the others.

    The picture has the lower sides of hole and string: tool joints on the wall, the body no lower than their radii say.
    """
    case, inch = jointed(), 0.0254
    lying = bridged(RodInHole(case.problem), 0.0)
    assert lying is not None
    state = contact_state(lying)
    path: Any = SimpleNamespace(ended_because="", missed=())
    found = Bridged(case, path, None, StateBeyond("loading", Value(0.0), state, None), ())
    assert {found.edge_of(point.s.value) for point in found.edges} == {TOOL_JOINT}
    assert [point.s.value for point in found.levered] == pytest.approx([0.25 / 27.0, 26.75 / 27.0])
    rests = bridged_sentences(found)[1]
    assert rests.startswith("Where nothing is compressed it rests on 6 edges of tool joints with at most ")
    assert re.search(r"(0\.2500|26\.75) m from the end s = 0\. That edge is next to an end that holds", rests)
    assert "narrower" not in rests
    many = [
        line for n in (5, 6) for line in limits(replace(found, case=jointed(joints=n))) if "rodwell endless" in line
    ]
    assert many == [ENDLESS]
    largest = max(point.force.value for point in found.edges if point not in found.levered)
    assert f"at most {case.scales and case.scales.text(largest, 'force')}" in rests
    axes = plot_bridging(state, scales=case.scales, pairs=case.pairs)
    wall, string = (np.asarray(line.get_ydata(), dtype=float) for line in axes.lines[:2])
    unit = 25.4 if axes.get_ylabel().endswith("[mm]") else inch
    assert wall == pytest.approx(-4.25 * unit)
    assert np.min(string) == pytest.approx(-4.25 * unit)
    assert np.min(np.abs(np.max(string) + (4.25 - 0.8125) * unit)) < 0.05 * unit


def test_a_thousand_joints_are_two_thousand_sections() -> None:
    assert len(jointed(joints=1000).problem.sections) == 2001


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"tool_joint_length": None}, "tool_joint_length: is missing: tool_joint_diameter needs it"),
        ({"joints": None, "joint_length": None, "length": "27 m"}, "joints: is missing: tool_joint_diameter needs it"),
        ({"tool_joint_diameter": "4.5 in"}, "must be above the diameter of the body, 0.127 m"),
        ({"tool_joint_length": "9.5 m"}, "must be below the length of a joint, 9 m"),
        (
            {"tool_joint_bore": "7 in"},
            "tool_joint_bore = '7 in': must be below tool_joint_diameter, 0.168275 m",
        ),
        (
            {"tool_joint_diameter": "9 in"},
            "string 1 (5 in 19.5 lb/ft drill pipe).tool_joint_diameter = '9 in': must be below the hole's diameter of "
            "0.2159 m (8.5 in): the section does not fit",
        ),
    ],
)
def test_what_tool_joints_cannot_be_is_named(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(CaseError) as caught:
        jointed(**changes)
    assert words in str(caught.value)


def test_sections_alike_are_the_uniform_rod() -> None:
    one = {"outer_diameter": "5 in", "inner_diameter": "4.276 in", "material": "steel"}
    whole = {"rod": {**one, "length": "30 m"}, "hole": DATA["hole"]}
    parts = {"string": [{**one, "length": "12 m"}, {**one, "joints": 2, "joint_length": "9 m"}], "hole": DATA["hole"]}
    uniform, string = (Case.from_dict(data) for data in (whole, parts))
    assert string.problem.sections == ()
    loads = [critical_loads(found.problem, 1)[0].force for found in (uniform, string)]
    assert loads[1] == pytest.approx(loads[0], rel=1e-12)


def test_weights_are_those_in_the_fluids() -> None:
    mud = case(mud={"density": "1200 kg/m^3"})
    for dry, wet in zip(case().string.members, mud.string.members, strict=True):  # type: ignore[union-attr]
        assert wet.weight == pytest.approx(dry.weight - 1200.0 * 9.80665 * dry.rod.area, rel=1e-9)


def test_real_forces_are_those_of_the_section_where_they_act() -> None:
    pressure = {"outside": "10 MPa"}
    forces = [
        case(pressure=pressure, load={"applied": "-100 kN", "kind": "real", "at": at}).applied[0].force
        for at in ("top", "bottom")
    ]
    found = case(pressure=pressure, load={"applied": "-100 kN", "kind": "effective"})
    inch, unit = 0.0254, found.scales.factor("force")  # type: ignore[union-attr]
    areas = [math.pi / 4.0 * (size * inch) ** 2 for size in (5.0, 6.0)]
    weight = found.problem.hung_weight
    assert forces[0] * unit == pytest.approx(-100e3 + 10e6 * areas[0], rel=1e-9)
    assert (forces[1] - weight) * unit == pytest.approx(-100e3 + 10e6 * areas[1], rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rod": {"outer_diameter": "5 in"}}, "rod.outer_diameter = '5 in': cannot stand beside [[string]]"),
        ({"rod": {"length": "31 m"}}, "rod.length = '31 m': is not that of the sections, 12 + 18 = 30 m"),
        ({"rod": {"endz": "x"}}, "rod.endz"),
        ({"string": []}, "string: has no section"),
        ({"string": {"length": "3 m"}}, "string: must be sections: write [[string]]"),
        ({"of_1": {"outer_diameter": ["6 in", "7 in"]}}, "string 1.outer_diameter"),
        ({"of_1": {"outer_diameter": ["6 in", "7 in"]}}, "write one [[string]] for each section"),
        ({"of_2": {"length": "18 m ± 1 m", "joints": None}}, "cannot have an uncertainty here"),
        ({"of_1": {"length": None}}, "string 1 (collar).length: is missing: give it, or joints and joint_length"),
        ({"of_2": {"joint_length": None}}, "string 2 (section 2).joint_length: is missing"),
        ({"of_2": {"length": "18 m"}}, "string 2 (section 2).joints = 2: contradicts length"),
        ({"of_2": {"joints": 0}}, "string 2.joints = 0"),
        ({"of_1": {"material": None}}, "string 1 (collar).youngs_modulus: is missing"),
        ({"of_1": {"material": "stele"}}, "string 1 (collar).material = 'stele': is not in the catalogue"),
        ({"of_2": {"pipe": "5 in 19.6 lb/ft drill pipe"}}, "string 2"),
        ({"of_2": {"bending_stiffness": "0 N m^2"}}, "string 2.bending_stiffness = '0 N m^2': must be above 0"),
        ({"of_2": {"outer_diam": "5 in"}}, "string 2.outer_diam = '5 in': is not known; did you mean 'outer"),
        ({"of_2": {"outer_diameter": "5 m"}}, "string 2.outer_diameter = '5 m': is not plausible"),
        ({"hole": {"diameter": "5.5 in", "angle_from_vertical": "50 deg"}},
         "string 1 (collar).outer_diameter = '6 in': must be below the hole's diameter of 0.1397 m"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_named(changes: dict[str, Any], words: str) -> None:
    assert words in refused(**changes)


def test_a_range_in_a_section_varies_nothing() -> None:
    data = copy.deepcopy(DATA)
    data["string"][0]["length"] = "10..20 m in 3"
    with pytest.raises(InputError, match=r"string 1\.length.*cannot vary"):
        varied_inputs(data)
    data["string"][0]["length"] = "12 m"
    data["hole"]["angle_from_vertical"] = "30..60 deg in 3"
    assert [varied.name for varied in varied_inputs(data)] == ["hole.angle_from_vertical"]


def test_an_audit_takes_the_sections_of_a_case_and_the_answer_leaves_formulas_out() -> None:
    assert {row.section for row in audit(case()).rows} <= {one.name for one in case().string.members}  # type: ignore[union-attr]
    assert answer(case()).assessment.formulas == ()


def test_each_section_is_set_against_its_own_strength() -> None:
    """Stress of the straight string under an axial force: N/A in each section; the least safety counts."""
    found = answer(Case.read(EXAMPLE)).assessment
    section = found.section
    assert isinstance(section, StringSections)
    state, inch = found.at_buckling, 0.0254
    top = -state.force * found.case.scales.factor("force")  # type: ignore[union-attr]
    heavy, drill = section.largest_each(state)
    area = math.pi / 4.0 * (5.0**2 - 4.276**2) * inch**2
    at_step = top - found.case.string.members[1].weight * 60.0 * 0.3048 * -math.cos(math.radians(40.0))  # type: ignore[union-attr]
    assert drill.value == pytest.approx(at_step / area, rel=2e-2)  # the mud's pressure is left out
    assert heavy.s < 0.5 <= drill.s
    assert drill.value > heavy.value
    largest = section.largest(state)
    assert largest.value == drill.value
    assert heavy.safety is not None
    assert drill.safety is not None
    assert largest.safety is not None
    assert heavy.safety.value == pytest.approx(55000 * PSI / heavy.value)
    assert drill.safety.value == pytest.approx(135000 * PSI / drill.value, rel=1e-3)
    assert largest.safety.value == min(heavy.safety.value, drill.safety.value)


def test_the_report_draws_and_lists_the_sections() -> None:
    found = answer(Case.read(EXAMPLE)).assessment
    (section,) = string_section(found)
    picture, grid, _ = section.blocks
    assert picture.name == "string"  # type: ignore[union-attr]
    assert [row[0] for row in grid.rows] == ["heavy-weight pipe", "drill pipe"]  # type: ignore[union-attr]
    assert [row[1:3] for row in grid.rows] == [("0", "60 ft"), ("60 ft", "120 ft")]  # type: ignore[union-attr]
    uniform = {key: DATA[key] for key in ("hole",)} | {"rod": {"length": "30 m", "outer_diameter": "5 in",
                                                               "material": "steel"}}  # fmt: skip
    assert string_section(answer(Case.from_dict(uniform)).assessment) == ()


def test_a_buckled_string_stays_on_the_wall_only_where_its_steps_are_held() -> None:
    """A wall cannot exert the couple at a step: no verdict and no number of the first page says so without it."""
    found = answer(Case.read(EXAMPLE))
    first_page = case_report(found, []).front.numbers
    assert any(number.label.startswith("Leaves the wall between steps at") for number in first_page)
    assert "its slope held at steps of its stiffness" in verdict(found.assessment)
    assert any("stays on the wall, if its slope is held" in sentence for sentence in sentences(found))
    one = {"outer_diameter": "5 in", "inner_diameter": "4.276 in", "material": "steel"}
    alike = {"string": [{**one, "length": "12 m"}, {**one, "length": "18 m"}], "hole": DATA["hole"]}
    uniform = answer(Case.from_dict(alike))
    assert not any("step" in number.label for number in case_report(uniform, []).front.numbers)
    assert "step" not in verdict(uniform.assessment)

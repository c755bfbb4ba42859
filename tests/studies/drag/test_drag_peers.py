"""Hook loads of the soft string beside two other programs, welleng 0.30.0 and torque-drag 0.1.1, with recorded numbers.

Their numbers are those that ``benchmarks/drag_peers.py`` printed, which also says how the programs are called and where
they differ: welleng has the sign of a build the other way, torque-drag shifts bends against weights by one course. Both
go course by course, so their errors fall with the spacing of stations; rodwell takes arcs and needs none.
"""

from __future__ import annotations

import numpy as np
import pytest
from drag_wells import cutter, operation, well_a_survey

from rodwell.studies.drag.laws import STRAIGHT_LAW
from rodwell.studies.drag.run import run
from rodwell.survey.survey import Survey

KINDS = ("pull-out", "run-in", "rotate-off-bottom")


def turn_survey() -> Survey:
    """At 60° all along; straight to 1000 m, turning by 90° to 1900 m, straight to 3400 m; stations 1 m apart."""
    md = np.arange(0.0, 3401.0)
    return Survey.of(md, np.full(len(md), 60.0), np.interp(md, [0.0, 1000.0, 1900.0, 3400.0], [0.0, 0.0, 90.0, 90.0]))


def computed(survey: Survey) -> list[float]:
    """Hook loads in kN and torque while rotating in kN m."""
    found = [run(cutter(survey), operation(kind, survey), STRAIGHT_LAW) for kind in KINDS]
    return [*(one.force / 1e3 for one in found), found[-1].torque / 1e3]


def without_courses(three: list[float], one: list[float]) -> list[float]:
    """What courses of 3 m and 1 m tend to, with an error of first order in their length."""
    return [b + 0.5 * (b - a) for a, b in zip(three, one, strict=True)]


@pytest.mark.parametrize(
    ("survey", "three", "one"),
    [
        # sign of the build turned
        (well_a_survey, [502.510, 222.638, 379.206, 7.8030], [502.566, 222.671, 379.206, 7.8030]),
        # as it is: nothing builds
        (turn_survey, [676.322, 215.739, 409.833, 14.1804], [676.422, 215.728, 409.833, 14.1826]),
    ],
)
def test_the_soft_string_is_what_welleng_tends_to(survey, three: list[float], one: list[float]) -> None:  # type: ignore[no-untyped-def]
    assert computed(survey()) == pytest.approx(without_courses(three, one), rel=1e-5)


def test_with_the_sign_of_the_build_as_it_is_welleng_is_far_off() -> None:
    """The reason for the difference: 579.464 kN pulling out by courses of 1 m, 15 % more than with tension inwards."""
    mine = computed(well_a_survey())[0]
    assert mine == pytest.approx(502.595, rel=1e-6)
    assert 1.15 < 579.464 / mine < 1.16


@pytest.mark.parametrize(
    ("survey", "one"),
    [
        (well_a_survey, [502.657, 222.811, 379.206, 7.8030]),
        (turn_survey, [676.250, 215.660, 409.713, 14.1793]),
    ],
)
def test_torque_drag_with_courses_of_a_metre_is_close(survey, one: list[float]) -> None:  # type: ignore[no-untyped-def]
    """As it is, but for a friction factor at each station; its shifted courses leave less than 0.06 %."""
    assert computed(survey()) == pytest.approx(one, rel=6e-4)

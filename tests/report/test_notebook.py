"""What notebooks show: results as tables and as pictures."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure
from pages import Page, number_of

import rodwell

TITLE = "A <b>bold</b> & \"quoted\" 'title'"


@pytest.fixture(scope="module")
def problem() -> rodwell.Problem:
    return rodwell.Problem(15.0)


@pytest.fixture(scope="module")
def branch(fig3c: dict[int, rodwell.Branch]) -> rodwell.Branch:
    return fig3c[1]


@pytest.fixture(scope="module")
def answer() -> rodwell.Answer:
    data = {"title": TITLE, "dimensionless": {"weight": 15}, "analysis": {"modes": 2, "rtol": 1e-6}}
    return rodwell.answer(rodwell.Case.from_dict(data))


@pytest.fixture
def pyplot() -> Iterator[Any]:
    from matplotlib import pyplot

    before = mpl.get_backend()
    pyplot.switch_backend("agg")
    yield pyplot
    pyplot.close("all")
    pyplot.switch_backend(before)


def shown(result: Any) -> Page:
    page = Page(result._repr_html_())
    assert page.faults == []
    assert page.open == []
    assert "nan" not in " ".join(page.words).lower().split()
    return page


def test_critical_loads_as_a_table(problem: rodwell.Problem) -> None:
    page = shown(rodwell.critical_loads(problem, 2))
    (rows,) = page.tables
    assert rows[0] == ["mode", "F in B/L²", "± error", "mode shape"]
    assert [number_of(row[1]) for row in rows[1:]] == pytest.approx([-111.2334402, -127.2577803], abs=5e-8)
    assert [row[3] for row in rows[1:]] == ["odd", "even"]
    assert all(0.0 < number_of(row[2]) < 1e-6 for row in rows[1:])
    assert "both ends clamped" in " ".join(page.words)
    assert "tension positive" in " ".join(page.words)


def test_branch_as_a_table(branch: rodwell.Branch) -> None:
    page = shown(branch)
    (rows,) = page.tables
    kinds = ["buckling of the straight rod", "lift-off", "secondary bifurcation", "end of the branch"]
    assert [row[0] for row in rows[1:]] == kinds
    assert number_of(rows[3][1]) == pytest.approx(-362.629366, abs=5e-7)  # AUTO-07p; theory, section 1
    assert rows[2][1] == "−123.1730744"  # theory, section 4
    assert rows[2][3:] == ["0 → 0", "0.5"]
    assert number_of(rows[2][2]) < 1e-6
    assert "converged: every number meets" in " ".join(page.words)


def test_what_has_not_converged_says_so(problem: rodwell.Problem) -> None:
    short = rodwell.follow(problem, until=-112.0, rtol=1e-5)
    short.__dict__["converged"] = False  # as if it had been found so
    assert "NOT CONVERGED" in " ".join(shown(short).words)


def test_state_as_a_table(branch: rodwell.Branch) -> None:
    state = branch.lift_off.solution
    page = shown(state)
    (rows,) = page.tables
    values = {row[1]: row for row in rows[1:]}
    assert abs(number_of(values["max p"][2])) < 1e-6  # lift-off is where it vanishes
    assert values["max p"][4] == "B/L³"
    # approach of the ends of a branch of equilibria: dE/dF = −(1 − z(1)), by differences of the energy
    before, after = branch.at(-120.01), branch.at(-119.99)
    slope = (after.number(rodwell.analysis.discrete.measures.Measured.ENERGY).value
             - before.number(rodwell.analysis.discrete.measures.Measured.ENERGY).value) / 0.02  # fmt: skip
    row = {row[1]: row for row in shown(branch.at(-120.0)).tables[0][1:]}["1 − z(1)"]
    assert number_of(row[2]) == pytest.approx(slope, rel=1e-5)
    assert "stable, under dead loads" in " ".join(page.words)


def test_titles_are_escaped(answer: rodwell.Answer) -> None:
    for result in (answer, answer.case):
        markup = result._repr_html_()
        assert "<b>" not in markup
        assert TITLE in " ".join(shown(result).words)
        assert len(markup) < 12_000
    assert "−111.2334402" in " ".join(shown(answer).words)


def test_plots_are_drawn_on_the_axes_given(
    answer: rodwell.Answer, branch: rodwell.Branch, problem: rodwell.Problem
) -> None:
    curve = rodwell.critical_curves(problem, "weight", (10.0, 14.0), modes=1)[0]
    diagram = rodwell.diagram(problem, modes=1, until=-113.0, rtol=1e-5)
    for result in (answer, branch, answer.critical, branch[-1], curve, diagram):
        ax = Figure().add_subplot()
        assert result.plot(ax) is ax
        assert result.plot(ax=ax) is ax
        assert ax.lines
        assert ax.get_xlabel()
        assert "[" in ax.get_xlabel() + ax.get_ylabel() or "scaled" in ax.get_ylabel() or "γ" in ax.get_xlabel()
    solid = Figure().add_subplot(projection="3d")
    assert branch[-1].plot_rod(solid) is solid


def test_field_is_drawn_in_the_units_asked_for(branch: rodwell.Branch) -> None:
    state = branch.at(-120.0)
    case = rodwell.Case.from_dict(
        {
            "rod": {"length": "30 m", "bending_stiffness": "981.7477 kN m^2", "outer_diameter": "10 cm",
                    "weight_per_length": "600 N/m"},
            "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
        }
    )  # fmt: skip
    ax = state.plot(Figure().add_subplot(), field="rod_M2", scales=case.scales)
    x, y = ax.lines[0].get_data()
    assert x[-1] == pytest.approx(30.0)
    unit = 981.7477e3 / 30.0  # B/L in N·m
    assert "[kN·m]" in ax.get_ylabel()
    assert y[-1] * 1e3 == pytest.approx(unit * state.fields(np.array([1.0]))["omega2"][0], rel=1e-9)  # M₂ = B ω₂


def test_new_axes_are_those_of_pyplot(branch: rodwell.Branch, pyplot: Any) -> None:
    ax = branch[-1].plot()
    assert ax.figure is pyplot.gcf()
    solid = branch[-1].plot_rod()
    assert solid.figure is pyplot.gcf()
    assert solid.name == "3d"


def test_bad_input(branch: rodwell.Branch, pyplot: Any) -> None:
    with pytest.raises(rodwell.InputError, match="did you mean 'contact_pressure'"):
        branch[-1].plot(field="contact_presure")
    with pytest.raises(rodwell.InputError, match="must be one of y, xi2"):
        branch[-1].plot(field="?")
    other = rodwell.follow(branch.problem, start=branch.at(-115.0), parameter="weight", until=15.2, rtol=1e-5)
    with pytest.raises(rodwell.InputError, match="did you mean 'energy'"):
        other.plot(ordinate="enery")
    assert pyplot.get_fignums() == []  # nothing half drawn is left behind


@pytest.mark.parametrize("first", ["rodwell", "rodwell.web.engine"])
def test_nothing_is_imported_before_it_is_used(first: str) -> None:
    """Nor by the explorer before its first diagram, which it draws itself."""
    code = (
        f"import sys, rodwell, {first}; rodwell.Branch; rodwell.Case; rodwell.Answer;"
        "print(sorted({'matplotlib', 'jinja2', 'IPython', 'typst'} & set(sys.modules)))"
    )
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert printed.strip() == "[]"

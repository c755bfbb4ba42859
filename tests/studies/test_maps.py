"""Maps: what comes of each cell, what cannot be asked, where the result jumps, and what is said and drawn of it."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from matplotlib.collections import QuadMesh

import rodwell
from rodwell.cli.mapping import QUANTITIES
from rodwell.errors import InputError
from rodwell.plots.style import new_axes
from rodwell.quantities.value import Value
from rodwell.studies.maps import cells, jumps
from rodwell.studies.maps.axes import Axis
from rodwell.studies.maps.computing import time_text
from rodwell.studies.maps.numbers import NUMBERS
from rodwell.studies.maps.running import HereExecutor, each
from rodwell.studies.maps.workers import Workers

FLAT = rodwell.Problem(15.0, 90.0)


def test_lift_off_loads_are_those_of_single_problems_and_the_mode_switch_is_located() -> None:
    """The horizontal clamped rod has a double critical load at γ = 62.34181826, from (77), (78)."""
    found = rodwell.map(FLAT, "lift-off", over={"weight": "15..75 in 5"}, halvings=10)
    alone = rodwell.follow(FLAT).lift_off
    assert alone is not None
    assert found.values[0] == alone.force
    assert found.values[0] == pytest.approx(-123.1730743, abs=1e-6)
    assert found.cells["place"][0] == pytest.approx(0.5, abs=1e-6)
    assert found.counts == {"converged": 5}
    modes = found.jumps["outcome"] == jumps.MODE
    (low,), (high,) = found.jumps["low"][modes], found.jumps["high"][modes]
    assert high - low == pytest.approx(15.0 / 2**10)
    assert low <= 62.34181826 <= high


def test_numbers_at_a_load() -> None:
    """Straight, buckled and off the wall; the straight rod presses with its weight, γ sin α, and less where it lies."""
    found = rodwell.map(FLAT, "contact", over={"load": [-20.0, -118.0, -130.0]}, halvings=0)
    assert [cells.OUTCOMES[k] for k in found.cells["outcome"]] == ["converged", "converged", "off_the_wall"]
    assert found.values[0] == pytest.approx(15.0)
    state = rodwell.follow(FLAT, until=-120.0).at(-118.0)
    assert found.values[1] == pytest.approx(state.wall.contact.value, rel=1e-6)
    assert math.isnan(found.values[2])
    assert found.cells["wavenumber"][0] == 0.0
    total = rodwell.map(FLAT, "contact-total", over={"load": [-20.0, -118.0]}, halvings=0)
    assert total.values[0] == pytest.approx(15.0)
    short = rodwell.map(FLAT, "shortening", over={"load": [-20.0, -118.0]}, halvings=0)
    assert short.values[0] == 0.0
    assert short.values[1] > 0.0


def test_a_string_of_sections_keeps_its_sections() -> None:
    """Every field of the problem goes into a map, and into the question that its store bears."""
    string = rodwell.Problem(15.0, 90.0, sections=((0.6, 1.0), (0.4, 0.5, 0.8)))
    found = rodwell.map(string, "critical", over={"weight": [10.0, 15.0]}, halvings=0)
    assert found.values[1] == rodwell.critical_loads(string, 1)[0].force
    assert found.values[1] != rodwell.critical_loads(FLAT, 1)[0].force
    assert found.question.identity["of"]["sections"][1][:3] == [0.4, 0.5, 0.8]


def test_secondary_load_is_that_of_the_paper_and_is_not_defined_where_nothing_is_symmetric() -> None:
    """−362.63, section 4.1.2 of the paper."""
    found = rodwell.map(FLAT, "secondary", over={"alpha": [90.0, 60.0]}, halvings=0)
    assert found.values[0] == pytest.approx(-362.629366, abs=1e-5)
    assert list(found.counts) == ["converged", "not_defined"]
    assert "no branch has a symmetry" in found.cells["reason"][1]


def test_a_number_that_a_problem_does_not_have_is_not_defined() -> None:
    """A rod that its weight lifts off has no lift-off load."""
    found = rodwell.map(rodwell.Problem(15.0, 90.0, on_top=True), "lift-off", over={"weight": [5.0, 15.0]}, halvings=0)
    assert found.counts == {"not_defined": 2}
    assert "there is no lift-off" in found.cells["reason"][0]


def test_vertical_rod_lifts_off_where_it_buckles() -> None:
    both = [rodwell.map(rodwell.Problem(15.0, 0.0), name, over={"weight": [5.0, 15.0]}, halvings=0) for name in
            ("critical", "lift-off")]  # fmt: skip
    assert np.array_equal(both[0].values, both[1].values)
    assert "coincides with buckling" in both[1].cells["reason"][0]


def test_cases_have_units_and_stress_is_that_of_the_answer() -> None:
    given = {
        "rod": {"length": "30 m", "outer_diameter": "10 cm", "inner_diameter": "0 m", "youngs_modulus": "200 GPa",
                "density": "7800 kg/m^3"},
        "hole": {"diameter": "70 cm", "angle_from_vertical": "60..90 deg in 2"},
        "load": {"applied": ["-20 kN"]},
    }  # fmt: skip
    found = rodwell.map(given, "stress", over={"rod.length": ["20 m", "30 m"]}, halvings=0)
    assert (found.question.dims, found.unit) == (("hole.angle_from_vertical", "rod.length"), "Pa")
    single = {**given, "hole": {**given["hole"], "angle_from_vertical": "90 deg"}}
    answer = rodwell.answer(rodwell.Case.from_dict(single))
    (state,) = (at.state for at in answer.assessment.applied)
    assert state is not None
    stress = answer.assessment.stress(state)
    assert stress is not None
    assert found.values[1, 1] == pytest.approx(stress.value, rel=1e-6)
    force = rodwell.map(given, "critical", over={"rod.length": ["20 m", "30 m"]}, halvings=0)
    assert force.unit == "N"
    scales = answer.case.scales
    assert scales is not None
    assert force.values[1, 1] == pytest.approx(answer.critical[0].force * scales.factor("force"), rel=1e-9)


def test_a_bad_cell_is_recorded_and_the_others_are_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    found = rodwell.map(FLAT, "critical", over={"weight": [15.0, 5e9]}, halvings=0)
    assert list(found.counts) == ["converged", "impossible"]
    assert "must be from 0 to 1e+09" in found.cells["reason"][1]

    tried = []

    def breaks(rod: cells.MappedRod) -> cells.Found:
        tried.append(rod.largest_step)
        raise ZeroDivisionError("nobody foresaw this")

    monkeypatch.setitem(NUMBERS, "critical", dataclasses.replace(NUMBERS["critical"], of=breaks))
    lost = rodwell.map(FLAT, "critical", over={"weight": [15.0, 20.0]}, halvings=0)
    assert lost.counts == {"failed": 2}
    assert lost.cells["reason"][0] == "ZeroDivisionError: nobody foresaw this"
    assert tried[1] == pytest.approx(tried[0] / cells.FINER), "not tried again with shorter steps"
    assert "failed" in str(lost.as_dict()["outcomes"])


class Dying(HereExecutor):
    """An executor that loses the piece with a certain cell, whenever it is given out."""

    def submit(self, fn: Any, /, *arguments: Any, **options: Any) -> Any:
        if len(arguments) == 2 and any(cell == (20.0,) for cell in arguments[1]):
            return super().submit(_dies)
        return super().submit(fn, *arguments, **options)


def _dies() -> None:
    raise RuntimeError("killed")


def test_what_a_dead_worker_lost_is_tried_cell_by_cell() -> None:
    found = rodwell.map(FLAT, "critical", over={"weight": [15.0, 20.0, 25.0]}, workers=Workers(Dying(), 2), halvings=0)
    assert list(found.counts) == ["converged", "failed"]
    assert found.cells["reason"][1] == "the process that computed it died: killed"
    assert math.isfinite(found.values[2])


def test_no_more_pieces_are_out_than_a_few_for_each_worker() -> None:
    out = []

    def pieces() -> Any:
        for i in range(50):
            out.append(i)
            yield i, (i,)

    for k, (key, result) in enumerate(each(abs, pieces(), HereExecutor(), 2)):
        assert key == result
        assert len(out) <= k + 1 + 6


@pytest.mark.parametrize(
    ("quantity", "over", "more", "what"),
    [
        ("lift", {"weight": [1.0, 2.0]}, {}, "quantity = 'lift': must be one of critical, lift-off"),
        ("critical", {"weight": 3.0}, {}, "over: nothing varies"),
        ("critical", {"wait": [1.0, 2.0]}, {}, "wait: is no parameter"),
        ("contact", {"weight": [1.0, 2.0]}, {}, "load: contact belongs to a load"),
        ("critical", {"weight": [1.0, 2.0]}, {"load": -5.0}, "load = -5.0: goes with contact, contact-total"),
        ("critical", {"weight": "normal(10, 1)"}, {}, "samples = 0: must be given"),
        ("critical", {"weight": [1.0, 2.0]}, {"samples": 5}, "samples = 5: draws nothing"),
        ("critical", {"weight": [-1.0, -2.0]}, {}, "weight = -1.0: must be from 0"),
        ("critical", {"weight": [1.0, 2.0]}, {"workers": 0}, "workers = 0: must be a whole number"),
        ("critical", {"weight": [1.0, 2.0]}, {"halvings": -1}, "halvings = -1"),
        ("critical", {"weight": [1, 2], "alpha": [1, 2], "clearance": [0.1, 0.2], "twist": [1, 2], "poisson": [0, 0.1]},
         {}, "poisson: is one too many"),
        ("critical", {n: np.linspace(0.1, 0.2, 9999) for n in ("weight", "clearance", "poisson")}, {}, "at most 1e+09"),
    ],
)  # fmt: skip
def test_questions_that_cannot_be_asked(quantity: str, over: Any, more: Any, what: str) -> None:
    with pytest.raises(InputError) as error:
        rodwell.map(FLAT, quantity, over=over, **more)
    assert what in str(error.value)


def test_jumps_are_told_from_steep_slopes() -> None:
    """A place that runs from one end to the other within a cell is smooth when looked at closely; a step is not."""
    axis = Axis("weight", (0.0, 1.0), (0.0, 1.0))

    def outcome(place: Any) -> int:
        rods: Any = None
        sides = tuple(jumps.Side(1, 0.0, place(x), 1.0) for x in (0.0, 1.0))
        edge = jumps.Edge(0, (0.0,), (0.0, 1.0), sides)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(jumps, "computed_cell", lambda _, v: cells.Found(1, Value(0.0), place(v[0]), 1.0))
            block = jumps.located_block(rods, [axis], [edge], 6)
        if block["outcome"][0] == jumps.PLACE:
            assert block["high"][0] - block["low"][0] == 1.0 / 64
            assert block["low"][0] <= 0.3 <= block["high"][0]
        return int(block["outcome"][0])

    assert outcome(lambda x: 0.2 if x < 0.3 else 0.7) == jumps.PLACE
    assert outcome(lambda x: 0.2 + 0.5 * x) == jumps.SMOOTH


def test_words_and_registry() -> None:
    assert tuple(NUMBERS) == QUANTITIES
    assert set(cells.IN_WORDS) == set(range(len(cells.OUTCOMES)))
    assert [time_text(s) for s in (3.0, 150.0, 9000.0, 3e5)] == ["3 s", "2 min", "2 h", "3 d"]
    found = rodwell.map(FLAT, "critical", over={"weight": [15.0, 20.0]})
    html = found._repr_html_()
    assert "first critical load" in html
    assert "known to the tolerance" in html
    assert found.complete
    assert found.as_dict()["largest"]["at"] == {"weight": 15.0}


def test_figures_show_what_the_map_holds() -> None:
    plane = rodwell.map(FLAT, "lift-off", over={"weight": "50..75 in 4", "alpha": [60.0, 90.0]})
    ax = plane.plot(new_axes(), load=-200.0)
    mesh = next(one for one in ax.collections if isinstance(one, QuadMesh) and one.get_array().size == 8)
    assert np.allclose(mesh.get_array().reshape(2, 4), -plane.values.T), "compression, positive"
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert any("unsafe under −F = 200" in label for label in labels)
    assert "the mode changes" in labels
    assert "α from the vertical" in ax.get_ylabel()
    line = plane.plot(new_axes(), at={"alpha": 1}, load=-200.0)
    assert np.allclose(line.lines[0].get_ydata(), -plane.values[:, 1])
    for show in ("place", "half-waves", "error"):
        assert plane.plot(new_axes(), show=show)
    load = rodwell.map(FLAT, "contact", over={"load": [-20.0, -118.0, -130.0], "weight": [14.0, 15.0]}, halvings=2)
    shown = load.plot(new_axes())
    assert "has left the wall" in [text.get_text() for text in shown.get_legend().get_texts()]
    drawn_ones = rodwell.map(FLAT, "critical", over={"weight": "normal(15, 1)"}, samples=8)
    steps = drawn_ones.plot(new_axes()).lines[0].get_xydata()
    assert steps[-1] == pytest.approx([-drawn_ones.values.min(), 1.0])
    for wrong, options in (("show", {"show": "colour"}), ("at", {"at": {"weight": 9}}), ("load", {"load": math.nan})):
        with pytest.raises(InputError, match=wrong):
            plane.plot(new_axes(), **options)
    with pytest.raises(InputError, match="goes with maps of loads"):
        load.plot(new_axes(), load=-100.0)

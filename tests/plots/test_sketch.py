"""The sketch of a case shows what was given: inclination, ends, loads where they act, the section to scale."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.patches import Circle, Polygon
from matplotlib.text import Annotation

import rodwell
from rodwell.plots.sketch import plot_sketch

PIPE = {
    "units": "field",
    "rod": {"pipe": "5 in 19.5 lb/ft drill pipe", "length": "300 ft", "ends": "clamped-pinned"},
    "hole": {"diameter": "8.5 in", "angle_from_vertical": "30 deg"},
    "load": {"applied": "-35000 lbf", "at": "bottom"},
}


def texts(case: rodwell.Case) -> str:
    return " | ".join(t.get_text() for ax in plot_sketch(case).axes for t in (*ax.texts, ax.title))


def test_words_and_numbers_of_the_case() -> None:
    said = texts(rodwell.Case.from_dict(PIPE))
    for what in ("bottom, s = 0\nclamped", "top, s = 1\npinned", "α = 30°", "L = 300 ft",
                 "35\u202f000 lbf\ncompression", "Δ = 1.75 in", "hole 8.5 in, rod 5 in", "to scale"):  # fmt: skip
        assert what in said


@pytest.mark.parametrize(("angle", "at"), [("30 deg", "bottom"), ("75 deg", "top"), ("0 deg", "top")])
def test_the_hole_is_inclined_and_the_load_acts_at_its_end(angle: str, at: str) -> None:
    case = rodwell.Case.from_dict(
        {
            **PIPE,
            "hole": {"diameter": "8.5 in", "angle_from_vertical": angle},
            "load": {"applied": "-35000 lbf", "at": at},
        }
    )
    side, across = plot_sketch(case).axes
    wall_of_hole = next(p for p in side.patches if isinstance(p, Polygon)).get_xy()
    along = wall_of_hole[1] - wall_of_hole[0]
    assert np.degrees(np.arctan2(-along[0], along[1])) == pytest.approx(case.problem.alpha, abs=1e-9)
    rod, wall = (side.patches[i].get_xy()[:4].mean(axis=0) for i in (1, 0))
    assert (rod - wall) @ np.array(
        [np.cos(np.radians(case.problem.alpha)), np.sin(np.radians(case.problem.alpha))]
    ) < 0.0
    arrow = next(a for a in side.texts if isinstance(a, Annotation) and a.arrowprops and a.arrowprops.get("lw") == 2.6)
    middle = 0.5 * (wall_of_hole[0] + wall_of_hole[2])
    assert ((np.array(arrow.xy) - middle) @ along > 0.0) == (at == "top")
    radii = sorted(p.radius for p in across.patches if isinstance(p, Circle))
    assert radii[-1] / radii[-3] == pytest.approx(8.5 / 5.0, rel=1e-9)  # hole, drawn twice, against rod


def test_without_dimensions() -> None:
    said = texts(rodwell.Case.from_dict({"dimensionless": {"weight": 15, "alpha": 60}, "load": {"applied": -115}}))
    assert "115 B/L²\ncompression" in said
    assert "radii not given" in said


@pytest.mark.parametrize("angle", ["30 deg", "90 deg"])
def test_a_string_is_drawn_with_its_sections(angle: str) -> None:
    """Lengths to scale along the hole, bores against the outer diameter; each section has its name."""
    pipes = (("collar", "80 ft", "2 in"), ("pipe", "160 ft", "4 in"))
    members = [
        {"name": name, "length": length, "outer_diameter": "5 in", "inner_diameter": bore, "material": "steel"}
        for name, length, bore in pipes
    ]
    hole = {"diameter": "8.5 in", "angle_from_vertical": angle}
    case = rodwell.Case.from_dict({"string": members, "hole": hole, "units": "field"})
    side, _ = plot_sketch(case).axes
    dashed = [
        np.array(line.get_data()).T for line in side.lines if line.get_linestyle() == "--" and line.get_lw() == 0.7
    ]
    lengths = [np.linalg.norm(edge[-1] - edge[0]) for edge in dashed]
    assert lengths[2] / lengths[0] == pytest.approx(2.0)
    bores = [np.linalg.norm(dashed[i + 1][0] - dashed[i][0]) for i in (0, 2)]
    assert bores[1] / bores[0] == pytest.approx(2.0)
    said = texts(case)
    assert all(what in said for what in ("collar", "pipe", "mean weight\n", "hole 8.5 in, pipe 5 in"))
    (weight,) = (a for a in side.texts if isinstance(a, Annotation) and a.arrowprops and a.arrowprops.get("lw") == 1.4)
    (left, right), (low, high) = side.get_xlim(), side.get_ylim()
    assert all(left < x < right and low < y < high for x, y in (weight.xy, weight.xyann))  # or it would not be drawn

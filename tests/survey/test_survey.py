"""Surveys: reading them, and the path that follows, against closed forms."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from rodwell import InputError, Survey

TWO = [0.0, 100.0]


def read(tmp_path: Path, text: str, **units: str) -> Survey:
    file = tmp_path / "well.csv"
    file.write_text(text, encoding="utf-8")
    return Survey.read(file, **units)


@pytest.mark.parametrize(
    "text",
    [
        "MD [m],Inc [deg],Azi [deg]\n0,0,30\n100,10,40\n",
        "Measured Depth (m);Inclination (°);Azimuth\n0;0;30\n100;10;40\n",
        "md_m\tincl_deg\tazim_deg\tNorthing\n0\t0\t30\t1\n100\t10\t40\t2\n",
        "# a comment\n\nMD,INC,AZI\n(m),(deg),(deg)\n0,0,30\n\n100,10,40\n",
        "\ufeffAZI,MD m,Hole Angle\n30,0,0\n40,100,10\n",
    ],
)
def test_spellings_of_headers_are_the_same_well(tmp_path: Path, text: str) -> None:
    survey = read(tmp_path, text)
    assert survey.md.tolist() == TWO
    assert survey.inclination.tolist() == [0.0, 10.0]
    assert survey.azimuth is not None
    assert survey.azimuth.tolist() == [30.0, 40.0]
    assert survey.depth_unit == "m"


def test_units_are_converted(tmp_path: Path) -> None:
    survey = read(tmp_path, "MD [ft],Inc [rad],Force [klbf]\n0,0,-1\n1000,1.5,2\n")
    assert survey.md[1] == pytest.approx(304.8, rel=1e-14)  # the foot is 0.3048 m by definition
    assert survey.inclination[1] == pytest.approx(math.degrees(1.5), rel=1e-14)
    assert survey.force is not None
    assert survey.force[0] == pytest.approx(-4448.2216152605, rel=1e-13)  # 1 lbf = 4.4482216152605 N by definition
    assert survey.depth_unit == "ft"
    assert survey.azimuth is None


def test_a_unit_given_beside_the_file_counts_more(tmp_path: Path) -> None:
    assert read(tmp_path, "MD [m],Inc\n0,0\n100,1\n", depth_unit="ft").md[1] == pytest.approx(30.48)
    assert read(tmp_path, "MD,Inc\n0,0\n100,1\n", depth_unit="m").md[1] == 100.0


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("", "is empty"),
        ("MD,Inc\n0,0\n1,1\n", "--depth-unit"),
        ("MD [m],Inc,Force\n0,0,1\n1,1,1\n", "--force-unit"),
        ("MD [fathom],Inc\n0,0\n1,1\n", "fathom"),
        ("MD [m],Azi\n0,0\n1,1\n", "no column of inclination"),
        ("Inc,Azi\n0,0\n1,1\n", "no column of measured depth"),
        ("MD [m],Inc,Inc\n0,0,0\n1,1,1\n", "second column"),
        ("MD [m],Inc\n0,0\n", "fewer than two"),
        ("MD [m],Inc\n0,0\n50,1\n20,2\n", "line 4"),
        ("MD [m],Inc\n0,0\n50,1\n50,2\n", "line 4"),
        ("MD [m],Inc\n-5,0\n50,1\n", "line 2"),
        ("MD [m],Inc\n0,0\n50,121\n", "line 3"),
        ("MD [m],Inc\n0,0\n50,-30\n", "from the horizontal"),
        ("MD [m],Inc\n0,0\n# remark\n50,x\n", "line 4, Inc"),
        ("MD [m],Inc\n0,0\n50,\n", "is missing"),
        ("MD [m],Inc\n0,0\n50\n", "line 3"),
        ("MD [m];Inc\n0.5;0\n50;1,5\n", "decimal point"),
        ("MD [m],Inc\n0,0\n50,nan\n", "is missing"),
        ("MD [m],Inc\n0,0\ninf,2\n", "finite"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path: Path, text: str, names: str) -> None:
    with pytest.raises(InputError, match=names):
        read(tmp_path, text)


def test_files_that_are_no_survey(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        Survey.read(tmp_path / "none.csv")
    with pytest.raises(InputError, match="folder"):
        Survey.read(tmp_path)
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="UTF-8"):
        Survey.read(tmp_path / "binary.csv")


@pytest.mark.parametrize(
    ("md", "inclination"),
    [([0.0, 1.0], [0.0]), ([[0.0, 1.0]], [0.0, 1.0]), ([0.0, math.nan], [0.0, 1.0]), (["a", "b"], [0.0, 1.0]),
     ([1.0], [0.0]), ([1.0, 0.0], [0.0, 1.0])],
)  # fmt: skip
def test_arrays_are_checked(md: list[float], inclination: list[float]) -> None:
    with pytest.raises(InputError):
        Survey.of(md, inclination)


def test_path_of_a_circular_arc() -> None:
    """A build of constant rate is a circle: depth R sin α, rate 1/R, whatever the stations."""
    radius = 400.0
    alpha = np.array([0.0, 3.0, 20.0, 21.0, 77.0, 90.0])
    survey = Survey.of(np.radians(alpha) * radius, alpha)
    assert survey.tvd == pytest.approx(radius * np.sin(np.radians(alpha)), rel=1e-12)
    assert survey.build == pytest.approx(np.full(6, 1.0 / radius), rel=1e-12)
    assert np.all(survey.turn == 0.0)


def test_path_of_a_tilted_circle() -> None:
    """A great circle through a tilted plane: from 60°, azimuth 0, it goes on to the horizontal at azimuth 90."""
    radius, tilt = 300.0, math.radians(60.0)
    t = np.radians(np.linspace(0.0, 90.0, 13))
    down = math.cos(tilt) * np.cos(t)  # tangent = cos t (sin 60° north + cos 60° down) + sin t east
    north, east = math.sin(tilt) * np.cos(t), np.sin(t)
    survey = Survey.of(radius * t, np.degrees(np.arccos(down)), np.degrees(np.arctan2(east, north)))
    assert survey.tvd == pytest.approx(radius * math.cos(tilt) * np.sin(t), rel=1e-10)
    curvature = np.hypot(survey.build, survey.turn)[2:-2]
    assert curvature == pytest.approx(np.full_like(curvature, 1.0 / radius), rel=2e-2)  # differences over 15°


def test_azimuth_passes_north() -> None:
    survey = Survey.of([0.0, 100.0, 200.0], [90.0] * 3, [350.0, 0.0, 10.0])
    assert survey.turn == pytest.approx(np.full(3, math.radians(0.1)), rel=1e-12)
    assert survey.tvd == pytest.approx(np.zeros(3), abs=1e-9)


def test_minimum_curvature_against_a_second_code() -> None:
    """Positions and doglegs by welleng 0.30.0 (minimum curvature, azimuths from grid north), all digits."""
    md = [0.0, 300.0, 600.0, 900.0, 1200.0, 1500.0, 1800.0, 2100.0, 2130.0, 2500.0]
    inclination = [0.0, 0.0, 12.0, 30.0, 45.0, 62.0, 88.0, 93.0, 91.0, 70.0]
    survey = Survey.of(md, inclination, [0.0, 0.0, 350.0, 355.0, 10.0, 25.0, 40.0, 80.0, 81.0, 185.0])
    north = [0.0, 0.0, 30.825719838643387, 137.13623945231657, 317.70647234923655, 544.6847525408477, 784.955041088886,
             931.9114752453693, 936.8594156803742, 734.2939132697777]  # fmt: skip
    east = [0.0, 0.0, -5.435406107313019, -17.48770998453143, -5.5133140694250375, 69.70255734118894, 225.5369397586591,
            479.99144945546294, 509.5601418208953, 744.8424641135985]  # fmt: skip
    tvd = [0.0, 300.0, 597.811559882162, 876.7542652035058, 1114.5692335095625, 1293.0137975800906, 1370.408978763731,
           1367.6800834530484, 1366.6331251604936, 1450.9549241178788]  # fmt: skip
    dogleg = [0.0, 12.0, 18.07320241503186, 17.46913780393236, 20.766854826066048, 29.68899486622309,
              40.29700896776645, 2.2357728429218136, 103.48947095255218]  # fmt: skip
    assert survey.north == pytest.approx(north, abs=1e-8)
    assert survey.east == pytest.approx(east, abs=1e-8)
    assert survey.tvd == pytest.approx(tvd, abs=1e-8)
    assert np.degrees(survey.dogleg) == pytest.approx(dogleg, abs=1e-9)

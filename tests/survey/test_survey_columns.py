"""Which column is which, what stands for a missing value, what numbers mean: no silent loss, no wrong angle."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rodwell import InputError, Survey
from rodwell.survey.reading.names import CERTAIN, LOOKALIKE, UNDERSTOOD, meaning


def read(tmp_path: Path, text: str, **options: Any) -> Survey:
    file = tmp_path / "well.csv"
    file.write_text(text, encoding="utf-8")
    return Survey.read(file, **options)


@pytest.mark.parametrize(
    ("name", "kind", "sure", "unit"),
    [
        ("MD", "md", CERTAIN, ""),
        ("Inc", "inclination", CERTAIN, ""),
        ("Azi", "azimuth", CERTAIN, ""),
        ("Azi (azimuth)(°)", "azimuth", CERTAIN, "°"),
        ("Azim Grid (deg)", "azimuth", UNDERSTOOD, "deg"),
        ("Grid Az", "azimuth", UNDERSTOOD, ""),
        ("Azimut", "azimuth", UNDERSTOOD, ""),
        ("Dir", "azimuth", UNDERSTOOD, ""),
        ("Hole Direction", "azimuth", UNDERSTOOD, ""),
        ("azi [Grid] °", "azimuth", CERTAIN, "°"),
        ("Force [kN]", "force", CERTAIN, "kn"),
        ("Incl.", "inclination", CERTAIN, ""),
        ("Drift", "inclination", UNDERSTOOD, ""),
        ("Inclinación (°)", "inclination", UNDERSTOOD, "°"),
        ("HoleAngle", "inclination", CERTAIN, ""),
        ("Measured Depth ft", "md", CERTAIN, "ft"),
        ("MD (ft RKB)", "md", CERTAIN, "ft"),
        ("Prof. medida", "md", UNDERSTOOD, ""),
        ("Depth", "md", UNDERSTOOD, ""),
        ("Inc, deg", "inclination", CERTAIN, "deg"),
        ("Dip (deg)", "inclination", LOOKALIKE, "deg"),
        ("theta [deg]", "azimuth", LOOKALIKE, ""),
        ("Azmx", "azimuth", LOOKALIKE, ""),
        ("Depth SS", "md", LOOKALIKE, ""),
        *((name, "", 0, "") for name in ("TVD [m]", "True Vertical Depth", "DLS (deg/30m)", "Build rate", "Closure Azi",
                                         "Toolface [deg]", "Azimuth error", "Northing", "Water depth", "Lat [deg]")),
    ],
)  # fmt: skip
def test_names_of_columns(name: str, kind: str, sure: int, unit: str) -> None:
    found = meaning(name)
    assert (found.kind, found.sure, found.unit) == (kind, sure, unit)


@pytest.mark.parametrize("name", ["Azim Grid (deg)", "Grid Az", "Azimut", "Dir", "Hole Direction"])
def test_an_unusual_azimuth_is_taken_and_said(tmp_path: Path, name: str) -> None:
    survey = read(tmp_path, f"MD [m],Inc,{name}\n0,10,30\n100,10,40\n")
    assert survey.azimuth is not None
    assert survey.azimuth.tolist() == [30.0, 40.0]
    assert survey.notes == (f'Column "{name}" is taken as the azimuth.',)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("MD [m],Inc,Azmx\n0,0,1\n9,1,1\n", r'"Azmx" looks like one .* columns found: "MD \[m\]", "Inc", "Azmx"; name '
         r'it: --column azimuth="Azmx" \(Python: columns={"azimuth": "Azmx"}\), or leave it aside with .*azimuth=none'),
        ("MD [m],Inc,theta [deg]\n0,0,1\n9,1,1\n", "no column of azimuth"),
        ("MD [m],Dip (deg)\n0,0\n9,1\n", r'no column of inclination; "Dip \(deg\)" looks like one.*--column inclin'),
        ("Depth SS [m],Inc\n0,0\n9,1\n", r'no column of measured depth; "Depth SS \[m\]" looks like one'),
        ('""\n', "is empty"),
        (";;;\n,\n", "is empty|no column"),
        ("0 0 30\n9 1 30\n", "--column md=1 --column inclination=2"),
        ("MD [m],Inc,Azi,Azimuth\n0,0,1,1\n9,1,1,1\n", "second column for azimuth"),
        ("MD [m],Inc,Incl\n0,0,1\n9,1,1\n", "second column for inclination"),
        ("Measured Depth Inc\n0 0\n9 1\n", "header 3 names"),
    ],
)  # fmt: skip
def test_what_is_not_understood_stops_with_what_was_found(tmp_path: Path, text: str, names: str) -> None:
    with pytest.raises(InputError, match=names):
        read(tmp_path, text)


def test_columns_are_named_by_header_or_number(tmp_path: Path) -> None:
    text = "MD [m],Dip (deg),Azmx\n0,0,30\n100,10,40\n"
    columns = {"inclination": " dip  (DEG) ", "azimuth": "none"}
    survey = read(tmp_path, text, columns=columns)
    assert survey.inclination.tolist() == [0.0, 10.0]
    assert survey.azimuth is None
    assert "one vertical plane" in " ".join(survey.notes)
    assert survey.ignored == ("Azmx",)
    bare = read(tmp_path, "0 0 30\n100 10 40\n", columns={"md": 1, "inclination": 2, "azimuth": 3}, depth_unit="ft")
    assert bare.md[1] == pytest.approx(30.48)
    assert bare.azimuth is not None
    for wrong, names in (({"azimuth": "Az"}, "no column; columns found"), ({"depth": "MD"}, "the column of one of"),
                         ({"md": "none"}, "must name a column"), ({"azimuth": 9}, "no column")):  # fmt: skip
        with pytest.raises(InputError, match=names):
            read(tmp_path, text, columns=columns | wrong)


def test_of_several_azimuths_that_from_grid_north_is_taken(tmp_path: Path) -> None:
    survey = read(tmp_path, "MD [m],Inc,Azi Mag,Azi True,Azi Grid\n0,9,1,2,3\n9,9,1,2,3\n", columns={})
    assert survey.azimuth is not None
    assert survey.azimuth.tolist() == [3.0, 3.0]
    assert '"Azi Mag", "Azi True" are left aside' in survey.notes[0]


def test_the_same_depth_in_two_units_is_one(tmp_path: Path) -> None:
    assert read(tmp_path, "MD (ft),MD (m),Inc\n0,0,0\n100,30.48,1\n").depth_unit == "ft"


def test_a_force_that_is_not_understood_is_told(tmp_path: Path) -> None:
    survey = read(tmp_path, "MD [m],Inc,Compression [kN]\n0,0,1\n9,1,1\n")
    assert survey.force is None
    assert '"Compression [kN]" is left aside' in survey.notes[0]


NULLS = [
    "-999.25",
    "-999",
    "-9999",
    "-9999.25",
    "9999.25",
    "999.25",
    "-99999",
    "",
    "NaN",
    "NULL",
    "-",
    "n/a",
    "−999.25",
]


@pytest.mark.parametrize("null", NULLS)
def test_nulls_are_missing_values_never_angles(tmp_path: Path, null: str) -> None:
    text = f"MD [m],Inc,Azi\n0,0,{null}\n100,10,40\n200,{null},50\n300,20,{null}\n400,30,60\n"
    survey = read(tmp_path, text)
    assert survey.md.tolist() == [0.0, 100.0, 300.0, 400.0]
    assert survey.azimuth is not None
    assert survey.azimuth == pytest.approx([40.0, 40.0, 40.0 + 20.0 * 200.0 / 300.0, 60.0])
    assert survey.notes == (
        "1 of 5 stations are left out, Inc is missing: line 4.",
        "Azimuth is missing at 1 of 3 inclined stations and interpolated there, the shorter way round: line 5.",
    )


def test_depths_may_be_large_but_not_null(tmp_path: Path) -> None:
    survey = read(tmp_path, "MD [ft],Inc\n-999.25,3\n9998,0\n9999,1\n99999,2\n")
    assert survey.md / 0.3048 == pytest.approx([9998.0, 9999.0, 99999.0])
    assert "MD [ft] is missing: line 2" in survey.notes[0]


def test_missing_azimuths_go_the_shorter_way_round(tmp_path: Path) -> None:
    survey = read(tmp_path, "MD [m],Inc,Azi\n0,0.2,\n10,5,350\n20,5,\n30,5,10\n40,5,12\n50,0.1,\n")
    assert survey.azimuth is not None
    assert survey.azimuth % 360.0 == pytest.approx([350.0, 350.0, 0.0, 10.0, 12.0, 12.0], abs=1e-9)
    assert np.max(np.abs(survey.turn)) < 0.01
    with pytest.raises(InputError, match="is missing at 2 of 3 inclined stations"):
        read(tmp_path, "MD [m],Inc,Azi\n0,5,\n10,5,350\n20,5,\n")
    none = read(tmp_path, "MD [m],Inc,Azi\n0,5,\n10,5,\n")
    assert none.azimuth is None
    assert "No station has an azimuth" in none.notes[0]


def test_missing_forces_stop(tmp_path: Path) -> None:
    text = "MD [m],Inc,Force [kN]\n0,5,1\n10,5,-999.25\n20,5,3\n"
    with pytest.raises(InputError, match=r"force: is missing at line 3.*force=none"):
        read(tmp_path, text)
    assert read(tmp_path, text, columns={"force": "none"}).force is None


def test_arrays_hold_no_nulls() -> None:
    with pytest.raises(InputError, match=r"station 2, azimuth.*-999.25 deg"):
        Survey.of([0.0, 1.0], [5.0, 5.0], [3.0, -999.25])


@pytest.mark.parametrize(
    ("cells", "depth"),
    [
        (["0,5", "1,5"], 1.5),
        (["0,5", "1.234,5"], 1234.5),
        (["0.5", "1,234.5"], 1234.5),
        (["0.5", "1,234"], 1234.0),
        (["0", "1,234,567.5"], 1234567.5),
        (["0", "1.234.567"], 1234567.0),
        (["0", "0,123"], 0.123),
        (["0", "12345,678"], 12345.678),
        (["0", "1 234,5"], 1234.5),
        (["0", "1'234.5"], 1234.5),
        (["0", "1e3"], 1000.0),
        (["0", "1.234"], 1.234),
    ],
)
def test_decimal_marks_and_thousands(tmp_path: Path, cells: list[str], depth: float) -> None:
    survey = read(tmp_path, "MD [m];Inc\n" + "".join(f"{cell};3\n" for cell in cells))
    assert survey.md[-1] == pytest.approx(depth, rel=1e-15)


@pytest.mark.parametrize(
    ("cells", "names"),
    [
        (["0", "1,234"], "line 3, MD .*'1,234': may have a decimal comma.*--decimal point or --decimal comma"),
        (["0,5", "1.5"], "has a decimal comma, but 1.5 .* has a decimal point"),
        (["0,5", "1.234"], "point between thousands.*--decimal"),
        (["0", "1,2345.5"], "is not a number"),
        (["0", "1_000"], "is not a number"),
        (["0", "0x10"], "is not a number"),
        (["0", "1e999"], "must be finite"),
    ],
)
def test_numbers_that_could_be_two_are_refused(tmp_path: Path, cells: list[str], names: str) -> None:
    text = "MD [m];Inc\n" + "".join(f"{cell};3\n" for cell in cells)
    with pytest.raises(InputError, match=names):
        read(tmp_path, text)


def test_the_decimal_mark_can_be_given(tmp_path: Path) -> None:
    text = "MD [m];Inc\n0;3\n1,234;3\n"
    assert read(tmp_path, text, decimal="comma").md[1] == 1.234
    assert read(tmp_path, text, decimal="point").md[1] == 1234.0
    with pytest.raises(InputError, match="point or comma"):
        read(tmp_path, text, decimal="dot")


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("MD [ft],Inc\n0,0\n1200,1\n1100,2\n", "line 4, measured depth = '1100 ft': .* station before, 1200 ft"),
        ("MD [m],Inc [rad]\n0,0\n9,2.5\n", "line 3, inclination = '2.5 rad': must be from 0 to 120 degrees"),
        ("MD [m],Inc [deg]\n0,1e308\n10,1\n", r"line 2, inclination = '1e\+308 deg'"),
        ("MD [m],Inc [deg]\n0,0,1,5\n10,1,2,5\n", "line 2: has 4 cells, and the header names 2: .*decimal commas"),
        ("MD [m],Inc,Azi\n0,0,3289\n10,1,3\n", "line 2, azimuth = '3289 deg'"),
        ("MD [m],Inc\n0,0\n10,1\nTotal depth: 10\n", "line 4: has 1 cells.*begin a remark with #"),
        ("MD [m],Inc\n0,0\n10,\x1b[31m\n", "line 3, Inc = '�"),
    ],
)
def test_messages_speak_of_the_file(tmp_path: Path, text: str, names: str) -> None:
    with pytest.raises(InputError, match=names):
        read(tmp_path, text)


def test_angles_that_may_be_radians_are_told(tmp_path: Path) -> None:
    text = "MD [m],Inc,Azi\n0,0,3.1\n1000,0.7,3.2\n2000,1.5,6.1\n"
    assert "if they are in radians, give --angle-unit rad" in read(tmp_path, text).notes[0]
    assert read(tmp_path, text.replace("Inc", "Inc [deg]")).notes == ()
    assert read(tmp_path, text.replace("6.1", "61")).notes == ()
    assert read(tmp_path, text, angle_unit="rad").inclination[1] == pytest.approx(np.degrees(0.7))


def test_units_for_columns_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="--force-unit = 'kN': is given, but there is no column of force"):
        read(tmp_path, "MD [m],Inc\n0,0\n10,1\n", force_unit="kN")

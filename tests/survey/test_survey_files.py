"""Survey files as they come: kinds, separators, encodings, several wells, sizes, damage."""

from __future__ import annotations

import io
import math
import time
import zipfile
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import openpyxl
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from programs import CAMPAIGNS, loaded

from rodwell import InputError, Survey, read_surveys
from rodwell.cli.main import cli
from rodwell.survey.reading import source

ROWS = [(0.0, 0.0, 30.5), (100.25, 10.5, 40.0), (1200.0, 62.75, 359.5)]


def _campaign() -> ModuleType:
    """The campaign over 20,000 damaged files, with what writes files of every kind."""
    return loaded(CAMPAIGNS / "survey_files.py")


campaign = _campaign()


def read(tmp_path: Path, data: str | bytes, **options: Any) -> Survey:
    file = tmp_path / "well"
    file.write_bytes(data if isinstance(data, bytes) else data.encode())
    return Survey.read(file, **options)


def assert_rows(survey: Survey, rows: Any = ROWS) -> None:
    assert survey.azimuth is not None
    assert survey.md.tolist() == [row[0] for row in rows]
    assert survey.inclination.tolist() == [row[1] for row in rows]
    assert survey.azimuth.tolist() == [row[2] for row in rows]


@pytest.mark.parametrize("kind", campaign.KINDS)
def test_a_file_of_each_kind_is_the_same_well(tmp_path: Path, kind: str) -> None:
    survey = read(tmp_path, campaign.KINDS[kind](ROWS))
    assert_rows(survey)
    assert survey.depth_unit == "m"


@pytest.mark.parametrize(
    "text",
    [
        '"MD [m],Inc [deg],Azi [deg]"\n"0,0,30.5"\n"100.25,10.5,40"\n"1200,62.75,359.5"\n',  # lines quoted as a whole
        '"MD\n(m)","Inc\n(deg)",Azi\n"0","0","30.5"\n100.25,"10.5",40\n1200,62.75,359.5\n',
        "MD;Inc;Azi;Remark\nm;deg;°;\n0,0;0,0;30,5;a, b\n100,25;10,5;40;\n1.200,00;62,75;359,5;c\n",
        "Measured,Incl.,Azim.\nDepth,,\n(m),(deg),(deg)\n0,0,30.5\n100.25,10.5,40\n1200,62.75,359.5\n",
        "# made by hand\n# MD[m] INC AZI\n0 0 30.5\n100.25\t10.5  40\n1200 62.75 359.5\n",
        "Measured Depth (m)   Inclination (deg)   Azimuth (deg)\n 0 0 30.5\n100.25 10.5 40\n  1200  62.75  359.5\n",
        "MD (m) Inc (deg) Azi (deg)\n0 0 30.5\n100.25 10.5 40\n1200 62.75 359.5\n",
        "Depth unit: m\nWell,A\n\nMD|Inc|Azi\n0|0|30.5\n100.25|10.5|40\nMD|Inc|Azi\n1200|62.75|359.5\n",
        "MD [m]\tInc\tAzi\n0\t0\t30.5\n100.25\t10.5\t40\n1 200.0\t62.75\t359.5\n",
        "MD [m]\tInc\tAzi\r\n1'200.0\t62.75\t359.5\r\n100.25\t10.5°\t40\r\n0\t0\t30.5\r\n",  # from the bottom up
    ],
)  # fmt: skip
def test_layouts_of_text_are_the_same_well(tmp_path: Path, text: str) -> None:
    assert_rows(read(tmp_path, text))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp1252"])
def test_encodings(tmp_path: Path, encoding: str) -> None:
    text = "Größe;x\nMD [m];Inc [°];Azi [°]\n0;0;30,5\n100,25;10,5;40\n1200;62,75;359,5\n"
    assert_rows(read(tmp_path, text.encode(encoding)))


def test_petrel_takes_the_unit_and_the_name_from_its_comments(tmp_path: Path) -> None:
    survey = read(tmp_path, campaign.petrel(ROWS).replace("m-UNITS", "ft-UNITS"))
    assert survey.depth_unit == "ft"
    assert survey.well == "A-1 H"
    assert survey.md[1] == pytest.approx(100.25 * 0.3048)
    assert survey.notes == ('Column "AZIM_GN" is taken as the azimuth; "AZIM_TN" is left aside.',)


def test_las_nulls_units_and_wrapped_lines(tmp_path: Path) -> None:
    text = campaign.las(ROWS, null="-8888.5")
    lost = text.replace(" 100.25 10.5 40.0", " 100.25 -8888.5 40.0")
    survey = read(tmp_path, lost)
    assert survey.md.tolist() == [0.0, 1200.0]
    assert "line 16" in " ".join(survey.notes)
    feet = read(tmp_path, text.replace("MD .M", "MD .F"))
    assert feet.depth_unit == "ft"
    wrapped = text.replace("WRAP. NO", "WRAP. YES").replace(" 10.5 ", "\n 10.5\n ")
    assert_rows(read(tmp_path, wrapped))
    with pytest.raises(InputError, match="LAS 3"):
        read(tmp_path, text.replace("2.0", "3.0"))
    with pytest.raises(InputError, match="line 15"):
        read(tmp_path, text.replace(" 0.0 0.0 30.5", " 0.0 0.0"))


def workbook(**sheets: list[list[Any]]) -> bytes:
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    kept = io.BytesIO()
    book.save(kept)
    return kept.getvalue()


def test_sheets_of_a_workbook_are_wells_and_empty_cells_are_missing(tmp_path: Path) -> None:
    head = ["MD (ft)", "Inc", "Azi"]
    data = workbook(Cover=[["Report"]], A=[["x"], head, [0, 0, None], [100, "5,5", 10]], B=[head, [0, 1, 2], [9, 1, 3]])
    with pytest.raises(InputError, match="2 wells: A, B"):
        read(tmp_path, data)
    survey = read(tmp_path, data, well="a")
    assert survey.inclination.tolist() == [0.0, 5.5]
    assert survey.azimuth is not None
    assert survey.azimuth.tolist() == [10.0, 10.0]
    assert survey.depth_unit == "ft"
    with pytest.raises(InputError, match="row 4, measured depth = '90 ft'"):
        read(tmp_path, workbook(S=[head, [100, 0, 0], [120, 1, 0], [90, 1, 0]]))


def test_wells_of_a_file(tmp_path: Path) -> None:
    text = "Well,MD [m],Inc,Azi\nA-1,0,0,30\n,100,10,40\nB-2,0,0,1\nB-2,50,2,2\n"
    with pytest.raises(InputError, match="holds 2 wells: A-1, B-2; pick one with --well"):
        read(tmp_path, text)
    assert read(tmp_path, text, well="b-2").md.tolist() == [0.0, 50.0]
    assert {name: len(survey) for name, survey in read_surveys(tmp_path / "well").items()} == {"A-1": 2, "B-2": 2}
    with pytest.raises(InputError, match="its wells are A-1, B-2"):
        read(tmp_path, text, well="C")
    with pytest.raises(InputError, match="names no wells"):
        read(tmp_path, campaign.delimited(ROWS), well="C")
    with pytest.raises(InputError, match="another well"):
        read(tmp_path, "MD [m],Inc\n0,0\n100,1\n0,0\n50,1\n")


def test_command_screens_every_well(tmp_path: Path) -> None:
    (tmp_path / "w.csv").write_text("Well,Tiefe [m],Dip (deg)\nA/1,0,3\nA/1,100,10\nB,0,3\nB,50,2\n", encoding="utf-8")
    case = Path(__file__).parents[2] / "examples" / "well-string.toml"
    line = ["screen", str(tmp_path / "w.csv"), "--case", str(case), "--out", str(tmp_path / "out"), "--all-wells"]
    found = CliRunner().invoke(cli, [*line, "--column", "inclination=dip (DEG)"], catch_exceptions=False)
    assert found.exit_code == 0
    assert {file.name for file in (tmp_path / "out").iterdir()} == {"1-A-1", "2-B"}
    assert "Tiefe [m]" in " ".join(found.output.split())
    for more, names in ((["--column", "x"], "KIND=NAME"), (["--well", "B"], "together"), ([], "looks like one")):
        with pytest.raises(InputError, match=names):
            CliRunner().invoke(cli, [*line, *more], catch_exceptions=False)


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_any_table_written_in_any_way_comes_back(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject) -> None:
    steps = data.draw(st.lists(st.floats(0.01, 500.0), min_size=2, max_size=8))
    digits = data.draw(st.sampled_from([None, 1, 2, 4]))
    md = [float(value) for value in np.cumsum(steps)]
    inc = [data.draw(st.floats(0.5, 120.0)) for _ in md]
    azi = [data.draw(st.floats(0.0, 360.0)) for _ in md]
    if digits is not None:
        md = [round(value, 1) + 0.1 * i for i, value in enumerate(md)]
        md, inc, azi = ([float(f"{v:.{digits}f}") for v in column] for column in (md, inc, azi))
    rows = list(zip(md, inc, azi, strict=True))
    separator = data.draw(st.sampled_from([",", ";", "\t", "|", " "]))
    decimal = data.draw(st.sampled_from([".", ","]))
    encoding = data.draw(st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]))
    end = data.draw(st.sampled_from(["\n", "\r\n", "\r"]))
    above = data.draw(st.sampled_from(["", "Operator: X\nDate: 2020-02-02\n\n", "# remark, with; marks\n"]))
    text = (above + campaign.delimited(rows, separator, decimal, digits)).replace("\n", end)
    mark = "comma" if decimal == "," else "point"
    survey = read(tmp_path_factory.mktemp("any"), text.encode(encoding), decimal=mark)
    assert_rows(survey, rows)


def test_damaged_files_are_read_or_refused(tmp_path: Path) -> None:
    """A sample of the campaign: no exception but InputError, each in less than a second of processor time."""
    seen = [campaign.outcome(7_000_000 + number, tmp_path) for number in range(300)]
    assert [one for one in seen if one["fault"]] == []
    assert {one["what"] for one in seen} == {"read", "refused"}


@pytest.mark.parametrize(
    "text",
    ["x" + "( " * 4000 + "\n1\n", "x" + "[" * 20000 + ",MD [m],Inc\n1,2,3\n", "MD [m],Inc" + " " * 50000 + "\n0,0\n",
     "9" * 100_000 + "\n", "MD [m],Inc\n" + "1" * 100_000 + ",1\n", "a," * 100_000 + "\n", '"' * 30_001 + "\n",
     "MD [m],Inc\n" + '"x\n' * 20_001, "_" * 200_000, "MD [m]," * 400 + "Inc\n1,1\n",
     "\n".join(",".join(f"w{i}x{j}" for j in range(400)) for i in range(300)), "a b " * 200_000 + "\n",
     "~V\n~" + "." * 100_000, "~V\n VERS. 2.0:\n~C\n" + " A.m :\n" * 1500 + "~A\n1\n"],
)  # fmt: skip
def test_no_text_makes_the_reader_slow(tmp_path: Path, text: str) -> None:
    start = time.process_time()
    with pytest.raises(InputError) as caught:
        read(tmp_path, text)
    assert time.process_time() - start < 20.0  # a second at most where nothing else runs; minutes, once it is quadratic
    assert len(str(caught.value)) < 2000


def test_sizes_are_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match="larger than 50 MB"):
        Survey.read("/dev/zero")
    monkeypatch.setattr(source, "MOST_LINES", 100)
    with pytest.raises(InputError, match="more than 100 lines"):
        read(tmp_path, "\n" * 300)
    many = "MD [m],Inc\n" + "".join(f"{i},0\n" for i in range(100_001))
    monkeypatch.setattr(source, "MOST_LINES", 500_000)
    with pytest.raises(InputError, match="holds 100001 stations; at most 100000"):
        read(tmp_path, many)
    bomb = io.BytesIO()
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/worksheets/sheet1.xml", bytes(1000))
    monkeypatch.setattr("rodwell.survey.reading.workbook.LARGEST_UNPACKED", 500)
    with pytest.raises(InputError, match="unpacks to more"):
        read(tmp_path, bomb.getvalue())
    with pytest.raises(InputError, match="XLS"):
        read(tmp_path, source.OLE + bytes(600))


def test_wide_sheets_are_cut(tmp_path: Path) -> None:
    """A cell in the last column of the last row does not fill the memory."""
    data = workbook(S=[["MD [m]", "Inc"], [0, 0], [1, 1]])
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    far = b'<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData>'
    parts["xl/worksheets/sheet1.xml"] = parts["xl/worksheets/sheet1.xml"].replace(b"</sheetData>", far)
    kept = io.BytesIO()
    with zipfile.ZipFile(kept, "w") as archive:
        for name, part in parts.items():
            archive.writestr(name, part)
    assert len(read(tmp_path, kept.getvalue())) == 2


def test_a_sheet_ends_after_many_empty_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = workbook(S=[["MD [m]", "Inc"], [0, 0], [], [1, 1], [], [], [], [], ["remark far below"]])
    with pytest.raises(InputError, match="row 9, MD"):
        read(tmp_path, data)
    monkeypatch.setattr("rodwell.survey.reading.workbook.MOST_EMPTY", 3)
    assert len(read(tmp_path, data)) == 2


def test_a_hundred_thousand_stations_are_read_quickly(tmp_path: Path) -> None:
    md, inc = np.linspace(0.0, 9000.0, 100_000), np.linspace(0.0, 90.0, 100_000)
    text = "MD [m];Inc;Azi\n" + "".join(f"{a:.3f};{b:.4f};\n" for a, b in zip(md, inc, strict=True))
    start = time.process_time()
    survey = read(tmp_path, text)
    assert time.process_time() - start < 6.0  # 1.2 s where nothing else runs
    assert len(survey) == 100_000
    assert survey.azimuth is None
    assert math.isclose(float(survey.md[-1]), 9000.0)

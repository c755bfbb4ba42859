"""The report of a case: page, PDF and tables say what answer.json says, and nothing gets in that does not belong."""

from __future__ import annotations

import csv
import importlib.util
import io
import json
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from pages import Page, number_of
from pypdf import PdfReader

import rodwell
from rodwell.analysis.discrete.measures import Measured
from rodwell.answers.words.advice import statuses
from rodwell.cli.main import main
from rodwell.plots.ordinates import telling
from rodwell.quantities.names import UNITS
from rodwell.quantities.written import number_and_rest
from rodwell.report.folders.case import write_results
from rodwell.report.reports import texts

TITLE = 'A <script>alert("1")</script> & *bold* #pagebreak() $x$ pipe'
PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "": 1.0, "m": 1e-3, "µ": 1e-6, "n": 1e-9, "p": 1e-12}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results of the drill string of (62), one mode, with a title that means mischief and a load beyond lift-off."""
    case = rodwell.Case.from_dict(
        {
            "title": TITLE,
            "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
            "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg", "gravity": "9.8 m/s^2"},
            "load": {"until": "-150 kN"},
            "analysis": {"modes": 1, "rtol": 1e-6},
        }
    )
    out = tmp_path_factory.mktemp("report") / "out"
    names = write_results(rodwell.answer(case), str(out), with_pdf=True)
    assert sorted(file.name for file in out.iterdir()) == list(names)
    return out


@pytest.fixture(scope="module")
def page(folder: Path) -> Page:
    return Page((folder / "report.html").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def figures(folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((folder / "answer.json").read_text(encoding="utf-8"))["figures"]
    return found


def si(text: str) -> float:
    """Value in SI of a text such as "−139.582 kN"."""
    read = number_and_rest(text.replace("\u2007", "").replace("\u2008", "").replace("\u00a0", " "))
    assert read is not None
    number, unit = read
    prefix = unit[0] if len(unit) > 1 and unit[0] in PREFIXES and unit not in ("m", "N·m") else ""
    return number * PREFIXES[prefix]


def table(page: Page, *head: str) -> list[list[str]]:
    """The rows of the table whose head begins so."""
    return next(rows[1:] for rows in page.tables if tuple(rows[0][: len(head)]) == head)


def dots(resources: Any) -> int:
    """How many pictures made of dots there are, in drawings too; masks of transparency do not count."""
    parts = [part.get_object() for part in (resources.get_object().get("/XObject") or {}).values()]
    return sum(part["/Subtype"] == "/Image" for part in parts) + sum(
        dots(part["/Resources"]) for part in parts if "/Resources" in part
    )


def test_page_is_well_formed(page: Page, folder: Path) -> None:
    assert "<script>alert" not in (folder / "report.html").read_text(encoding="utf-8")
    assert page.faults == []
    assert page.open == []
    assert len(page.ids) == len(set(page.ids))
    assert "front" in page.ids
    assert len(page.tables) >= 6
    for rows in page.tables:
        assert {len(row) for row in rows} == {len(rows[0])}
    text = " ".join(page.words)
    assert TITLE in text  # as text, not as markup
    assert "nan" not in text.lower().split()


def test_no_line_ends_within_an_end_of_the_rod(folder: Path) -> None:
    said = (folder / "report.html").read_text(encoding="utf-8").partition("<body>")[2]
    said = re.sub(r"<script.*?</script>", "", said, flags=re.DOTALL)
    assert re.search("end force at s\u00a0=\u00a01", said)
    assert "B\u00a0=\u00a0L\u00a0=\u00a01" in said
    assert not re.search(r"\bs = [01]|B = L", said)


def test_numbers_of_the_page_are_those_of_the_json(page: Page, figures: dict[str, Any]) -> None:
    """In the reader's table compression is positive; in that for research all is as in the data."""
    rows = table(page, "Quantity", "Value", "±\u00a0error".replace("\u00a0", " "))
    assert len(rows) == len(figures)
    for figure, (label, value, error, _) in zip(figures.values(), rows, strict=True):
        end_force = figure["label"].endswith(", end force at s = 1")
        assert label == figure["label"].replace("end force at s = 1", "compression")
        assert si(value) == pytest.approx((-1.0 if end_force else 1.0) * figure["si"]["value"], rel=5e-6)
        assert si(error) == pytest.approx(figure["si"]["error"], rel=0.5)
    rows = table(page, "Quantity", "Value, B = L = 1")
    for figure, (label, value, error, note) in zip(figures.values(), rows, strict=True):
        assert label == figure["label"]
        assert number_of(value) == pytest.approx(figure["value"], rel=1e-9, abs=10.0 * figure["error"])
        assert number_of(error) == pytest.approx(figure["error"], rel=0.5)
        assert note == figure.get("note", "")


def test_pdf_says_the_same(folder: Path, page: Page) -> None:
    reader = PdfReader(folder / "report.pdf")
    sheets = ["".join(sheet.extract_text().split()) for sheet in reader.pages]
    assert reader.metadata is not None
    assert reader.metadata.title == TITLE
    assert "".join(TITLE.split()) in sheets[0]  # not read as commands
    assert "Thestraightrodisstableuntilthecompressionreaches124.6kN" in sheets[0]
    for words in (
        "buckled,stable",
        "leavesthewall",
        "numericallyconverged",
        "Whattodonext",
        "Compressionpositive",
        "contactwithout",
    ):
        assert words in sheets[0]
    assert sheets[1].startswith("Whatthenumbersmean")  # the front is one sheet
    whole = "".join(sheets)
    for rows in page.tables:
        for row in rows[1:]:
            for cell in row:
                assert "".join(cell.split()) in whole
    assert reader.pages[0].mediabox.height == pytest.approx(842, abs=1)  # A4, in points
    fonts = {str(font) for sheet in reader.pages for font in (sheet["/Resources"].get("/Font") or {})}
    assert fonts
    assert sum(dots(sheet["/Resources"]) for sheet in reader.pages) == 1  # only the rod in space is made of dots


def test_front_shows_what_decides(page: Page) -> None:
    """One end, one sign, no numerical errors: those stand in the tables."""
    front = " ".join(" ".join(page.words).split("What the numbers mean")[1].split())  # after the contents
    for text in ("124.6 kN", "139.6 kN", "110 MPa", "below 124.6 kN", "numerically converged", "30 m long"):
        assert text in front
    assert "−124" not in front
    assert not re.search(r"[kMm]?(N|Pa)\s*±|±\s*\S+\s*[kMmµnp]?(N|Pa)", front)  # of no input is an uncertainty given
    assert "compression" in front
    assert "horizontal" in front


def test_tables_hold_the_json(folder: Path, figures: dict[str, Any]) -> None:
    with (folder / "key-figures.csv").open(encoding="utf-8", newline="") as file:
        lines = list(csv.reader(file))
    assert [line[0] for line in lines[1:]] == list(figures)
    for line in lines[1:]:
        figure = figures[line[0]]
        assert [float(x) for x in (*line[2:4], *line[5:7])] == [
            figure["value"], figure["error"], figure["si"]["value"], figure["si"]["error"],
        ]  # fmt: skip
        assert (line[4], line[7]) == (figure["unit"], figure["si"]["unit"])
    book = openpyxl.load_workbook(folder / "tables.xlsx")
    assert book.sheetnames == ["Key figures", "Special points", "at buckling", "at lift-off"]
    kinds = [row[1] for row in book["Special points"].iter_rows(min_row=2, max_row=4, values_only=True)]
    assert kinds == ["critical", "lift_off", "end"]
    assert book["Key figures"]["C2"].value == pytest.approx(figures["critical_load_1"]["value"], rel=1e-15)


def test_figures_come_as_svg_too(folder: Path) -> None:
    for name in ("bifurcation", "modes", "wall-loads", "cylinder", "sketch"):
        root = ET.parse(folder / f"{name}.svg").getroot()
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
        assert (folder / f"{name}.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("until", "levels", "words"),
    [
        # the first mode of γ = 15, horizontal: buckles at −111.2334, lifts off at −123.1731 (paper, Table 1 and Fig. 3)
        (-50.0, ["good", "good"], ["straight", "on the wall"]),
        (-105.0, ["caution", "good"], ["straight, close to buckling", "on the wall"]),
        (-115.0, ["caution", "good"], ["buckled, stable", "on the wall"]),
        (-130.0, ["caution", "bad"], ["buckled, stable", "leaves the wall"]),
        (None, ["open", "open"], ["no load given", "no load given"]),
    ],
)
def test_status_of_a_load(until: float | None, levels: list[str], words: list[str]) -> None:
    load = {} if until is None else {"load": {"until": until}}
    case = rodwell.Case.from_dict({"dimensionless": {"weight": 15}, "analysis": {"modes": 1, "rtol": 1e-6}, **load})
    buckling, contact, numbers = statuses(rodwell.answer(case))
    assert [buckling.level, contact.level] == levels
    assert [buckling.word, contact.word] == words
    assert numbers.level == "good"


def test_ordinate_of_the_diagram_does_not_vanish() -> None:
    """A pinned end has no curvature: what is drawn must be another number."""
    for ends, expected in (
        ("clamped-clamped", "OMEGA2_1"),
        ("clamped-pinned", "OMEGA2_0"),
        ("pinned-pinned", "SHORTENING"),
    ):
        problem = rodwell.Problem(15, ends=tuple(ends.split("-")))
        branch = rodwell.follow(problem, 1, until=rodwell.critical_loads(problem, 1)[0].force - 5.0, rtol=1e-6)
        assert telling([branch]) == Measured[expected]
        assert abs(branch.numbers(telling([branch]))[-1]) > 1e-5


def test_without_typst(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    case = tmp_path / "case.toml"
    case.write_text("[dimensionless]\nweight = 15\n", encoding="utf-8")
    found = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name, *a: None if name == "typst" else found(name, *a))
    monkeypatch.setattr("sys.argv", ["rodwell", "run", str(case), "--pdf", "--out", str(tmp_path / "r")])
    with pytest.raises(SystemExit) as left:
        main()
    assert left.value.code == 2
    message = capsys.readouterr().err
    assert "--pdf" in message
    assert "pip install 'rodwell[pdf]'" in message
    assert not (tmp_path / "r").exists()


def test_front_stays_one_sheet_and_letter_paper_for_field_units() -> None:
    from rodwell.report.folders.pictures import draw_branches, draw_rod
    from rodwell.report.pages.pdf import pdf
    from rodwell.report.reports.case import case_report
    from rodwell.report.reports.content import Words

    case = rodwell.Case.from_dict(
        {
            "units": "field",
            "rod": {"pipe": "5 in 19.5 lb/ft drill pipe", "length": "100 ft"},
            "hole": {"diameter": "8.5 in", "angle_from_vertical": "60 deg"},
            "mud": {"density": "10 lb/gal"},
            "analysis": {"modes": 1, "rtol": 1e-5},
        }
    )
    answer = rodwell.answer(case)
    report = case_report(answer)
    drawn = draw_branches(answer) | draw_rod(answer)
    pictures = {name: next(reversed(formats.items())) for name, formats in drawn.items()}
    paragraphs = [block.text for part in report.sections for block in part.blocks if isinstance(block, Words)]
    assert all(text.endswith((".", ":")) for text in paragraphs)  # nothing is cut off
    more = replace(report, front=replace(report.front, steps=report.front.steps * 4))
    for content in (report, more):
        made = PdfReader(io.BytesIO(pdf(content, pictures)))
        assert made.pages[0].mediabox.height == pytest.approx(792, abs=1)
        assert "effectiveforce" in "".join(made.pages[0].extract_text().split())
        assert made.pages[1].extract_text().startswith("What the numbers mean")


def test_every_dimension_of_the_nomenclature_has_a_unit_that_is_read() -> None:
    """The rotation of a twisted end is an angle: a case with twist has it among its key numbers."""
    assert set(texts.PLAIN_UNITS) == set(UNITS)
    data = {"dimensionless": {"weight": 15, "alpha": 90}, "load": {"twist": 2}, "analysis": {"modes": 1}}
    twisted = rodwell.answer(rodwell.Case.from_dict(data))
    assert "rad" in {row["value"].split(" ")[-1] for row in texts.rows(twisted.key_numbers.values(), twisted.case)}

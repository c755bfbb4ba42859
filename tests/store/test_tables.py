"""Tables as CSV and XLSX: texts that look like formulas are texts in both."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from rodwell.quantities.table import Table
from rodwell.store.tables import as_text, write_csv, write_xlsx

FORMULA = '=HYPERLINK("http://example.com","x")'
CELLS = (FORMULA, "+1", "-1+1", "@SUM(1)", "\t=1", "\r=1", "＝1", "a=1", " ", "−5", "")


def test_csv_holds_no_formula(tmp_path: Path) -> None:
    table = Table("t", (FORMULA, *(f"c{i}" for i in range(11))), ((*CELLS, -1.5),))
    write_csv(table, tmp_path / "t.csv")
    with (tmp_path / "t.csv").open(encoding="utf-8", newline="") as file:
        head, row = csv.reader(file)
    assert head[0] == "'" + FORMULA
    assert row[:7] == ["'" + cell for cell in CELLS[:7]]
    assert row[7:] == ["a=1", " ", "−5", "", "-1.5"]
    assert float(row[-1]) == -1.5


@pytest.mark.parametrize("cell", [-1.0, 3, None, "plain"])
def test_other_cells_stay(cell: object) -> None:
    assert as_text(cell) is cell


def test_xlsx_holds_texts(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    write_xlsx([Table("t", ("a", "b"), ((FORMULA, -1.5),))], tmp_path / "t.xlsx")
    sheet = openpyxl.load_workbook(tmp_path / "t.xlsx").active
    assert (sheet["A2"].value, sheet["A2"].data_type, sheet["B2"].value) == (FORMULA, "s", -1.5)


def test_a_study_over_names_of_the_user(tmp_path: Path) -> None:
    import rodwell
    from rodwell.studies.sweep.tables import study_table

    names = [FORMULA, "@other"]
    (tmp_path / "own.toml").write_text(
        "".join(
            f"[[pipe]]\nname = '{name}'\nsource = 'me'\nouter_diameter = '5 cm'\nmaterial = 'steel'\n" for name in names
        ),
        encoding="utf-8",
    )
    case = tmp_path / "case.toml"
    case.write_text(
        f"""study = true\n[rod]\nlength = "20 m"\npipe = {names!r}
[hole]\ndiameter = "8 cm"\nangle_from_vertical = "0 deg"
[catalogue]\nfiles = ["own.toml"]\n[analysis]\nrtol = 1e-3\nmodes = 1\n""",
        encoding="utf-8",
    )
    write_csv(study_table(rodwell.study(case)), tmp_path / "points.csv")
    with (tmp_path / "points.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert [row[1] for row in rows[1:]] == ["'" + name for name in names]

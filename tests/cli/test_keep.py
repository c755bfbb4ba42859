"""``--figure`` and ``--out`` of commands that answer with a few numbers."""

import csv
import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from rodwell.cli.main import cli
from rodwell.errors import InputError

COMMANDS = {
    "critical": ("--weight", "15", "--alpha", "90", "--modes", "2"),
    "liftoff": ("--weight", "15", "--alpha", "90"),
    "sensitivity": ("--weight", "15", "--alpha", "90"),
    "twist": ("--weight", "15", "--alpha", "89"),
    "modes": ("--weight", "15", "--table", "3"),
    "endless": ("--beta", "3"),
}
"""Commands that draw, with an input."""


def run(*arguments: str) -> str:
    """What a command prints; what it raises is raised."""
    result = CliRunner().invoke(cli, arguments, standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result.output


@pytest.mark.parametrize("name", COMMANDS)
def test_numbers_are_kept_as_printed_with_a_table_and_a_picture(name: str, tmp_path: Path) -> None:
    figure, out = tmp_path / f"picture-{name}.svg", tmp_path / "kept"
    printed = run(name, *COMMANDS[name], "--json", "--figure", str(figure), "--out", str(out))
    assert "<svg" in figure.read_text(encoding="utf-8")
    assert sorted(file.name for file in out.iterdir()) == [f"{name}.{kind}" for kind in ("csv", "json", "png", "svg")]
    assert json.loads((out / f"{name}.json").read_text(encoding="utf-8")) == json.loads(printed)
    with (out / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    assert rows
    assert all(len(row) == len(head) for row in rows)


def test_the_table_has_the_loads_of_the_paper(tmp_path: Path) -> None:
    run("critical", *COMMANDS["critical"], "--out", str(tmp_path / "kept"))
    with (tmp_path / "kept" / "critical.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    loads = {(row["kind"], row["mode"]): float(row["end force at s = 1, tension positive [B/L^2]"]) for row in rows}
    assert loads["kept on the wall", "1"] == pytest.approx(-111.23344016, rel=1e-10)  # a second program
    assert loads["without the wall's help", "1"] == pytest.approx(-39.47841760435743, rel=1e-12)  # −4π², Euler


def test_proofs_are_kept_as_data(tmp_path: Path) -> None:
    printed = run(
        "certify", "--weight", "15", "--alpha", "90", "--modes", "1", "--json", "--out", str(tmp_path / "kept")
    )
    (file,) = (tmp_path / "kept").iterdir()
    assert json.loads(file.read_text(encoding="utf-8")) == json.loads(printed)


def test_what_cannot_be_written_is_said_before_anything_is_computed(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"must end in \.png, \.svg or \.pdf"):
        run("critical", "--weight", "nan", "--alpha", "90", "--figure", str(tmp_path / "picture.gif"))
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(InputError) as said:
        run("liftoff", "--weight", "nan", "--alpha", "90", "--out", str(tmp_path / "file" / "kept"))
    assert said.value.field == "--out"
    with pytest.raises(InputError, match="give --weight, too"):
        run("modes", "--table", "3", "--figure", str(tmp_path / "picture.png"))
    assert [path.name for path in tmp_path.iterdir()] == ["file"]

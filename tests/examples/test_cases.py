"""Case files that are shipped: each meets its tolerance, and what is said of it is written as all pages are."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner
from written import OF_SYSTEM, of_page, said, violations

import rodwell
from rodwell.answers.result.bridged import bridged_answer
from rodwell.cli.main import cli
from rodwell.cli.run import _details, _verdict
from rodwell.quantities.units import SYSTEMS
from rodwell.report.reports.bridged import bridged_report
from rodwell.report.reports.case import case_report
from rodwell.report.reports.study import study_report
from rodwell.studies.sweep.varied import is_study

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
ELSEWHERE = ("[packer]", "[[hole.section]]", "stabiliser in a build section")
"""Sections that make a case one of another kind."""

CASES = sorted(
    path for path in EXAMPLES.glob("*.toml")
    if not is_study(path) and not any(section in path.read_text("utf-8") for section in ELSEWHERE)
)  # fmt: skip


def without_names(texts: Iterable[str], case: rodwell.Case) -> list[str]:
    """The texts without the title, names and sources of the catalogue, and what the user wrote."""
    parts = [part for values in case.given.values() for part in (values if isinstance(values, list) else [values])]
    parts += [one for part in parts for one in part.get("section", ())]
    names = {case.title, *(str(v) for part in parts for v in part.values() if len(str(v)) > 12)}
    names |= {fact.value for fact in case.facts if isinstance(fact.value, str)} | {fact.note for fact in case.facts}
    own = re.compile("|".join(re.escape(name) for name in sorted(filter(None, names), key=len, reverse=True)))
    return [own.sub("", text) for text in texts]


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_every_number_of_an_example_meets_its_tolerance_and_is_written_well(
    path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "400")
    found = rodwell.answer(rodwell.Case.read(path))
    missed = [f.name for f in found.key_numbers.values() if f.error > found.case.rtol * f.scale]
    assert not missed
    assert found.converged
    for system in SYSTEMS if found.case.scales is not None else (None,):
        case = found.case.in_units(system)
        there = rodwell.Answer(case, found.critical, found.branches, found.until, found.other_arm, found.lying)
        report = case_report(there).as_dict()
        texts = without_names(said(report), case)
        _verdict(there)
        _details(there)
        printed = without_names(capsys.readouterr().out.splitlines(), case)
        assert violations([*texts, *printed]) == []
        if system is None:
            continue
        assert [text for text in (*texts, *printed) if OF_SYSTEM[system].search(text)] == []
        front = " ".join(without_names(said(report["front"]), case))
        assert "B/L" not in front  # the reader's units
        assert not re.search(r"−\d[\d.\u202f]* [kmµ]?(?:N|lbf)\b", front)  # compression has its word, not a sign
        assert not re.search(r"(?:N|lbf|Pa|psi)\s*±", front)  # numerical errors stand in the tables


COMMANDS = (
    "endless",
    "endless --beta 3",
    "path --weight 15 --alpha 90 --until -124.7 --unload-to -123.5 --at -124.65,-200 --seeds 1 --out {out}",
    "packer tubing-packer.toml --out {out}",
    "audit drill-string.toml --out {out}",
    "screen well-survey.csv --case well-string.toml --out {out}",
    "map --quantity critical --weight '5..20 in 2' --alpha '30..90 in 2' --workers 1 --out {out}.zarr",
    "critical --weight 16.5 --alpha 60",
    "critical --weight 0 --alpha 0 --twist 5 --modes 1",
    "liftoff --weight 16.5 --alpha 90",
    "modes --weight 16.5 --table 3",
    "sensitivity --weight 16.5 --alpha 90",
    "twist --weight 15 --alpha 90",
    "certify --weight 15000 --alpha 90 --modes 1 --clearance 1e-4",
    "diagram --weight 15 --alpha 90 --until -124 --modes 1 --out {out}",
    "curve critical --alpha 90 --over weight --from 1 --to 3 --out {out}",
)


@pytest.mark.parametrize("line", COMMANDS, ids=lambda line: line.split()[0])
def test_what_a_command_prints_and_its_report_are_written_well(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`drag` is read in tests/studies/drag/test_drag_input.py, where its example is computed."""
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.chdir(EXAMPLES)
    ran = CliRunner().invoke(cli, shlex.split(line.format(out=tmp_path / "out")))
    assert ran.exit_code == 0, ran.output
    texts = [text for text in ran.output.splitlines() if str(tmp_path) not in text]
    pages = [text for page in (tmp_path / "out").glob("*.html") for text in of_page(page)]
    assert violations([*texts, *pages]) == []


@pytest.mark.parametrize("name", ["tubing-two-casings", "stabiliser-in-build"])
def test_steps_of_the_clearance_are_written_well(name: str) -> None:
    found = bridged_answer(rodwell.Case.read(EXAMPLES / f"{name}.toml"))
    assert found.converged
    for system in SYSTEMS:
        there = replace(found, case=found.case.in_units(system))
        texts = without_names(said(bridged_report(there).as_dict()), there.case)
        assert violations(texts) == []
        assert [text for text in texts if OF_SYSTEM[system].search(text)] == []


def test_a_study_is_written_well() -> None:
    found = rodwell.study(EXAMPLES / "study.toml")
    texts = (text.replace(found.title, "") for text in said(study_report(found).as_dict()))
    assert violations(texts) == []

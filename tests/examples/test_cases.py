"""Case files that are shipped: each meets its tolerance, and what is said of it is written as all pages are."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest

import rodwell
from rodwell.answers.result.bridged import bridged_answer
from rodwell.cli.run import _details, _verdict
from rodwell.quantities.units import SYSTEMS
from rodwell.report.reports.bridged import bridged_report
from rodwell.report.reports.case import case_report
from rodwell.report.reports.study import study_report
from rodwell.studies.sweep.study import is_study

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
ELSEWHERE = ("[packer]", "[[hole.section]]")
"""Sections that make a case one of another kind."""

CASES = sorted(
    path for path in EXAMPLES.glob("*.toml")
    if not is_study(path) and not any(section in path.read_text("utf-8") for section in ELSEWHERE)
)  # fmt: skip

VIOLATIONS = {
    "an exponent": re.compile(r"(?<![\w#])\d+(?:\.\d+)?e[−+-]?\d"),
    "a hyphen for a minus": re.compile(r"(?<![\w.,–-])-\d"),
    "thousands together": re.compile(r"(?<![\d.\u202f])\d{5,}(?!\d*[\w/-])"),
    "N m": re.compile(r"\bN m\b"),
    "deg": re.compile(r"\d\s?deg\b|\[deg\]"),
    "a raised fraction": re.compile(r"\^[¼⅓½]"),
    "N_real": re.compile(r"N_real"),
    "no number": re.compile(r"(?<![\w])(?:nan|inf)(?![\w])"),
    "an article": re.compile(r"\ba (?:angle|end|inclin)"),
}
OF_SYSTEM = {
    "field": re.compile(r"\d\s?(?:[kM]?N|N/m|m|mm|[kMG]?Pa|N·m)(?![\w·/.])"),
    "si": re.compile(r"\d\s?(?:lbf|psi|ft|in)(?![\w·/.])"),
    "mm": re.compile(r"\d\s?(?:lbf|psi|ft|in|m)(?![\w·/.])"),
}
"""Units of other systems."""


def said(item: Any) -> Iterator[str]:
    """Every text of a report, the user's own words aside."""
    if isinstance(item, str):
        yield item.replace("\u00a0", " ")
    elif isinstance(item, dict):
        own = item.get("kind") == "grid" and item["head"][0] == "Key of the case file"
        for key, value in item.items():
            if not own and key not in ("title", "subtitle", "about", "files", "footer"):
                yield from said(value)
    elif isinstance(item, list | tuple):
        for value in item:
            yield from said(value)


def violations(texts: Iterable[str]) -> list[tuple[str, str]]:
    return [(name, text) for text in texts for name, rule in VIOLATIONS.items() if rule.search(text)]


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
        there = rodwell.Answer(case, found.critical, found.branches, found.until, found.other_arm)
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


@pytest.mark.parametrize("system", SYSTEMS)
def test_steps_of_the_clearance_are_written_well(system: str) -> None:
    found = bridged_answer(rodwell.Case.read(EXAMPLES / "tubing-two-casings.toml").in_units(system))
    assert found.converged
    texts = without_names(said(bridged_report(found).as_dict()), found.case)
    assert violations(texts) == []
    assert [text for text in texts if OF_SYSTEM[system].search(text)] == []


def test_a_study_is_written_well() -> None:
    found = rodwell.study(EXAMPLES / "study.toml")
    texts = (text.replace(found.title, "") for text in said(study_report(found).as_dict()))
    assert violations(texts) == []

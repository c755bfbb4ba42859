"""``rodwell paper``: every printed number of the paper, the rules of comparison, files and exit codes."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.quantities.value import Value
from rodwell.studies.paper import items, linear, scorer, stability
from rodwell.studies.paper.agreement import Agreement, agreement
from rodwell.studies.paper.claims import FORMULA, INTERVAL, Claim, matches, typeset
from rodwell.studies.paper.table1 import ROWS
from rodwell.studies.paper.work import CLEARANCE, Work

PAPER = {
    "eq63": "16.5",
    "text.k3.2": "8.9868",
    "text.k3.4": "15.4505",
    "fig3c.secondary1": "-362.63",
    "fig3c.secondary2": "-164.78",
    "fig6.88": "125.95",
    "fig6.90": "74.63",
    "eq79.slope1": "0.5290",
    "eq79.slope2": "0.5143",
    "fig9.first": "14.3626",
    "eq87.1": "74.628569",
    "eq87.3": "325.513452",
    "eq87.engelhardt": "74.6285 ± 0.0005",
    "eq88": "18.956266",
    "ratio": "1.58",
    "fig12.1": "5.0056",
    "fig12.2": "38.0354",
    "fig12.3": "146.1763",
}
"""Printed in the paper and reproduced, apart from Table 1."""

DIFFERENT = {
    "table1.text.formula": 8.76681819306022,  # 9π⁴Δ
    "fig3d.secondary3": -1899.765516,  # AUTO-07p on the 15 equations
    "eq87.2": 157.0327801526689,  # zero of the determinant of Airy and Scorer functions
    "eq86.t1": -1.0,  # the definition of t
    "fig11.lower": -1.0,  # the mirror image of the other arm
}
"""Differences and what is right instead, by other means than the engine."""


@pytest.fixture(scope="module")
def table() -> Agreement:
    return agreement()


def run(*arguments: str) -> Any:
    return CliRunner().invoke(cli, ["paper", *arguments])


def test_every_printed_number_is_there_and_agrees(table: Agreement) -> None:
    found = {finding.claim.key: finding for finding in table}
    assert len(found) == len(table), "keys are unique"
    for key, printed in PAPER.items():
        assert found[key].claim.printed == printed
        assert found[key].agrees, (key, found[key].computed)
    for finding in table:
        assert finding.agrees == (finding.claim.key not in DIFFERENT), finding
        assert 0.0 <= finding.computed.error < 1e-6, finding


def test_differences_are_those_that_are_known(table: Agreement) -> None:
    differing = {finding.claim.key: finding for finding in table if not finding.agrees}
    assert set(differing) == set(DIFFERENT)
    for key, right in DIFFERENT.items():
        assert differing[key].documented
        assert differing[key].computed.value == pytest.approx(right, rel=1e-9)
        assert len(differing[key].evidence) > 60
    assert table.passed
    assert f"{len(table) - 5} agree" in table.summary


def test_table_1_is_the_formula_printed_below_it(table: Agreement) -> None:
    """(78) in closed form, to many more digits than are printed."""
    found = {finding.claim.key: finding.computed for finding in table}
    assert len(ROWS) == 20
    for n, m, *_ in ROWS:
        row = {name: found[f"table1.{n}-{m}.{name}"] for name in ("k1", "k3", "weight", "force", "pair")}
        exact = {"k1": n * math.pi, "k3": m * math.pi, "weight": n**2 * m**2 * math.pi**4 / 100.0}
        exact |= {"force": (n**2 + m**2) * math.pi**2, "pair": (m - n) / 2}
        for name, value in exact.items():
            assert row[name].value == pytest.approx(value, rel=1e-11), (n, m, name)
            assert abs(row[name].value - value) <= row[name].error + 1e-14 * value


def test_determinant_against_other_means() -> None:
    """Gi(0) in closed form, Gi'' − t Gi = −1/π by differences, and roots against the eigenproblem."""
    zero = scorer.airy(np.array([0.0]))
    assert zero[2][0] == pytest.approx(1.0 / (3.0 ** (7.0 / 6.0) * math.gamma(2.0 / 3.0)), rel=1e-14)
    h = 1e-3
    for t in (-7.0, -3.3, -0.4, 1.2):
        below, here, above = scorer.airy(np.array([t - h, t, t + h]))[2]
        assert (above - 2.0 * here + below) / h**2 - t * here == pytest.approx(-1.0 / math.pi, abs=1e-5)
    for number in (1, 2, 3):
        root, error = scorer.root(number)
        load = rodwell.critical_loads(rodwell.Problem(root, alpha=0.0), number)[-1]
        assert abs(load.force) < 0.6 * error + load.error + 1e-10


@pytest.mark.parametrize(
    ("printed", "value", "error", "agrees"),
    [
        ("98.6960", 98.69604401, 1e-9, True),
        ("98.6960", 98.69605001, 1e-9, False),
        ("98.6960", 98.69604999, 1e-9, True),
        ("98.6960", 98.696050004, 1e-8, True),  # within the error of rounding to the digits printed
        ("98.6960", 98.69604401, 1e-3, False),  # not known well enough to tell
        ("-362.63", -362.6293664, 1e-8, True),
        ("-362.63", 362.6293664, 1e-8, False),
        ("157.032783", 157.0327801, 1e-10, False),
        ("16.5", 16.51104, 0.0, True),
        ("1", 2.0, 0.0, False),
        ("1.0", math.nan, 0.0, False),
        ("1.0", 1.0, math.inf, False),
    ],
)
def test_digits(printed: str, value: float, error: float, agrees: bool) -> None:
    assert matches(printed, Value(value, error)) is agrees


def test_interval_and_formula() -> None:
    assert matches("74.6285 ± 0.0005", Value(74.628569, 1e-9), INTERVAL)
    assert not matches("74.6285 ± 0.0005", Value(74.62901, 1e-9), INTERVAL)
    assert not matches("74.6285 ± 0.0005", Value(74.6285, 1.0), INTERVAL)
    assert matches("2π", Value(2.0 * math.pi + 1e-9, 2e-9), FORMULA, 2.0 * math.pi)
    assert not matches("2π", Value(2.0 * math.pi + 1e-9, 1e-10), FORMULA, 2.0 * math.pi)


def test_minus_signs() -> None:
    assert typeset("F = -3 ± 1e-08, AUTO-07p, non-zero") == "F = −3 ± 1e−08, AUTO-07p, non-zero"


def _with_printed(monkeypatch: pytest.MonkeyPatch, key: str, printed: str) -> None:
    """Print another value for one claim of (87) or (63)."""
    for name, make in (("eq63", linear.claims_63), ("eq87", linear.claims_87)):
        claims = [replace(c, printed=printed) if c.key == key else c for c in make()]
        monkeypatch.setitem(items.ITEMS, name, replace(items.ITEMS[name], claims=lambda claims=claims: claims))


def test_a_wrong_printed_value_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    good = run("--only", "eq63", "--no-figures", "--out", str(tmp_path / "good"))
    assert good.exit_code == 0, good.output
    _with_printed(monkeypatch, "eq63", "16.6")
    bad = run("--only", "eq63", "--no-figures", "--out", str(tmp_path / "bad"), "--json")
    assert bad.exit_code == 1
    data = json.loads(bad.output)
    assert data["passed"] is False
    assert data["findings"][0]["verdict"] == "differs"
    assert (tmp_path / "bad/agreement.md").exists(), "the table shows what differs"


def test_another_difference_than_the_documented_one_is_an_error() -> None:
    second = next(claim for claim in linear.claims_87() if claim.key == "eq87.2")
    from rodwell.studies.paper.work import Work

    off = replace(second, compute=lambda work: Value(157.0401, 1e-9))
    finding = off.check(Work())
    assert not finding.agrees
    assert not finding.documented
    assert finding.verdict == "differs"


def test_files_and_their_content(tmp_path: Path) -> None:
    done = run("--only", "fig10, eq87", "--out", str(tmp_path / "p"), "--jobs", "1")
    assert done.exit_code == 0, done.output
    names = ["agreement.html", "agreement.json", "agreement.md", "fig10.pdf", "fig10.png"]
    assert sorted(p.name for p in (tmp_path / "p").iterdir()) == names
    assert (tmp_path / "p/fig10.pdf").read_bytes().startswith(b"%PDF")
    assert (tmp_path / "p/fig10.png").read_bytes().startswith(b"\x89PNG")
    assert "157.0327802" in done.output
    text = (tmp_path / "p/agreement.md").read_text(encoding="utf-8")
    row = next(line for line in text.splitlines() if "157.032783 |" in line)
    assert "157.0327802" in row
    assert "differs, documented" in row
    html = (tmp_path / "p/agreement.html").read_text(encoding="utf-8")
    assert html.count("<tr ") == 5
    assert html.count('class="known"') == 2
    assert "http" not in html, "nothing from the network"
    data = json.loads((tmp_path / "p/agreement.json").read_text(encoding="utf-8"))
    assert [f["key"] for f in data["findings"]] == ["eq87.1", "eq87.2", "eq87.3", "eq87.engelhardt", "eq86.t1"]
    assert "tension positive" in data["convention"]


def test_figures_are_drawn_by_other_processes(tmp_path: Path) -> None:
    done = run("--only", "fig10,eq63", "--out", str(tmp_path), "--jobs", "2", "--json")
    assert done.exit_code == 0, done.output
    assert json.loads(done.output)["files"] == sorted(p.name for p in tmp_path.iterdir())
    assert {"fig10.png", "fig10.pdf"} <= {p.name for p in tmp_path.iterdir()}


def test_unknown_names_list_what_there_is(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"only = 'fig99': must be one or more of eq63, .*table1, fig3, .*fig13"):
        items.chosen(["fig3", "fig99"])
    done = run("--only", "fig99", "--out", str(tmp_path / "none"))
    assert isinstance(done.exception, InputError)
    assert not (tmp_path / "none").exists()
    with pytest.raises(InputError):
        items.chosen([])
    listed = run("--list")
    assert [line.split()[0] for line in listed.output.splitlines()] == list(items.ITEMS)


def test_nothing_is_written_if_a_figure_fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(_work: object) -> Any:
        raise rodwell.NotConvergedError("on purpose")

    monkeypatch.setitem(items.ITEMS, "fig10", replace(items.ITEMS["fig10"], figure=fails))
    done = run("--only", "fig10,eq63", "--out", str(tmp_path / "p"), "--jobs", "1")
    assert isinstance(done.exception, rodwell.NotConvergedError)
    assert not (tmp_path / "p").exists()


def test_bad_numbers_are_refused(tmp_path: Path) -> None:
    for option in (("--rtol", "1"), ("--jobs", "0")):
        done = run("--only", "eq63", *option, "--out", str(tmp_path / "p"))
        assert isinstance(done.exception, InputError), option
    assert not (tmp_path / "p").exists()


def test_claims_name_their_place() -> None:
    for item in items.ITEMS.values():
        for claim in item.claims() if item.claims else ():
            assert isinstance(claim, Claim)
            assert claim.place
            assert claim.quantity
            assert (claim.formula is None) == (claim.rule != FORMULA)


def test_the_loads_of_fig_13_are_those_of_closed_forms_where_modes_switch() -> None:
    """Where the horizontal clamped rod has a double load, (77) and (78): F = −π²(n² + (n + 2)²)."""
    lying, _ = stability.fig13(Work())
    for n in (1, 2, 3):
        at = int(np.argmin(np.abs(lying.weights - n**2 * (n + 2) ** 2 * np.pi**4 * CLEARANCE)))
        assert lying.exact[at] == pytest.approx(-(np.pi**2) * (n**2 + (n + 2) ** 2), rel=1e-8)


def test_stability_diagrams_are_those_of_maps_at_the_same_weights() -> None:
    """Curves are followed from point to point; a map computes each weight alone, from the straight rod on."""
    diagram = stability.inclined(Work(), "", 10.0, 60.0)
    ((weights, forces),) = diagram.lift_off
    first = diagram.critical[0]
    for quantity, x, loads in (("lift-off", weights, forces), ("critical", first.x, first.values)):
        chosen = slice(3, None, 1 + len(x) // 6)
        found = rodwell.map(diagram.problem, quantity, over={"weight": x[chosen]}, halvings=0)
        assert found.values.size > 3
        assert found.values == pytest.approx(loads[chosen], rel=1e-8)

"""Bad input of the rarer kinds: extreme sizes, wrong types, folds, folders in the way, text that looks like markup."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from rodwell import (
    Case,
    InputError,
    Problem,
    RodwellError,
    answer,
    critical_loads,
    equilibrium,
    follow,
)
from rodwell.answers.words.reach import unreached
from rodwell.case.case import CaseError
from rodwell.cli.main import main
from rodwell.quantities.units import to_si

PHYSICAL = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}
CASE = "[dimensionless]\nweight = 15.0\n[analysis]\nmodes = 1\nrtol = 1e-5\n"


def changed(section: str, key: str, value: object) -> dict[str, dict[str, object]]:
    return {name: (values | {key: value} if name == section else dict(values)) for name, values in PHYSICAL.items()}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    return tmp_path


def exit_code(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr(sys, "argv", ["rodwell", *arguments])
    try:
        main()
    except SystemExit as end:
        return int(end.code or 0)
    return 0


@pytest.mark.parametrize(
    "text",
    ["30,5 m", "[1,2] m", "30 m..", "m", "30 m + 2 cm", "3,000 mm", "9**9**9 m", "10**10**8 m", "1" * 100_000 + " m"],
    ids=lambda text: text[:12],
)
def test_text_is_never_evaluated(text: str) -> None:
    with pytest.raises(ValueError, match="for example"):
        to_si(text, "length")


@pytest.mark.parametrize(
    ("section", "key", "value"),
    [("rod", "length", "1e300 m"), ("rod", "outer_diameter", "1e-100 m"), ("hole", "diameter", "1e101 m")],
)
def test_sizes_beyond_sense(section: str, key: str, value: str) -> None:
    with pytest.raises(CaseError, match=rf"case: {section}\.{key} = .*check the unit"):
        Case.from_dict(changed(section, key, value))


@pytest.mark.parametrize(
    ("section", "key", "value", "blamed", "shown"),
    [
        ("rod", "inner_diameter", "11 cm", "rod.inner_diameter", "'11 cm'"),
        ("rod", "outer_diameter", "80 cm", "hole.diameter", "'70 cm'"),
        ("hole", "diameter", "1 km", "hole.diameter", "'1 km'"),
        ("hole", "angle_from_vertical", "3.2 rad", "hole.angle_from_vertical", "'3.2 rad'"),
    ],
)
def test_values_are_shown_as_they_were_written(section: str, key: str, value: str, blamed: str, shown: str) -> None:
    with pytest.raises(CaseError) as caught:
        Case.from_dict(changed(section, key, value))
    assert str(caught.value).startswith(f"case: {blamed} = {shown}: ")


def test_a_weight_beyond_sense_names_what_to_check() -> None:
    with pytest.raises(CaseError, match=r"γ = mg L³/B = .*check the units of length, weight or density, stiffness"):
        Case.from_dict(changed("rod", "length", "300 km"))


@pytest.mark.parametrize(
    "content", [b"a = " + b"[" * 5000 + b"]" * 5000, b"a = " + b"1" * 5000], ids=["deep", "digits"]
)
def test_files_that_no_parser_likes(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "well.toml").write_bytes(content)
    with pytest.raises(InputError, match=r"case file = .*is not valid TOML"):
        Case.read(tmp_path / "well.toml")


def test_byte_order_mark_is_no_harm(tmp_path: Path) -> None:
    (tmp_path / "well.toml").write_text(CASE, encoding="utf-8-sig")
    assert Case.read(tmp_path / "well.toml").problem.weight == 15.0


@pytest.mark.parametrize("data", [None, 5, "abc", [1], b"x"])
def test_a_case_must_be_a_dictionary(data: object) -> None:
    with pytest.raises(InputError, match="must be a dictionary of sections"):
        Case.from_dict(data)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("field", "value"),
    [("turns", math.nan), ("turns", math.inf), ("turns", "x"), ("turns", None), ("weight", 10**400), ("weight", True)],
    ids=str,
)
def test_problem_refuses_wrong_types(field: str, value: object) -> None:
    with pytest.raises(InputError, match=f"^{field}( = |: )"):
        Problem(**({"weight": 16.5} | {field: value}))  # type: ignore[arg-type]


CALLS: dict[str, Callable[[], object]] = {
    "count": lambda: critical_loads(Problem(16.5), math.nan),  # type: ignore[arg-type]
    "count none": lambda: critical_loads(Problem(16.5), None),  # type: ignore[arg-type]
    "rtol": lambda: critical_loads(Problem(16.5), rtol="x"),  # type: ignore[arg-type]
    "until": lambda: follow(Problem(16.5), until="x"),  # type: ignore[arg-type]
    "until huge": lambda: follow(Problem(16.5), until=-1e300),
    "until in tension": lambda: follow(Problem(16.5), until=1.0),
    "step": lambda: follow(Problem(16.5), largest_step="x"),  # type: ignore[arg-type]
    "mode": lambda: follow(Problem(16.5), mode="1"),  # type: ignore[arg-type]
    "mode of another": lambda: follow(Problem(16.5), critical_loads(Problem(17.0), 1)[0]),
    "force": lambda: equilibrium(Problem(16.5, turns=1), "x"),  # type: ignore[arg-type]
    "clearance": lambda: Problem(16.5, clearance=1e-300),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_calls_refuse_wrong_values(call: Callable[[], object]) -> None:
    with pytest.raises(RodwellError):
        call()


def test_a_branch_that_turns_across_the_cylinder_says_so() -> None:
    branch = follow(Problem(16.5, clearance=0.9), until=-57.0, rtol=1e-4)
    assert not branch.reached_end
    assert "|η| = 90°" in branch.ended_because


def test_a_load_beyond_a_fold_is_said_to_be_out_of_reach_with_the_load_of_the_fold() -> None:
    data = {
        "dimensionless": {"weight": 16.5, "clearance": 0.1},
        "load": {"until": -200.0},
        "analysis": {"modes": 1, "rtol": 1e-4},
    }
    (sentence,) = unreached(answer(Case.from_dict(data)).assessment)
    assert sentence.startswith("Not reached: the end force −200 B/L² at s = 1, asked for")
    assert "goes no farther than the end force −118.4" in sentence


def test_far_too_much_work_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rodwell.analysis.branch.watching.MOST_WORK", 2000.0)
    branch = follow(Problem(16.5), until=-2000.0)
    assert not branch.reached_end
    assert "work allowed for one branch is used up" in branch.ended_because


@pytest.mark.usefixtures("nothing_drawn")
def test_text_that_looks_like_markup(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (place / "case.toml").write_text('title = "a [bold] c"\n' + CASE, encoding="utf-8")
    assert exit_code(monkeypatch, "run", "case.toml", "--no-path", "--out", "x[b]") == 0
    printed = capsys.readouterr().out
    assert "a [bold] c" in printed
    assert "x[b]" in printed


@pytest.mark.usefixtures("nothing_drawn")
def test_a_folder_in_the_way_leaves_everything_as_it_was(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (place / "results" / "answer.json").mkdir(parents=True)
    (place / "results" / "report.html").write_text("old", encoding="utf-8")
    assert exit_code(monkeypatch, "run", "case.toml", "--no-path", "--out", "results") == 2
    assert "holds a folder 'answer.json'" in capsys.readouterr().err
    assert sorted(file.name for file in (place / "results").iterdir()) == ["answer.json", "report.html"]
    assert (place / "results" / "report.html").read_text(encoding="utf-8") == "old"


@pytest.mark.usefixtures("nothing_drawn")
def test_nothing_is_made_if_nothing_is_written(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("rodwell.report.pages.pdf.render", stopped)
    assert exit_code(monkeypatch, "run", "case.toml", "--no-path") == 130
    assert [file.name for file in place.iterdir()] == ["case.toml"]

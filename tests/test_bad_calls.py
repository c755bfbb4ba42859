"""Bad files, problems and calls: every error names what is wrong, what is allowed, and what to do."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from bad_cases import GONE, INF, NAN, PHYSICAL, changed

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.minimum import equilibrium
from rodwell.analysis.straight.critical import critical_loads
from rodwell.answers.result.answer import answer
from rodwell.answers.words.meaning import sentences
from rodwell.case.case import Case
from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem

BAD_FILES = [
    pytest.param(b"[rod\nlength = '30 m'\n", ("is not valid TOML", "line 1"), id="open-section"),
    pytest.param(b"[rod]\nlength = 30 m\n", ("is not valid TOML", "line 2"), id="no-quotes"),
    pytest.param(b"[rod]\nlength = \n", ("is not valid TOML", "line 2"), id="no-value"),
    pytest.param(b"[rod]\n[rod]\n", ("is not valid TOML", "twice"), id="section-twice"),
    pytest.param(b"\x00\xff\xfe\x80binary", ("is not text in UTF-8", "TOML"), id="binary"),
    pytest.param("[rod]\n".encode("utf-16"), ("is not text in UTF-8", "TOML"), id="utf-16"),
    pytest.param(b"", ("rod: is missing", "give [rod] and [hole], or [dimensionless]"), id="empty"),
    pytest.param(b"# only a comment\n", ("rod: is missing", "[dimensionless]"), id="comment"),
    pytest.param(b"rod = 5\n", ("rod = 5", "write [rod]"), id="rod-number"),
    pytest.param(b"[[rod]]\nlength = '30 m'\n", ("rod = ", "write [rod]"), id="list-of-tables"),
    pytest.param(b"[dimensionless]\nweight = nan\n", ("dimensionless.weight = nan", "must be finite"), id="nan"),
    pytest.param(b"[dimensionless]\nweight = 16.5\nalpha = 1979-05-27\n", ("dimensionless.alpha",), id="date"),
]


@pytest.mark.parametrize(("content", "phrases"), BAD_FILES)
def test_bad_file(tmp_path: Path, content: bytes, phrases: tuple[str, ...]) -> None:
    file = tmp_path / "well.toml"
    file.write_bytes(content)
    with pytest.raises(InputError) as caught:
        Case.read(file)
    assert "well.toml" in str(caught.value)
    for phrase in phrases:
        assert phrase in str(caught.value)


def test_missing_file_suggests_its_neighbour(tmp_path: Path) -> None:
    (tmp_path / "drill-string.toml").write_text("")
    with pytest.raises(InputError, match=r"does not exist; did you mean '.*drill-string\.toml'\?"):
        Case.read(tmp_path / "drill-sting.toml")


def test_missing_file_without_neighbours(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"case file = .*nothing\.toml'.*does not exist$"):
        Case.read(tmp_path / "no-such-folder" / "nothing.toml")


def test_folder_for_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is a folder; name a TOML file in it"):
        Case.read(tmp_path)


def test_file_below_a_file(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"case file = .*cannot be read"):
        Case.read(tmp_path / "file" / "well.toml")


def test_file_without_permission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> str:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(InputError, match=r"case file = .*cannot be read: Permission denied"):
        Case.read(tmp_path / "well.toml")


BAD_PROBLEMS = [
    pytest.param({"weight": -1.0}, "weight", "from 0 to 1e+09", id="weight-negative"),
    pytest.param({"weight": 1e10}, "weight", "from 0 to 1e+09", id="weight-large"),
    pytest.param({"weight": NAN}, "weight", "must be finite", id="weight-nan"),
    pytest.param({"weight": INF}, "weight", "must be finite", id="weight-inf"),
    pytest.param({"weight": "heavy"}, "weight", "must be a number", id="weight-text"),
    pytest.param({"weight": None}, "weight", "must be a number", id="weight-none"),
    pytest.param({"weight": [1.0]}, "weight", "must be a number", id="weight-list"),
    pytest.param({"weight": 1j}, "weight", "must be a number", id="weight-complex"),
    pytest.param({"alpha": 195.0}, "alpha", "from 0 (vertical) over 90 (horizontal) to 180", id="alpha-195"),
    pytest.param({"alpha": -1e-9}, "alpha", "from 0 (vertical) over 90 (horizontal)", id="alpha-negative"),
    pytest.param({"alpha": NAN}, "alpha", "must be finite", id="alpha-nan"),
    pytest.param({"clearance": 0.0}, "clearance", "above 0 and below 1", id="clearance-zero"),
    pytest.param({"clearance": -0.01}, "clearance", "above 0 and below 1", id="clearance-negative"),
    pytest.param({"clearance": 1.0}, "clearance", "above 0 and below 1", id="clearance-one"),
    pytest.param({"clearance": INF}, "clearance", "must be finite", id="clearance-inf"),
    pytest.param({"poisson": 0.51}, "poisson", "above -1 and at most 0.5", id="poisson-above"),
    pytest.param({"poisson": -1.0}, "poisson", "above -1 and at most 0.5", id="poisson-below"),
    pytest.param({"twist": NAN}, "twist", "must be finite", id="twist-nan"),
    pytest.param({"twist": "none"}, "twist", "must be a number", id="twist-text"),
    pytest.param({"turns": "half"}, "turns", "whole or not", id="turns-half"),
    pytest.param({"turns": True}, "turns", "must be a number", id="turns-true"),
    pytest.param({"turns": 1001}, "turns", "from -1000 to 1000", id="turns-many"),
    pytest.param({"turns": 20}, "turns", "cannot wind around so often at clearance 0.01", id="turns-for-length"),
    pytest.param({"on_top": 1}, "on_top", "must be True or False", id="on-top-number"),
    pytest.param({"on_top": "yes"}, "on_top", "must be True or False", id="on-top-text"),
]


@pytest.mark.parametrize(("values", "field", "remedy"), BAD_PROBLEMS)
def test_bad_problem(values: dict[str, Any], field: str, remedy: str) -> None:
    with pytest.raises(InputError) as caught:
        Problem(**({"weight": 16.5} | values))
    assert caught.value.field == field
    assert str(caught.value).startswith(field)
    assert remedy in str(caught.value)
    if values[field] is not None:
        assert repr(values[field]) in str(caught.value)
    with pytest.raises(InputError):
        Problem(16.5).but(**values)


HORIZONTAL = Problem(16.5)


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(HORIZONTAL, rtol=1e-4)


@pytest.fixture(scope="module")
def first_load(branch: Branch) -> float:
    assert branch.mode is not None
    return branch.mode.force


BAD_CALLS = [
    pytest.param(lambda: critical_loads(HORIZONTAL, 0), "modes", "from 1 to 200", id="count-zero"),
    pytest.param(lambda: critical_loads(HORIZONTAL, -1), "modes", "from 1 to 200", id="count-negative"),
    pytest.param(lambda: critical_loads(HORIZONTAL, 201), "modes", "from 1 to 200", id="count-large"),
    pytest.param(lambda: critical_loads(HORIZONTAL, 2.5), "modes", "whole number", id="count-fraction"),
    pytest.param(lambda: critical_loads(HORIZONTAL, True), "modes", "whole number", id="count-true"),
    pytest.param(lambda: critical_loads(HORIZONTAL, "3"), "modes", "whole number", id="count-text"),
    pytest.param(lambda: critical_loads(HORIZONTAL, rtol=0.0), "rtol", "from 1e-11", id="critical-rtol-zero"),
    pytest.param(lambda: critical_loads(HORIZONTAL, rtol=NAN), "rtol", "from 1e-11", id="critical-rtol-nan"),
    pytest.param(lambda: critical_loads(HORIZONTAL, rtol=0.1), "rtol", "to 0.01", id="critical-rtol-large"),
    pytest.param(lambda: critical_loads(HORIZONTAL.but(turns=1)), "turns", "turns must be 0", id="critical-coiled"),
    pytest.param(lambda: follow(HORIZONTAL, 0), "mode", "from 1 to 200", id="mode-zero"),
    pytest.param(lambda: follow(HORIZONTAL, 1.5), "mode", "whole number", id="mode-fraction"),
    pytest.param(lambda: follow(HORIZONTAL, until=NAN), "until", "finite end force", id="until-nan"),
    pytest.param(lambda: follow(HORIZONTAL, until=-INF), "until", "finite end force", id="until-inf"),
    pytest.param(lambda: follow(HORIZONTAL, rtol=1e-12), "rtol", "from 1e-11", id="follow-rtol-small"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=0.0), "largest_step", "from 0.0001 to 1", id="step-zero"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=-1), "largest_step", "from 0.0001 to 1", id="step-neg"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=2), "largest_step", "from 0.0001 to 1", id="step-large"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=NAN), "largest_step", "from 0.0001 to 1", id="step-nan"),
    pytest.param(
        lambda: follow(HORIZONTAL.but(on_top=True)), "until", "not pressed to the wall", id="on-top-without-until"
    ),
    pytest.param(lambda: follow(HORIZONTAL.but(turns=1)), "turns", "turns must be 0", id="follow-coiled"),
    pytest.param(lambda: equilibrium(HORIZONTAL.but(turns=1), NAN), "force", "finite end force", id="force-nan"),
    pytest.param(lambda: equilibrium(HORIZONTAL.but(turns=1), INF), "force", "finite end force", id="force-inf"),
    pytest.param(lambda: equilibrium(HORIZONTAL, -10.0), "turns", "must not be 0", id="equilibrium-without-turns"),
    pytest.param(lambda: equilibrium(HORIZONTAL.but(turns=1), -10.0, rtol=1.0), "rtol", "to 0.01", id="force-rtol"),
]


@pytest.mark.parametrize(("call", "field", "remedy"), BAD_CALLS)
def test_bad_call(call: Callable[[], object], field: str, remedy: str) -> None:
    with pytest.raises(InputError) as caught:
        call()
    assert str(caught.value).startswith(field)
    assert remedy in str(caught.value)


def test_until_is_the_critical_load(branch: Branch, first_load: float) -> None:
    assert branch.mode is not None
    with pytest.raises(InputError, match=r"until = .*must be below the critical load"):
        follow(HORIZONTAL, branch.mode, until=first_load)


def test_start_needs_an_end(branch: Branch) -> None:
    with pytest.raises(InputError, match=r"^until: must be given to follow a branch from a given state"):
        follow(HORIZONTAL, start=branch[3])
    with pytest.raises(InputError, match=r"^until = .*must differ"):
        follow(HORIZONTAL, start=branch[3], until=branch[3].force)


def test_start_of_another_problem(branch: Branch) -> None:
    with pytest.raises(InputError, match=r"^start = .*belongs to another problem"):
        follow(HORIZONTAL.but(weight=17.0), start=branch[3], until=-130.0)


@pytest.mark.parametrize("force", [1e5, -1e5])
def test_force_beyond_the_branch(branch: Branch, force: float) -> None:
    low, high = branch.force.min(), branch.force.max()
    with pytest.raises(InputError) as caught:
        branch.at(force)
    message = str(caught.value)
    assert message.startswith("force = ")
    assert f"covers {low:.6g} to {high:.6g} B/L²; follow it further" in message


@pytest.mark.parametrize("clearance", [0.3, 0.5, 0.9])
def test_load_beyond_ninety_degrees(clearance: float) -> None:
    case = Case.from_dict(
        {
            "dimensionless": {"weight": 16.5, "clearance": clearance},
            "load": {"until": -65.0},
            "analysis": {"modes": 1, "rtol": 1e-4},
        }
    )
    told = next(text for text in sentences(answer(case)) if text.startswith("Not reached: "))
    assert told.startswith(
        "Not reached: the end force −65 B/L² at s = 1, asked for: the branch of mode 1 goes no farther"
    )
    assert "than the end force −5" in told
    assert "the rod turned across the cylinder" in told


def test_load_beyond_ninety_degrees_in_newtons() -> None:
    data = changed(
        PHYSICAL,
        hole__diameter=GONE,
        hole__clearance="15 m",
        load__until="-80 kN",
        analysis={"modes": 1, "rtol": 1e-4},
    )
    told = [text for text in sentences(answer(Case.from_dict(data))) if text.startswith("Not reached: ")]
    assert len(told) == 1
    assert re.search(r"^Not reached: 80 kN of compression.*goes no farther than 6\d\.\d+ kN of compression", told[0])


@pytest.mark.parametrize(
    ("turns", "clearance", "force"),
    [
        pytest.param(3, 0.05, -10.0, id="winding-too-steep"),
        pytest.param(1, 0.15, -1000.0, id="compression-too-large"),
    ],
)
def test_coil_beyond_ninety_degrees(turns: int, clearance: float, force: float) -> None:
    with pytest.raises(NotConvergedError, match=rf"no coiled state found at F = {force:g} B/L².*\|η\| = 90°"):
        equilibrium(Problem(16.5, clearance=clearance, turns=turns), force)

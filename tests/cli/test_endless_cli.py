"""``rodwell.endless`` and ``rodwell endless``: what users hold and see, pictures, wrong input."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError


def run(line: str) -> Result:
    return CliRunner().invoke(cli, line.split(), catch_exceptions=False)


def run_json(line: str) -> Any:
    result = run(line + " --json")
    assert result.exit_code == 0
    return json.loads(result.output)


def test_states_at_a_load() -> None:
    """β = 3: numbers of two other programs (tests/analysis/endless/test_endless.py)."""
    text = run("endless --beta 3").output
    assert "contact mean        1.384684352" in text
    assert "contact mean         2.248630717" in text
    assert text.count("stable under dead load") == 2
    data = run_json("endless --beta 3")
    assert data["sinusoidal"]["contact_mean"]["value"] == pytest.approx(1.38468435, abs=1e-8)
    assert data["helical"]["frequency"]["value"] == pytest.approx(1.20880593, abs=1e-8)
    assert data["helical"]["contact_least"]["error"] < 1e-11
    assert data["sinusoidal"]["stability"]["stable"]
    assert data["converged"]
    assert "compression" in data["convention"]
    assert set(data["sinusoidal"]) >= {
        *("frequency", "amplitude", "energy", "contact_mean", "contact_largest", "contact_least", "rate_largest"),
    }


def test_loads_and_hysteresis() -> None:
    data = run_json("endless")
    loads = data["loads"]
    assert loads["buckling"] == {"value": 2.0, "error": 0.0}
    order = (
        *("buckling", "helix_ceases", "helix_lift_off", "straight_helix_equal_energy"),
        *("sinusoidal_helix_equal_energy", "sinusoidal_lift_off", "sinusoidal_ceases"),
    )
    values = [loads[name]["value"] for name in order]
    assert values == sorted(values)
    up, down = (next(s for s in data["history"] if s["leg"] == leg and s["jump"]) for leg in ("loading", "unloading"))
    assert (up["state"], up["jump"]["to"], up["to"]) == ("sinusoidal", "helical", loads["sinusoidal_lift_off"])
    assert (down["state"], down["jump"]["to"], down["to"]) == ("helical", "sinusoidal", loads["helix_lift_off"])
    for stage in (up, down):
        assert stage["jump"]["energy_lost"]["value"] > 0.0
    text = run("endless").output
    assert "sinusoidal from 2 to 3.541672, where it lifts off" in text
    assert "helical to 2.744687" in text


def test_the_slope_is_used() -> None:
    loads = run_json("endless --slope 0.3")["loads"]
    # weightless helices end at 4/(3√3 ε²); weight hardly changes that
    assert loads["helix_largest"]["value"] == pytest.approx(4.0 / 27**0.5 / 0.09, rel=1e-3)
    state = run_json("endless --beta 3 --slope 0.3")["helical"]
    assert state["contact_mean"]["value"] > 1.1 * 2.24863072


@pytest.mark.parametrize(
    ("slope", "states"),
    [(0.6, ["straight", "sinusoidal", "helical", "straight"]), (0.8, ["straight", "sinusoidal", "straight"])],
)
def test_very_steep_rods_have_no_helix_to_jump_to(slope: float, states: list[str]) -> None:
    """Above 4/(3√3 ε²) no helix bears the load: 2.14 at ε = 0.6, below the sinusoidal state's lift-off."""
    history = rodwell.endless(slope=slope).history
    assert [stage.state for stage in history] == states
    assert all(stage.jump is None for stage in history if stage.leg == "loading")


def test_where_there_is_no_state_the_reason_is_told() -> None:
    text = run("endless --beta 1.5").output
    assert "No sinusoidal state: at beta = 1.5 the rod is straight" in text
    data = run_json("endless --beta 6")
    assert data["sinusoidal"]["reached"] is False
    assert "end near beta = 5.2613" in data["sinusoidal"]["reason"]
    assert data["helical"]["reached"] is True
    assert "On paper only" in run("endless --beta 4").output


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_pictures(suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rodwell.plots.endless.STEPS", 6)
    file = tmp_path / f"states.{suffix}"
    assert f"Written: {file}" in run(f"endless --beta 3 --figure {file}").output.replace("\n", "")
    assert file.stat().st_size > 5000
    assert [item.name for item in tmp_path.iterdir()] == [file.name]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("endless --beta -3", "--beta = -3.0: must be a compression"),
        ("endless --beta nan", "--beta = nan: must be finite"),
        ("endless --beta 20000", "at most|to 10000"),
        ("endless --slope 1.5", "--slope = 1.5: must be from 0"),
        ("endless --figure states.txt", r"--figure = 'states.txt': must end in .png, .svg or .pdf"),
    ],
)
def test_wrong_input(line: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        run(line)


def test_what_users_hold() -> None:
    result = rodwell.endless(3)
    assert (
        repr(result) == "<endless rod at beta 3: sinusoidal: mean contact 1.38468 q; helical: mean contact 2.24863 q>"
    )
    assert repr(rodwell.endless(1)) == "<endless rod at beta 1: straight>"
    assert "on paper only" in repr(rodwell.endless(4.0))
    assert "sinusoidal_lift_off 3.54167" in repr(rodwell.endless())
    table = result._repr_html_()
    assert "helical state" in table
    assert "contact mean" in table
    assert rodwell.local_state(3.0).contact_mean == pytest.approx(result.states["sinusoidal"].contact_mean.value)
    with pytest.raises(InputError, match="number = 'weight': must be one of contact"):
        result.plot(number="weight")


def test_a_plot_shows_the_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    import matplotlib as mpl
    from matplotlib import pyplot

    mpl.use("Agg")
    monkeypatch.setattr("rodwell.plots.endless.STEPS", 6)
    ax = rodwell.endless(3.0).plot(number="shortening")
    dots = [line.get_xydata()[0] for line in ax.lines if line.get_marker() == "o"]
    assert sorted(float(y) for _, y in dots) == pytest.approx([0.19331089, 0.73385468], abs=1e-7)
    pyplot.close("all")

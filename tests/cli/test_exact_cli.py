"""``rodwell certify`` and ``rodwell modes`` on the command line."""

from __future__ import annotations

import json
from typing import Any

import pytest
from click.testing import CliRunner

from rodwell.cli.main import cli
from rodwell.errors import InputError


def run(line: str) -> str:
    result = CliRunner().invoke(cli, line.split(), catch_exceptions=False)
    assert result.exit_code == 0
    return result.output


def run_json(line: str) -> Any:
    return json.loads(run(line + " --json"))


def test_the_paper() -> None:
    """All printed values, the corrected root among them, and the verdicts."""
    text = run("certify")
    assert "157.032780152668906037880504306" in text
    assert "printed 157.032783: NOT as printed" in text
    assert text.rstrip().endswith("54 values, 53 of them as printed.")
    data = run_json("certify --digits 12")
    wrong = [value["printed"] for value in data["values"] if not value["printed_is_value_rounded"]]
    assert wrong == ["157.032783"]
    assert all(float(value["radius"]) < 1e-11 * abs(float(value["value"])) for value in data["values"])


def test_one_problem() -> None:
    """γ = 15, horizontal: loads of the paper's Fig. 3(c), rounded; proofs named."""
    text = run("certify --weight 15 --alpha 90 --modes 2 --digits 20")
    assert "−111.2334401619984454" in text
    assert "mode  2" in text
    assert "1 above; (77) changes sign" in text
    data = run_json("certify --weight 60 --alpha 35 --ends clamped-free --modes 1 --digits 15")
    (load,) = data["loads"]
    assert (load["mode"], load["loads_above"], load["loads_in_interval"], load["closed_form"]) == (1, 0, 1, "")
    assert data["problem"]["ends"] == "clamped-free"


@pytest.mark.parametrize("line", ["--alpha 30", "--modes 3", "--on-top", "--ends pinned-pinned", "--clearance 0.02"])
def test_weight_is_asked_for(line: str) -> None:
    with pytest.raises(InputError, match="is needed with"):
        run("certify " + line)


def test_modes() -> None:
    text = run("modes --weight 15")
    assert "switched once below this weight; last at γ = 8.76681819" in text
    assert "next at γ = 62.34181826 (n = 2, m = 4)" in text
    data = run_json("modes --weight 5 --pairs 2 --table 10")
    assert [pair["symmetry"] for pair in data["pairs"]] == [["even", "odd"]] * 2
    assert data["pairs"][0]["before"] is None
    assert len(data["table"]) == 20
    assert "modes, " not in run("modes --table 4")
    with pytest.raises(InputError, match="weight"):
        run("modes")
    with pytest.raises(InputError, match="weight"):
        run("modes --weight -1")

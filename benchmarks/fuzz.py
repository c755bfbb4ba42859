"""Texts that nobody foresaw, by Hypothesis: what is read is right or refused with an InputError, in less than a second.

    python benchmarks/fuzz.py [--examples 5000] [--seed 25] [--only axes]

Targets: values of the parameters of maps, questions of maps with cases, places of stores and addresses of schedulers,
catalogues, case files with ranges, surveys as text, and requests to the explorer. Damaged case and survey files have
campaigns of their own (``campaigns/case_files.py``, ``campaigns/survey_files.py``). Examples grow from words that
readers stumble over, and Hypothesis makes them small again where one fails. Writes ``results/fuzz.md``.
"""

from __future__ import annotations

import argparse
import datetime
import platform
import tempfile
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fuzz_explorer import TARGETS as OF_EXPLORER
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

import rodwell
from rodwell.case.catalogue import read_catalogue
from rodwell.errors import InputError
from rodwell.store.chunked import opened
from rodwell.studies.maps.axes import MOST_VALUES, Axis, read
from rodwell.studies.maps.question import asked
from rodwell.studies.maps.workers import ADDRESS, working
from rodwell.studies.sweep.varied import varied_inputs

OUT = Path(__file__).parent / "results" / "fuzz.md"
SLOWEST = 1.0
"""Seconds of processor time in which a text must be read or refused."""

WORDS = st.sampled_from(
    [
        *("..", "...", "…", " in ", "log", ", ", ",", ";", "[", "]", "(", ")", "( " * 400, "[" * 400, "-", "−", "+"),
        *("e", "E9", "1e308", "1e-320", "1e999", "nan", "inf", "NaN", "0", "0.1", ".5", "5.", "12", "1,000", "1.000,5"),
        *("35 000", "9" * 300, "3", "200", "99999999", "m", " m", "cm", " deg", "kN", "°", "µm", "normal", "normal("),
        *("uniform(1, 2)", "triangular(", "loguniform(0, 1)", "±", "\0", "\x1b[31m", "\n", "\t", " ", "\u202e"),
        *("\ud7ff", "٣", "²", "_", "=", '"', "'", "true", "clamped-clamped", "pinned", "1..2 in 3", "60..90 deg in 4"),
    ]
)
TEXTS = st.lists(WORDS | st.text(max_size=6), max_size=9).map("".join)
RANGES = st.tuples(TEXTS, TEXTS, TEXTS).map(lambda three: f"{three[0]}..{three[1]} in {three[2]}")
LISTS = st.lists(st.floats() | st.integers() | TEXTS | st.none() | st.booleans() | st.lists(st.floats()), max_size=5)
NUMBERS = st.sampled_from(["1", "0.5", "2e1", "-3", "0", "80"])
GOOD = st.tuples(
    NUMBERS, NUMBERS, st.sampled_from(["2", "3 log", "5"]), st.sampled_from(["", " m", " cm", " deg"])
).map(lambda four: f"{four[0]}..{four[1]}{four[3]} in {four[2]}")
VALUES = TEXTS | RANGES | LISTS | GOOD
PLACES = TEXTS.map(lambda text: text.replace("\0", "")) | st.tuples(
    st.sampled_from(["memory://", "file://", "s3://", "http://", "nosuch://", "://", "tcp://"]), TEXTS
).map("".join)

CASE = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "inner_diameter": "0 m", "youngs_modulus": "200 GPa",
            "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}  # fmt: skip
KEYS = st.sampled_from(
    ["rod.length", "rod.density", "hole.diameter", "hole.angle_from_vertical", "load.applied", "analysis.rtol", "rod",
     "a.b", ".", "rod.", "title", "rod.length.x"]
)  # fmt: skip


def axes(value: Any) -> None:
    axis = read("weight", value)
    if isinstance(axis, Axis):
        assert 2 <= len(axis.values) <= MOST_VALUES
        assert axis.numbers is None or len(axis.numbers) == len(axis.values)


def questions(pair: tuple[str, Any]) -> None:
    question = asked(CASE, "critical", {pair[0]: pair[1], "rod.length": "20..30 m in 3"})
    assert question.size >= 3


def problems(pair: tuple[str, Any]) -> None:
    asked(rodwell.Problem(15.0, 90.0), "critical", {pair[0]: pair[1], "weight": "20..30 in 3"})


def stores(place: str) -> None:
    """Places in an empty folder; what is made there must be a store, and only there."""
    if place.startswith(("s3://", "http://")) or place.lstrip().startswith(("/", "~")) or ".." in place:
        return  # no network here, and nothing outside of the folder
    with tempfile.TemporaryDirectory() as folder:
        where = place if "://" in place else str(Path(folder) / (place or "x"))
        with opened(
            where, {"quantity": "critical"}, lambda group: group.attrs.update({"question": {"quantity": "critical"}})
        ):
            pass


def schedulers(place: str) -> None:
    if place.startswith(("s3://", "http://", "memory://")):
        return
    with working(1, place):
        raise AssertionError("a scheduler where there is none")


def catalogues(text: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "pipes.toml").write_text(text, encoding="utf-8", errors="replace")
        read_catalogue(["pipes.toml"], Path(folder))


def studies(value: Any) -> None:
    varied_inputs({"study": True, **CASE, "hole": {**CASE["hole"], "angle_from_vertical": value}})


def surveys(text: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "survey.csv"
        file.write_text("MD [m],Inc [deg]\n0,0\n10,5\n" + text, encoding="utf-8", errors="replace")
        rodwell.read_surveys(file)


KINDS = st.sampled_from(["pipe", "material", "grade", "tool", "x"])
ENTRY = st.tuples(KINDS, TEXTS, st.sampled_from(["outer_diameter", "density", "x"]), TEXTS).map(
    lambda four: f'[{four[0]}."{four[1]}"]\n{four[2]} = "{four[3]}"\n'
)

TARGETS: dict[str, tuple[Callable[[Any], None], Any]] = {
    "axes": (axes, VALUES),
    "problems": (problems, st.tuples(st.sampled_from(["alpha", "ends", "twist", "clearance", "load", "x"]), VALUES)),
    "questions": (questions, st.tuples(KEYS, VALUES)),
    "stores": (stores, PLACES),
    "schedulers": (schedulers, TEXTS.filter(lambda text: not ADDRESS.fullmatch(text))),
    "catalogues": (catalogues, TEXTS | ENTRY | st.lists(ENTRY, max_size=3).map("".join)),
    "studies": (studies, VALUES),
    "surveys": (surveys, TEXTS | st.lists(TEXTS, max_size=6).map("\n".join)),
    **OF_EXPLORER,
}
"""What is fuzzed, and with what."""

DEAR = {"schedulers": 20, "stores": 5, "catalogues": 2, "surveys": 2}
"""Targets that take longer get so many times fewer examples."""


def fuzzed(name: str, examples: int, number: int) -> dict[str, Any]:
    """Try one target; how many texts were read, how many refused, and the smallest that did something else."""
    function, strategy = TARGETS[name]
    seen = {"read": 0, "refused": 0, "slowest": 0.0, "fault": ""}

    @seed(number)
    @settings(
        max_examples=max(1, examples // DEAR.get(name, 1)),
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
        phases=(Phase.generate, Phase.shrink),
    )
    @given(strategy)
    def trial(value: Any) -> None:
        start = time.process_time()
        try:
            function(value)
            seen["read"] += 1
        except InputError:
            seen["refused"] += 1
        spent = time.process_time() - start
        seen["slowest"] = max(seen["slowest"], spent)
        assert spent < SLOWEST, f"{spent:.1f} s"

    try:
        trial()
    except Exception:
        seen["fault"] = "\n".join(traceback.format_exc().splitlines()[-12:])
    return seen


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--examples", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=25)
    parser.add_argument("--only", choices=list(TARGETS))
    options = parser.parse_args()
    import rodwell.studies.maps.workers as of_workers  # noqa: PLC0415

    of_workers.TIMEOUT = 0.2
    found = {}
    for name in TARGETS if options.only is None else [options.only]:
        fuzzed(name, 3, 0)  # imports
        found[name] = fuzzed(name, options.examples, options.seed)
        print(name, found[name], flush=True)
    if options.only is not None:
        return
    lines = [
        "# Texts that nobody foresaw", "",
        f"`python benchmarks/fuzz.py --examples {options.examples} --seed {options.seed}`, "
        f"{datetime.date.today().isoformat()}, rodwell {rodwell.__version__}, {platform.machine()}, Python "
        f"{platform.python_version()}.", "",
        "| Target | Read | Refused with an InputError | Slowest, s | Anything else |",
        "| --- | --- | --- | --- | --- |",
        *(f"| {name} | {one['read']} | {one['refused']} | {one['slowest']:.2f} | {one['fault'] or 'none'} |"
          for name, one in found.items()),
        "",
    ]  # fmt: skip
    OUT.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()

"""Whether the tests notice: a seeded sample of small changes of physics, numerics and units, each tested alone.

    pip install cosmic-ray
    python benchmarks/campaigns/mutants.py [--count 300] [--workers 1]

The changes are those of cosmic-ray: another operator, another number, a comparison that is another, a loop that is not
run, a decorator that is gone. Each is made in a copy of the tree, and the tests of the room it stands in, the quickest
first, run until one fails. What kernels are made of is changed and tested uncompiled (:mod:`interpreted`), with the
tests that take less than ``QUICK`` seconds so; all else as users have it. A change that no test noticed is told with
its line: it is to be explained, or a test to be written. Results go to ``mutants.json`` beside this file; a campaign
that was broken off goes on where it ended.
"""

from __future__ import annotations

import difflib
import functools
import inspect
import json
import random
from collections import Counter
from pathlib import Path
from typing import Any

import mutants_tried
import resumable
from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names
from mutants_tried import SOURCE

HERE = Path(__file__).parent
SEED, LINES, SUMMARY = 25, HERE / "mutants.jsonl", HERE / "mutants.json"
PAGE = HERE.parent / "results" / "mutants.md"

SURVIVORS: dict[str, dict[str, str]] = json.loads((HERE / "mutants_survivors.json").read_text(encoding="utf-8"))
"""Changes that live, or may, each with the test that was written for it, or why it is the same program; and whether it
lived before that test was there."""

DRAWN, DRAW = HERE / "mutants_drawn.json", 300
"""The sample, a change each: file, operator, which of its occurrences, lines; and how many are drawn."""

LONGEST = 60.0
"""Seconds of the processor after which a test that was written for a change has failed."""

LEFT_OUT = "_density.py", "_curved_density.py", "__init__.py"
"""Written by the program itself, and held against what writes them by a test; names alone."""

Mutant = tuple[str, str, int]  # path in src/rodwell, operator, which of its occurrences


@functools.cache
def every_mutant() -> list[Mutant]:
    """All changes that can be made."""
    found = []
    for room in ("physics", "numerics", "quantities"):
        for path in sorted((SOURCE / room).rglob("*.py")):
            if path.name in LEFT_OUT:
                continue
            nodes = list(ast_nodes(get_ast(path.read_text(encoding="utf-8"))))
            name = path.relative_to(SOURCE).as_posix()
            for operator in sorted(operator_names()):
                made = _operator(operator)
                if made is not None:
                    count = sum(1 for node in nodes for _ in made.mutation_positions(node))
                    found += [(name, operator, k) for k in range(count)]
    return found


def _operator(name: str) -> Any:
    """An operator; none for those that want arguments, change nothing, or change what is written for readers of types.

    Annotations are not evaluated: ``X | None`` with another operator is the same program.
    """
    made = get_operator(name)
    return None if list(made.arguments()) or name.endswith(("NoOp", "_BitOr")) or "BitOr_" in name else made()


@functools.cache
def drawn() -> list[tuple[str, str, int, list[str]]]:
    """The changes that were drawn: file, operator, which of its occurrences, and the lines that changed."""
    if not DRAWN.exists():
        chosen = random.Random(SEED).sample(every_mutant(), DRAW)
        kept = ",\n".join(json.dumps([*one, _change(one)[1]], ensure_ascii=False) for one in chosen)
        DRAWN.write_text(f"[\n{kept}\n]\n", encoding="utf-8")
    return [tuple(one) for one in json.loads(DRAWN.read_text(encoding="utf-8"))]


@functools.cache
def mutant(number: int) -> Mutant:
    """A change as it is found in the sources now: the same occurrence, another one, or another change of the file."""
    name, operator, occurrence, change = drawn()[number]
    if _change((name, operator, occurrence))[1] == change:
        return name, operator, occurrence
    every = [one for one in every_mutant() if one[0] == name]
    same = sorted((one for one in every if one[1] == operator), key=lambda one: abs(one[2] - occurrence))
    gone = random.Random(f"{SEED} {occurrence} {change}").choice(every)
    return next((one for one in same if _change(one)[1] == change), gone)


def _changed(number: int) -> tuple[str, str, list[str]]:
    """File, its text with a change, and the lines that changed."""
    return mutant(number)[0], *_change(mutant(number))


@functools.cache
def _change(one: Mutant) -> tuple[str, list[str]]:
    """The text of a file with a change, and the lines that changed; none if there is no such occurrence."""
    name, operator, occurrence = one
    before = (SOURCE / name).read_text(encoding="utf-8")
    after = mutate_code(before, _operator(operator), occurrence) or before
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0)
    return after, [line for line in lines if line[:1] in "+-" and line[:3] not in ("+++", "---")]


def trial(number: int) -> resumable.Result:
    """Make one change, test it, take it back."""
    name, after, change = _changed(number)
    operator = mutant(number)[1].rpartition("/")[2]
    known: resumable.Result = {
        "number": number, "file": name, "operator": operator, "change": change, "fault": None,
    }  # fmt: skip
    try:
        compile(after, name, "exec")
    except SyntaxError:
        return known | {"outcome": "no program"}
    tests = mutants_tried.chosen(name, resumable.done(LINES))
    with mutants_tried.changed(name, after):
        outcome, said = mutants_tried.run_tests(tests, name, longest=mutants_tried.MOST)
    return known | {
        "interpreted": mutants_tried.interpreted(name),
        "tests": len(tests),
        "outcome": "survived" if outcome == "passed" else "killed",
        "how": said if outcome == "failed" else outcome,
    }


def known_of(one: resumable.Result) -> dict[str, str]:
    """What was done about a change; nothing of most."""
    return SURVIVORS.get(f"{one['file']}: {one['change'][-1][1:].strip()}", {})


def seen_to(one: resumable.Result) -> resumable.Result:
    """A survivor with what was done about it: the test that notices it now, tried; or why it is the same program."""
    what = known_of(one)
    told_of = {key: one[key] for key in ("number", "file", "operator", "change")} | what
    if "test" not in what:
        return told_of
    name, after, _ = _changed(one["number"])
    with mutants_tried.changed(name, after):
        outcome, _ = mutants_tried.run_tests([what["test"]], name, longest=LONGEST)
    return told_of | {"noticed now": outcome != "passed"}


def told(results: list[resumable.Result]) -> resumable.Result:
    """What the summary says."""
    outcomes = Counter(result["outcome"] for result in results)
    survivors = [seen_to(one) for one in results if one["outcome"] == "survived"]
    before = sum(one["outcome"] == "killed" and "lived" in known_of(one) for one in results)
    noticed = before + sum(one.get("noticed now", False) for one in survivors)
    at_first, programs = outcomes["killed"] - before, len(results) - outcomes["no program"]
    by_file: dict[str, Counter[str]] = {}
    for one in results:
        by_file.setdefault(one["file"].rpartition("/")[0], Counter())[one["outcome"]] += 1
    return {
        "what": inspect.cleandoc(__doc__ or "").splitlines()[0], "changes that can be made": len(every_mutant()),
        "no program": outcomes["no program"], "programs": programs,
        "killed at first": at_first, "share killed at first": round(at_first / programs, 4),
        "killed by tests written since": noticed, "share killed": round((at_first + noticed) / programs, 4),
        "rooms": by_file, "survivors": survivors,
    }  # fmt: skip


def page(summary: resumable.Result) -> str:
    """The summary, to read."""
    lines = [
        f"`python benchmarks/campaigns/mutants.py --count {summary['count']}`, seed {summary['seed']}, "
        f"{summary['date']}, {summary['machine']}. Of {summary['changes that can be made']:,} changes of physics, "
        f"numerics and units that cosmic-ray can make, {summary['count']} were drawn; of these {summary['no program']} "
        f"{'is' if summary['no program'] == 1 else 'are'} no program; {summary['programs']} were tested.", "",
        "| | |", "| --- | --- |",
        f"| noticed by the quickest tests of the room | {summary['killed at first']} "
        f"({summary['share killed at first']:.1%}) |",
        f"| … with the tests that were written for those that lived | {summary['share killed']:.1%} |", "",
        "| Room | Changes | Noticed at first | Lived | No program |", "| --- | --- | --- | --- | --- |",
        *(
            f"| {room} | {sum(n.values())} | {n['killed']} | {n['survived']} | {n['no program']} |"
            for room, n in sorted(summary["rooms"].items())
        ), "",
        "Those that lived:", "", "| File | Was | Is | What of it |", "| --- | --- | --- | --- |",
    ]  # fmt: skip
    for one in summary["survivors"]:
        was, now = (" ".join(x[1:].strip() for x in one["change"] if x[0] == sign) for sign in "-+")
        what = f"noticed by `{one['test'].rpartition('/')[2]}`" if one.get("noticed now") else one.get("why", "open")
        lines.append(f"| {one['file']} | {_code(was)} | {_code(now)} | {what} |")
    return "\n".join(lines) + "\n"


def _code(text: str) -> str:
    return f"`{text}`".replace("|", "\\|")


if __name__ == "__main__":
    for one in resumable.done(LINES):
        if _changed(one["number"])[2] != one["change"]:
            raise SystemExit(f"{LINES} is of other sources: move it away")
    _, summary = resumable.campaign(__doc__ or "", trial, SEED, LINES, SUMMARY, told)
    PAGE.write_text(page(summary), encoding="utf-8")
    print(json.dumps({k: v for k, v in summary.items() if k not in ("survivors", "rooms")}, indent=1))

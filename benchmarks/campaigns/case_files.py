"""Mutated case files and catalogues end in a case or in a message, each in less than a second: seeded, resumable.

    python benchmarks/campaigns/case_files.py [--files 20000] [--seed 18]

Every file is an example, or a catalogue with a case that names it, with one to six mutations drawn from its own seed:
bytes, lines, values, pieces of other files, and texts that readers choke on (control characters, towers of powers, long
runs of brackets). It is read as ``rodwell run`` reads it, and nothing is computed. Allowed are a case, or an InputError
whose text can be printed. Results go to ``case_files.json`` beside this file; a campaign that was broken off goes on
where it ended (``case_files.part``).
"""

from __future__ import annotations

import argparse
import json
import platform
import random
import re
import signal
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from datetime import date
from functools import cache
from pathlib import Path
from typing import Any

import rodwell
from rodwell.case.case import Case
from rodwell.case.file import read_case
from rodwell.errors import InputError
from rodwell.studies.sweep.varied import is_study, varied_inputs

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
OUT, PART = HERE / "case_files.json", HERE / "case_files.part"

ALLOWED = 1.0
"""Seconds of the processor that reading may take."""

LONGEST = 30
"""Seconds after which reading is broken off."""

OWN = """source = "the user's"

[[pipe]]
name = "my pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
weight_per_length = "19.5 lbf/ft"
material = "my steel"

[[material]]
name = "my steel"
youngs_modulus = "206 GPa"
density = "7850 kg/m^3"
aliases = ["steel of mine"]

[[grade]]
name = "mine"
yield_strength = "110 ksi"
"""
"""A catalogue."""

NAMES_IT = """title = "with a catalogue"
[rod]
length = "30 m"
pipe = "my pipe"
grade = "mine"
[hole]
diameter = "8.5 in"
angle_from_vertical = "80 deg"
[catalogue]
files = ["own.toml"]
"""
"""A case that takes its pipe from it."""

NASTY = [
    "\x00", "\x1b[31m", "\\u0000", "\\u001b]0;x\\u0007", "\\u202e", "\ufeff", "\r", "\u2028", "\ud7ff", "é", "−", "±",
    "+/-", "..", "1e999", "-0", "nan", "inf", "1e-400", "9" * 400, "0x" + "f" * 90, "9**9**9", "m^9^9^9",
    "((m^9)^9)^9", "a" * 59 + "!", "[" * 300, "{" * 60, '"' * 7, "'''", '"""', "\\", "#", "=", "[[", "]]", "true",
    "1979-05-27T07:32:00Z", "in 400", "1..2 m in 3", "30..90 deg in 13", "30 m ± 2 %", "30 m ± 30 m",
    ", ".join("1" * 99),
    "a." * 40, " " * 2000, "\t" * 50, "lbf" * 30, "%s%n{}", "../../../etc/passwd", "/dev/zero", "/dev/stdin", "=1+1",
    "title = 5\n", "[rod]\n", "[rod.length]\n", "rod = 1\n", "[load]\n", "length = []\n", "applied = [1, 'x']\n",
]  # fmt: skip
"""Texts that readers choke on."""


@cache
def corpus() -> list[str]:
    """Files to start from."""
    examples = sorted((ROOT / "examples").glob("*.toml"))
    return [file.read_text(encoding="utf-8") for file in examples]


def _bytes(text: str, draw: random.Random) -> str:
    raw = bytearray(text.encode("utf-8", "replace"))
    for _ in range(draw.randint(1, 5)):
        raw[draw.randrange(len(raw))] = draw.choice([draw.randrange(32, 127), draw.randrange(256)])
    return raw.decode("utf-8", "surrogateescape")


def _insert(text: str, draw: random.Random) -> str:
    at = draw.randrange(len(text) + 1)
    return text[:at] + draw.choice(NASTY) + text[at:]


def _cut(text: str, draw: random.Random) -> str:
    a, b = sorted(draw.randrange(len(text) + 1) for _ in range(2))
    return text[:a] + text[min(b, a + 40) :]


def _repeat(text: str, draw: random.Random) -> str:
    a, b = sorted(draw.randrange(len(text) + 1) for _ in range(2))
    return text[:a] + text[a : a + min(b - a, 30)] * draw.choice([2, 3, 50, 2000]) + text[a:]


def _lines(text: str, draw: random.Random) -> str:
    lines = text.splitlines(keepends=True)
    a, b = draw.randrange(len(lines)), draw.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[draw.choice([a, b])]
    return "".join(lines)


def _value(text: str, draw: random.Random) -> str:
    """Another value for a key: nasty, quoted or not, in a list or not."""
    found = list(re.finditer(r"(?m)^(\s*[\w.]+\s*=\s*)(.*)$", text))
    if not found:
        return text
    one, new = draw.choice(found), draw.choice([*NASTY, *re.findall(r'"[^"\n]*"|[\d.]+', text)])
    new = draw.choice(["{}", '"{}"', "'{}'", "[{0}, {0}]", '["{}"]', "{{x = {}}}", "-{}"]).format(new)
    return text[: one.start(2)] + new + text[one.end(2) :]


def _within(text: str, draw: random.Random) -> str:
    """Something nasty within a quoted text."""
    found = list(re.finditer(r'"([^"\n]*)"', text))
    if not found:
        return text
    at = draw.randint(*draw.choice(found).span(1))
    return text[:at] + draw.choice(NASTY) + text[at:]


def _splice(text: str, draw: random.Random) -> str:
    other = draw.choice(corpus())
    a, b = draw.randrange(len(text) + 1), draw.randrange(len(other))
    return text[:a] + other[b : b + 200] + text[a:]


MUTATIONS: list[Callable[[str, random.Random], str]] = [
    _bytes, _insert, _cut, _repeat, _lines, _value, _value, _within, _within, _splice,
]  # fmt: skip


def mutated(seed: int) -> tuple[str, bytes]:
    """What is mutated, "case" or "catalogue", and its bytes."""
    draw = random.Random(seed)
    kind = draw.choice(["case", "case", "catalogue"])
    text = draw.choice(corpus()) if kind == "case" else OWN
    for _ in range(draw.choice([1, 1, 2, 3, 6])):
        text = draw.choice(MUTATIONS)(text or "x", draw) or "x"
    return kind, text.encode("utf-8", "surrogateescape" if draw.random() < 0.7 else "replace")


def outcome(kind: str, raw: bytes, folder: Path) -> str:
    """Read a file as ``rodwell run`` does: "case", "study", "refused", or what went wrong."""
    case = folder / "case.toml"
    if kind == "case":
        case.write_bytes(raw)
    else:
        (folder / "own.toml").write_bytes(raw)
        case.write_text(NAMES_IT, encoding="utf-8")
    try:
        read = read_case(case)
        if is_study(read):
            varied_inputs(read.data)
            return "study"
        title = Case.read(read).title
    except InputError as error:
        text = str(error)
        return "refused" if text.replace("\n", "").isprintable() else f"not printable: {text[:200]!a}"
    except Exception as error:  # the campaign is here to find these
        return f"{type(error).__name__}: {str(error)[:200]!a}"
    return "case" if title.isprintable() else f"title not printable: {title[:200]!a}"


def trial(seed: int, folder: Path) -> dict[str, Any]:
    """One file: what was mutated, what came of it, and in how many seconds of the processor."""
    kind, raw = mutated(seed)
    start = time.process_time()
    found = outcome(kind, raw, folder)
    return {"seed": seed, "kind": kind, "outcome": found, "seconds": round(time.process_time() - start, 4)}


def fault(one: dict[str, Any]) -> bool:
    """Whether a file was neither read nor refused, or took too long."""
    return one["outcome"] not in ("case", "study", "refused") or one["seconds"] >= ALLOWED


def _too_long(*_: object) -> None:
    raise TimeoutError(f"not read in {LONGEST} s")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--files", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=18)
    given = parser.parse_args()
    signal.signal(signal.SIGALRM, _too_long)
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if one["seed"] // 1_000_000 == given.seed]
    with PART.open("a") as part, tempfile.TemporaryDirectory() as folder:
        trial(0, Path(folder))  # imports and the registry of units are not reading
        for number in range(len(done), given.files):
            signal.alarm(LONGEST)
            done.append(trial(given.seed * 1_000_000 + number, Path(folder)))
            signal.alarm(0)
            part.write(json.dumps(done[-1]) + "\n")
            part.flush()
    seconds = sorted(one["seconds"] for one in done)
    result = {
        "what": "mutated case files and catalogues, read and not computed",
        "seed": given.seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
        "files": len(done), "kinds": dict(Counter(one["kind"] for one in done).most_common()),
        "outcomes": dict(Counter(one["outcome"] for one in done).most_common(20)),
        "seconds": {"median": seconds[len(seconds) // 2], "largest": seconds[-1], "in_all": round(sum(seconds), 1)},
        "faults": [one for one in done if fault(one)],
    }  # fmt: skip
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PART.unlink()
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()

"""Damaged survey files end in an InputError or in a survey that holds together: 20,000 mutants, seeded, resumable.

    python benchmarks/campaigns/survey_files.py [--mutants 20000] [--seed 18]

Every mutant is drawn from its own seed: a survey file of one of the kinds that are read, damaged in one to four
places (bytes turned, cut out, doubled, moved; words that readers stumble over put in; XLSX also inside its archive).
It must be read, or refused with an InputError, in less than a second of processor time. Results go to
``survey_files.json`` beside this file; a run that was broken off goes on where it ended (``survey_files.part``).
"""

from __future__ import annotations

import argparse
import io
import json
import platform
import tempfile
import time
import traceback
import zipfile
from collections import Counter
from collections.abc import Callable, Sequence
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl

import rodwell
from rodwell import InputError

HERE = Path(__file__).parent
OUT, PART = HERE / "survey_files.json", HERE / "survey_files.part"
SLOWEST = 1.0
"""Seconds of processor time in which a mutant must be read or refused."""

Rows = Sequence[tuple[float, float, float | None]]

STUMBLES = [
    b'"', b'""', b",", b";", b"\t", b"|", b"\n", b"\r", b"\0", b"\xff\xfe", b"\xef\xbb\xbf", b"\xb0", b"-999.25",
    b"NaN", b"inf", b"1e308", b"1e999", b"-0", b"1,234", b"1.234,5", b"0,5", b"(" * 3000, b"[" * 3000, b"( " * 3000,
    b"9" * 400, b" " * 50000, b"~A\n", b"~C\n", b"#", b"MD", b"Azi", b"Inc [deg]", b"\xc2\xa0", b"=HYPERLINK(1)",
    b"\x1b[31m", b"m",
    b"ft", b"_" * 5000, "−".encode(), "٣".encode(), "²".encode(), b"1_000", b"0x10", b"Well,", b"NULL. nan :\n", b"  ",
    b"~Version\n",
]  # fmt: skip


def delimited(rows: Rows, separator: str = ",", decimal: str = ".", digits: int | None = None) -> str:
    """A table with a header, cells separated by ``separator``; an azimuth that is None is left empty."""

    def cell(value: float | None) -> str:
        text = "" if value is None else repr(value) if digits is None else f"{value:.{digits}f}"
        text = text.replace(".", decimal)
        return f'"{text}"' if separator in text or (not text and not separator.strip()) else text

    head = ("MD [m]", "Inc [deg]", "Azi [deg]")
    names = [f'"{name}"' if separator == " " else name for name in head]
    return "\n".join([separator.join(names), *(separator.join(map(cell, row)) for row in rows)]) + "\n"


def petrel(rows: Rows) -> str:
    """A deviation file as Petrel writes them."""
    head = ["# WELL TRACE FROM PETREL", "# WELL NAME:              A-1 H", "# WELL HEAD X-COORDINATE: 456979.06 (m)",
            "# MD AND TVD ARE REFERENCED (=0) AT WELL DATUM AND INCREASE DOWNWARDS", "# ANGLES ARE GIVEN IN DEGREES",
            "# DX DY ARE GIVEN IN GRID NORTH IN m-UNITS", "# DEPTH (Z, TVD) GIVEN IN m-UNITS", "#" + "=" * 90,
            "      MD       X       Y      Z      TVD      DX      DY   AZIM_TN     INCL     DLS    AZIM_GN",
            "#" + "=" * 90]  # fmt: skip
    body = [f" {md!r} 456979.0 6782712.0 {-md!r} {md!r} 0.0 0.0 {azi!r} {inc!r} 0.0 {azi!r}" for md, inc, azi in rows]
    return "\n".join([*head, *body]) + "\n"


def las(rows: Rows, null: str = "-999.25") -> str:
    """A LAS 2.0 file of three curves."""
    head = ["~Version", " VERS. 2.0 : CWLS LOG ASCII STANDARD", " WRAP. NO :", "~Well", " STRT.M 0 :", " STOP.M 1 :",
            " STEP.M 0 :", f" NULL. {null} :", " WELL. A-1 H : WELL", "~Curve", " MD .M : measured depth",
            " DEVI.DEG : hole deviation", " HAZI.DEG : hole azimuth", "~Ascii"]  # fmt: skip
    body = [f" {md!r} {inc!r} {null if azi is None else repr(azi)}" for md, inc, azi in rows]
    return "\n".join([*head, *body]) + "\n"


def xlsx(rows: Rows, above: int = 0, name: str = "Survey") -> bytes:
    """A workbook of one sheet, with ``above`` rows of other things above the header."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = name
    for i in range(above):
        sheet.append([f"Line {i}", "of a report"])
    for row in [("MD [m]", "Inc [deg]", "Azi [deg]"), *rows]:
        sheet.append(list(row))
    kept = io.BytesIO()
    book.save(kept)
    return kept.getvalue()


KINDS: dict[str, Callable[[Rows], bytes]] = {
    "comma": lambda rows: delimited(rows).encode(),
    "semicolon, decimal commas": lambda rows: delimited(rows, ";", ",").encode("cp1252"),
    "tab, UTF-16": lambda rows: delimited(rows, "\t").encode("utf-16"),
    "blanks": lambda rows: delimited(rows, " ").encode("utf-8-sig"),
    "preamble": lambda rows: (
        b"ACME Drilling\nWell Name: A-1 H\nTool: 4,75 in; gyro\n\n" + delimited(rows, "|").encode()
    ),
    "petrel": lambda rows: petrel(rows).encode(),
    "las": lambda rows: las(rows).encode(),
    "xlsx": lambda rows: xlsx(rows, above=2),
}


def random_rows(draw: np.random.Generator) -> list[tuple[float, float, float | None]]:
    count = int(draw.integers(2, 12))
    md = np.cumsum(draw.uniform(1.0, 60.0, count)).round(2)
    inc, azi = draw.uniform(0.0, 95.0, count).round(2), draw.uniform(0.0, 360.0, count).round(2)
    return list(zip(md.tolist(), inc.tolist(), azi.tolist(), strict=True))


def damaged(data: bytes, draw: np.random.Generator) -> bytes:
    """The bytes, damaged in one place."""
    i, j = sorted(int(k) for k in draw.integers(0, len(data) + 1, 2))
    j = min(j, i + int(draw.choice([1, 1, 2, 3, 8, 40])))
    at = int(draw.integers(0, len(data) + 1))
    kind = int(draw.integers(0, 7))
    if kind == 0:
        pool = np.frombuffer(data, np.uint8) if data and draw.random() < 0.8 else np.arange(256, dtype=np.uint8)
        return data[:i] + bytes(draw.choice(pool, min(max(j - i, 1), 4))) + data[j:]
    if kind == 1:
        return data[:i] + data[j:]
    if kind == 2:
        return data[:j] + data[i:]
    if kind == 3:
        return data[:at] + data[i:j] + data[at:]
    if kind == 4:
        return data[:at] if draw.random() < 0.3 else data[:i] + data[j:] + data[i:j]
    return data[:at] + STUMBLES[int(draw.integers(0, len(STUMBLES)))] + data[at:]


def mutant(seed: int) -> tuple[str, bytes]:
    """A kind of file and its damaged bytes."""
    draw = np.random.default_rng(seed)
    if draw.random() < 0.03:
        return "random bytes", draw.bytes(int(draw.integers(0, 2000)))
    kind = list(KINDS)[int(draw.integers(0, len(KINDS)))]
    data = KINDS[kind](random_rows(draw))
    for _ in range(int(draw.integers(1, 5))):
        data = _inside(data, draw) if kind == "xlsx" and draw.random() < 0.7 else damaged(data, draw)
    return kind, data


def _inside(data: bytes, draw: np.random.Generator) -> bytes:
    """A workbook with one part of its archive damaged; as it was if it is no archive any more."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = {name: archive.read(name) for name in archive.namelist()}
    except Exception:  # damaged before
        return data
    chosen = list(parts)[int(draw.integers(0, len(parts)))]
    parts[chosen] = damaged(parts[chosen], draw)
    kept = io.BytesIO()
    with zipfile.ZipFile(kept, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, part in parts.items():
            archive.writestr(name, part)
    return kept.getvalue()


def outcome(seed: int, folder: Path) -> dict[str, Any]:
    """What becomes of a mutant: "read", "refused", or a fault, with the seconds that it took."""
    kind, data = mutant(seed)
    file = folder / "survey"
    file.write_bytes(data)
    start, fault = time.process_time(), ""
    try:
        survey = rodwell.Survey.read(file)
        what = "read"
        columns = [survey.md, survey.inclination, *([] if survey.azimuth is None else [survey.azimuth])]
        if not all(np.all(np.isfinite(column)) for column in columns) or not np.all(np.diff(survey.md) > 0.0):
            fault = "read into a survey that does not hold together"
    except InputError as error:
        what = "refused"
        if not str(error).isprintable() or len(str(error)) > 4000:
            fault = "refused with control characters, or at great length"
    except BaseException:
        what, fault = "fault", traceback.format_exc()[-800:]
    seconds = time.process_time() - start
    if seconds > SLOWEST:
        fault = fault or "slow"
    return {"seed": seed, "kind": kind, "what": what, "seconds": round(seconds, 4), "fault": fault}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--mutants", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=18)
    given = parser.parse_args()
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if one["seed"] // 1_000_000 == given.seed]
    with tempfile.TemporaryDirectory() as folder, PART.open("a") as part:
        for number in range(len(done), given.mutants):
            done.append(outcome(given.seed * 1_000_000 + number, Path(folder)))
            part.write(json.dumps(done[-1]) + "\n")
            part.flush()
    kinds = {
        kind: dict(Counter(one["what"] for one in done if one["kind"] == kind)) for kind in (*KINDS, "random bytes")
    }
    result = {
        "what": "damaged survey files: read or refused with an InputError, in less than a second of processor time",
        "seed": given.seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}",
        "mutants": len(done), "outcomes": kinds, "slowest_seconds": max(one["seconds"] for one in done),
        "mean_seconds": round(sum(one["seconds"] for one in done) / len(done), 5),
        "faults": [one for one in done if one["fault"]],
    }  # fmt: skip
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PART.unlink()
    print(json.dumps(result, indent=1)[:3000])


if __name__ == "__main__":
    main()

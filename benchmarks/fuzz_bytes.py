"""Bytes that nobody foresaw, guided by what the readers' code did with those before (Atheris, libFuzzer).

    pip install atheris
    python benchmarks/fuzz_bytes.py [--seconds 60] [--seed 25] [--only survey.csv]

Targets are the readers of files that users write or export: case files, catalogues, surveys as text, LAS and XLSX,
centre lines and measured hook loads. Each begins with the shipped examples, in a process of its own, and lasts so many
seconds. A file is read or refused with an InputError in less than a second of processor time; anything else ends the
target, and the bytes are kept beside the table. Writes ``results/fuzz_bytes.md``.
"""

from __future__ import annotations

import argparse
import datetime
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"
OUT = HERE / "results" / "fuzz_bytes.md"
SLOWEST = 1.0
"""Seconds of processor time in which a file must be read or refused."""

ROOMS = ("case", "quantities", "studies", "survey")
"""Rooms whose code guides the choice of bytes."""

LONGEST = 4096
"""Bytes of a file."""

TARGETS = {
    "case.toml": sorted(EXAMPLES.glob("*.toml")),
    "well.toml": sorted(EXAMPLES.glob("wells/*.toml")),
    "catalogue.toml": [],
    "survey.csv": [EXAMPLES / "well-survey.csv", *sorted(EXAMPLES.glob("wells/*.csv"))],
    "survey.las": [],
    "survey.xlsx": [],
    "centerline.csv": [],
    "hookloads.csv": [EXAMPLES / "wells" / "extended-reach-hookloads.csv"],
}
"""What is read, by the name of the file, and the files to begin with beside those in :func:`first_files`."""


def first_files() -> dict[str, list[bytes]]:
    """Small files of the kinds of which no example is shipped."""
    from openpyxl import Workbook  # noqa: PLC0415

    book = Workbook()
    for row in (("MD [m]", "Inc [deg]", "Azi [deg]"), (0, 0, 0), (100, 10, 20), (200, 30, 25)):
        book.active.append(row)
    with tempfile.TemporaryDirectory() as folder:
        book.save(Path(folder) / "x.xlsx")
        workbook = (Path(folder) / "x.xlsx").read_bytes()
    las = b"~V\nVERS. 2.0:\nWRAP. NO:\n~W\nSTRT.M 0:\nSTOP.M 200:\nSTEP.M 100:\nNULL. -999.25:\n"
    las += b"~C\nDEPT.M:\nINC.DEG:\nAZI.DEG:\n~A\n0 0 0\n100 10 20\n200 30 25\n"
    pipe = b'[pipe."a"]\nouter_diameter = "5 in"\ninner_diameter = "4.276 in"\nmaterial = "steel"\nsource = "x"\n'
    line = b"x [mm],y [mm],z [mm]\n0,0,0\n0,0,100\n0,20,200\n0,60,300\n"
    return {"survey.xlsx": [workbook], "survey.las": [las], "catalogue.toml": [pipe], "centerline.csv": [line]}


def reader(name: str) -> Callable[[Path], object]:
    """What reads a file of a target."""
    import rodwell  # noqa: PLC0415
    from rodwell.case.catalogue import read_catalogue  # noqa: PLC0415
    from rodwell.studies.drag.measured import read_measured  # noqa: PLC0415
    from rodwell.studies.drag.well_case import Well  # noqa: PLC0415
    from rodwell.survey.centerline import read_centerline  # noqa: PLC0415

    well = Well.read(EXAMPLES / "wells" / "extended-reach.toml") if name == "hookloads.csv" else None
    readers: dict[str, Callable[[Path], object]] = {
        "case.toml": rodwell.Case.read,
        "well.toml": Well.read,
        "catalogue.toml": lambda path: read_catalogue([path.name], path.parent),
        "centerline.csv": read_centerline,
        "hookloads.csv": lambda path: read_measured(path, well),
    }
    return readers.get(name, rodwell.read_surveys)


def fuzz(name: str, seconds: float, seed: int, corpus: Path) -> None:
    """Try one target until time is up or something goes wrong; libFuzzer then ends the process."""
    import atheris  # noqa: PLC0415

    with atheris.instrument_imports(
        include=["rodwell.case", "rodwell.survey", "rodwell.quantities", "rodwell.studies"]
    ):
        read = reader(name)
    from rodwell.errors import InputError  # noqa: PLC0415
    from rodwell.quantities.units import to_si  # noqa: PLC0415

    to_si("1 furlong", "length")  # reads the registry of all units, once in a process
    place = Path(tempfile.mkdtemp()) / name

    def trial(data: bytes) -> None:
        place.write_bytes(data)
        start = time.process_time()
        with warnings.catch_warnings(), suppress(InputError):
            warnings.simplefilter("ignore")
            read(place)
        spent = time.process_time() - start
        assert spent < SLOWEST, f"{spent:.1f} s"

    flags = [f"-max_total_time={seconds:.0f}", f"-seed={seed}", f"-max_len={LONGEST}", "-print_final_stats=1"]
    atheris.Setup([name, *flags, f"-artifact_prefix={corpus.parent}/", str(corpus)], trial)
    atheris.Fuzz()


def in_own_process(name: str, seconds: float, seed: int, kept: Path) -> dict[str, str]:
    """What libFuzzer says of one target, and what went wrong; the bytes that did it are in ``kept``."""
    corpus = kept / name / "corpus"
    corpus.mkdir(parents=True)
    files = [path.read_bytes() for path in TARGETS[name]] + first_files().get(name, [])
    for i, data in enumerate(files):
        (corpus / f"example-{i}").write_bytes(data)
    child = [sys.executable, __file__, "--child", name, "--seconds", str(seconds), "--seed", str(seed)]
    ran = subprocess.run([*child, "--corpus", str(corpus)], capture_output=True, text=True, check=False, cwd=EXAMPLES)
    told = ran.stdout + ran.stderr
    runs = re.search(r"number_of_executed_units: (\d+)", told)
    covered = re.findall(r"cov: (\d+)", told)
    wrong = re.search(r"Uncaught Python exception: ===\n(.*)", told)
    fault = wrong[1] if wrong else "" if ran.returncode == 0 else told[-300:]
    return {
        "files": runs[1] if runs else "?",
        "first": covered[0] if covered else "?",
        "covered": covered[-1] if covered else "?",
        "fault": fault.strip(),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=60.0, help="for each target")
    parser.add_argument("--seed", type=int, default=25)
    parser.add_argument("--only", choices=list(TARGETS))
    parser.add_argument("--child", choices=list(TARGETS), help=argparse.SUPPRESS)
    parser.add_argument("--corpus", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        fuzz(options.child, options.seconds, options.seed, options.corpus)
    kept = Path(tempfile.mkdtemp(prefix="fuzz-bytes-"))
    found = {}
    for name in TARGETS if options.only is None else [options.only]:
        found[name] = in_own_process(name, options.seconds, options.seed, kept)
        print(name, found[name], flush=True)
    print(f"what was tried, and what went wrong: {kept}")
    if options.only is not None:
        return
    lines = [
        "# Bytes that nobody foresaw", "",
        f"`python benchmarks/fuzz_bytes.py --seconds {options.seconds:g} --seed {options.seed}`, "
        f"{datetime.date.today().isoformat()}, rodwell {rodwell_version()}, {platform.machine()}, Python "
        f"{platform.python_version()}. Branches of the readers' code that were reached, at first and in the end.", "",
        "| Reader of | Files tried | Branches at first | in the end | Neither read nor refused |",
        "| --- | --- | --- | --- | --- |",
        *(f"| {name} | {one['files']} | {one['first']} | {one['covered']} | {one['fault'] or 'none'} |"
          for name, one in found.items()),
        "",
    ]  # fmt: skip
    OUT.write_text("\n".join(lines), encoding="utf-8")


def rodwell_version() -> str:
    """Version of what is fuzzed, which only the processes of the targets import."""
    from rodwell import __version__  # noqa: PLC0415

    return __version__


if __name__ == "__main__":
    main()

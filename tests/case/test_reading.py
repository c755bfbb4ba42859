"""Case files and catalogues from pipes, of any size and content: read once, in a time that grows as their length."""

from __future__ import annotations

import io
import os
import random
import sys
import threading
import time
from pathlib import Path

import pytest

from rodwell.case.case import LONGEST_TITLE, Case
from rodwell.case.catalogue import key_of, read_catalogue
from rodwell.case.checks.explain import MOST_PROBLEMS
from rodwell.case.file import LARGEST_CASE, LARGEST_CATALOGUE, parsed, printable_data, read_case
from rodwell.case.uncertain import split
from rodwell.errors import InputError, printable
from rodwell.quantities.units import in_unit_of, to_si
from rodwell.studies.sweep.study import study
from rodwell.studies.sweep.varied import is_study, varied_inputs
from rodwell.studies.varied import is_varied

CASE = "[dimensionless]\nweight = 16.5\n"
QUICK = 2.0
"""Seconds of the processor that nothing below may take; what grew as the square or worse took minutes."""


# From pipes


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_is_read_once(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = threading.Thread(target=pipe.write_text, args=(CASE,))  # a second reader would wait for ever
    writer.start()
    read = read_case(pipe)
    writer.join()
    assert not is_study(read)
    assert Case.read(read).problem.weight == 16.5
    assert (read.source, read.name, read.folder) == ("pipe", "case", Path())


def test_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"\xef\xbb\xbf" + CASE.encode())))
    case = Case.read("-")
    assert (case.problem.weight, case.source, case.text) == (16.5, "standard input", CASE)


def test_no_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(InputError, match="case file = '-': cannot be read"):
        read_case("-")


@pytest.mark.skipif(not Path("/dev/fd").exists(), reason="needs /dev/fd")
def test_a_shells_substitution(tmp_path: Path) -> None:
    """What ``<(cat case.toml)`` gives; catalogues are sought from the current folder."""
    reading, writing = os.pipe()
    os.write(writing, CASE.encode())
    os.close(writing)
    read = read_case(f"/dev/fd/{reading}")
    os.close(reading)
    assert (Case.read(read).problem.weight, read.name, read.folder) == (16.5, "case", Path())


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="needs /dev/zero")
def test_what_never_ends() -> None:
    with pytest.raises(InputError, match=r"case file = '/dev/zero': is larger than 200 kB"):
        Case.read("/dev/zero")
    with pytest.raises(InputError, match=r"catalogue.files = '/dev/zero': is larger than 1000 kB"):
        read_catalogue(["/dev/zero"], Path())


@pytest.mark.parametrize("more", [0, 1])
def test_the_largest_case(tmp_path: Path, more: int) -> None:
    file = tmp_path / "case.toml"
    file.write_text(CASE + "#" * (LARGEST_CASE - len(CASE) + more), encoding="utf-8")
    if more:
        with pytest.raises(InputError, match="is larger than 200 kB"):
            Case.read(file)
    else:
        assert Case.read(file).problem.weight == 16.5


def test_a_catalogue_is_parsed_once_for_all_points(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "own.toml").write_text('[[pipe]]\nname = "p"\nsource = "me"\nouter_diameter = "5 cm"\n', "utf-8")
    times = []
    monkeypatch.setattr("rodwell.case.catalogue.parsed", lambda *given: times.append(1) or parsed(*given))
    for _ in range(3):
        assert read_catalogue(["own.toml"], tmp_path).pipe("P").outer_diameter == 0.05
    assert len(times) <= 1


# In linear time

LONG = [
    "a" + ".a" * 99_000 + " = 1",
    "[" + "a." * 99_000 + "a]",
    '"x y".' * 33_000 + "a = 1",
    r'"\"".' * 39_000 + "a = 1",
    "1_" * 99_000 + " = 1",
    "a = " + "1_" * 99_000,
    "a = " + "'" * 199_000,
    "a = " + "[" * 199_000,
    "a = " + "{b=" * 60_000,
    "".join(f"a{i} = 1\n" for i in range(19_000)),
    "[rod]\n" + "".join(f"a{i} = 1\n" for i in range(19_000)),
    "".join(f"[a{i}]\n" for i in range(19_000)),
    "[load]\n" + "".join(f"a{i} = 1\n" for i in range(18_000)) + CASE,
    "".join(f"[{'a.' * 18}b{i}]\nc = 1\n" for i in range(3_000)),
    'title = "' + r"\u001b" * 33_000 + '"\n' + CASE,
    '[rod]\nlength = "' + " " * 199_000 + '"',
    '[rod]\nlength = "30' + " " * 99_000 + "±" + " " * 99_000 + '"',
    '[rod]\nlength = "' + ".." * 99_000 + '"',
    '[rod]\nlength = "' + "1" * 199_000 + '\\n"',
    '[rod]\nlength = ["' + "1" * 99_000 + '\\n", "2 m"]',
    '[rod]\npipe = "' + "1" * 199_000 + '"',
]


@pytest.mark.parametrize("text", LONG, ids=lambda text: repr(text[:20]))
def test_long_files_are_read_quickly(text: str) -> None:
    def read() -> None:
        data = parsed(text, "case file", "long.toml")
        varied_inputs(data)
        Case.from_dict(data)

    start = time.process_time()
    with pytest.raises(InputError) as caught:
        read()
    assert time.process_time() - start < QUICK
    assert len(str(caught.value)) < 20_000
    assert len(getattr(caught.value, "problems", ())) <= MOST_PROBLEMS


@pytest.mark.parametrize(
    "unit",
    [
        "a" * 56 + "!",
        "ab " * 18 + "2",
        "()" * 25 + "+",
        "m*" * 26 + "2",
        "m^9^9^9",
        "((((m^9)^9)^9)^9)^9",
        "m^99999999",
    ],
)
def test_units_are_read_quickly(unit: str) -> None:
    start = time.process_time()
    with pytest.raises(ValueError, match="write for example"):
        to_si(f"1 {unit}", "length")
    assert time.process_time() - start < QUICK


@pytest.mark.parametrize("unit", ["9**9**9", "9^999999999 m", "(((9)^9)^9)^9", "m" * 100])
def test_units_of_uncertainties_are_read_quickly(unit: str) -> None:
    with pytest.raises(ValueError, match="do not go together"):
        in_unit_of(1.0, unit, "m")
    with pytest.raises(InputError, match=r"rod.length = "):
        Case.from_dict({"rod": {"length": f"30 m ± 1 {unit}"}})


def test_units_that_people_write_are_still_read() -> None:
    for text in ("1 m", "1m", "1 (m)^2/m", "1 m**2 / m", "1 m²/m", "1 m ^2·m^-1", "1 m^2 m^-1"):
        assert to_si(text, "length") == 1.0
    assert in_unit_of(1.0, "metric_ton*g_0", "N") == pytest.approx(9806.65)


def test_expressions_take_short_texts_only() -> None:
    start = time.process_time()
    assert split({"rod": {"length": " " * 200_000 + "±"}})[1] == {}
    assert not is_varied(".." * 100_000)
    assert not is_varied("1" + ".. " * 50 + "x")
    assert varied_inputs({"rod": {"length": ["1" * 100_000 + "x\nx", "2 m"]}})[0].numbers is None
    assert key_of("1" * 100_000) == "1" * 100_000
    assert time.process_time() - start < QUICK


def test_numbers_that_no_float_holds() -> None:
    with pytest.raises(InputError, match=r"dimensionless.weight = .* must hold numbers"):
        study({"dimensionless": {"weight": [10**400, 1]}})


# What cannot be printed


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("plain, Ωµ² 中文 été", "plain, Ωµ² 中文 été"),
        ("a\x00b\x1b[31mc\x7f\x9b", r"a\x00b\x1b[31mc\x7f\x9b"),
        ("line\nbreak\ttab\u2028", "line break tab "),
        ("left\u202eright\ufeff\u200b", r"left\u202eright\ufeff\u200b"),
        ("half \udc80", r"half \udc80"),
        ("\u00a0thin\u202f, می\u200cخواهم", "\u00a0thin\u202f, می\u200cخواهم"),
    ],
)
def test_printable(text: str, shown: str) -> None:
    assert printable(text) == shown
    assert printable(shown) == shown


def test_any_text_is_made_harmless() -> None:
    draw = random.Random(18)
    for _ in range(300):
        text = printable("".join(chr(draw.randrange(0x110000)) for _ in range(20)))
        assert not any(
            ord(c) < 32 or 127 <= ord(c) < 160 or 0xD800 <= ord(c) < 0xE000 or c in "\u202e\u2066" for c in text
        )


def test_texts_of_a_case_are_harmless() -> None:
    given = {"title": "a\x1b[2Jb\x00", "dimensionless": {"weight": 1.0}}
    assert Case.from_dict(given).title == r"a\x1b[2Jb\x00"
    assert study(given | {"dimensionless": {"weight": [0.5, 1.0]}}).title == r"a\x1b[2Jb\x00"
    assert printable_data({"a\x1b": [("\x00",), 1, None]}) == {r"a\x1b": [(r"\x00",), 1, None]}


@pytest.mark.parametrize(
    "text",
    ['[rod]\n"\\u001b[31mx" = 1', '"\\u001b[31m\\n" = 1', 'title = 1\n[load]\n"\\u001bx" = 1\n' + CASE,
     '[rod]\nlength = "1 \\u001b]0;x\\u0007"', '[rod]\npipe = "\\u202epipe"\nlength = "1 m"\n[hole]\ndiameter = "1 m"'],
)  # fmt: skip
def test_messages_are_harmless(tmp_path: Path, text: str) -> None:
    file = tmp_path / "esc\x1b.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        Case.read(file)
    assert all(line.isprintable() for line in str(caught.value).splitlines())


def test_the_source_of_a_dictionary_is_harmless() -> None:
    with pytest.raises(InputError, match=r"^a\\x1b: rod: is missing"):
        Case.from_dict({}, source="a\x1b")


def test_names_in_catalogues_are_harmless(tmp_path: Path) -> None:
    entry = '[[pipe]]\nname = "p\\u001b[31m"\nsource = "me\\u0000"\nouter_diameter = "5 cm"\n'
    (tmp_path / "own.toml").write_text(entry, encoding="utf-8")
    pipe = read_catalogue(["own.toml"], tmp_path).pipe("p\\x1b[31m")
    assert (pipe.name, pipe.source) == (r"p\x1b[31m", r"me\x00")
    (tmp_path / "own.toml").write_text(entry + '"\\u001bx" = 1\n', encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_catalogue(["own.toml"], tmp_path)
    assert str(caught.value).isprintable()
    assert len(entry) < LARGEST_CATALOGUE


def test_a_title_has_an_end() -> None:
    with pytest.raises(InputError, match=r"title = .*must have at most 300 characters"):
        Case.from_dict({"title": "x" * (LONGEST_TITLE + 1), "dimensionless": {"weight": 1.0}})

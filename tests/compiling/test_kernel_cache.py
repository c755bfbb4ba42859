"""Machine code on disk: compiled again after damage, or in memory if need be; what commands say of it."""

from __future__ import annotations

import errno
import fcntl
import os
import pickle
import shutil
import subprocess
import sys
import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any, NamedTuple

import numba
import pytest
from numba.core.caching import CacheImpl
from numba.core.environment import Environment

from rodwell.cli import main as command_line
from rodwell.compiling import cache, turns
from rodwell.compiling.kernels import kernel
from rodwell.compiling.reading import read
from rodwell.errors import CacheWarning
from rodwell.physics.on_wall.model import RodOnCylinder

FLOAT = (numba.types.float64,)


def tripled(x):
    return 3.0 * x


def opened(model, x):
    return model.y + x


class Other(NamedTuple):
    """A model of somebody else, with the name of ours."""

    y: int = 0


Other.__name__ = RodOnCylinder.__name__


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder for machine code, and a process that has not warned yet."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path / "kernels"))
    monkeypatch.setattr(cache, "_told", set())
    return tmp_path / "kernels"


def files(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.is_file()]


def compilations(compiled: Any) -> int:
    return sum(compiled.stats.cache_misses.values())


def flipped(content: bytes, at: int) -> bytes:
    return content[:at] + bytes([content[at] ^ 0x10]) + content[at + 1 :]


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda _content: b"",
    "cut in the checksum": lambda content: content[:2],
    "cut in the stamp": lambda content: content[:9],
    "cut in the machine code": lambda content: content[: len(content) // 2],
    "last byte missing": lambda content: content[:-1],
    "junk": lambda content: bytes(range(256)) * (len(content) // 256),
    "text": lambda _content: b"not machine code\n",
    "nought": lambda content: bytes(len(content)),
    "flipped in the checksum": lambda content: flipped(content, 1),
    "flipped in the stamp": lambda content: flipped(content, 7),
    "flipped in the key": lambda content: flipped(content, 60),
    "flipped in the machine code": lambda content: flipped(content, len(content) // 2),
    "flipped at the end": lambda content: flipped(content, -1 % len(content)),
    "something behind it": lambda content: content + b"\0",
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_damage_is_told_and_compiled_again(kind, folder):
    kernel(tripled)(1.0)
    (path,) = files(folder)
    whole = path.read_bytes()
    path.write_bytes(DAMAGE[kind](whole))
    again = kernel(tripled)
    with pytest.warns(CacheWarning, match="were damaged; they are compiled again") as told:
        assert again(2.0) == 6.0
    assert (len(told), compilations(again)) == (1, 1)
    assert str(path.parent) in str(told[0].message)
    later = kernel(tripled)
    assert (later(2.0), compilations(later)) == (6.0, 0)  # what is on disk is whole again


def test_a_file_that_cannot_be_read_is_damage(folder):
    kernel(tripled)(1.0)
    (path,) = files(folder)
    path.unlink()
    path.mkdir()
    with pytest.warns(CacheWarning) as told:
        assert kernel(tripled)(2.0) == 6.0
    assert ["damaged" in str(one.message) for one in told] == [True, False]  # the second: nor be written there


def test_several_damaged_files_are_told_once(folder):
    kernel(tripled)(1.0)
    kernel(tripled)(1)
    assert len(files(folder)) == 2
    for path in files(folder):
        path.write_bytes(b"")
    again = kernel(tripled)
    with pytest.warns(CacheWarning) as told:
        assert (again(2.0), again(2)) == (6.0, 6.0)
    assert (len(told), compilations(again)) == (1, 2)


def test_machine_code_on_disk_is_seen(folder):
    compiled = kernel(tripled)
    assert not cache.on_disk(compiled, FLOAT)
    compiled(1.0)
    assert cache.on_disk(compiled, FLOAT)
    assert not cache.on_disk(compiled, (numba.types.int64,))
    compiled._cache.flush()
    assert files(folder) == []
    assert not cache.on_disk(compiled, FLOAT)


def test_of_two_processes_one_compiles(folder):
    kernel(tripled)(1.0)
    (path,) = files(folder)
    whole = path.read_bytes()
    path.unlink()
    lock = path.with_name(f"{path.name}.turn").open("w")
    fcntl.flock(lock, fcntl.LOCK_EX)  # another process compiles it
    waiting = kernel(tripled)
    with ThreadPoolExecutor(1) as thread:
        result = thread.submit(waiting, 2.0)
        assert wait([result], timeout=0.2).not_done
        path.write_bytes(whole)
        lock.close()
        assert result.result() == 6.0
    assert compilations(waiting) == 0
    assert files(folder) == [path]


def test_nobody_waits_for_ever(folder, monkeypatch):
    monkeypatch.setattr(turns, "LONGEST_WAIT", 0.05)
    kernel(tripled)(1.0)
    (path,) = files(folder)
    path.unlink()
    with path.with_name(f"{path.name}.turn").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        compiled = kernel(tripled)
        assert (compiled(2.0), compilations(compiled)) == (6.0, 1)
    assert path.exists()


def test_code_of_other_sources_is_not_loaded(folder, monkeypatch):
    kernel(tripled)(1.0)
    monkeypatch.setattr(cache, "stamp", lambda *_names: b"s" * cache.STAMP_SIZE)
    edited = kernel(tripled)
    assert (edited(2.0), compilations(edited)) == (6.0, 1)  # without a warning
    assert len(files(folder)) == 1
    later = kernel(tripled)
    assert (later(2.0), compilations(later)) == (6.0, 0)


def test_models_of_one_name_do_not_take_each_others_place(folder):
    models = (RodOnCylinder(2), Other(2))
    assert repr(numba.typeof(models[0])) == repr(numba.typeof(models[1]))
    for misses in (1, 0):
        for model in models:
            compiled = kernel(opened)
            assert (compiled(model, 1), compilations(compiled)) == (3, misses)
    assert len(files(folder)) == 2


@pytest.mark.parametrize("problem", [OSError(errno.ENOSPC, "No space left on device"), PermissionError(13, "denied")])
def test_on_a_full_disk_kernels_stay_in_memory(problem, folder, monkeypatch):
    def full(path: Path, content: bytes) -> None:
        with path.open("wb") as file:  # a part of it is written, and must go
            file.write(content[:100])
        raise problem

    monkeypatch.setattr(Path, "write_bytes", full)
    compiled = kernel(tripled)
    with pytest.warns(CacheWarning, match="NUMBA_CACHE_DIR") as told:
        assert (compiled(2.0), compiled(2)) == (6.0, 6)
    assert len(told) == 1
    assert str(compiled.stats.cache_path) in str(told[0].message)
    assert problem.strerror in str(told[0].message)
    assert files(folder) == []


def test_a_folder_that_went_away_is_told_when_it_cannot_be_made_again(folder):
    compiled = kernel(tripled)
    shutil.rmtree(folder)
    folder.write_text("in the way")
    with pytest.warns(CacheWarning, match="NUMBA_CACHE_DIR"):
        assert compiled(2.0) == 6.0


def test_without_any_folder_kernels_are_compiled_in_each_process(monkeypatch):
    monkeypatch.setattr(CacheImpl, "_locator_classes", [])
    with pytest.warns(CacheWarning, match="NUMBA_CACHE_DIR") as told:
        one, two = kernel(tripled), kernel(opened)
    assert len(told) == 1
    assert (one(2.0), two(RodOnCylinder(2), 1)) == (6.0, 3)
    assert not cache.on_disk(one, FLOAT)


def test_parts_of_numba_are_read_without_their_modules():
    written = Environment({"__name__": "numba.no_such_module"})
    written.consts[:], written.env_name = ["a constant"], "name of a part"
    code = pickle.dumps(written)
    found = read(code)
    assert found.consts == ["a constant"]
    assert found.can_cache()  # with what is compiled on it, it is written again
    assert pickle.dumps(found) == code
    assert read(code) is found


def test_with_another_numba_its_own_cache_serves(monkeypatch, folder):
    def changed(_function: Any) -> None:
        raise AttributeError("_impl")

    monkeypatch.setattr(cache, "KernelCache", changed)
    assert kernel(tripled)(2.0) == 6.0
    assert sorted(path.suffix for path in files(folder)) == [".nbc", ".nbi"]


def test_what_numba_does_not_compile_is_left_alone():
    assert cache.keep(tripled) is tripled


# The command line.


def critical(folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "rodwell", "critical", "--weight", "15", "--alpha", "90"],
        env=os.environ | {"NUMBA_CACHE_DIR": str(folder)},
        capture_output=True,
        text=True,
        check=False,
    )


def test_a_command_with_damaged_kernels_says_so_in_one_line_and_goes_on(folder):
    first = critical(folder)
    assert (first.returncode, first.stderr) == (0, "")
    kept = sorted(files(folder), key=lambda path: path.stat().st_size)
    assert len(kept) > 3
    for kind, path in zip(("empty", "junk", "cut in the machine code"), kept, strict=False):  # the soonest compiled
        path.write_bytes(DAMAGE[kind](path.read_bytes()))
    again = critical(folder)
    assert (again.returncode, again.stdout) == (0, first.stdout)
    (line,) = again.stderr.splitlines()
    assert line.startswith("rodwell: warning: compiled kernels in ")
    assert line.endswith(" were damaged; they are compiled again")
    last = critical(folder)
    assert (last.returncode, last.stdout, last.stderr) == (0, first.stdout, "")


def test_warnings_of_others_are_shown_as_python_does(capsys, monkeypatch):
    monkeypatch.setattr(command_line, "_show_warning", lambda message, *_where: print(f"shown: {message}"))
    command_line._warned(UserWarning("theirs"), UserWarning, "file.py", 1)
    command_line._warned(CacheWarning("ours"), CacheWarning, "file.py", 1)
    shown = capsys.readouterr()
    assert (shown.out, shown.err) == ("shown: theirs\n", "rodwell: warning: ours\n")


@pytest.mark.parametrize("cause", [EOFError("ran out of input"), KeyboardInterrupt()])
def test_only_an_interruption_is_told_as_one(cause, capsys, monkeypatch):
    def broken(**_options: Any) -> None:
        raise cause

    monkeypatch.setattr(command_line.cli.commands["critical"], "callback", broken)
    monkeypatch.setattr(sys, "argv", ["rodwell", "critical", "--weight", "15", "--alpha", "90"])
    with warnings.catch_warnings(), pytest.raises((EOFError, SystemExit)) as left:
        command_line.main()
    interrupted = isinstance(cause, KeyboardInterrupt)
    assert isinstance(left.value, SystemExit) is interrupted
    assert ("nothing was written" in capsys.readouterr().err) is interrupted

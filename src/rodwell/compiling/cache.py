"""Machine code on disk: fresh, whole, or compiled again.

Numba keeps the machine code of a kernel for the next start. Left alone it notices changes of the kernel's own file
only, not of what the kernel calls; it runs whatever the file holds; and where the file cannot be written it ends the
run. So files are read and written here, one for each kernel and types of arguments, and Numba is handed what is

fresh
    The *stamp* in the file is the one of today's sources: of the file of the kernel and of the model that it is
    compiled for, and of every file that these import, directly or not. What a kernel calls, what is called when it is
    compiled, and the constants that it freezes all reach it by imports.
whole
    The checksum in the file is that of its content. Damage is thrown away, told once, and compiled again.

A file is written beside its place and moved there, so processes that read and write at a time see a whole file or none.
"""

from __future__ import annotations

import re
import sys
import uuid
import warnings
import zlib
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

import llvmlite
import numba
from numba.core.caching import FunctionCache
from numba.core.runtime.nrt import rtsys
from numba.core.serialize import dumps

from rodwell._version import __version__
from rodwell.compiling import turns
from rodwell.compiling.garbage import without_collecting
from rodwell.compiling.reading import read
from rodwell.errors import CacheWarning

ROOM = Path(__file__).resolve().parent
SOURCE = ROOM.parent
STAMP_SIZE, CHECKSUM_SIZE = 16, 4

_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+(rodwell[\w.]*)[ \t]+import[ \t]*(\([^)]*\)|[^\n]*)|import[ \t]+(rodwell[\w.]*))",
    re.MULTILINE,
)


def keep(kernel: Any) -> Any:
    """Give a kernel that Numba has made its files on disk, and return it."""
    if not hasattr(kernel, "enable_caching"):  # NUMBA_DISABLE_JIT: a plain function
        return kernel
    try:
        kernel._compiler.compile = without_collecting(kernel._compiler.compile)
        kernel._cache = KernelCache(kernel.py_func)
        _tell_elsewhere(kernel._cache.cache_path)
    except RuntimeError:  # Numba: "no locator available"
        _tell(
            "no place",
            "compiled kernels are not kept: no folder for them can be written, so they are compiled at each start. "
            "The environment variable NUMBA_CACHE_DIR names another folder",
        )
    except AttributeError:  # another Numba, with other insides: its own cache
        kernel.enable_caching()
    return kernel


def _tell_elsewhere(kept_in: str) -> None:
    """Warn where NUMBA_CACHE_DIR names a folder that cannot be used: Numba passes it over without a word."""
    named = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    if named and not Path(kept_in).absolute().is_relative_to(Path(named).absolute()):
        what = (
            f"NUMBA_CACHE_DIR names {named}, where no folder can be written: compiled kernels are kept elsewhere, the "
        )
        _tell("elsewhere", f"{what}first of them in {kept_in}. Name a folder that can be written, or none")


def on_disk(kernel: Any, arguments: tuple[Any, ...]) -> bool:
    """Whether machine code of a kernel for types of arguments lies on disk, fresh and whole."""
    kept = kernel._cache
    if not isinstance(kept, KernelCache):  # Numba's own cache, which cannot be asked, or none
        return kept.cache_path is not None
    return kept.holds(arguments, kernel.targetctx.codegen())


class KernelCache(FunctionCache):
    """Numba's cache of one kernel, with our files."""

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        files: Any = _Files(Path(self.cache_path), self._impl.filename_base, function.__module__)
        self._cache_file = files

    def load_overload(self, signature: Any, target: Any) -> Any:
        """Load machine code from the disk; None where there is none: then it is this process's turn to compile it.

        Numba first reads in all that compiling needs, at each kernel, which takes longer than the machine code. That
        runs with the runtime alone; where something must be compiled after all, the compiler reads what it needs.
        """
        rtsys.initialize(target)
        found = self._load_overload(signature, target)
        if found is None:
            path = self._path(signature, target.codegen())
            if turns.take(path) and (found := self._load_overload(signature, target)) is not None:
                turns.give_back(path)
        return found

    def save_overload(self, signature: Any, compiled: Any) -> None:
        """Put machine code on disk; where that fails it stays in memory."""
        try:
            super().save_overload(signature, compiled)
        except OSError as problem:  # disk full, folder that can no longer be written
            _tell(
                "no place",
                f"compiled kernels cannot be kept in {self.cache_path} ({problem.strerror or problem}), so they are "
                "compiled at each start. The environment variable NUMBA_CACHE_DIR names another folder",
            )
        finally:
            turns.give_back(self._path(signature, compiled.codegen))

    def holds(self, signature: Any, codegen: Any) -> bool:
        """Whether machine code for a signature lies on disk, fresh and whole."""
        files: Any = self._cache_file
        return files.code(self._index_key(signature, codegen)) is not None

    def _path(self, signature: Any, codegen: Any) -> Path:
        files: _Files = self._cache_file  # type: ignore[assignment]
        return files.path(self._index_key(signature, codegen))


class _Files:
    """The files of one kernel; ``load``, ``save`` and ``flush`` are what Numba's cache asks for.

    A *key* is Numba's: the types of the arguments, the processor, and hashes of the bytecode.
    """

    def __init__(self, folder: Path, name: str, module: str) -> None:
        self.folder, self.name, self.module = folder, name, module

    def load(self, key: Any) -> Any:
        code = self.code(key)
        if code is None:
            return None
        try:
            stored, data = read(code)
        except Exception:  # what it names is no longer there
            return None
        return data if stored == key else None

    def code(self, key: Any) -> memoryview | None:
        """What lies on disk for a key, if that is fresh and whole: key and data, pickled."""
        path = self.path(key)
        try:
            content = path.read_bytes()
        except (FileNotFoundError, NotADirectoryError):
            return None
        except OSError:  # an unreadable part of the disk is damage too
            content = b""
        checksum, stamped = content[:CHECKSUM_SIZE], content[CHECKSUM_SIZE:]
        if checksum != _checksum(stamped):
            self._throw_away(path)
            return None
        fresh = stamped[:STAMP_SIZE] == stamp(self.module, *_models(key))
        return memoryview(stamped)[STAMP_SIZE:] if fresh else None

    def save(self, key: Any, data: Any) -> None:
        stamped = stamp(self.module, *_models(key)) + dumps((key, data))
        path = self.path(key)
        beside = path.with_name(f"{path.name}.tmp.{uuid.uuid4().hex[:16]}")
        try:
            beside.write_bytes(_checksum(stamped) + stamped)
            beside.replace(path)
        finally:
            beside.unlink(missing_ok=True)

    def flush(self) -> None:
        for path in self.folder.iterdir():
            if path.name.startswith(f"{self.name}.") and path.suffix == ".nbc":
                path.unlink(missing_ok=True)

    def path(self, key: Any) -> Path:
        """Where the machine code for a key lies."""
        models = [f"{model.__module__}.{model.__qualname__}" for model in _models(key)]  # types tell no modules
        return self.folder / f"{self.name}.{blake2b(repr((key, models)).encode(), digest_size=8).hexdigest()}.nbc"

    def _throw_away(self, path: Path) -> None:
        # Another process may have put a whole file there in between: it is compiled once more, no harm is done.
        with suppress(OSError):  # then it is written over, or stays
            path.unlink(missing_ok=True)
        _tell("damage", f"compiled kernels in {self.folder} were damaged; they are compiled again")


def _checksum(content: bytes) -> bytes:
    return zlib.crc32(content).to_bytes(CHECKSUM_SIZE, "big")


def _models(key: Any) -> list[type]:
    """Classes of the named tuples among the arguments, and in them: formulas of models are compiled into the kernel."""
    signature = key[0]
    found, ahead = [], list(getattr(signature, "args", signature))
    while ahead:
        argument = ahead.pop(0)
        if hasattr(argument, "instance_class"):
            found.append(argument.instance_class)
            ahead += getattr(argument, "types", ())
    return found


def stamp(module: str, *models: type) -> bytes:
    """Hash of all that machine code depends on: the compiler, and the sources behind a module and models."""
    versions = (__version__, numba.__version__, llvmlite.__version__)  # the first for an installation without sources
    found = blake2b(repr(versions).encode(), digest_size=STAMP_SIZE)
    for name in (module, *(model.__module__ for model in models)):
        found.update(_hash_of(name))
    return found.digest()


@cache
def _hash_of(module: str) -> bytes:
    """Hash of the file of a module and of all files of rodwell that it imports, directly or not."""
    found = blake2b()
    for path in sorted(sources(module)):
        found.update(blake2b(_read(path)).digest())
    return found.digest()


def sources(module: str) -> set[Path]:
    """Files of a module, and of all modules of rodwell that it imports, directly or not."""
    first = _file(module) or getattr(sys.modules.get(module), "__file__", None)  # the latter: a model of somebody else
    found: set[Path] = set()
    ahead = [Path(first)] if first else []
    while ahead:
        path = ahead.pop()
        if path not in found:
            found.add(path)
            ahead += () if path.parent == ROOM else imported(path)  # what this room needs shapes no machine code
    return found


@cache
def imported(path: Path) -> list[Path]:
    """Files of rodwell that a file imports, wherever in it.

    Read with a regular expression, for speed: a line of a docstring that looks like an import counts as one.
    """
    return [file for name in _names(_read(path).decode(errors="replace")) if (file := _file(name))]


def _names(text: str) -> Iterator[str]:
    for package, names, module in _IMPORT.findall(text):
        if module:
            yield module
            continue
        yield package
        home = _file(package)
        if home is None or home.name == "__init__.py":  # of a package: names may be modules
            yield from (f"{package}.{word}" for word in re.findall(r"\w+", names))


@cache
def _file(module: str) -> Path | None:
    top, *parts = module.split(".")
    if top != "rodwell":
        return None
    base = SOURCE.joinpath(*parts)
    for path in (base / "__init__.py", base.with_suffix(".py")):
        if path.is_file():
            return path
    return None


@cache
def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""


_told: set[str] = set()


def _tell(cause: str, message: str) -> None:
    """Warn, of each cause once in a process: many kernels suffer from one."""
    if cause not in _told:
        _told.add(cause)
        warnings.warn(message, CacheWarning, stacklevel=2)

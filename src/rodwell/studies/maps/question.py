"""What a map asks: which number, of which rods, over which grid; and in which chunks it is computed and kept."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from hashlib import blake2b
from pathlib import Path
from typing import Any

from rodwell._version import __version__
from rodwell.case.case import Case
from rodwell.case.file import CaseText, named_files, printable_data, read_case
from rodwell.errors import InputError, checked_number, checked_whole
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.names import SI_UNITS, UNITS
from rodwell.quantities.tolerance import LARGEST_FORCE, RTOL, checked_rtol
from rodwell.studies.maps.axes import Axis, Distribution, drawn, read, varies
from rodwell.studies.maps.numbers import NUMBERS
from rodwell.studies.maps.rods import LOAD, OF_PROBLEM, Rods, data_of

MOST_PARAMETERS = 4
MOST_CELLS = 10**9
MOST_SAMPLES = 10**7
FILES = "files"
"""Key of what a case's files hold, in the identity of a question."""

SAMPLE = "sample"
"""Dimension of samples."""

LARGEST_CHUNK, CHUNKS = 4096, 256
"""Cells of a chunk at most, and how many chunks a large map has at least."""

WORTHWHILE, FEWEST = 64, 8
"""Cells that are worth the 20 ms of giving out and writing a chunk; a small map has this many chunks all the same."""

SAMPLINGS = ("sobol", "random")


@dataclass(frozen=True)
class Samples:
    """How parameters are drawn: how many times, how, and from which seed."""

    count: int = 0
    sampling: str = "sobol"
    seed: int = 0


@dataclass(frozen=True)
class Question:
    """A map before it is computed.

    Attributes
    ----------
    rods
        What all cells share; its names are those of ``axes``, then of ``distributions``.
    axes
        Parameters that make the grid.
    distributions
        Parameters that are drawn, which make one more dimension, "sample".
    samples
        How they are drawn.
    title
        Of a case, for figures.
    """

    rods: Rods
    axes: tuple[Axis, ...]
    distributions: tuple[Distribution, ...] = ()
    samples: Samples = field(default_factory=Samples)
    title: str = ""

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return tuple(axis.name for axis in self.axes) + ((SAMPLE,) if self.distributions else ())

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells in each dimension."""
        return tuple(len(axis.values) for axis in self.axes) + ((self.samples.count,) if self.distributions else ())

    @property
    def size(self) -> int:
        """Cells in all."""
        return math.prod(self.shape)

    @cached_property
    def chunk_shape(self) -> tuple[int, ...]:
        """Cells of a chunk in each dimension; it depends on the grid only, so that any machine can go on with a map."""
        wanted = min(max(self.size // CHUNKS, min(WORTHWHILE, self.size // FEWEST), 1), LARGEST_CHUNK)
        out = list(self.shape)
        while math.prod(out) > wanted:
            longest = max(range(len(out)), key=out.__getitem__)
            out[longest] = -(-out[longest] // 2)
        return tuple(out)

    @property
    def chunk_counts(self) -> tuple[int, ...]:
        """Chunks in each dimension."""
        return tuple(-(-n // size) for n, size in zip(self.shape, self.chunk_shape, strict=True))

    def chunks(self) -> Iterator[tuple[int, ...]]:
        """Numbers of all chunks, in order."""
        return itertools.product(*map(range, self.chunk_counts))

    def region(self, chunk: Sequence[int]) -> tuple[slice, ...]:
        """Where the cells of a chunk lie in the arrays of the whole map."""
        sizes = zip(chunk, self.chunk_shape, self.shape, strict=True)
        return tuple(slice(i * size, min((i + 1) * size, n)) for i, size, n in sizes)

    def cells(self, chunk: Sequence[int]) -> list[tuple[Any, ...]]:
        """Values of the parameters of all cells of a chunk, the last dimension fastest."""
        region = self.region(chunk)
        parts: list[list[tuple[Any, ...]]] = [
            [(value,) for value in axis.values[where]] for axis, where in zip(self.axes, region, strict=False)
        ]
        if self.distributions:
            parts.append([self._sample(row) for row in self.drawn[region[-1]].tolist()])
        return [tuple(itertools.chain.from_iterable(cell)) for cell in itertools.product(*parts)]

    def _sample(self, row: list[float]) -> tuple[Any, ...]:
        pairs = zip(self.distributions, row, strict=True)
        return tuple(f"{x!r} {one.unit}" if one.unit else x for one, x in pairs)

    @cached_property
    def drawn(self) -> FloatArray:
        """All samples, (count, distributions)."""
        return drawn(self.distributions, self.samples.count, self.samples.sampling, self.samples.seed)

    @property
    def unit(self) -> str:
        """Unit of the values: of B and L, or SI where the rods have dimensions."""
        dimension = self.rods.number.dimension
        return (UNITS if self.dimensionless else SI_UNITS)[dimension]

    @property
    def dimensionless(self) -> bool:
        """Whether the rods have no dimensions."""
        return self.rods.folder is None or "dimensionless" in self.rods.given

    @property
    def identity(self) -> dict[str, Any]:
        """All that the numbers depend on, as plain data: two maps of one identity are one map."""
        axes = {axis.name: _text_of(axis) for axis in self.axes} | {one.name: one.text for one in self.distributions}
        files = self._files()
        data = {
            "quantity": self.rods.quantity,
            "of": {k: v for k, v in self.rods.given.items() if k != "title"},
            "over": axes,
            "shape": list(self.shape),
            "samples": [self.samples.count, self.samples.sampling, self.samples.seed] if self.distributions else None,
            "rtol": self.rods.rtol if self.rods.folder is None else None,
            "values": blake2b(json.dumps([axis.values for axis in self.axes]).encode(), digest_size=8).hexdigest(),
            "rodwell": __version__,
            **({FILES: files} if files else {}),
        }
        plain: dict[str, Any] = json.loads(json.dumps(data, default=str))  # as a store gives it back
        return plain

    def _files(self) -> dict[str, str]:
        """Files that the case of any cell names, with digests of their contents; a problem names none."""
        if self.rods.folder is None:
            return {}
        varied = ({section: {key: axis.values}} for axis in self.axes for section, _, key in [axis.name.partition(".")])
        named = (named_files(data, Path(self.rods.folder)) for data in (self.rods.given, *varied))
        return dict(itertools.chain.from_iterable(files.items() for files in named))


def _text_of(axis: Axis) -> str:
    values = axis.numbers or axis.values
    ends = f"{values[0]:g}..{values[-1]:g}" if axis.numbers else ", ".join(map(str, values[:6]))
    return f"{ends} {axis.unit}".rstrip() + f" in {len(values)}" + (" log" if axis.logarithmic else "")


def asked(
    of: Problem | CaseText | str | Path | Mapping[str, Any],
    quantity: str,
    over: Mapping[str, Any],
    samples: Samples | None = None,
    *,
    load: float | None = None,
    rtol: float | None = None,
) -> Question:
    """Put a question: the number ``quantity`` of a problem or case, over parameters given as ``axes.read`` takes them.

    Single values among ``over`` replace those of the problem or case. ``rtol`` goes with a problem: a case has its own.

    Raises
    ------
    InputError
        Naming what cannot be used.
    """
    if quantity not in NUMBERS:
        raise InputError("quantity", quantity, f"must be one of {', '.join(NUMBERS)}")
    given, folder, title = _base(of)
    over = {**ranges_in(given if folder is not None else {}), **over}
    read_over = {name: read(name, values) for name, values in over.items()}
    for name in read_over:
        _check_name(name, folder is None)
    fixed = {name: over[name] for name, axis in read_over.items() if axis is None}
    if load is not None:
        fixed[LOAD] = checked_number(LOAD, load, -LARGEST_FORCE, LARGEST_FORCE, "an end force in B/L²")
    if not NUMBERS[quantity].at_load and (LOAD in fixed or LOAD in read_over):
        loads = ", ".join(name for name, number in NUMBERS.items() if number.at_load)
        raise InputError(LOAD, fixed.get(LOAD), f"goes with {loads}; {quantity} depends on no load: leave it out")
    axes = tuple(axis for axis in read_over.values() if isinstance(axis, Axis))
    drawn_ones = tuple(axis for axis in read_over.values() if isinstance(axis, Distribution))
    names = (*(axis.name for axis in axes), *(one.name for one in drawn_ones))
    tolerance = checked_rtol(RTOL if rtol is None else rtol)
    if folder is not None and rtol is not None:
        raise InputError("rtol", rtol, f"belongs to a problem; a case has a key: set analysis.rtol = {rtol:g} in it")
    rods = Rods(quantity, _with(given, fixed, folder is None), names, tolerance, folder)
    question = Question(rods, axes, drawn_ones, _checked(samples or Samples(), bool(drawn_ones)), title)
    _check_size(question)
    first = _first_case(question)
    return replace(question, rods=replace(rods, rtol=first.rtol))


def _base(of: Problem | CaseText | str | Path | Mapping[str, Any]) -> tuple[dict[str, Any], str | None, str]:
    """Data of problem or case, the folder of a case, its title."""
    if isinstance(of, Problem):
        return data_of(of), None, ""
    if isinstance(of, Mapping):
        return dict(printable_data(of)), ".", str(of.get("title", ""))
    if not isinstance(of, CaseText | str | Path):
        raise InputError("of", of, "must be a Problem, the path of a case file, or its content as a dictionary")
    text = of if isinstance(of, CaseText) else read_case(of)
    return dict(text.data), str(text.folder.resolve()), str(text.data.get("title") or text.name)


def ranges_in(data: Mapping[str, Any]) -> dict[str, str]:
    """Ranges and distributions that stand in a case file, by "section.key"."""
    sections = {name: section for name, section in data.items() if isinstance(section, Mapping) and name != "report"}
    texts = ((f"{name}.{key}", value) for name, section in sections.items() for key, value in section.items())
    return {name: value for name, value in texts if isinstance(value, str) and varies(value)}


def _check_name(name: str, of_problem: bool) -> None:
    if of_problem and name not in OF_PROBLEM:
        raise InputError(name, None, f"is no parameter of a problem that may vary: these are {', '.join(OF_PROBLEM)}")
    if not of_problem and (name.count(".") != 1 or name.startswith("analysis.")):
        raise InputError(name, None, 'is no key of a case that may vary: write section and key, "rod.length"')


def _with(given: dict[str, Any], fixed: dict[str, Any], of_problem: bool) -> dict[str, Any]:
    if of_problem:
        return given | fixed
    out = {k: dict(v) if isinstance(v, Mapping) else v for k, v in given.items() if k != "study"}
    for name, value in fixed.items():
        section, _, key = name.partition(".")
        out.setdefault(section, {})[key] = value
    return out


def _checked(samples: Samples, needed: bool) -> Samples:
    if samples.sampling not in SAMPLINGS:
        raise InputError("sampling", samples.sampling, f"must be one of {', '.join(SAMPLINGS)}")
    if needed != (samples.count > 0):
        why = "must be given: parameters are drawn at random" if needed else "draws nothing: no distribution is given"
        raise InputError("samples", samples.count, why)
    checked_whole("samples", samples.count, 0, MOST_SAMPLES)
    checked_whole("seed", samples.seed, 0, 2**32 - 1)
    return samples


def _check_size(question: Question) -> None:
    names = question.rods.names
    if not names:
        raise InputError("over", None, "nothing varies: give a parameter a range, a list or a distribution")
    if len(names) > MOST_PARAMETERS:
        raise InputError(names[MOST_PARAMETERS], None, f"is one too many: at most {MOST_PARAMETERS} parameters vary")
    if question.size > MOST_CELLS:
        raise InputError(names[-1], None, f"makes {question.size} cells; at most {MOST_CELLS:.0e}: use fewer values")


def _first_case(question: Question) -> Case:
    """The first cell that makes a problem; refused if the first, the middle and the last chunk hold none."""
    counts, why = question.chunk_counts, None
    for chunk in ([0] * len(counts), [n // 2 for n in counts], [n - 1 for n in counts]):
        for values in question.cells(chunk):
            try:
                return question.rods.case(values)
            except InputError as error:
                why = why or error
    assert why is not None
    raise why

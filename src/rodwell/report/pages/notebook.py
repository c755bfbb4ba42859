"""Results as small tables for notebooks: found by :mod:`rodwell.faces`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.answers.result.answer import Answer
from rodwell.answers.words.advice import statuses
from rodwell.answers.words.meaning import sentences
from rodwell.case.case import Case
from rodwell.plots.bifurcation import ORDINATES
from rodwell.problem.problem import Problem, ends_text
from rodwell.quantities.names import QUANTITIES
from rodwell.quantities.text import minus
from rodwell.report.pages.templates import template
from rodwell.report.reports.case import key_numbers
from rodwell.report.reports.content import Grid
from rodwell.report.reports.texts import KINDS, PLAIN_UNITS, conversions, derived, inputs, number, short
from rodwell.studies.maps.result import Map
from rodwell.studies.maps.words import sentences as map_sentences
from rodwell.studies.maps.words import title as map_title

FORCE = "F is the end force at s = 1, tension positive; units B = L = 1 where no other stand."

PARAMETERS = {
    "force": "F in B/L²",
    "weight": "weight γ",
    "alpha": "angle α in degrees",
    "clearance": "clearance Δ/L",
    "twist": "twisting moment T₁ in B/L",
}


@dataclass(frozen=True)
class Card:
    """What a notebook shows: a title, lines of words, tables, a remark."""

    title: str
    lines: tuple[str, ...]
    grids: tuple[Grid, ...]
    note: str = ""


def html(result: object) -> str:
    """Return a result as HTML: every text escaped, no colours of its own, so that dark themes stay legible."""
    return str(template("notebook.html.j2").render(card=card(result)))


@singledispatch
def card(result: object) -> Card:
    """What is shown of a result."""
    raise TypeError(f"{type(result).__name__} has no table")


@card.register
def _(result: Case) -> Card:
    grids = [Grid(("As given", ""), tuple(inputs(result))), Grid(("What follows", ""), tuple(derived(result)))]
    facts = tuple((label, value) for label, value, _ in conversions(result))
    grids += [Grid(("From the inputs", ""), facts)] if facts else []
    return Card(f"Case: {result.title}", (ends_text(result.problem),), tuple(grids))


@card.register
def _(result: CriticalLoads) -> Card:
    shape = {1: "even", -1: "odd", 0: "no symmetry"}
    rows = tuple((str(mode.number), number(mode.load), short(mode.error), shape[mode.parity]) for mode in result)
    lines = (_problem(result[0].problem),) if result else ()
    return Card(
        "Critical loads", lines, (Grid(("mode", "F in B/L²", "± error", "mode shape"), rows, (0, 1, 2)),), FORCE
    )


@card.register
def _(result: Branch) -> Card:
    low, high = result.reach
    parameter = PARAMETERS[result.parameter]
    lines = (
        _problem(result.problem),
        f"{len(result)} points, {parameter} from {_plain(low)} to {_plain(high)}; "
        + ("reached the end asked for" if result.reached_end else result.ended_because),
        _converged(result.converged),
    )
    rows = tuple(
        (
            KINDS[point.kind],
            number(point.reached),
            "" if point.kind == "end" else short(point.error),
            f"{point.index_before} → {point.index_after}",
            ", ".join(f"{s:.6g}" for s in point.s),
        )
        for point in result.special_points
    )
    head = ("what", parameter, "± error", "stability index", "s/L")
    note = f"{FORCE} Stability index: 0 is stable under dead loads, for a rod kept on the wall."
    return Card(f"Branch: {result.name}", lines, (Grid(head, rows, (1, 2)),), note)


@card.register
def _(result: Solution) -> Card:
    stable = "stable" if result.stable else f"unstable, stability index {result.stability_index}"
    rows = []
    for which in Measured:
        known = result.number(which)
        quantity = QUANTITIES[ORDINATES[which][0]]
        unit = PLAIN_UNITS[quantity.dimension]
        meaning = quantity.meaning.partition(";")[0]
        rows.append((meaning, quantity.symbol, number(known), short(known.error), unit))
    lines = (_problem(result.problem), f"{stable}, under dead loads, kept on the wall", _converged(result.converged))
    grid = Grid(("quantity", "symbol", "value", "± error", "unit"), tuple(rows), (2, 3))
    return Card(f"State at F = {_plain(result.force)} B/L²", lines, (grid,), FORCE)


@card.register
def _(result: Answer) -> Card:
    found = tuple(f"{status.subject}: {status.word} ({status.reason})" for status in statuses(result))
    (grid,) = (block for block in key_numbers(result).blocks if isinstance(block, Grid))
    return Card(result.case.title, (sentences(result)[0], *found), (grid,), FORCE)


def _problem(problem: Problem) -> str:
    text = f"γ = {problem.weight:.6g}, α = {problem.alpha:g}° from the vertical, Δ/L = {problem.clearance:.6g}"
    return minus(f"{text}, T₁ = {problem.twist:g} B/L, {ends_text(problem)}")


def _converged(met: bool) -> str:
    return "converged: every number meets the tolerance" if met else "NOT CONVERGED: see the errors"


def _plain(value: float) -> str:
    return minus(f"{value:.8g}")


@card.register
def _(result: Map) -> Card:
    return Card(map_title(result), tuple(map_sentences(result)), ())

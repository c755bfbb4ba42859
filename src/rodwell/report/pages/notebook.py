"""Results as small tables for notebooks: found by :mod:`rodwell.faces`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.endless.endless import Endless
from rodwell.analysis.endless.state import NUMBERS
from rodwell.analysis.path.events import MEANING
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.answers.result.answer import Answer
from rodwell.answers.words.advice import statuses
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.wording import forces_in
from rodwell.case.case import Case
from rodwell.plots.ordinates import ORDINATES
from rodwell.problem.problem import Problem
from rodwell.problem.words import ends_text
from rodwell.quantities.names import QUANTITIES
from rodwell.quantities.text import minus
from rodwell.report.pages.templates import template
from rodwell.report.reports.case import key_numbers
from rodwell.report.reports.content import Grid
from rodwell.report.reports.drag import ends_grid
from rodwell.report.reports.texts import KINDS, PLAIN_UNITS, conversions, derived, inputs, number, short
from rodwell.studies.drag.drag import Drag
from rodwell.studies.drag.words import sentences as drag_sentences
from rodwell.studies.maps.result import Map
from rodwell.studies.maps.words import sentences as map_sentences
from rodwell.studies.maps.words import title as map_title
from rodwell.studies.packer.packer import PackerAnswer
from rodwell.studies.packer.tables import SIGNS, packer_table
from rodwell.studies.packer.words import sentences as packer_sentences

FORCE = "F is the end force at s = 1, tension positive; units B = L = 1 where no other stand."

PARAMETERS = {
    "force": "F in B/L²",
    "weight": "weight γ",
    "alpha": "angle α in degrees",
    "clearance": "clearance Δ/L",
    "twist": "twisting moment T₁ in B/L",
    "poisson": "Poisson's ratio ν",
    "torsion": "torsional stiffness C/B",
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
    parameter = PARAMETERS.get(str(result.parameter), str(result.parameter))
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
    if result.beyond is not None:
        happens = {**MEANING, **KINDS}
        rows += tuple(
            (
                f"off the wall: {happens[away.kind]}",
                number(away.reached),
                "" if away.kind == "end" else short(away.reached.error),
                f"{away.index_before} → {away.index_after}",
                ", ".join(f"{s:.6g}" for s in away.s),
            )
            for away in result.beyond.special_points
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
def _(result: Drag) -> Card:
    note = "Effective forces, tension positive; hook load at surface without the block."
    return Card(f"Torque and drag: {result.well.title}", (drag_sentences(result)[0],), (ends_grid(result),), note)


@card.register
def _(result: Endless) -> Card:
    slope = "small slopes" if result.slope == 0.0 else f"slope ε = {result.slope:g}"
    loads = tuple(
        (name.replace("_", " "), number(load), short(load.error))
        for name, load in result.loads.named().items()
        if load is not None
    )
    grids = [Grid(("load β at which", "value", "± error"), loads, (1, 2))]
    for kind, state in result.states.items():
        rows = [(name.replace("_", " "), getattr(state, name)) for name in NUMBERS]
        cells = tuple((name, number(value), short(value.error)) for name, value in rows)
        title = f"{kind} state" if state.in_contact else f"{kind} state, on paper only: the wall would pull"
        grids.append(Grid((title, "value", "± error"), cells, (1, 2)))
    title = "Endless rod" if result.beta is None else f"Endless rod at β = {_plain(result.beta)}"
    note = "β = P/√(Bq/D), compression P positive; forces per length in q, lengths in ℓ = ∜(BD/q)."
    return Card(title, (f"kept on the wall, {slope}",), tuple(grids), note)


@card.register
def _(result: PackerAnswer) -> Card:
    table = packer_table(result)
    cells = tuple((str(row[0]), *(f"{x:.6g}" for x in row[1:3]), *map(str, row[3:])) for row in table.rows)
    title, *more = packer_sentences(result)
    return Card(result.case.title, (title, *more), (Grid(table.columns, cells, (1, 2)),), " ".join(SIGNS[:2]))


@card.register
def _(result: LoadPath) -> Card:
    why = forces_in(result, None).retold(result.ended_because)
    ended = "followed to the end" if result.reached else f"not followed to the end: {why}"
    rows = tuple(
        (
            event.leg,
            event.meaning,
            number(event.force),
            short(event.force.error),
            ", ".join(f"{s:.6g}" for s in event.s),
        )
        for event in result.events
    )
    grid = Grid(("leg", "what", "F in B/L²", "± error", "s/L"), rows, (2, 3))
    lines = (_problem(result.problem), ended, _converged(not result.missed))
    return Card("Load path", lines, (grid,), f"{FORCE} {result.assumptions[0].upper()}{result.assumptions[1:]}.")


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

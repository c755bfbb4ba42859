"""What ``rodwell critical`` prints of a rod that lies along a curved hole."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import UNIT, print_json
from rodwell.problem.words import side_of_wall
from rodwell.quantities.text import plain, with_error

if TYPE_CHECKING:
    from rodwell.analysis.straight.critical import CriticalLoads, Mode
    from rodwell.problem.problem import Problem
    from rodwell.quantities.value import Peak, Value
    from rodwell.report.folders.numbers import Numbers

CONTACT = "B/L³"


def show_lying(loads: CriticalLoads, tensile: CriticalLoads, unheld: Value | str | None, as_json: bool) -> None:
    """Print loads of both signs and where the rod lies, or all of it as JSON; ``unheld`` is that of a string."""
    if as_json:
        print_json(_data(loads, tensile, unheld))
        return
    _print(loads, tensile)
    if isinstance(unheld, str):
        wrapped(f"When it buckles if nothing holds it at its steps was not found: {unheld}")
    elif unheld is not None:
        click.echo(
            f"  not held at its steps, off the wall beside them: {with_error(unheld)}   out of the vertical plane"
        )


def unheld_load(problem: Problem, rtol: float) -> Value | str | None:
    """The load at which a string buckles sideways that is off the wall beside its steps, or why it is not known.

    None of one without steps of its stiffness.
    """
    from rodwell.analysis.path.follow import not_held_at_steps  # noqa: PLC0415

    found = not_held_at_steps(problem, rtol)
    return found if found is None or isinstance(found, str) else found.force


def lying_numbers(loads: CriticalLoads, tensile: CriticalLoads, unheld: Value | str | None) -> Numbers:
    """Loads as files: the same data, a row for each load, and the modes in compression drawn."""
    from rodwell.plots.profiles import plot_modes  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("kind", "mode", "end force along the rod at s = 1, tension positive [B/L^2]", "error [B/L^2]")
    kinds = (("compression", loads), ("tension", tensile))
    rows = [(kind, mode.number, mode.force, mode.error) for kind, modes in kinds for mode in modes]
    table = Table("critical", columns, tuple(rows))
    if unheld is not None and not isinstance(unheld, str):
        table = Table("critical", columns, (*rows, ("not held at steps", 1, unheld.value, unheld.error)))
    return Numbers("critical", _data(loads, tensile, unheld), table, lambda axes: plot_modes(loads, ax=axes))


def _data(loads: CriticalLoads, tensile: CriticalLoads, unheld: Value | str | None) -> dict[str, Any]:
    from rodwell.analysis.state.wall import lying_step_loads  # noqa: PLC0415
    from rodwell.analysis.straight.lying import least_contact, lies_between  # noqa: PLC0415
    from rodwell.answers.words.steps import steps_data  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    problem = loads[0].problem
    low, high = lies_between(problem)
    return {
        "critical_loads": [float(f) for f in loads.forces],
        "error": [float(e) for e in loads.errors],
        "tensile_loads": [{"value": mode.force, "error": mode.error} for mode in tensile],
        "without_wall": None,
        **({} if unheld is None else {"not_held_at_steps": unheld if isinstance(unheld, str) else unheld.as_dict()}),
        "lying": {
            "side": side_of_wall(problem),
            "lowest_force": _peak(low),
            "highest_force": _peak(high),
            "least_contact": [_peak(least_contact(problem, mode.force)) for mode in loads],
            "least_contact_tensile": [_peak(least_contact(problem, mode.force)) for mode in tensile],
            "contact_unit": "B/L^3",
            **({"steps": steps_data(lying_step_loads(problem))} if problem.sections else {}),
        },
        "unit": "B/L^2",
        "convention": "end force along the tangent of the rod on the wall at s = 1, tension positive; "
        + ends_text(problem),
    }


def _peak(peak: Peak | None) -> dict[str, float] | None:
    return None if peak is None else {"value": float(peak.value), "error": float(peak.error), "s": float(peak.s)}


def _print(loads: CriticalLoads, tensile: CriticalLoads) -> None:
    from rodwell.analysis.state.wall import lying_step_loads  # noqa: PLC0415
    from rodwell.analysis.straight.lying import off_at_steps  # noqa: PLC0415
    from rodwell.answers.words.steps import steps_note  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    problem = loads[0].problem
    wrapped(f"{_hole(problem)} End force along the tangent of the rod on the wall at s = 1, tension positive.")
    click.echo(f"Critical end force in {UNIT}, {ends_text(problem)}:")
    for mode in loads:
        click.echo(f"  mode {mode.number:>2}  {with_error(mode.load)}   {_symmetry(mode)}{_pulls(problem, mode)}")
    for mode in tensile:
        click.echo(f"  in tension, {mode.number}  {with_error(mode.load)}   {_symmetry(mode)}{_pulls(problem, mode)}")
    wrapped(_range(problem))
    note = steps_note(lying_step_loads(problem), bent=True, off=off_at_steps(problem, loads[0].force))
    if note:
        wrapped(note)


def _hole(problem: Problem) -> str:
    given = f"build {plain(problem.build, 6)}/L" if not problem.axis else "the axis given"
    lies = f"The rod {'floats, and ' if problem.floats else ''}lies on the {side_of_wall(problem)} side"
    return f"{lies} of a curved hole ({given}, α = {plain(problem.alpha, 6)}° at mid-length)."


def _symmetry(mode: Mode) -> str:
    return {1: "even", -1: "odd", 0: "no symmetry"}[mode.parity]


def _pulls(problem: Problem, mode: Mode) -> str:
    """What the wall would have to do at a load, if it would have to pull."""
    from rodwell.analysis.straight.lying import least_contact  # noqa: PLC0415

    least = least_contact(problem, mode.force)
    if least.value >= 0.0:
        return ""
    return f"   the wall would have to pull, {plain(-least.value, 3)} {CONTACT} at s/L = {plain(least.s, 3)}"


def _range(problem: Problem) -> str:
    """Between which forces the rod lies by itself."""
    from rodwell.analysis.straight.lying import lies_between  # noqa: PLC0415

    low, high = lies_between(problem)
    if low is not None and high is not None and low.value >= high.value:
        return (
            "At no end force does the undeformed rod lie on this side by itself: somewhere the wall would have to pull."
        )
    said = []
    if low is not None:
        said.append(f"above {plain(low.value, 6)} {UNIT} (below, it leaves the wall at s/L = {plain(low.s, 3)} first)")
    if high is not None:
        said.append(
            f"below {plain(high.value, 6)} {UNIT} (above, it leaves the wall at s/L = {plain(high.s, 3)} first)"
        )
    if not said:
        return "The undeformed rod lies on this side at every end force."
    return f"The undeformed rod lies on this side by itself at end forces {' and '.join(said)}."

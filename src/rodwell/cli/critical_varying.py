"""What ``rodwell critical`` prints of a rod on a wall whose clearance varies smoothly."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import UNIT, print_json
from rodwell.quantities.text import plain, with_error

if TYPE_CHECKING:
    from rodwell.analysis.straight.critical import CriticalLoads
    from rodwell.quantities.value import Peak
    from rodwell.report.folders.numbers import Numbers


def show_varying(loads: CriticalLoads, asked: int, as_json: bool) -> None:
    """Print the loads, how the wall pushes along the hole and where it presses least; or all of it as JSON."""
    if as_json:
        print_json(_data(loads))
    else:
        _print(loads, asked)


def varying_numbers(loads: CriticalLoads) -> Numbers:
    """Loads as files: the same data as on the terminal, a row for each load, and the modes drawn."""
    from rodwell.plots.profiles import plot_modes  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("mode", "end force at s = 1, tension positive [B/L^2]", "error [B/L^2]")
    table = Table("critical", columns, tuple((mode.number, mode.force, mode.error) for mode in loads))
    return Numbers("critical", _data(loads), table, lambda axes: plot_modes(loads, ax=axes))


def _least(loads: CriticalLoads) -> Peak:
    from rodwell.analysis.straight.ramps import least_contact_on_ramps  # noqa: PLC0415

    return least_contact_on_ramps(loads[0].problem, loads[0].force)


def _data(loads: CriticalLoads) -> dict[str, Any]:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    least = _least(loads)
    return {
        "critical_loads": [float(f) for f in loads.forces],
        "error": [float(e) for e in loads.errors],
        "tensile_loads": [],
        "without_wall": None,
        "varying_clearance": {
            "axial_contact": loads.axial_contact,
            "least_contact": {**least.as_dict(), "s": least.s},
        },
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; contact force per length in B/L^3 at the first load; "
        + ends_text(loads[0].problem),
    }


def _print(loads: CriticalLoads, asked: int) -> None:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    least = _least(loads)
    click.echo(f"Critical end force at s = 1 in {UNIT} (tension positive), {ends_text(loads[0].problem)}:")
    for mode in loads:
        symmetry = {1: "even", -1: "odd", 0: "no symmetry"}[mode.parity]
        click.echo(f"  mode {mode.number:>2}  {with_error(mode.load)}   {symmetry}")
    wrapped(
        "The clearance varies along the rod. At the first load the wall presses the rod least at "
        f"s/L = {plain(least.s, 4)}, by {plain(least.value, 4)} B/L³, and pushes it along the hole with "
        f"{plain(abs(loads.axial_contact), 3)} {UNIT} in all, towards s = {1 if loads.axial_contact < 0.0 else 0}."
    )
    if len(loads) < asked:
        wrapped("At higher loads the wall would have to pull: the rod has left it before.")

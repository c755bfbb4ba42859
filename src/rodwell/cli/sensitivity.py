"""``rodwell sensitivity``: how loads change with the data of a dimensionless problem."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.keep import keep, keep_options, take_keep
from rodwell.cli.listing import wrapped
from rodwell.cli.options import UNIT, check_missed, json_option, make_problem, print_json, problem_options, rtol_option
from rodwell.quantities.text import signed, with_error

if TYPE_CHECKING:
    from rodwell.analysis.loads.derivatives import Sensitivity
    from rodwell.report.folders.numbers import Numbers


@click.command(short_help="How loads change with weight, inclination, clearance, twist.")
@problem_options()
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@keep_options("the changes as bars")
@rtol_option
@json_option
def sensitivity(mode: int, rtol: float, as_json: bool, **given: Any) -> None:
    """How critical and lift-off load change with weight, inclination, clearance, stiffness, length and curvature.

    Exact derivatives, and elasticities: the change of the end force at s = 1 in percent for one percent more of an
    input, the others constant.
    """
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    where, problem = take_keep(given), make_problem(given)
    if problem.leaves_wall:
        from rodwell.analysis.path.bridged_slopes import sensitivities  # noqa: PLC0415
    else:
        from rodwell.analysis.loads.sensitivity import sensitivities  # noqa: PLC0415
    loads = sensitivities(problem, mode, rtol=rtol)
    missed = [load.name for load in loads if not load.converged]
    convention = "end force F at s = 1 in B/L^2, tension positive; alpha in degrees; " + ends_text(problem)
    data = {"loads": [load.as_dict() for load in loads], "convention": convention}
    if as_json:
        print_json(data)
    else:
        _print_sensitivities(loads)
    keep(where, lambda: _sensitivity_numbers(data, loads), quiet=as_json)
    check_missed(missed, rtol)


def _print_sensitivities(loads: tuple[Sensitivity, ...]) -> None:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    for load in loads:
        problem = load.problem
        wrapped(f"{load.name}: F = {signed(load.force, 10)} {UNIT} at s = 1 (tension positive), {ends_text(problem)}")
        for name, slope in load.derivatives.items():
            click.echo(f"  dF per {_PER[name]:<13} {with_error(slope)}")
        if load.force != 0.0:
            for name, change in load.elasticities().items():
                click.echo(f"  {_MORE[name]:<26} {signed(change.value, 6)} %")
        for number, section in enumerate(load.sections, 1):
            for name, slope in section.items():
                click.echo(f"  dF per {_OF_SECTION[name].format(number):<44} {with_error(slope)}")
        if load.note:
            wrapped(load.note, "  ")


def _sensitivity_numbers(data: dict[str, Any], loads: tuple[Sensitivity, ...]) -> Numbers:
    """Derivatives and elasticities as files, the latter drawn."""
    from rodwell.plots.loads.sensitivity import plot_sensitivities  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("load", "end force at s = 1, tension positive [B/L^2]", "change of", "value", "error", "kind")
    rows = []
    for load in loads:
        percent = load.elasticities() if load.force != 0.0 else {}
        for kind, changes in (("derivative", load.derivatives), ("percent for 1 % (alpha: 1 degree)", percent)):
            rows += [
                (load.name, load.force, name, change.value, change.error, kind) for name, change in changes.items()
            ]
    table = Table("sensitivity", columns, tuple(rows))
    return Numbers("sensitivity", data, table, lambda axes: plot_sensitivities(loads, axes))


_PER = {"weight": "unit of γ", "alpha": "degree of α", "clearance": "unit of Δ/L", "twist": "B/L of T₁",
        "build": "1/L of build", "walk": "1/L of walk"}  # fmt: skip
_OF_SECTION = {
    "stiffness": "unit of the stiffness ratio, section {}",
    "weight": "unit of the weight ratio, section {}",
    "stiffness_factor": "unit of a factor on the stiffness, section {}",
    "weight_factor": "unit of a factor on the weight, section {}",
    "clearance": "unit of the clearance ratio, section {}",
    "upper_end": "L that section {} is longer, the next shorter",
}
_MORE = {
    "weight_per_length": "1 % more weight per length",
    "clearance": "1 % more clearance Δ",
    "stiffness": "1 % more stiffness B",
    "length": "1 % more length L",
    "alpha": "1° more from the vertical",
    "build": "1 % more curvature, build",
    "walk": "1 % more turn, walk",
}

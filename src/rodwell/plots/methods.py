"""What the ``plot`` methods of results draw: found by :mod:`rodwell.faces`."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.diagram import Diagram
from rodwell.analysis.branch.functionals import Number
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.curves.curve import Curve
from rodwell.analysis.discrete.measures import Measured, measured
from rodwell.analysis.endless.endless import Endless
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.answers.result.answer import Answer
from rodwell.errors import InputError
from rodwell.plots.bifurcation import plot_bifurcation
from rodwell.plots.curves import plot_curves
from rodwell.plots.endless import plot_endless
from rodwell.plots.fields import plot_field
from rodwell.plots.in_parameter import plot_in_parameter
from rodwell.plots.maps.figure import plot_map
from rodwell.plots.paths.path import plot_path
from rodwell.plots.profiles import plot_modes
from rodwell.plots.rod3d import WIDE, plot_rod, wide_axes
from rodwell.plots.style import RC, SIZE
from rodwell.plots.wells.drag import plot_drag
from rodwell.plots.wells.packer import plot_packer
from rodwell.quantities.scales import Scales
from rodwell.studies.drag.drag import Drag
from rodwell.studies.maps.result import Map
from rodwell.studies.packer.packer import PackerAnswer


def plot(result: object, ax: Any = None, **options: Any) -> Any:
    """Draw a result on ``ax``, or on new axes of pyplot; return the axes."""
    return _on_axes(ax, SIZE, _subplot, lambda axes: _plot(result, axes, **options))


def plot_in_space(result: Solution | ContactState, ax: Any = None, **options: Any) -> Any:
    """Draw a state in three dimensions on ``ax``, or on new axes of pyplot; return the axes."""
    state = result.fine if isinstance(result, ContactState) else result
    return _on_axes(ax, WIDE, wide_axes, lambda axes: plot_rod(state, ax=axes, **options))


def _subplot(figure: Figure) -> Any:
    figure.set_layout_engine("constrained")
    return figure.add_subplot()


def _on_axes(ax: Any, size: tuple[float, float], new: Callable[[Figure], Any], draw: Callable[[Any], Any]) -> Any:
    """Draw on ``ax``, or on ``new`` axes of a figure of pyplot, which notebooks and ``pyplot.show`` show."""
    if ax is not None:
        with mpl.rc_context(RC):
            return draw(ax)
    from matplotlib import pyplot  # noqa: PLC0415 - for those who look on; files are drawn without it

    figure = pyplot.figure(figsize=size)  # outside rc_context, which would undo what a backend sets when it is loaded
    try:
        with mpl.rc_context(RC):
            return draw(new(figure))
    except BaseException:
        pyplot.close(figure)
        raise


def _known(ordinate: Number | None) -> Measured | None:
    """The measured number that a bifurcation diagram shows, by its name."""
    if callable(ordinate):
        raise InputError("ordinate", ordinate, "must be the name of a measured number where several branches are drawn")
    return None if ordinate is None else measured(ordinate)


@singledispatch
def _plot(result: object, axes: Any, **_options: Any) -> Any:
    raise TypeError(f"{type(result).__name__} cannot be drawn")


@_plot.register
def _(result: Branch, axes: Any, ordinate: Number | None = None, scales: Scales | None = None) -> Any:
    if result.parameter != "force" or callable(ordinate):
        if scales is not None:
            raise InputError("scales", None, "must be left out: such a branch is drawn in units B = L = 1")
        return plot_in_parameter(result, axes, ordinate)
    return plot_bifurcation([result], CriticalLoads(), scales, axes, _known(ordinate))


@_plot.register
def _(result: Diagram, axes: Any, ordinate: Number | None = None, scales: Scales | None = None) -> Any:
    shown = [branch for branch in result.branches if branch.parameter == "force"]
    return plot_bifurcation(shown, result.critical, scales, axes, _known(ordinate))


@_plot.register
def _(result: Answer, axes: Any, ordinate: Number | None = None) -> Any:
    return plot_bifurcation(result.branches, result.critical, result.case.scales, axes, _known(ordinate))


@_plot.register
def _(result: CriticalLoads, axes: Any, **options: Any) -> Any:
    return plot_modes(result, ax=axes, **options)


@_plot.register
def _(result: Drag, axes: Any) -> Any:
    return plot_drag(result, ax=axes)


@_plot.register
def _(result: Curve, axes: Any) -> Any:
    return plot_curves([result], ax=axes)


@_plot.register
def _(result: Map, axes: Any, **options: Any) -> Any:
    return plot_map(result, axes, **options)


@_plot.register
def _(result: Endless, axes: Any, **options: Any) -> Any:
    return plot_endless(result, ax=axes, **options)


@_plot.register
def _(result: PackerAnswer, axes: Any) -> Any:
    return plot_packer(result, ax=axes)


@_plot.register
def _(result: LoadPath, axes: Any) -> Any:
    return plot_path(result, ax=axes)


@_plot.register
def _(result: Solution, axes: Any, field: str = "contact_pressure", **options: Any) -> Any:
    return plot_field(result, field, ax=axes, **options)

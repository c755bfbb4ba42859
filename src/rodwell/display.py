"""How results show themselves in notebooks, and draw themselves.

Results are made by packages that know of neither pages nor drawing. What shows them stands above those and is found by
name at the first call, as the names of the package :mod:`rodwell` are; so nothing is imported before it is used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Shown:
    """A result that notebooks show as a small table."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        """The result as HTML, for notebooks: numbers with units and errors, titles escaped."""
        return str(import_module("rodwell.report.notebook").html(self))


def drawn_in_space(result: object, ax: Axes | None, **options: Any) -> Axes:
    """Draw a state in three dimensions, as :func:`drawn` does."""
    axes: Axes = import_module("rodwell.plots.methods").plot_in_space(result, ax, **options)
    return axes


def drawn(result: object, ax: Axes | None, **options: Any) -> Axes:
    """Draw a result on ``ax``, or on new axes of pyplot, which notebooks show by themselves; return the axes."""
    axes: Axes = import_module("rodwell.plots.methods").plot(result, ax, **options)
    return axes

"""How results show, draw and write themselves: hooks that stand below all results and are filled from above.

Results are made in rooms that know neither pages nor drawings nor files; what shows them stands above those. So the
faces of results are six hooks here, empty at first. The door, :mod:`rodwell`, fills them when it is opened, with
functions that import what they need at the first call: nothing is imported before it is used, and imports go down only.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes  # noqa: PLC0414 - the one alias, for annotations of results that draw

Face = Callable[..., Any]

HOOKS = ("html", "plot", "plot_in_space", "animation", "dataset", "plain")
"""As HTML for notebooks; drawn on axes; drawn in space; as an animation in a file; as an xarray Dataset; as plain data
for JSON."""

_faces: dict[str, Face] = {}


def fill(**faces: Face) -> None:
    """Put functions of a result into the hooks of these names.

    Raises
    ------
    LookupError
        If there is no hook of a name.
    """
    for name in faces:
        if name not in HOOKS:
            raise LookupError(f"there is no hook {name!r}; there are {', '.join(HOOKS)}")
    _faces.update(faces)


def face(name: str) -> Face:
    """Return what a hook holds.

    Raises
    ------
    LookupError
        If it is empty: the package :mod:`rodwell`, which fills it, was not imported as a whole.
    """
    if name not in _faces:
        raise LookupError(f"the hook {name!r} is empty: import rodwell, which fills it")
    return _faces[name]


class Shown:
    """A result that notebooks show as a small table."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        """The result as HTML, for notebooks: numbers with units and errors, titles escaped."""
        return str(face("html")(self))


def drawn(result: object, ax: Axes | None, **options: Any) -> Axes:
    """Draw a result on ``ax``, or on new axes of pyplot, which notebooks show by themselves; return the axes."""
    axes: Axes = face("plot")(result, ax, **options)
    return axes


def drawn_in_space(result: object, ax: Axes | None, **options: Any) -> Axes:
    """Draw a state in three dimensions, as :func:`drawn` does."""
    axes: Axes = face("plot_in_space")(result, ax, **options)
    return axes


def plain(result: object) -> dict[str, Any]:
    """Return a result as plain data, for JSON."""
    data: dict[str, Any] = face("plain")(result)
    return data

"""What takes the wall of a case as rigid, and says so."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

from rodwell.errors import InputWarning

LEFT_ASIDE = (
    "wall_stiffness is left aside: the wall is rigid here; it counts in `rodwell run` beyond lift-off and in "
    "`rodwell path CASE`"
)


def gives_way(sections: Mapping[str, Any]) -> bool:
    """Whether the sections of a case file give the wall a stiffness."""
    known = (sections.get(name) for name in ("hole", "dimensionless"))
    return any(isinstance(keys, Mapping) and "wall_stiffness" in keys for keys in known)


def warn_if_it_gives_way(sections: Mapping[str, Any]) -> None:
    """Warn the caller of a public function that it leaves the stiffness of a case's wall aside."""
    if gives_way(sections):
        warnings.warn(LEFT_ASIDE, InputWarning, stacklevel=3)

"""What there is: each table, figure and group of numbers by name, with its claims and its data."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from rodwell.errors import InputError
from rodwell.studies.paper import diagrams, linear, scorer, shapes, stability, table1, twisting
from rodwell.studies.paper.claims import Claim
from rodwell.studies.paper.work import Work


@dataclass(frozen=True)
class Item:
    """A table, figure or group of numbers.

    Attributes
    ----------
    name
        As ``--only`` takes it.
    title
        What it shows.
    claims
        Makes the list of its printed numbers.
    figure
        Computes what its figure shows; None if there is none.
    """

    name: str
    title: str
    claims: Callable[[], list[Claim]] | None = None
    figure: Callable[[Work], Any] | None = None


def _fig12(work: Work) -> tuple[diagrams.Panel, stability.Stability]:
    return diagrams.fig12a(work), stability.fig12b(work)


ITEMS = {
    item.name: item
    for item in (
        Item("eq63", "weight of the drill string (62)", linear.claims_63),
        Item("loads", "critical loads quoted in section 4.1.2", linear.claims_text),
        Item("table1", "Table 1, mode switching", table1.claims),
        Item("fig3", "bifurcation diagrams, horizontal cylinder", diagrams.claims_3, diagrams.fig3),
        Item("fig4", "y and T₂ along the branch without symmetry", shapes.claims_4, shapes.fig4),
        Item("fig5", "stability diagram, horizontal cylinder", None, stability.fig5),
        Item("fig6", "stability diagrams, inclined cylinders", linear.claims_6, stability.fig6),
        Item("eq79", "critical lines of the vertical column", linear.claims_79),
        Item("fig7", "solutions at different inclinations", None, shapes.fig7),
        Item("fig8", "shapes in space at γ = 140", None, shapes.fig8),
        Item("fig9", "bifurcation diagram, vertical column", linear.claims_9, diagrams.fig9),
        Item("eq87", "self-weight buckling, (86) and (87)", linear.claims_87),
        Item("fig10", "determinant (86)", None, lambda _work: scorer.data()),
        Item("eq88", "column free to sway, (88), and the factor 1.58", linear.claims_88),
        Item("fig11", "twist at lift-off", twisting.claims, twisting.fig11),
        Item("fig12", "rod on top of the cylinder", linear.claims_12, _fig12),
        Item("fig13", "Dellinger's fit (89)", None, stability.fig13),
    )
}  # fmt: skip
"""In the order of the paper."""


def chosen(names: Sequence[str] | None) -> tuple[Item, ...]:
    """Return the items of these names in the order of the paper, all of them for None.

    Raises
    ------
    InputError
        For a name that is not in the list, or none at all.
    """
    if names is None:
        return tuple(ITEMS.values())
    unknown = [name for name in names if name not in ITEMS]
    if unknown or not names:
        raise InputError("only", ",".join(unknown or names), f"must be one or more of {', '.join(ITEMS)}")
    return tuple(item for item in ITEMS.values() if item.name in names)

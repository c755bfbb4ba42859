"""Picture and tables of the page on the braid and its reactions, called by ``make_pages``: everything is computed."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.patches import Arc, Circle
from shown import DPI, number, table

import rodwell
from rodwell.analysis.branch.solution import Solution
from rodwell.physics.on_wall.frames import frames
from rodwell.plots.style import GREY, INK, MODES, RC, WARN, new_axes

PROBLEM, FORCE, CUT = rodwell.Problem(15.0, alpha=60.0), -110.0, 0.4
"""The state of the page, and the place at which rod and cylinder are cut."""

LARGER = 3.0
"""How many times as large the angle around the wall is drawn across the axis."""

AXES = ("i, up across the axis", "j, sideways", "k, along the axis")


@cache
def state() -> Solution:
    """A buckled rod that lies on the wall."""
    return rodwell.follow(PROBLEM, 1, until=FORCE)[-1]


def pages(out: Path) -> dict[str, str]:
    """Draw the picture into ``out``; return the tables."""
    with mpl.rc_context(RC):
        draw(out / "braid.png")
    return {"braid-cut.md": cut_table(), "braid-supports.md": supports_table()}


def numbers() -> dict[str, str]:
    """Numbers that the text quotes."""
    fields = state().fields([CUT])
    names = {"braid_p": "contact_pressure", "braid_T2": "T2", "braid_mu": "mu", "braid_M3": "cylinder_M3"}
    out = {key: number(float(fields[name][0]), 5 if key != "braid_p" else 3) for key, name in names.items()}
    out["braid_angle"] = number(float(np.degrees(fields["xi2"][0])), 1)
    return out


def vectors(s: np.ndarray) -> dict[str, np.ndarray]:
    """Forces and moments at ``s`` (m,) as vectors along i, j, k, (m, 3), rebuilt from their components."""
    f = state().fields(s)
    axes = frames(f["xi1"], f["eta"], f["xi2"])

    def along(frame: str, *names: str) -> np.ndarray:
        return np.einsum("mij,mj->mi", axes[frame], np.stack([f[name] for name in names], axis=1))

    def three(kind: str) -> tuple[str, str, str]:
        return f"{kind}1", f"{kind}2", f"{kind}3"

    d1 = axes["R11"][:, :, 1]
    cylinder = along("R12", *three("cylinder_F"))
    return {
        "rod force": along("R11", *three("rod_F")),
        "cylinder force": cylinder,
        "braid force": along("R11", *three("braid_F")),
        "rod moment": along("R11", *three("rod_M")),
        "cylinder moment": along("R12", "T2", "mu", "cylinder_M3"),
        "lever": PROBLEM.clearance * np.cross(d1, cylinder),
        "braid moment": along("R11", *three("braid_M")),
        "push": -f["contact_pressure"][:, None] * d1,
    }


def cut_table() -> str:
    """The balance (45) at a cut, in components."""
    v = {name: value[0] for name, value in vectors(np.array([CUT])).items()}
    rows = []
    for kind, parts, words in (
        ("force", ("rod force", "cylinder force"), ("F⁽¹⁾, in the rod", "F⁽²⁾, in the cylinder")),
        (
            "moment",
            ("rod moment", "cylinder moment", "lever"),
            ("M⁽¹⁾, in the rod", "M⁽²⁾, in the cylinder", "Δ d₁ × F⁽²⁾, lever of the cylinder's force"),
        ),
    ):
        total, whole = sum(v[part] for part in parts), v[f"braid {kind}"]
        if np.max(np.abs(total - whole)) > 1e-8 * np.max(np.abs(whole)):
            raise RuntimeError(f"docs: (45) does not hold for the {kind}: {total - whole}")
        lines = [*zip(words, (v[part] for part in parts), strict=True), (f"**{kind} of the braid, (22)–(27)**", whole)]
        rows += [(name, *(number(round(float(x), 5) + 0.0, 5) for x in value)) for name, value in lines]
    return table(("At s = 0.4", *AXES), rows)


def balance() -> dict[str, np.ndarray]:
    """Forces on the whole rod, (3,) each; they add up to zero, (48) integrated along the rod."""
    nodes, weights = np.polynomial.legendre.leggauss(200)
    s, w = 0.5 * (nodes + 1.0), 0.5 * weights
    rod = {r.s: r.force for r in state().reactions if r.on == "rod"}
    return {
        "support at s = 0, on the rod": rod[0.0],
        "support at s = 1, on the rod": rod[1.0],
        "wall, ∫ −p d₁ ds": w @ vectors(s)["push"],
        "weight": np.array([-PROBLEM.lateral_weight, 0.0, -PROBLEM.axial_weight]),
    }


def supports_table() -> str:
    """What acts on the whole rod, and what the cylinder's support gives."""
    forces = balance()
    total = sum(forces.values())
    if np.max(np.abs(total)) > 1e-8 * abs(FORCE):
        raise RuntimeError(f"docs: the rod is not in balance: {total}")
    rows = [(name, *(number(round(float(x), 5) + 0.0, 5) for x in value)) for name, value in forces.items()]
    rows.append(("**sum**", *(f"{abs(x):.0e}".replace("-", "−") for x in total)))
    pipe = next(r for r in state().reactions if r.on == "cylinder" and r.s == 0.0)
    for name, value in (("force", pipe.force), ("moment, B/L,", pipe.moment)):
        cells = (number(round(float(x), 5) + 0.0, 5) for x in value)
        rows.append((f"{name} of the support at s = 0 on the cylinder", *cells))
    return table(("Force in B/L²", *AXES), rows)


def draw(path: Path) -> None:
    """Two views of the state at the cut: across the axis, and the wall unrolled."""
    left = new_axes(size=(9.4, 4.6))
    left.set_subplotspec(left.figure.add_gridspec(1, 2, width_ratios=(1.0, 1.25))[0])
    right = left.figure.add_subplot(left.figure.axes[0].get_subplotspec().get_gridspec()[1])
    _section(left)
    _unrolled(right)
    left.figure.savefig(path, dpi=DPI)


def _arrow(
    ax: Any, start: tuple[float, float], by: tuple[float, float], text: str, color: str = INK, **place: Any
) -> None:
    end = (start[0] + by[0], start[1] + by[1])
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.6, "shrinkA": 0, "shrinkB": 0})
    away = (start[0] + 1.15 * by[0], start[1] + 1.15 * by[1])
    ax.annotate(text, away, color=color, **{"ha": "center", "va": "center"} | place)


def _section(ax: Any) -> None:
    """Across the axis, seen from s = 1 towards s = 0: i up, j to the left."""
    angle = LARGER * float(state().fields([CUT])["xi2"][0])
    rod, inner = 0.16, 1.16  # Δ = 1
    x, y = -np.sin(angle), -np.cos(angle)
    ax.add_patch(Circle((0.0, 0.0), inner, fill=False, color="#627d98", lw=1.4))
    ax.add_patch(Circle((x, y), rod, color=MODES[0]))
    ax.plot([0.0, 0.0], [0.0, -1.0], color=GREY, lw=0.8, ls=":")
    ax.plot([0.0, x], [0.0, y], color=GREY, lw=0.8, ls=":")
    low, high = sorted((-90.0, -90.0 - np.degrees(angle)))
    ax.add_patch(Arc((0.0, 0.0), 0.7, 0.7, theta1=low, theta2=high, color=GREY))
    ax.text(0.24 * np.sin(-angle / 2.0), -0.24 * np.cos(angle / 2.0), "ξ₂", ha="center", va="center", color=INK)
    _arrow(ax, (x, y), (-0.45 * x, -0.45 * y), "  wall on rod, −p d₁", WARN, ha="left")
    _arrow(ax, (inner * x, inner * y), (0.42 * x, 0.42 * y), " rod on wall", WARN, ha="left")
    _arrow(ax, (x, y), (0.0, -0.78), "mg sin α", MODES[2])
    _arrow(ax, (x, y), (-0.45 * np.cos(angle), 0.45 * np.sin(angle)), "u₂", MODES[1])
    _arrow(ax, (-0.25, 0.35), (0.0, 0.45), "i")
    _arrow(ax, (-0.25, 0.35), (-0.45, 0.0), "j")
    ax.plot(-0.25, 0.35, "o", color=INK, ms=4)
    ax.text(-0.2, 0.27, "k, towards you", va="top", fontsize=8.5)
    ax.set_xlim(-1.3, 1.75)
    ax.set_ylim(-2.0, 1.3)
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.set_title(f"Across the axis (ξ₂ drawn {LARGER:g} times as large)", loc="left", fontsize=9.5)


def _unrolled(ax: Any) -> None:
    """The wall unrolled: y over z, with the two frames at the cut. Scales differ, so the angle is larger than it is."""
    fields = state().fields(401)
    z, y = fields["z"], fields["y"] / PROBLEM.clearance
    at = round(400 * CUT)
    ax.axhline(0.0, color=GREY, lw=0.8, ls=":")
    ax.plot(z, y, color=MODES[0], lw=2.4)
    low, high = float(y.min()) - 0.1, float(y.max()) + 0.3
    across, up = 4.9 / 1.1, 3.7 / (high - low)  # inches to a unit
    along = np.array([across, float(np.gradient(y, z)[at]) * up])
    along *= 0.75 / np.hypot(*along)  # inches
    here = (float(z[at]), float(y[at]))
    _arrow(ax, here, (along[0] / across, along[1] / up), "t₁", MODES[0])
    _arrow(ax, here, (-along[1] / across, along[0] / up), "u₁", MODES[0])
    _arrow(ax, here, (0.75 / across, 0.0), "t₂ = k", MODES[1], ha="left")
    _arrow(ax, here, (0.0, 0.75 / up), "u₂", MODES[1])
    ax.text(here[0] + 0.45 / across, here[1] + 0.08 / up, "η", color=INK)
    ax.plot(*here, "o", color=INK, ms=4)
    ax.set_xlabel("distance along the cylinder z  [L]")
    ax.set_ylabel("angle around the wall ξ₂ = y/Δ  [rad]")
    ax.set_ylim(low, high)
    ax.set_title("The wall unrolled (η enlarged)", loc="left", fontsize=9.5)

"""Heavy-weight pipe and drill pipe behind the bit in a build section: the stress along them at the loads that act.

The hole alone bends each by E r κ all along (dotted). Compression of the bottom-hole assembly adds to it, and the waves
of the buckled string add more.
"""

from pathlib import Path

import numpy as np

import rodwell
from rodwell.plots.style import INK, MODES, new_axes
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.section import rod_section

LOADS = (30000.0, 95000.0, 120000.0, 145000.0)
"""Compression at the bottom in lbf."""

LBF, PSI, FEET = 4.4482216152605, 6894.757293168, 0.3048


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "assembly-in-build.toml")
    problem, unit, section = case.problem, case.scales.factor("force"), rod_section(case)
    forces = [problem.hung_weight - load * LBF / unit for load in LOADS]
    branch = rodwell.follow(problem, until=1.001 * forces[-1])
    step = problem.rod.breaks[1]
    s = np.union1d(np.linspace(0.0, 1.0, 601), [np.nextafter(step, 0.0), step])
    ax, largest, feet = new_axes(), [], s * case.scales.length / FEET
    for load, force, color in zip(LOADS, forces, MODES, strict=False):
        state = branch.at(force) if force < branch.force[0] else None
        found = section.stresses(LoadedRod("", problem, force, solution=state).fields(s))
        label = f"{load:,.0f} lbf".replace(",", "\u202f")
        ax.plot(feet, found.von_mises / PSI, color=color, label=label)
        largest.append(float(found.von_mises.max()))
    lying = section.stresses(LoadedRod("", problem, 0.0).fields(s)).bending
    ax.plot(feet, lying / PSI, color=INK, ls=":", lw=1.2, label="bending by the hole")
    ax.axvline(step * case.scales.length / FEET, color=INK, lw=0.6)
    ax.set_xlabel("distance from the bit  [ft]")
    ax.set_ylabel("largest von Mises stress  [psi]")
    ax.set_title("3.5 in heavy-weight and drill pipe, hole of 6.125 in, 12° in 100 ft", loc="left", fontsize=9.5)
    ax.legend(title="compression at the bit", loc="center left", bbox_to_anchor=(1.01, 0.5))
    return ax.figure, {"case": case, "lying": lying, "largest": np.array(largest)}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("build_section.png", dpi=150)

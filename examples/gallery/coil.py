"""A guidewire that has snapped into two turns around its vessel, twisted at its outer end.

The light and the dark line were straight on the wire before it was loaded: they show how the end twisting
moment turns it about its own axis. Tip clamped, outer end pinned; the wall pushes everywhere.
"""

from pathlib import Path

import rodwell
from rodwell.plots.rod3d import plot_rod


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "guidewire.toml")
    problem = case.problem.but(turns=2, twist=2.0)  # T₁ = 2 B/L at s = 1
    force = -40.0 / case.scales.factor("force")  # 40 N of push at s = 1
    coil = rodwell.equilibrium(problem, force)
    ax = plot_rod(coil, case.scales)
    found = {
        "stable": coil.stable,
        "angle": float(coil.fields([1.0])["xi2"][0]),
        "pressure": coil.highest_pressure[0],
        "material_rate": float(coil.geometry(201).material_curvatures[100, 0]),
        "torsional_stiffness": 1.0 / (1.0 + problem.poisson),
    }
    return ax.figure, found


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("coil.png", dpi=150)

"""How branches of a horizontal rod hang together: the bifurcation diagram of the paper's Fig. 3(c).

Four pairs of branches leave the straight rod. The orange and turquoise ones leave those branches: shapes
without symmetry. Thick is stable, pale is off the wall.
"""

import rodwell
from rodwell.plots.bifurcation import plot_bifurcation


def main():
    result = rodwell.diagram(rodwell.Problem(weight=15, alpha=90), modes=4, until=-700)
    ax = plot_bifurcation(result.branches, result.critical)
    ax.set_title("γ = 15, α = 90°, Δ/L = 0.01, both ends clamped; tension positive", loc="left", fontsize=9.5)
    points = {}
    for name in ("mode 1", "mode 2"):
        points[name] = [p.force for p in result[name].special_points if p.kind == "branch_point"]
    return ax.figure, points


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("bifurcation_diagram.png", dpi=150)

"""Shapes between two modes: how a rod without symmetry goes over from the first mode to the second.

The branch joins the secondary bifurcations of modes 1 and 2 (thick lines). Below, what its weight does to the
cylinder: at either end of the branch the torque T₂ at the support s = 0 tells the shapes apart. This is the
paper's Fig. 4.
"""

import rodwell
from rodwell.plots.cylinder import plot_shapes


def main():
    result = rodwell.diagram(rodwell.Problem(weight=15, alpha=90), modes=2, until=-400)
    branch = result["secondary 1"]
    states = [*list(branch)[: -1 : max(1, len(branch) // 9)], branch[-1]]
    ax = plot_shapes(states)
    ax.set_title("γ = 15, α = 90°, Δ/L = 0.01, both ends clamped", loc="left", fontsize=9.5)
    found = {
        "from": states[0].force,
        "to": states[-1].force,
        "symmetry": (states[0].point.fine.symmetry, states[-1].point.fine.symmetry),
        "torque": [float(state.fields([0.0])["T2"][0]) for state in states],
    }
    return ax.figure, found


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("broken_symmetry.png", dpi=150)

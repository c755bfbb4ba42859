"""Why a rod that lifts off snaps into a coil: energies of buckled and coiled states.

The coil lies on the wall from the open circle on and has less energy than the straight rod from the cross on:
both come before the buckled rod lifts off (red). What leaves the wall there has somewhere to go, and on
unloading it comes back later than it went.
"""

import rodwell
from rodwell.analysis.discrete.measures import Measured
from rodwell.plots.bifurcation import plot_bifurcation


def main():
    flat = rodwell.diagram(rodwell.Problem(weight=15, alpha=90), modes=1, until=-210.0, secondary=False)
    coil = rodwell.coil(rodwell.Problem(weight=15, alpha=90, turns=1), until=-210.0)
    ax = plot_bifurcation([*flat, coil], flat.critical, ordinate=Measured.ENERGY)
    ax.set_xlim(60.0, 215.0)
    ax.set_ylim(-0.25, 0.12)
    ax.legend(loc="lower left", ncols=2)
    ax.set_title("γ = 15, α = 90°, Δ/L = 0.01, both ends clamped", loc="left", fontsize=9.5)
    energies = {force: coil.at(force).number(Measured.ENERGY) for force in (-140.0, -160.0, -200.0)}
    return ax.figure, energies


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("snap_to_coil.png", dpi=150)

"""Sideways or wound: what the wall feels of a rod far from its ends.

Loading, the rod goes up the blue line to the ring where it lifts off; what is left in full contact there is the helix.
Unloading, a helix stays one down to the other ring. Between the rings the rod may be either, and pushes the wall half
as hard again when it is wound.
"""

import numpy as np

import rodwell
from rodwell.analysis.endless.local import LIMITS, local_state
from rodwell.plots.style import GREY, MODES, new_axes


def main():
    up, down = LIMITS.sinusoidal_lift_off.value, LIMITS.helix_lift_off.value
    ax = new_axes()
    ends = {}
    for kind, load, colour, beta in (
        ("sinusoidal", up, MODES[0], np.linspace(2.0, up, 200)),
        ("helical", down, MODES[1], np.linspace(down, 4.5, 200)),
    ):
        state = local_state(beta, kind)
        ax.fill_between(beta, state.contact_least, state.contact_largest, color=colour, alpha=0.15, lw=0.0)
        ax.plot(beta, state.contact_mean, color=colour, lw=2.4, label=f"{kind}, mean, from least to largest")
        ends[kind] = local_state(load, kind).contact_mean
        ax.plot(load, ends[kind], "o", color="white", mec=colour, mew=1.6, ms=8, zorder=5)
    ax.plot([1.0, 2.0], [1.0, 1.0], color="#1f2933", lw=2.4, label="straight")
    for start, load, to in (("sinusoidal", up, "helical"), ("helical", down, "sinusoidal")):
        last = local_state(load, to).contact_mean
        ax.annotate("", (load, last), (load, ends[start]), arrowprops={"arrowstyle": "-|>", "color": GREY, "lw": 1.5})
    ax.set_xlim(1.0, 4.5)
    ax.set_ylim(0.0, 6.5)
    ax.set_xlabel("load  β = P/√(Bq/D),  compression positive")
    ax.set_ylabel("contact force per length  [q]")
    ax.legend(loc="upper left")
    exact = rodwell.endless(3.0)
    return ax.figure, {
        "lifts_off": (up, down),
        "sinusoidal_at_3": exact.sinusoidal.contact_mean.value,
        "helical_at_3": exact.helical.contact_mean.value,
    }


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("endless.png", dpi=150)

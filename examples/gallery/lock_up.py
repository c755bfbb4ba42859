"""How hard one has to push: coiled tubing in a horizontal liner, until it locks up.

The longer the tubing in the liner, the harder the push at surface, first in proportion (grey: friction of its weight).
Once it buckles it presses the wall harder, and a little further no push is enough. Between the two exact lines the
tubing may be sinusoidal or helical, as it was before; dashed, what the correlation of practice makes of it.
"""

import numpy as np

import rodwell
from rodwell.plots.style import GREY, MODES, WARN, new_axes

TUBING = {"outer_diameter": "2 in", "inner_diameter": "1.688 in", "youngs_modulus": "206 GPa", "density": "7850 kg/m^3"}
LENGTH = 3400.0


def curve(contact, rule):
    """Push at surface in N over the length in the liner, and the length at which it locks up, with its error."""
    data = {
        "hole": {"diameter": "3.958 in", "friction": 0.25},
        "string": [TUBING],
        "mud": {"density": "8.34 lb/gal"},
        "well": {"contact": contact, "state_rule": rule, "operation": [{"kind": "run-in"}]},
    }
    survey = rodwell.Survey.of([0.0, LENGTH], [90.0, 90.0])
    found = rodwell.drag(rodwell.Well.from_dict(data, survey=survey)).operations[0]
    bounds = found.reach.get("late" if rule == "late" else "early")
    return found.run.rows[:, 0], -found.run.forces, bounds.lock_up, found


def main():
    ax = new_axes()
    lines = (
        ("straight", "late", GREY, "-", "straight: friction of its weight"),
        ("correlation", "early", WARN, (0, (5, 2)), "by correlation"),
        ("exact", "early", MODES[0], "-", "exact, helix early"),
        ("exact", "late", MODES[5], "-", "exact, helix late"),
    )
    ends = {}
    for contact, rule, colour, dashes, label in lines:
        length, push, lock_up, found = curve(contact, rule)
        ax.plot(length, push / 1e3, color=colour, ls=dashes, lw=2.0, label=label)
        if lock_up is not None:
            ax.axvline(lock_up.value, color=colour, lw=0.8, ls=(0, (1, 2)))
            ends[contact, rule] = lock_up.value
    rod = found.run.pieces.table[0]
    ax.set_xlim(0.0, 1.08 * max(ends.values()))
    ax.set_ylim(0.0, 120.0)
    ax.set_xlabel("length of tubing in the liner  [m]")
    ax.set_ylabel("push at surface  [kN]")
    ax.legend(loc="upper left")
    unit = np.sqrt(rod[7] / rod[6]) / 0.25  # (1/μ) √(B/wr)
    return ax.figure, {"lock_up": ends, "unit": float(unit)}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("lock_up.png", dpi=150)

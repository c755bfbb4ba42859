"""A guidewire with a ground core: where it buckles, and what becomes of the load if the taper is cut into steps.

Above: the wire, its core within the coil. Below: how it buckles first, sideways along the vessel; dashed, the same wire
with its taper cut into one step and into two, each as stiff and heavy as the taper in its middle.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import rodwell
from rodwell.plots.sections import plot_string
from rodwell.plots.style import GREY, MODES, WARN


def cut(problem, count):
    """The problem with its taper, the second section, in so many steps."""
    tip, (length, stiffness, weight, clearance, torsion), shaft = problem.sections
    middles = (np.arange(count) + 0.5) / count
    ratios = stiffness, weight, torsion
    fits = [np.polyfit(np.linspace(0.0, 1.0, len(values)), values, len(values) - 1) for values in ratios]
    steps = np.transpose([np.polyval(fit, middles) for fit in fits])
    return problem.but(sections=(tip, *((length / count, b, q, clearance, c) for b, q, c in steps), shaft))


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "tapered-guidewire.toml")
    wire, newton = case.problem, case.scales.factor("force")
    figure = Figure(figsize=(7.2, 5.6), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2, 3))
    plot_string(case, upper)
    upper.set_xlabel("")
    s, length = np.linspace(0.0, 1.0, 401), case.scales.length * 1e3
    loads, looks = {}, {0: ("-", MODES[0]), 1: ("--", WARN), 2: ("--", MODES[1])}
    for count in (0, 1, 2, 8, 16):
        mode = rodwell.critical_loads(cut(wire, count) if count else wire, 1)[0]
        loads[count] = mode.force
        if count in looks:
            shape, (style, color) = mode.shape(s), looks[count]
            shape = shape / shape[np.argmax(np.abs(shape))]
            name = f"in {count} step" + "s" * (count > 1) if count else "the taper"
            label = f"{name}: {-mode.force * newton:.3f} N"
            lower.plot(s * length, shape, ls=style, color=color, lw=2.2 if count == 0 else 1.2, label=label)
    for step in wire.rod.breaks[1:-1]:
        lower.axvline(step * length, color=GREY, lw=0.8, ls=":")
    lower.set_xlabel("distance from the tip, s = 0  [mm]")
    lower.set_ylabel("sideways, of the largest")
    lower.legend(title="buckles under a push at s = 1 of", loc="upper right")
    upper.set_title("0.035 in guidewire, core ground from 0.6 to 0.3 mm, in a 6 mm vessel", loc="left", fontsize=9.5)
    return figure, loads


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("tapered_guidewire.png", dpi=150)

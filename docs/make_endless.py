"""Tables and figures of the pages on the endless rod, called by ``make_pages``: everything is computed here."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import numpy as np
from shown import DPI, table

import rodwell
from rodwell.analysis.endless.local import HELICAL, LIMITS, SINUSOIDAL, local_state
from rodwell.formulas import helix, inclined
from rodwell.plots.endless import plot_endless
from rodwell.plots.style import GREY, INK, MODES, RC, WARN, new_axes

COMMANDS = {"endless": "endless", "endless-3": "endless --beta 3"}

UP, DOWN = LIMITS.sinusoidal_lift_off.value, LIMITS.helix_lift_off.value
LOADS = [float(beta) for beta in np.linspace(2.5, UP, 100)]
ONE = {"B": 1.0, "w": 1.0, "alpha": 90.0, "r": 1.0}
"""B, q and D of 1: forces are β."""


def pages(out: Path) -> dict[str, str]:
    """Return the tables by file name, and draw the figures into ``out``."""
    with mpl.rc_context(RC):
        ax = plot_endless(rodwell.endless(3.0))
        ax.figure.savefig(out / "endless-states.png", dpi=DPI)
        _practice(out / "endless-practice.png")
    return {
        "endless-loads.md": loads_table(),
        "endless-rates.md": rates_table(),
        "endless-contact.md": contact_table(),
        "endless-helix.md": helix_table(),
        "endless-slope.md": slope_table(),
    }


def loads_table() -> str:
    """Loads of practice beside what the exact curve has for the same event."""
    equal, straight = LIMITS.sinusoidal_helix_equal_energy.value, LIMITS.straight_helix_equal_energy.value
    rows = []
    for name, practice, event, exact, safe in (
        ("Dawson–Paslay 1984", inclined.dawson_paslay(**ONE), "the straight rod buckles", 2.0, "exact"),
        (
            "Chen–Lin–Cheatham 1990",
            inclined.chen_lin_cheatham(**ONE),
            "helix and straight rod cost the same",
            straight,
            "no event: at this load nothing happens by itself",
        ),
        ("the same", inclined.chen_lin_cheatham(**ONE), "helix and sinusoidal state cost the same", equal, "likewise"),
        (
            "Mitchell 1999, unloading",
            inclined.mitchell_unloading(**ONE),
            "the helix lifts off on unloading",
            DOWN,
            "no: the helix is still there a little below 2.8",
        ),
        (
            "Wu–Juvkam-Wold 1993",
            inclined.wu_juvkam_wold(**ONE),
            "the sinusoidal state lifts off on loading",
            UP,
            "",
        ),
        ("Qiu 1998", inclined.qiu(**ONE), "the same", UP, ""),
        ("Mitchell 1999, loading", inclined.mitchell_loading(**ONE), "the same", UP, ""),
        ("Mitchell 1997", inclined.mitchell_1997(**ONE), "the same", UP, ""),
    ):
        said = safe or f"no, by {100.0 * (practice / exact - 1.0):.0f} %"
        rows.append((name, f"{practice:.4g}", event, f"{exact:.7g}", _percent(practice / exact), said))
    return table(("Formula", "β", "what it is taken for", "exact β", "formula − exact", "safe?"), rows)


def rates_table() -> str:
    """Mitchell's fit of the largest rate beside the exact one."""
    rows = []
    for beta in (2.01, 2.1, 2.25, 2.5, 2.75, 3.0, 3.25, 3.5):
        state = local_state(beta)
        fit = helix.mitchell_lateral_rate(1.0, beta, 2.0)
        cells = (f"{state.amplitude:.5f}", f"{2 * np.pi / state.frequency:.4f}", f"{state.rate_largest:.5f}")
        rows.append((f"{beta:g}", *cells, f"{fit:.5f}", _percent(fit / state.rate_largest)))
    head = ("β", "amplitude [rad]", "wavelength [ℓ]", "largest θ′ [rad/ℓ]", "Mitchell's fit", "fit − exact")
    return table(head, rows)


def contact_table() -> str:
    """Contact force per length of the sinusoidal state."""
    rows = []
    for beta in (2.0, 2.25, 2.5, 2.75, 3.0, 3.25, 3.5, UP):
        n = local_state(beta)
        cells = (f"{x:.4f}" for x in (n.contact_mean, n.contact_largest, max(n.contact_least, 0.0)))
        rows.append((f"{beta:.5g}", *cells, _percent(1.0 / n.contact_mean), f"{2.0 * n.curvature_largest / beta:.4f}"))
    head = ("β", "mean [q]", "largest [q]", "least [q]", "error of n = q", "stress factor")
    return table(head, rows)


def helix_table() -> str:
    """Contact force, curvature and shortening of the helix beside the formulas for it."""
    rows = []
    for beta in (DOWN, 3.0, 3.5, 4.0, 5.0, 7.0, 10.0, 20.0):
        n = local_state(beta, HELICAL)
        bare = helix.helical_contact(1.0, 1.0, beta)
        rows.append(
            (
                f"{beta:.5g}",
                f"{n.contact_mean:.4f}",
                f"{max(n.contact_least, 0.0):.3f} to {n.contact_largest:.3f}",
                _percent(bare / n.contact_mean),
                _percent((1.0 + bare) / n.contact_mean),
                f"{2.0 * n.curvature_largest / beta:.4f}",
                _percent(0.25 * beta / n.shortening),
            )
        )
    head = (
        "β", "mean [q]", "from … to [q]", "error of DP²/(4B)", "error of q + DP²/(4B)", "stress factor",
        "error of shortening DP/(4B)",
    )  # fmt: skip
    return table(head, rows)


def slope_table() -> str:
    """The loads for larger slopes."""
    rows = []
    for slope in (0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.5):
        loads = rodwell.endless(slope=slope).loads
        named = (loads.sinusoidal_lift_off, loads.helix_lift_off, loads.sinusoidal_helix_equal_energy)
        largest = "" if slope == 0.0 else f"{4.0 / 27.0**0.5 / slope**2:.4g}"
        rows.append((f"{slope:g}", "2", *(f"{load.value:.7g}" for load in named if load is not None), largest))
    head = ("ε", "buckles", "sinusoidal lifts off", "helix lifts off", "both cost the same", "weightless helix ends")
    return table(head, rows)


def _percent(ratio: float) -> str:
    return f"{100.0 * (ratio - 1.0):+.2g} %".replace("-", "−") if abs(ratio - 1.0) > 5e-5 else "0"


def _practice(path: Path) -> None:
    """Mean contact force: exact, and as tools have it."""
    ax = new_axes()
    low, high = np.linspace(2.0, UP, 200), np.linspace(DOWN, 5.0, 200)
    ax.plot([1.0, 2.0], [1.0, 1.0], color=INK, lw=2.2)
    ax.plot(low, local_state(low).contact_mean, color=MODES[0], lw=2.2, label="exact, sinusoidal")
    ax.plot(high, local_state(high, HELICAL).contact_mean, color=MODES[1], lw=2.2, label="exact, helical")
    jump = inclined.chen_lin_cheatham(**ONE)
    tools = np.linspace(jump, 5.0, 100)
    usual = 1.0 + helix.helical_contact(1.0, 1.0, tools)
    ax.plot([1.0, jump, jump, *tools], [1.0, 1.0, usual[0], *usual], color=WARN, lw=1.4, ls=(0, (5, 2)),
            label="as tools have it: q up to 2√2, then q + DP²/(4B)")  # fmt: skip
    for load, place in ((UP, SINUSOIDAL), (DOWN, HELICAL)):
        ax.plot(load, local_state(load, place).contact_mean, "o", color="white", mec=INK, ms=6, zorder=5)
    ax.plot([], [], "o", color="white", mec=INK, ms=6, label="lifts off")
    ax.axvline(2.0, color=GREY, lw=0.9, ls=(0, (4, 3)))
    ax.set_xlim(1.0, 5.0)
    ax.set_ylim(0.0, 7.5)
    ax.set_xlabel("load  β = P/√(Bq/D),  compression positive")
    ax.set_ylabel("mean contact force per length  [q]")
    ax.legend(loc="upper left")
    ax.figure.savefig(path, dpi=DPI)


def numbers() -> dict[str, str]:
    """Numbers that the pages quote."""
    up, down = local_state(UP), local_state(DOWN, HELICAL)
    lift = rodwell.follow(rodwell.Problem(4000), 1).lift_off
    fit = [abs(helix.mitchell_lateral_rate(1.0, b, 2.0) / local_state(b).rate_largest - 1.0) for b in LOADS]
    return {
        "endless_up": f"{UP:.6f}",
        "endless_down": f"{DOWN:.6f}",
        "endless_equal": f"{LIMITS.sinusoidal_helix_equal_energy.value:.6f}",
        "endless_straight": f"{LIMITS.straight_helix_equal_energy.value:.6f}",
        "endless_up_mean": f"{up.contact_mean:.2f}",
        "endless_up_largest": f"{up.contact_largest:.2f}",
        "endless_down_mean": f"{down.contact_mean:.3f}",
        "endless_down_stress": f"{100.0 * (2.0 * down.curvature_largest / DOWN - 1.0):.0f}",
        "endless_whole_w": f"{100.0 * ((1.0 + DOWN**2 / 4.0) / down.contact_mean - 1.0):.0f}",
        "endless_fit": f"{100.0 * max(fit):.1f}",
        "endless_ceases": f"{LIMITS.sinusoidal_ceases.value:.2f}",
        "endless_missing": f"{100.0 * (1.0 - 1.0 / up.contact_mean):.0f}",
        "endless_early": f"{100.0 * (inclined.mitchell_unloading(**ONE) / DOWN - 1.0):.0f}",
        "endless_miska": f"{100.0 * (3.75 / UP - 1.0):.0f}",
        "endless_ends": f"{-lift.force / np.sqrt(4000.0 / 0.01):.2f}",
    }

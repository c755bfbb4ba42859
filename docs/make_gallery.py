"""The gallery: every script of ``examples/gallery`` is run, its picture and its code put on the page."""

from __future__ import annotations

import runpy
from pathlib import Path

import matplotlib as mpl

from rodwell.plots.style import RC

SCRIPTS = Path(__file__).resolve().parent.parent / "examples" / "gallery"
DPI = 140

ORDER = {
    "The rod in its hole": ("drill_string", "coil", "bent_vessel"),
    "Which load, which mode": ("envelope", "lift_off", "lift_off_map", "formulas", "well"),
    "After buckling": (
        "bifurcation_diagram",
        "broken_symmetry",
        "snap_to_coil",
        "load_path",
        "build_path",
        "endless",
        "lock_up",
        "column",
        "twist",
    ),
    "What the wall bears": (
        "guidewire",
        "wall_moments",
        "heavy_weight",
        "tapered_guidewire",
        "two_casings",
        "build_section",
        "surveyed_well",
        "helix",
    ),
}

CHECKED = {
    "drill_string": "dimensionless weight of (63); the critical load solves (77); an odd shape lifts off at mid-length",
    "coil": "two turns are 4π, the material lines turn at −T₁/C, (32); stable, in contact everywhere",
    "envelope": "4π² without weight; double points at γ = n²m²π⁴Δ, F = −(n² + m²)π², (78)",
    "lift_off": "−123.1730743 B/L² for the horizontal rod, from AUTO-07p; lift-off comes after buckling",
    "lift_off_map": "the double point γ = 62.34181826 of (77), (78) is between the sides of a jump",
    "formulas": "ratio 2nm/(n² + m²) where modes switch, (78)",
    "well": "the formula by hand for the horizontal part; the exact load of a long rod within 1 % above it",
    "bifurcation_diagram": "secondary bifurcations at −362.63 and −164.78, section 4.1.2 of the paper",
    "broken_symmetry": "the same two loads, Fig. 4; the odd shape needs no torque at the support",
    "snap_to_coil": "energies of an interior-point method that lets the rod leave the wall, to 1e-6",
    "endless": "contact forces at β = 3, of two other programs, to 1e-8; where the wall begins to pull",
    "lock_up": "length by correlation in closed form, exact ones by quadrature of the endless rod's states: to 1e-8",
    "load_path": "loads of two other programs that let the rod leave the wall, to 1e-7: limit points at −147.1580802 "
    "and −103.6731326",
    "build_path": "buckling and lift-off of the rod kept on the wall, which another model computes: to 1e-9 and 1e-8",
    "column": "14.3626 of Fig. 9; 74.628569 of (87)",
    "twist": "reflection exchanges the arms and the sign of T₁; T₁ > 0 stabilises up to a limit, section 4.2",
    "guidewire": "contact pressure of a uniform helix from (52)–(55), written out in the script; π² for pinned ends",
    "wall_moments": "T₂ from (33), integrated a second time",
    "heavy_weight": "b ω₂ continuous, ω₂ in the ratio of the stiffnesses; the couple of the wall is the jump of b ω₃",
    "tapered_guidewire": "the limit of the loads in 8 and 16 steps, whose errors go like their length squared",
    "two_casings": "free lengths and edge force of the small-slope closed form, to 1e-5",
    "bent_vessel": "the push of the wire that has not buckled, w cos ψ − κᵣ(F − κᵣ²), by hand",
    "build_section": "bending by the hole, E r κ/(1 + κΔ), and stress of the pipe that has not buckled, by hand",
    "surveyed_well": "bending of the pipe at rest, its stiffness times the angle between stations over their distance",
    "helix": "load to 1e-8 and push to 1e-7 of the closed form",
}
"""What the tests hold each picture's numbers against."""


def pages(out: Path) -> dict[str, str]:
    """Draw every picture into ``out``; return the page's text."""
    left = {script.stem for script in SCRIPTS.glob("*.py")}
    parts = []
    for group, names in ORDER.items():
        parts.append(f"## {group}\n")
        for name in names:
            left.discard(name)
            parts.append(_entry(name, out))
    if left:
        raise RuntimeError(f"docs/make_gallery.py: {', '.join(sorted(left))} not in the gallery")
    return {"gallery.md": "\n".join(parts)}


def _entry(name: str, out: Path) -> str:
    script = SCRIPTS / f"{name}.py"
    with mpl.rc_context(RC):
        module = runpy.run_path(str(script))
        figure, _ = module["main"]()
        figure.savefig(out / f"gallery-{name}.png", dpi=DPI)
    title, _, text = module["__doc__"].strip().partition("\n\n")
    code = script.read_text(encoding="utf-8").split('"""', 2)[2].strip()
    return f"""### {title.rstrip(".")}

```{{image}} _generated/gallery-{name}.png
:alt: {title}
```

{" ".join(text.split())}

Checked: {CHECKED[name]}.

<details><summary>Code: <code>examples/gallery/{name}.py</code></summary>

```python
{code}
```

</details>
"""

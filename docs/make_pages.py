"""Parts of the pages that come from the program itself, written to ``_generated`` before each build.

Tables (nomenclature, case file), the output of the commands and of the examples that the pages show, and the
pictures of the drill-string case; what the other pages show comes from the other ``make_*`` modules. Nothing of it is
kept under version control.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import runpy
import shutil
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import make_formulas
import make_howto
import make_long
import make_paper
import make_wells
from click.testing import CliRunner

import rodwell
from rodwell.case import schema
from rodwell.case.case import SECTIONS
from rodwell.case.catalogue import package_catalogue
from rodwell.cli.main import cli
from rodwell.quantities import names
from rodwell.quantities.text import readable
from rodwell.quantities.units import KINDS, SI, System

HERE = Path(__file__).resolve().parent
OUT = HERE / "_generated"
RESULTS = OUT / "results" / "drill-string"

COMMANDS = {
    "run": "run examples/drill-string.toml",
    "run-field": "run examples/field-drill-pipe.toml",
    "run-wire": "run examples/guidewire.toml",
    "audit-field": "audit examples/field-drill-pipe.toml --no-chart --out results/audit-field",
    "critical": "critical --weight 15 --alpha 90",
    "liftoff": "liftoff --weight 15 --alpha 90",
    "liftoff-json": "liftoff --weight 15 --alpha 90 --json",
    **make_howto.COMMANDS,
    **make_formulas.COMMANDS,
    **make_wells.COMMANDS,
    **make_long.COMMANDS,
    **make_paper.COMMANDS,
}

JOBS = (
    "commands", "make_howto", "make_gallery", "make_formulas", "examples", "make_paper", "make_convergence",
    "make_errors", "make_long", "make_wells", "make_braid", "make_report", "make_architecture",
)  # fmt: skip
"""What is made, the longest first; modules have ``pages(out)`` and perhaps ``numbers()``."""

PRETTY = {
    "1": "1",
    "rad": "rad",
    "L": "L",
    "1/L": "1/L",
    "B/L": "B/L",
    "B/L^2": "B/L²",
    "B/L^3": "B/L³",
    "B/L^4": "B/L⁴",
    "N m": "N·m",
}


def build() -> dict[str, str]:
    """Write everything to ``_generated``; return the numbers that the text quotes, by name.

    What compiles comes first; then two processes share the rest.
    """
    OUT.mkdir(exist_ok=True)
    (OUT / "results").mkdir(exist_ok=True)
    shutil.copytree(HERE.parent / "examples", OUT / "examples", dirs_exist_ok=True)
    _write("nomenclature.md", nomenclature_tables())
    _write("case-keys.md", case_keys())
    _write("catalogue.md", catalogue_tables())
    _write("twist.md", twist_table())
    numbers: dict[str, str] = {}
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        for job in [pool.submit(_job, name) for name in JOBS]:
            numbers |= job.result()
    numbers["version"] = rodwell.__version__
    return numbers | _numbers(json.loads((RESULTS / "answer.json").read_text(encoding="utf-8")))


def _job(name: str) -> dict[str, str]:
    """Run one part; return the numbers for the text that it gives."""
    if name in ("commands", "examples"):
        return {"commands": _commands, "examples": _examples}[name]()
    module = importlib.import_module(name)
    with contextlib.chdir(OUT):
        _write_all(module.pages(OUT))
        return dict(module.numbers()) if hasattr(module, "numbers") else {}


def _commands() -> dict[str, str]:
    with contextlib.chdir(OUT):
        for name, line in COMMANDS.items():
            _write(f"{name}.txt", f"$ rodwell {line}\n{_run(line)}")
    return {}


def _examples() -> dict[str, str]:
    with contextlib.chdir(OUT):
        for example in sorted((HERE / "_examples").glob("*.py")):
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                runpy.run_path(str(example))
            _write(f"{example.stem}.txt", printed.getvalue())
    return {}


def _write_all(pages: dict[str, str]) -> None:
    for name, text in pages.items():
        _write(name, text)


def _write(name: str, text: str) -> None:
    """Write a file only if its text changed, so that an unchanged page is not built again."""
    file = OUT / name
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


def _run(line: str) -> str:
    result = CliRunner().invoke(cli, line.split(), env={"COLUMNS": "103"}, catch_exceptions=False)
    if result.exit_code != 0:
        raise RuntimeError(f"rodwell {line} ended with {result.exit_code}: {result.output}")
    return "\n".join(row.rstrip() for row in result.output.splitlines()) + "\n"


def nomenclature_tables() -> str:
    """The fields along the rod and the numbers of one state, as two tables."""
    parts = []
    titles = {"Fields along the rod": names.FIELDS, "Numbers of one state": names.SCALARS}
    titles["Contact loads that vanish without friction"] = names.VANISHING
    for title, listed in titles.items():
        rows = []
        for name in listed:
            q = names.QUANTITIES[name]
            unit = PRETTY[names.UNITS[q.dimension]]
            si = names.SI_UNITS[q.dimension]
            rows.append((q.symbol, f"`{q.name}`", q.meaning, unit, PRETTY.get(si, si), q.equation))
        head = ("Symbol", "Name in code", "Meaning", "Unit", "SI", "Equation")
        parts.append(f"## {title}\n\n{make_howto.table(head, rows)}")
    return "\n".join(parts)


def twist_table() -> str:
    """Lift-off loads without and with end twist, on both arms."""
    rows = []
    for weight, mode in ((15, 1), (5, 2), (5, 1), (15, 2)):
        problem = rodwell.Problem(weight, alpha=90)
        plain = rodwell.follow(problem, mode)
        arms = [rodwell.follow(problem.but(twist=0.5), mode, mirror=mirror) for mirror in (False, True)]
        parity = {1: "even", -1: "odd"}[plain.mode.parity]
        loads = [f"{branch.lift_off.force:.4f}".replace("-", "−") for branch in (plain, *arms)]
        rows.append((f"{weight}, mode {mode}", parity, *loads))
    head = ("γ, mode", "y", "lift-off, T₁ = 0", "T₁ = 0.5, arm ω₂(1) < 0", "T₁ = 0.5, arm ω₂(1) > 0")
    return make_howto.table(head, rows)


def _branch_point(weight: float, mode: int, until: float) -> str:
    """Load of the first secondary bifurcation of a mode's branch, horizontal cylinder."""
    branch = rodwell.follow(rodwell.Problem(weight, alpha=90), mode, until=until)
    point = next(p for p in branch.special_points if p.kind == "branch_point")
    return f"{point.force:.6f} B/L², where its stability index goes from {point.index_before} to {point.index_after}"


MEANINGS: dict[str, dict[str, str]] = {
    "rod": {
        "length": "length L between the ends; required",
        "outer_diameter": "needed with `youngs_modulus`, `density`, `material`, `hole.diameter` and fluids",
        "inner_diameter": "0 (solid) if not given",
        "youngs_modulus": "with the diameters gives the bending stiffness",
        "bending_stiffness": "B = EI, instead of `youngs_modulus`",
        "density": "of the material; with diameters and gravity gives the weight",
        "weight_per_length": "in air with `[mud]`, else mg itself; instead of `density` or a pipe's nominal weight",
        "poisson": "Poisson's ratio ν, from above −1 to 0.5; that of the `material` if not given",
        "ends": "conditions at s = 0 and s = 1, two of `clamped`, `pinned`, `guided`, `free`",
        "pipe": "name in the [catalogue](pipes-and-fluids.md), instead of diameters, modulus and weight",
        "material": "name in the catalogue, instead of `youngs_modulus` and `density`",
        "grade": "name in the catalogue: gives the yield strength",
        "yield_strength": "of the rod, instead of `grade`",
    },
    "hole": {
        "diameter": "inner diameter of the hole; with the rod's outer diameter gives the clearance",
        "clearance": "Δ, from axis to axis, instead of `diameter`",
        "angle_from_vertical": "inclination α, from `0 deg` (vertical) to `90 deg` (horizontal)",
        "angle_from_horizontal": "instead of `angle_from_vertical`; one of the two is required",
        "gravity": "used with `density`",
    },
    "dimensionless": {
        "weight": "γ = mg L³/B; required",
        "alpha": "inclination α from the vertical, in degrees",
        "clearance": "Δ/L",
        "poisson": "Poisson's ratio ν",
        "ends": "as in [rod]",
    },
    "load": {
        "until": "end force to which branches are followed, **tension positive** (compression negative); "
        "chosen from the loads found if not given",
        "twist": "end twisting moment T₁ at s = 1, a dead load",
        "applied": "the load that acts, or a list, **tension positive**: [what becomes of the rod there](strength.md); "
        "a range makes a [study](studies.md)",
        "at": "where `until` and `applied` act: `top` (s = 1, the upper end) or `bottom` (s = 0)",
        "kind": "what `until` and `applied` are: the `effective` force, or the `real` one in the wall; must "
        "be said beside `[pressure]`",
    },
    "cylinder": {
        "outer_diameter": "outer diameter of the cylinder; the whole section, for its strength, may be left out",
        "inner_diameter": "inner diameter; that of the hole, if hole.diameter is given",
        "yield_strength": "strength against which the largest equivalent stress is set",
    },
    "supports": {
        "force": "largest force that a support of rod or cylinder can bear, at either end",
        "moment": "largest bending moment across its axis",
        "torque": "largest twisting moment about its axis",
    },
    "mud": {
        "density": "of the fluid on both sides of the pipe, instead of `inside` and `outside`",
        "inside": "of the fluid in the bore; empty if not given",
        "outside": "of the fluid around the rod; empty if not given",
    },
    "pressure": {
        "inside": "in the bore at s = 1",
        "outside": "around the rod at s = 1",
    },
    "catalogue": {
        "files": "TOML files with pipes, materials and grades of your own, from the folder of the case file",
    },
    "analysis": {
        "modes": "how many buckling modes, 1 to 12",
        "rtol": "relative tolerance of every number, 1e-11 to 1e-2",
    },
}


def case_keys() -> str:
    """Every key of a case file: one table for each section; the schema says which keys there are."""
    kinds = {"Number": "number", "int": "whole number", "InnerLength": "length", "Stiffness": "bending stiffness"}
    kinds |= {"ForcePerLength": "force per length", "Ends": "text", "Name": "text", "FluidDensity": "density"}
    kinds |= {"Forces": "force", "PositiveForce": "force", "PositiveMoment": "moment"}
    kinds |= {"End": "text", "ForceKind": "text", "list[str]": "list of text"}
    parts = []
    for section, model in SECTIONS.items():
        meanings = MEANINGS[section]
        if set(meanings) != set(model.model_fields):
            raise RuntimeError(f"docs/make_pages.py: keys of [{section}] differ from the schema's")
        rows = []
        for key, field in model.model_fields.items():
            alias = str(model.__annotations__[key]).split(" | ")[0]
            kind = kinds.get(alias, alias.lower())
            examples = KINDS.get(kind, ("", ""))[1]
            default = "" if field.default is None or field.is_required() else _default(field.default, kind)
            rows.append(
                (f"`{key}`", kind, " ".join(f"`{e}`" for e in examples.split(", ") if e), default, meanings[key])
            )
        text = (model.__doc__ or "").partition("\n")[0].partition(": ")[2]
        parts.append(f"### `[{section}]`\n\n{text[:1].upper()}{text[1:]}\n")
        parts.append(make_howto.table(("Key", "Kind", "Examples", "Default", "Meaning"), rows))
    return "\n".join(parts)


def catalogue_tables() -> str:
    """Every entry of the catalogue with its source."""
    catalogue, system = package_catalogue(), System("field")

    def cell(value: float | None, dimension: str, shown: System = system) -> str:
        return "" if value is None else shown.text(value, dimension, 5)

    groups: dict[tuple[str, str, str], list[tuple[str, ...]]] = {}
    for pipe in map(catalogue.pipe, catalogue.names("pipe")):
        medical = pipe.kind in ("guidewire", "catheter")
        outer, bore = (
            cell(length, "length", System("mm") if medical else system) for length in (pipe.outer_diameter, pipe.bore)
        )
        row = (f"`{pipe.name}`", outer, bore, cell(pipe.weight_per_length, "force_per_length"))
        groups.setdefault((pipe.kind, pipe.source, pipe.note), []).append(row)
    parts = []
    for (kind, source, note), rows in groups.items():
        parts.append(f"### {kind.capitalize()}\n\nSource: {source}. {note[:1].upper()}{note[1:]}.\n")
        parts.append(make_howto.table(("Name", "Outer diameter", "Inner diameter", "Nominal weight"), rows))
    rows = []
    for m in map(catalogue.material, catalogue.names("material")):
        numbers = (cell(m.youngs_modulus, "stress", SI), cell(m.density, "density", SI), f"{m.poisson:g}")
        rows.append((f"`{m.name}`", *numbers, m.source, m.note))
    parts.append("### Materials\n")
    parts.append(make_howto.table(("Name", "E", "Density", "ν", "Source", "Note"), rows))
    rows = []
    for g in map(catalogue.grade, catalogue.names("grade")):
        rows.append((f"`{g.name}`", cell(g.yield_strength, "stress"), cell(g.yield_strength, "stress", SI), g.source))
    parts.append("### Grades\n")
    parts.append(make_howto.table(("Name", "Yield strength", "SI", "Source"), rows))
    return "\n".join(parts)


def _default(value: Any, kind: str) -> str:
    unit = KINDS.get(kind, ("", ""))[0].replace("*", " ").replace("^2", "²")
    return value if isinstance(value, str) else f"{value:g} {unit}".strip()


def _numbers(answer: dict[str, Any]) -> dict[str, str]:
    """Numbers of the drill-string case for the text, in SI and dimensionless."""
    out = {}
    for name, figure in answer["figures"].items():
        si = figure["si"]
        out[name] = readable(si["value"], si["unit"], 4).replace("N m", "N·m")
        out[f"{name}_plain"] = f"{figure['value']:.6g} {PRETTY[figure['unit']]}".replace("-", "−")
    out["compression_1"] = out["critical_load_1"].lstrip("−")
    out["compression_2"] = out["critical_load_2"].lstrip("−")
    out["lift_off_compression"] = out["lift_off_load"].lstrip("−")
    out["gamma"] = f"{answer['problem']['weight']:.6g}"
    out["certificate"] = f"{answer['certificate']['worst']:.0e}".replace("-", "−")
    force = answer["figures"]["critical_load_1"]
    unit = force["si"]["value"] / force["value"]
    out["force_unit"] = readable(unit, "N", 6)
    second = answer["branches"][1]["special_points"]
    snap = next(p for p in second if p["kind"] == "branch_point")
    out["second_stable"] = readable(snap["force"] * unit, "N", 4).lstrip("−")
    for weight, mode, until in ((15, 1, -400.0), (15, 2, -200.0), (30, 3, -2000.0)):
        out[f"branch_point_{weight}_{mode}"] = _branch_point(weight, mode, until).replace("-", "−")
    return out


assert {name for name in schema.CaseFile.model_fields if name not in ("title", "units")} == set(SECTIONS)

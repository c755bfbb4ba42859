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

import click
import make_drag
import make_endless
import make_formulas
import make_howto
import make_long
import make_packer
import make_paper
import make_wells
import matplotlib.pyplot as plt
from click.testing import CliRunner
from shown import table

import rodwell
from rodwell.case.catalogue import package_catalogue
from rodwell.case.keys import TOP, every_key, purpose
from rodwell.cli.main import cli
from rodwell.quantities import names
from rodwell.quantities.text import readable
from rodwell.quantities.units import SI, System

HERE = Path(__file__).resolve().parent
OUT = HERE / "_generated"
RESULTS = OUT / "results" / "drill-string"

COMMANDS = {
    "run": "run examples/drill-string.toml",
    "run-field": "run examples/field-drill-pipe.toml --no-path",
    "run-wire": "run examples/guidewire.toml",
    "audit-field": "audit examples/field-drill-pipe.toml --no-chart --out results/audit-field",
    "keys": "keys hole",
    "init": "init first.toml --kind well --force",
    "critical": "critical --weight 15 --alpha 90",
    "liftoff": "liftoff --weight 15 --alpha 90",
    "liftoff-json": "liftoff --weight 15 --alpha 90 --json",
    **make_howto.COMMANDS,
    **make_formulas.COMMANDS,
    **make_wells.COMMANDS,
    **make_drag.COMMANDS,
    **make_long.COMMANDS,
    **make_endless.COMMANDS,
    **make_packer.COMMANDS,
    **make_paper.COMMANDS,
}

JOBS = (
    "commands", "make_howto", "make_gallery", "make_formulas", "examples", "make_paper", "make_convergence",
    "make_errors", "make_path", "make_long", "make_wells", "make_drag", "make_endless", "make_packer", "make_braid",
    "make_report", "make_exact",
    "make_architecture", "make_dependencies",
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
    _write("commands.md", command_tables())
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
    """What the samples print, as they stand; one that fails, or shows nothing, fails the build."""
    with contextlib.chdir(OUT):
        for example in sorted((HERE / "_examples").glob("*.py")):
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                runpy.run_path(str(example))
            if not printed.getvalue().strip() and not plt.get_fignums():
                raise RuntimeError(f"{example.name} neither prints nor draws anything")
            plt.close("all")
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
        parts.append(f"## {title}\n\n{table(head, rows)}")
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
    return table(head, rows)


def _branch_point(weight: float, mode: int, until: float) -> str:
    """Load of the first secondary bifurcation of a mode's branch, horizontal cylinder."""
    branch = rodwell.follow(rodwell.Problem(weight, alpha=90), mode, until=until)
    point = next(p for p in branch.special_points if p.kind == "branch_point")
    return f"{point.force:.6f} B/L², where its stability index goes from {point.index_before} to {point.index_after}"


MORE = {
    "rod.pipe": "pipes-and-fluids.md",
    "rod.torsional_stiffness": "twist.md",
    "load.applied": "strength.md",
    "packer.motion": "packer.md",
    "study": "studies.md",
    "catalogue.files": "pipes-and-fluids.md",
}
"""Pages that say more about a key."""


def command_tables() -> str:
    """Every command with its options, from the commands themselves."""
    parts = []
    for name, command in sorted(cli.commands.items()):
        context = click.Context(command, info_name=f"rodwell {name}")
        usage = " ".join(command.collect_usage_pieces(context))
        parts.append(f"## rodwell {name}\n\n{command.get_short_help_str(200)}\n\n```sh\nrodwell {name} {usage}\n```\n")
        options = [p for p in command.params if isinstance(p, click.Option)]
        rows = [(f"`{', '.join((*p.opts, *p.secondary_opts))}`", p.help or "") for p in options]
        parts.append(table(("Option", "Meaning"), rows) if rows else "")
    return "\n".join(parts)


def case_keys() -> str:
    """Every key of a case file: one table for each section, all from the schema."""
    parts = []
    for section, listed in every_key().items():
        rows = []
        for key in listed:
            limits = f" ({key.allowed})" if key.allowed else ""
            more = f" ([more]({MORE[key.full_name]}))" if key.full_name in MORE else ""
            default = "required" if key.required else f"`{key.default}`" if key.default else ""
            examples = " ".join(f"`{example}`" for example in key.examples)
            rows.append((f"`{key.name}`", key.kind + limits, examples, default, key.meaning + more))
        head = f"`[[{section}]]`" if section in ("string", "hole.section") else f"`[{section}]`"
        title = "Before the first section" if section == TOP else head
        text = "" if section == TOP else f"{purpose(section)}\n"
        parts.append(f"### {title}\n\n{text}")
        parts.append(table(("Key", "Kind", "Examples", "Default", "Meaning"), rows))
    return "\n".join(parts)


def catalogue_tables() -> str:
    """Every entry of the catalogue with its source."""
    catalogue, system = package_catalogue(), System("field")

    def cell(value: float | None, dimension: str, shown: System = system) -> str:
        return "" if value is None else shown.text(value, dimension, 5)

    groups: dict[tuple[str, str, str], list[tuple[str, ...]]] = {}
    for pipe in map(catalogue.pipe, catalogue.names("pipe")):
        medical = pipe.kind in ("guidewire", "catheter", "fibre")
        outer, bore = (
            cell(length, "length", System("mm") if medical else system) for length in (pipe.outer_diameter, pipe.bore)
        )
        row = (f"`{pipe.name}`", outer, bore, cell(pipe.weight_per_length, "force_per_length"))
        groups.setdefault((pipe.kind, pipe.source, pipe.note), []).append(row)
    parts = []
    for (kind, source, note), rows in groups.items():
        parts.append(f"### {kind.capitalize()}\n\nSource: {source}. {note[:1].upper()}{note[1:]}.\n")
        parts.append(table(("Name", "Outer diameter", "Inner diameter", "Nominal weight"), rows))
    rows = []
    for m in map(catalogue.material, catalogue.names("material")):
        numbers = (cell(m.youngs_modulus, "stress", SI), cell(m.density, "density", SI), f"{m.poisson:g}")
        rows.append((f"`{m.name}`", *numbers, m.source, m.note))
    parts.append("### Materials\n")
    parts.append(table(("Name", "E", "Density", "ν", "Source", "Note"), rows))
    rows = []
    for g in map(catalogue.grade, catalogue.names("grade")):
        rows.append((f"`{g.name}`", cell(g.yield_strength, "stress"), cell(g.yield_strength, "stress", SI), g.source))
    parts.append("### Grades\n")
    parts.append(table(("Name", "Yield strength", "SI", "Source"), rows))
    return "\n".join(parts)


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

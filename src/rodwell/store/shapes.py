"""The rod in space as files of other programs: glTF, STL, VTK and CSV.

Lengths in metres and forces in newtons where the scales of a case are given, otherwise in units B = L = 1. Axes i, j, k
of ``rodwell.analysis.space.geometry`` are x, y, z in STL, VTK and CSV. glTF has y up: there k is x, i is y and j is z.
"""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from rodwell._version import __version__
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.space.geometry import Geometry
from rodwell.analysis.space.scene import Part, linear_colours, scene
from rodwell.analysis.space.surfaces import SIDES, Mesh, cylinder, tube
from rodwell.problem.problem import Problem
from rodwell.quantities.names import FIELDS, QUANTITIES, SI_UNITS, UNITS
from rodwell.quantities.scales import Scales

VECTORS = ("t1", "d1", "u1", "d0", "v1")
"""Frames as vectors: braid frame {t₁, d₁, u₁}, material frame {t₁, d₀, v₁}."""


State = Solution | ContactState
"""A state on the wall, or of a rod that may have left it."""

ON_THE_WALL = "d1 towards the axis of the cylinder, u1 = t1 x d1; material frame d0, v1: d1, u1 turned about t1 by -xi1"
OFF_THE_WALL = (
    "d1 without turning about t1 from s = 0, where it points to the axis of the cylinder, u1 = t1 x d1; material frame "
    "d0, v1: d1, u1 turned about t1; curvatures in these frames"
)
"""What a file says of its frames."""

KNOWN = ("x", "y", "z", "xi1", "xi2", "eta", "omega1", "omega2", "omega3", "contact_pressure")
"""Fields of a CSV file whose errors it tells."""


def write_glb(path: Path, solution: State, rod: Geometry, scales: Scales | None, sides: int = SIDES) -> list[Path]:
    """Write the scene as binary glTF: colours by contact pressure, material lines, rings, translucent cylinder."""
    import trimesh  # noqa: PLC0415 - slow to import

    length = _length(scales)
    out = trimesh.Scene(metadata={"about": "\n".join(about(solution, rod, scales))})
    for part in scene(rod, sides):
        out.add_geometry(_gltf_mesh(part, length), node_name=part.name, geom_name=part.name)
    data = out.export(file_type="glb", include_normals=True, unitize_normals=True)
    path.write_bytes(data)
    return [path]


def write_stl(path: Path, _solution: State, rod: Geometry, scales: Scales | None, sides: int = SIDES) -> list[Path]:
    """Write the surface of the rod, closed at both ends, as binary STL; STL keeps no units."""
    import trimesh  # noqa: PLC0415

    body = tube(rod, sides)
    surface = trimesh.Trimesh(body.vertices * _length(scales), body.triangles, process=False, validate=False)
    path.write_bytes(surface.export(file_type="stl"))
    return [path]


def write_vtu(path: Path, solution: State, rod: Geometry, scales: Scales | None, sides: int = SIDES) -> list[Path]:
    """Write surface, centreline and cylinder as three VTK files, with every field of rod and cylinder as point data.

    ``NAME.vtu`` is the rod's surface, ``NAME-centreline.vtu`` the centreline with frames, ``NAME-cylinder.vtu`` the
    wall that its surface touches.
    """
    import meshio  # noqa: PLC0415

    body, wall = tube(rod, sides), cylinder(rod)
    line = np.stack([np.arange(rod.s.size - 1), np.arange(1, rod.s.size)], axis=1)
    along = _point_data(rod, scales)
    surface = {name: values[body.place] for name, values in along.items()} | {"material_angle [rad]": body.angle}
    frames = {name: getattr(rod, name) for name in VECTORS}
    pieces = {
        "": (body.vertices, "triangle", body.triangles, surface),
        "-centreline": (rod.centreline, "line", line, along | frames),
        "-cylinder": (wall.vertices, "triangle", wall.triangles, {}),
    }
    out = []
    for suffix, (points, kind, cells, data) in pieces.items():
        file = path.with_name(f"{path.stem}{suffix}{path.suffix}")
        meshio.Mesh(points * _length(scales), [(kind, cells)], point_data=data).write(file, file_format="vtu")
        out.append(file)
    return out


def write_csv(path: Path, solution: State, rod: Geometry, scales: Scales | None, _sides: int = SIDES) -> list[Path]:
    """Write the centreline with frames, angles, curvatures and contact pressure, one place a line.

    Lines that start with # say what the file holds; the line after them names each column with its unit.
    """
    columns = _columns(rod, scales)
    with path.open("w", encoding="utf-8", newline="") as file:
        for line in [*about(solution, rod, scales), _errors(solution, rod, scales)]:
            file.write(f"# {line}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in zip(*columns.values(), strict=True):
            writer.writerow([repr(float(value) + 0.0) for value in row])  # every digit, and no −0
    return [path]


Writer = Callable[[Path, State, Geometry, "Scales | None", int], list[Path]]

WRITERS: dict[str, Writer] = {".glb": write_glb, ".stl": write_stl, ".vtu": write_vtu, ".csv": write_csv}
"""Writers by the suffix of the file; each returns the files that it wrote."""

ENLARGED = (".glb",)
"""Formats for the eye: enlarged across the axis unless a scale is asked for. The others are in true scale."""


def about(solution: State, rod: Geometry, scales: Scales | None) -> list[str]:
    """What a file holds, and the conventions behind it, line by line."""
    p = solution.problem
    length, force = ("m", "N") if scales is not None else ("L", "B/L^2")
    end_force = solution.force * (1.0 if scales is None else scales.factor("force"))
    scale = (
        "true scale" if rod.radial_scale == 1.0 else f"x, y and the rod's radius {rod.radial_scale:.10g} times enlarged"
    )
    if rod.radial_scale != 1.0:
        scale += "; frames are those of the enlarged curve, curvatures those of the rod"
    unit = 1.0 if scales is None else scales.length
    return [
        f"rodwell {__version__}: heavy rod on a cylinder, equilibrium at end force F = {end_force:.10g} {force} at "
        "s = 1 (tension positive)",
        f"weight mg L^3/B = {p.weight:.10g}, alpha = {p.alpha:.10g} degrees from the vertical, clearance Delta/L = "
        f"{p.clearance:.10g}, {_torsion(p)}, T1 = {p.twist:.10g} B/L, turns {p.turns}, "
        f"ends {'-'.join(p.ends)}, on top {p.on_top}, outside {p.outside}, floats {p.floats}",
        f"lengths in {length}; rod radius {rod.rod_radius * unit:.10g} {length}, "
        f"radius of the wall that it touches {rod.wall_radius / rod.radial_scale * unit:.10g} {length}",
        f"scale: {scale}",
        "axes: z along the cylinder (k), x up (i: lateral gravity acts along -x), y = z cross x (j); straight rod at "
        + ("x > 0" if p.on_top != p.floats else "x < 0"),
        "frames: t1 tangent, " + (OFF_THE_WALL if rod.may_leave else ON_THE_WALL)
        + "; twist = rate of turning of d0, v1 about t1 = -T1/C",
        "contact pressure p: the wall pushes the rod towards the axis with -p per length; p < 0 is contact inside a "
        "cylinder, p > 0 outside",
    ]  # fmt: skip


def _torsion(problem: Problem) -> str:
    """What sets the torsional stiffness."""
    if problem.torsion is None:
        return f"Poisson's ratio {problem.poisson:.10g}"
    return f"torsional stiffness C/B = {problem.torsion:.10g}"


def _errors(solution: State, rod: Geometry, scales: Scales | None) -> str:
    """Error estimates of what a CSV file holds, the largest over s."""
    found = solution.field_errors(rod.s)
    parts = []
    for name in (name for name in KNOWN if name in found):
        factor, unit = _unit(QUANTITIES[name].dimension if name in QUANTITIES else "length", scales)
        parts.append(f"{name} {found[name] * factor:.1e} {unit}")
    sideways = "" if rod.may_leave else " (y is the arclength around the cylinder)"
    return f"error estimates, largest over s{sideways}: " + ", ".join(parts)


def _length(scales: Scales | None) -> float:
    return 1.0 if scales is None else scales.length


def _gltf_mesh(part: Part, length: float) -> Any:
    """A part with its material; colours of glTF are linear, those of the scene sRGB."""
    import trimesh  # noqa: PLC0415
    from trimesh.visual.material import PBRMaterial  # noqa: PLC0415

    mesh: Mesh = part.mesh
    each = part.colour.ndim == 2
    base = np.array([1.0, 1.0, 1.0]) if each else linear_colours(part.colour)
    material = PBRMaterial(
        name=part.name,
        baseColorFactor=np.round(255.0 * np.append(base, part.opacity)).astype(np.uint8),
        metallicFactor=0.0,
        roughnessFactor=0.6,
        alphaMode="BLEND" if part.opacity < 1.0 else "OPAQUE",
        doubleSided=part.opacity < 1.0,
    )
    visual = trimesh.visual.TextureVisuals(material=material)
    if each:
        rgba = np.column_stack([linear_colours(part.colour), np.ones(len(part.colour))])
        visual.vertex_attributes["color"] = np.round(255.0 * rgba).astype(np.uint8)
    points = mesh.vertices[:, [2, 0, 1]] * length
    return trimesh.Trimesh(points, mesh.triangles, visual=visual, process=False, validate=False)


def _unit(dimension: str, scales: Scales | None) -> tuple[float, str]:
    if scales is None:
        return 1.0, UNITS[dimension]
    return scales.factor(dimension), SI_UNITS[dimension]


def _named(name: str, unit: str) -> str:
    return name if unit == "1" else f"{name} [{unit}]"


def _point_data(rod: Geometry, scales: Scales | None) -> dict[str, Any]:
    """Every field at the places along the rod, with the unit in its name; twist, and the sign of contact."""
    length, unit = _unit("length", scales)
    curvature, per_length = _unit("curvature", scales)
    out = {_named("s", unit): rod.s * length}
    for name in (name for name in FIELDS if name in rod.fields):
        dimension = QUANTITIES[name].dimension
        factor, text = _unit(dimension, scales)
        out[_named(name, text)] = rod.fields[name] * factor
    out[_named("twist", per_length)] = rod.material_curvatures[:, 0] * curvature
    out |= _gap(rod)
    out["wall_pushes"] = -np.sign(rod.pull)  # 1 where the wall pushes the rod, −1 where it would have to pull
    return out


def _columns(rod: Geometry, scales: Scales | None) -> dict[str, Any]:
    length, m = _unit("length", scales)
    curvature, per_length = _unit("curvature", scales)
    pressure, force = _unit("force_per_length", scales)
    out = {f"s [{m}]": rod.s * length}
    out |= {f"{axis} [{m}]": rod.centreline[:, i] * length for i, axis in enumerate("xyz")}
    for name in VECTORS:
        out |= {f"{name}_{axis}": getattr(rod, name)[:, i] for i, axis in enumerate("xyz")}
    out |= {f"{name} [rad]": rod.fields[name] for name in ("xi1", "xi2", "eta") if name in rod.fields}
    for symbol, values in (("omega", rod.curvatures), ("material_omega", rod.material_curvatures)):
        out |= {f"{symbol}{i + 1} [{per_length}]": values[:, i] * curvature for i in range(3)}
    return out | _gap(rod) | {f"contact_pressure [{force}]": rod.fields["contact_pressure"] * pressure}


def _gap(rod: Geometry) -> dict[str, Any]:
    """The gap between rod and wall in clearances, of a rod that may have left it."""
    return {"gap [clearance]": rod.fields["gap"]} if rod.may_leave else {}

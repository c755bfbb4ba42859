"""[hole] and [cylinder] of a case file: what they may hold; each value on its own."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator, ConfigDict

from rodwell.case.kinds import (
    REQUIRED,
    Acceleration,
    Angle,
    Curvature,
    InnerLength,
    Length,
    Line,
    Name,
    OneOf,
    SectionInput,
    Stress,
    WallStiffness,
    _key,
)

DepthUnit = Annotated[str, BeforeValidator(OneOf(("m", "ft")))]


class Hole(SectionInput):
    """[hole]: the borehole, vessel or pipe around it."""

    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)

    diameter: Length | None = _key(
        None, "inner diameter of the hole; with the rod's outer diameter gives the clearance", "8.5 in", "6 mm"
    )
    clearance: Length | None = _key(None, "Δ, from axis to axis, instead of `diameter`", "1.75 in", "2.5 mm")
    angle_from_vertical: Angle | None = _key(
        None, "inclination α; beyond horizontal s = 1 is the lower end", "30 deg", allowed='"0 deg" to "180 deg"'
    )
    angle_from_horizontal: Angle | None = _key(
        None, "instead of `angle_from_vertical`; one of the two is required", "60 deg", allowed='"-90 deg" to "90 deg"'
    )
    wall_stiffness: WallStiffness | None = _key(
        None, "of a wall that gives way: its push per length of the rod and depth; counts beyond lift-off (`rodwell "
        "run`, `rodwell path`), and all that is told of the rod on the wall takes it as rigid; rigid if not given",
        "5e6 N/m^2",
    )  # fmt: skip
    gravity: Acceleration = _key(9.80665, "used with `density`", "9.80665 m/s^2")
    build: Curvature | None = _key(
        None, "curvature in the vertical plane of a curved hole, positive where its inclination grows with depth; "
        "the same all along the rod, whose inclination then is that at mid-length", "3 deg/30 m",
    )  # fmt: skip
    walk: Curvature | None = _key(
        None, "curvature sideways, positive to the right looking down the hole: the change of azimuth times the sine "
        "of the inclination", "1 deg/30 m",
    )  # fmt: skip
    survey: Line | None = _key(
        None, "file of measured depth, inclination and azimuth, from the folder of the case file: the rod lies in a "
        "piece of this hole, instead of an inclination", "well.csv",
    )  # fmt: skip
    well: Name | None = _key(None, "which well, if the survey holds several", "A-1")
    depth_unit: DepthUnit | None = _key(None, "unit of depth, if the survey does not say", "ft")
    centerline: Line | None = _key(
        None, "file of points x, y, z of the hole's axis, z upwards, its unit in the header, instead of `survey`",
        "vessel.csv",
    )  # fmt: skip
    from_: InnerLength | None = _key(
        None, "measured depth (or distance along the centre line from its first point) of the rod's end s = 1; with "
        "`to` it must be `rod.length` less", "1850 m", alias="from",
    )  # fmt: skip
    to: Length | None = _key(None, "that of the rod's end s = 0; the end of the file if neither is given", "1940 m")
    tortuosity: Angle | None = _key(
        None, "standard deviation of the hole's direction between stations, in each of two directions across it; none "
        "if not given", "0.2 deg", allowed='above "0 deg" and at most "5 deg"',
    )  # fmt: skip
    tortuosity_step: Length = _key(10.0, "distance of the places at which it is drawn", "10 m")
    tortuosity_seed: int = _key(1, "another number is another hole of the same kind", 7, strict=True, ge=1, le=10**9)


class CylinderInput(SectionInput):
    """[cylinder]: section and strength of the pipe around it, for the check of its capacity."""

    outer_diameter: Length = _key(REQUIRED, "outer diameter of the cylinder", "9.625 in", "75 cm")
    inner_diameter: Length | None = _key(
        None, "inner diameter; that of the hole, if `hole.diameter` is given", "8.535 in"
    )
    yield_strength: Stress = _key(
        REQUIRED, "strength against which the largest equivalent stress is set", "80000 psi", "300 MPa"
    )

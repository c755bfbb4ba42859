"""Names that are no keys of a case file, and what is said of each: what to write instead, or that it is not treated."""

from __future__ import annotations

TAPER = (
    "is not taken: write one [[string]] for each section, from the bottom up, with its own diameters and length; one "
    "that tapers goes from outer_diameter (inner_diameter, core_diameter) to outer_diameter_at_top"
)

SECTIONS_ELSEWHERE = {
    "friction": "is out of scope in this version: the wall is frictionless; leave it out",
    "temperature": "is out of scope in this version: thermal strain is not treated; leave it out and give "
    "rod.youngs_modulus and the load as they are at that temperature",
    "thermal": "is out of scope in this version: thermal strain is not treated; leave it out",
    "well": "is out of scope in this version: a case is one rod in one piece of a hole; for a whole well take "
    "`rodwell screen SURVEY --case CASE`, for torque and drag `rodwell drag WELL`",
    "survey": "is not a section: name the file as hole.survey, or give it on the command line, `rodwell screen SURVEY "
    "--case CASE`",
    "torque": "is not a section; the end twisting moment is load.twist",
    "force": "is not a section; the end force is load.applied, compression negative",
    "fluid": "is not a section; fluids stand in [mud], as density, or inside and outside",
    "fluids": "is not a section; fluids stand in [mud], as density, or inside and outside",
    "casing": "is not a section; its bore is hole.diameter, its strength stands in [cylinder]",
    "wellbore": "is not a section; the borehole is [hole]",
    "borehole": "is not a section; the borehole is [hole]",
    "vessel": "is not a section; the vessel is [hole]",
    "tube": "is not a section; the rod is [rod], what lies around it [hole]",
    "pipe": "is not a section; it belongs into [rod], as a name in the catalogue or as outer_diameter, inner_diameter "
    "and material",
    "drill_pipe": "is not a section; name it with rod.pipe, or give rod.outer_diameter, inner_diameter and material",
    "drillstring": "is not a section; the rod is [rod]",
    "wire": "is not a section; the rod, pipe or wire is [rod]",
    "catheter": "is not a section; the rod, pipe or wire is [rod]",
    "solver": "is not a section; tolerance and number of modes stand in [analysis]",
}
"""Sections that there are not, and what is said of them."""

_MASS = 'is not taken: give the weight instead, weight_per_length = "19.5 lbf/ft" (a force per length), or density'
_TOOL_JOINT = (
    "belongs into [[string]], which takes joints, joint_length, tool_joint_diameter and tool_joint_length. A pipe in "
    "[rod] lies on the wall all along; on its tool joints it buckles at less"
)
_FRICTION = "is out of scope in this version: the wall is frictionless; leave it out"
_FORCE = "is not known; the end force is `applied`, tension positive, compression with a minus sign"
_CENTERLINE = "is not known; write centerline, a file of points x, y, z, or survey"
_BEND = 'is not known; write build (and walk sideways) as a curvature, for example build = "3 deg/30 m"'
_DEPTHS = "is not known; write from and to, measured depths of the rod's ends in the survey"
_ANGLE = "is not known; write angle_from_vertical or angle_from_horizontal"

KEYS_ELSEWHERE: dict[str, dict[str, str]] = {
    "rod": {
        "diameter": "is not known; write outer_diameter (and inner_diameter for a pipe)",
        "od": "is not known; write outer_diameter",
        "id": "is not known; write inner_diameter",
        "radius": "is not taken: write outer_diameter, twice the radius",
        "wall": "is not taken in [rod]: write inner_diameter, the outer diameter less twice the wall",
        "wall_thickness": "is not taken: write inner_diameter, the outer diameter less twice the wall",
        "thickness": "is not taken: write inner_diameter, the outer diameter less twice the wall",
        "e": "is not known; write youngs_modulus",
        "modulus": "is not known; write youngs_modulus",
        "elastic_modulus": "is not known; write youngs_modulus",
        "ei": "is not known; write bending_stiffness",
        "stiffness": "is not known; write bending_stiffness (EI) or torsional_stiffness (GJ)",
        "gj": "is not known; write torsional_stiffness",
        "shear_modulus": "is not taken: write torsional_stiffness (GJ), or poisson",
        "nu": "is not known; write poisson",
        "weight": 'is not known; write weight_per_length = "19.5 lbf/ft", or density',
        "linear_weight": "is not known; write weight_per_length",
        "unit_weight": "is not known; write weight_per_length",
        "mass": _MASS,
        "mass_per_length": _MASS,
        "linear_density": _MASS,
        "tool_joint_diameter": _TOOL_JOINT,
        "tool_joint_length": _TOOL_JOINT,
        "tool_joint_od": _TOOL_JOINT,
        "tool_joints": _TOOL_JOINT,
        "joint_length": _TOOL_JOINT,
        "sections": TAPER,
        "taper": TAPER,
        "curvature": "is out of scope in this version: the rod is straight when free",
        "friction": _FRICTION,
        "friction_factor": _FRICTION,
        "friction_coefficient": _FRICTION,
        "temperature": SECTIONS_ELSEWHERE["temperature"],
    },
    "hole": {
        "radius": "is not taken: write diameter, twice the radius",
        "size": "is not known; write diameter",
        "inner_diameter": "is not known in [hole]; write diameter",
        "outer_diameter": "does not belong into [hole]: that of the rod stands in [rod], that of the pipe around it in "
        "[cylinder]",
        "inclination": 'is not known; write angle_from_vertical = "30 deg"',
        "angle": _ANGLE,
        "alpha": _ANGLE,
        "deviation": "is not known; write angle_from_vertical",
        "azimuth": "is not taken: it has no effect, but its change has: write walk, or a survey",
        "section": "is out of scope in this version: the hole of a case has one diameter; leave "
        "[[hole.section]] out and give hole.diameter",
        "sections": "is out of scope in this version: the hole of a case has one diameter",
        "axis": _CENTERLINE,
        "centreline": _CENTERLINE,
        "path": _CENTERLINE,
        "points": _CENTERLINE,
        "curvature": _BEND,
        "dogleg": _BEND,
        "dls": _BEND,
        "dogleg_severity": _BEND,
        "build_rate": _BEND,
        "turn": _BEND,
        "turn_rate": _BEND,
        "turn_angle": _BEND,
        "radius_of_curvature": 'is not taken: write build, the curvature, for example "3 deg/30 m"',
        "top": _DEPTHS,
        "bottom": _DEPTHS,
        "start": _DEPTHS,
        "end": _DEPTHS,
        "measured_depth": _DEPTHS,
        "md": _DEPTHS,
        "friction": _FRICTION,
        "friction_factor": _FRICTION,
        "friction_coefficient": _FRICTION,
    },
    "mud": {
        "weight": 'is not known; the weight of a mud is its density: write density = "10 lb/gal"',
        "mud_weight": 'is not known; the weight of a mud is its density: write density = "10 lb/gal"',
        "mw": 'is not known; the weight of a mud is its density: write density = "10 lb/gal"',
        "gradient": 'is not taken: write density = "10 lb/gal", the gradient over g',
        "specific_gravity": 'is not taken: write density = "1200 kg/m^3", specific gravity times that of water',
        "pressure": "does not belong into [mud]: write [pressure] with inside and outside",
        "internal": "is not known; write inside",
        "external": "is not known; write outside",
        "annulus": "is not known; write outside",
    },
    "pressure": {
        "internal": "is not known; write inside",
        "external": "is not known; write outside",
        "annulus": "is not known; write outside",
        "surface": "is not known; write inside and outside, both at s = 1",
    },
    "load": {
        "torque": "is not known; the end twisting moment is `twist`: write that instead",
        "force": _FORCE,
        "axial_force": _FORCE,
        "compression": _FORCE,
        "push": _FORCE,
        "wob": f'{_FORCE}; at = "bottom" says where',
        "weight_on_bit": f'{_FORCE}; at = "bottom" says where',
        "hook_load": f'{_FORCE}; at = "top" says where',
        "pressure": "does not belong into [load]: write [pressure] with inside and outside",
        "end": "is not known; write at",
        "rotation": "is not taken: the end is loaded by a dead torque, twist",
        "friction": _FRICTION,
    },
    "dimensionless": {
        "gamma": "is not known; write weight",
        "delta": "is not known; write clearance",
        "angle": "is not known; write alpha, in degrees from the vertical",
        "nu": "is not known; write poisson",
        "twist": "does not belong into [dimensionless] but into [load], in B/L",
        "force": "does not belong into [dimensionless] but into [load], as applied, in B/L²",
        "torsional_stiffness": "is not known in [dimensionless]; write torsion, the ratio C/B",
        "turns": "is not taken in case files: give `--turns` with `rodwell diagram`",
    },
    "analysis": {
        "tolerance": "is not known; write rtol",
        "tol": "is not known; write rtol",
        "accuracy": "is not known; write rtol",
        "mesh": "is not taken: meshes are chosen by the tolerance rtol",
        "elements": "is not taken: meshes are chosen by the tolerance rtol",
        "friction": _FRICTION,
    },
    "supports": {
        "twist": "is not known; write torque, the largest twisting moment that a support can bear",
        "bending": "is not known; write moment",
    },
}
"""Keys that there are not, by section, and what is said of them."""

"""Tool joints along a section of [[string]]: half of a made-up one at either end of each joint of pipe."""

from __future__ import annotations

from rodwell.case import schema
from rodwell.case.catalogue import Catalogue
from rodwell.case.pipe import PhysicalRod
from rodwell.errors import InputError

TOOL_JOINT = ", tool joint"
"""What follows the name of a section where its tool joints are meant."""

KEYS = ("tool_joint_diameter", "tool_joint_length", "tool_joint_bore")

OF_THE_BODY = ("pipe", "bending_stiffness", "torsional_stiffness", "weight_per_length", "grade", "yield_strength")
"""What a section says of its body alone."""


def body_between_tool_joints(one: schema.StringInput, catalogue: Catalogue) -> schema.StringInput | None:
    """The pipe between tool joints, with its plain-end weight if the catalogue has it; None: the section has none.

    Raises
    ------
    InputError
        Naming the key of the tool joints that is missing or does not fit.
    """
    given = [key for key in KEYS if getattr(one, key) is not None]
    if not given:
        return None
    for key in ("tool_joint_diameter", "tool_joint_length", "joints"):
        if getattr(one, key) is None:
            raise InputError(f"rod.{key}", None, f"is missing: {given[0]} needs it")
    diameter, length = one.tool_joint_diameter or 0.0, one.tool_joint_length or 0.0
    pipe = None if one.pipe is None else catalogue.pipe(one.pipe)
    outer = one.outer_diameter if pipe is None else pipe.outer_diameter
    if outer is not None and diameter <= outer:
        what = f"must be above the diameter of the body, {outer:g} m; leave tool joints out that are no thicker"
        raise InputError("rod.tool_joint_diameter", diameter, what)
    if one.tool_joint_bore is not None and one.tool_joint_bore >= diameter:
        raise InputError(
            "rod.tool_joint_bore", one.tool_joint_bore, f"must be below tool_joint_diameter, {diameter:g} m"
        )
    if one.joint_length is not None and length >= one.joint_length:
        what = f"must be below the length of a joint, {one.joint_length:g} m"
        raise InputError("rod.tool_joint_length", length, what)
    if pipe is None or pipe.plain_end_weight is None or one.weight_per_length is not None:
        return one
    return one.model_copy(update={"weight_per_length": pipe.plain_end_weight})


def tool_joint_of(one: schema.StringInput, body: PhysicalRod, catalogue: Catalogue) -> schema.StringInput:
    """The tool joint as a pipe: its own diameters, the material of the body; its strength is not known."""
    material = one.material
    if material is None and one.pipe is not None:
        material = catalogue.pipe(one.pipe).material
    bore = body.inner_diameter if one.tool_joint_bore is None else one.tool_joint_bore
    own = {"outer_diameter": one.tool_joint_diameter, "inner_diameter": bore, "material": material}
    return one.model_copy(update=dict.fromkeys(OF_THE_BODY) | own)

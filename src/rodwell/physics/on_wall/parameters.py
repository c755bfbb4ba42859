"""The order in which kernels take the physical parameters, and where each stands.

=================  ======  ==========================================================================
name               symbol  meaning (units B = L = 1)
=================  ======  ==========================================================================
force              F       axial end force at s = 1, tension positive
axial_weight       wₐ      mg cos α, weight per length along the cylinder, from s = 1 towards s = 0
lateral_weight     wₗ      mg sin α; negative for a rod on top of the cylinder (paper, section 4.3)
clearance          Δ       distance between the axes of rod and cylinder
twist              T₁      end twisting moment (dead load)
side               ±1      1 for a rod inside the cylinder, −1 for one outside: the sense in which p is contact
(ramp)             2πnΔ    rise of the even winding y = 2πnΔ s that is not part of the spline
=================  ======  ==========================================================================

The spline of a coiled rod holds y less the even winding: a helix is then exactly zero, and the third derivative of y,
which the contact pressure needs, is not drowned by the round-off of a large y. The ramp is added to y and y′ where a
model is evaluated (:mod:`rodwell.physics.on_wall.model`) and where fields are rebuilt; the energy itself does not know
it.
"""

from __future__ import annotations

PARAMETERS = ("force", "axial_weight", "lateral_weight", "clearance", "twist", "side")

RAMP = len(PARAMETERS)
COUNT = RAMP + 1

FORCE, AXIAL_WEIGHT, LATERAL_WEIGHT, CLEARANCE, TWIST, SIDE = range(len(PARAMETERS))

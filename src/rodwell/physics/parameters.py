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
=================  ======  ==========================================================================
"""

from __future__ import annotations

PARAMETERS = ("force", "axial_weight", "lateral_weight", "clearance", "twist", "side")

FORCE, AXIAL_WEIGHT, LATERAL_WEIGHT, CLEARANCE, TWIST, SIDE = range(len(PARAMETERS))

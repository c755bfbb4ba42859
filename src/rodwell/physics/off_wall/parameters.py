"""The order in which the density off the wall takes the physical parameters: the first five of a rod kept on it.

=================  ======  ==========================================================================
name               symbol  meaning (units B = L = 1)
=================  ======  ==========================================================================
force              F       axial end force at s = 1, tension positive
axial_weight       wₐ      mg cos α, weight per length along the cylinder, from s = 1 towards s = 0
lateral_weight     wₗ      mg sin α, towards the bottom of the hole, x = −Δ
clearance          Δ       radius of the hole in which the rod's axis can move
twist              T₁      end twisting moment (dead load)
=================  ======  ==========================================================================

Rooms of the physics do not know each other, so the order is written a second time; a test compares the two.
"""

from __future__ import annotations

PARAMETERS = ("force", "axial_weight", "lateral_weight", "clearance", "twist")

FORCE, AXIAL_WEIGHT, LATERAL_WEIGHT, CLEARANCE, TWIST = range(len(PARAMETERS))

"""The straight rod off the wall: second variation of the energy in both lateral displacements.

With u = x + iy, x inwards from the wall and y around it, the energy of a rod that is free in space,

    ∫ ½[x″² + y″² + …] − N(s) z′ + T₁ (x′y″ − y′x″)/(1 + z′) ds,    N(s) = F + wₐ(s − 1),

is ½Q + O(|u|⁴) for small slopes, without lateral weight, with the Hermitian form

    Q = ∫ |u″|² + N |u′|² + T₁ Im(ū′u″) ds = ∫ |u″ + ½iT₁ u′|² + (N − ¼T₁²) |u′|² ds,

since |u″ + ½iT₁u′|² = |u″|² + T₁ Im(ū′u″) + ¼T₁²|u′|². The second way to write it is a sum of squares: with
v = exp(½iT₁s) u′ it is ∫ |v′|² + (N − ¼T₁²)|v|² ds, a string whose tension is one, so F_c = ¼T₁² − μ with the
eigenvalues μ of that string, which must satisfy ∫ exp(−½iT₁s) v ds = 0 if both ends hold the position.

It is stationary where u⁗ + iT₁u‴ − (Nu′)′ = 0; at an end that does not hold the slope u″ + ½iT₁u′ = 0, and at one that
does not hold the position u‴ + iT₁u″ − Nu′ = 0. The other sign of T₁ gives the complex conjugate: loads are even in T₁.

In a section of bending stiffness b the first term is b|u″|², so Q = ∫ b|u″ + ½i(T₁/b)u′|² + (N − ¼T₁²/b)|u′|² ds.

*Which torque.* What T₁ does at an end that turns is decided by the first of these conditions. A dead moment T₁ about
the fixed axis (axial) leaves a bending moment with u″ + iT₁u′ = 0, a moment that stays tangential none, u″ = 0. The
energy has their mean: T₁ is *semi-tangential* (H. Ziegler, *Principles of Structural Stability*, 1968), the one of the
three that has a potential. Where both ends hold the slope there is no difference.
"""

from __future__ import annotations

import numpy as np

from rodwell.quantities.arrays import ComplexArray, FloatArray


def square_factors(axial: FloatArray, stiffness: FloatArray, lift: float) -> FloatArray:
    """Factors (3, m) of |u|², |u′|², |u″|² in Q + ``lift`` ∫|u′|² ds, from N at F = 0 and b at places, (m,) each.

    They belong to each of the two fields, which are coupled by T₁ ∫ x′y″ − y′x″ ds besides. A lift of ¼T₁²/b, with the
    least b, leaves a sum of squares but for the axial weight.
    """
    return np.array([np.zeros_like(axial), lift + axial, stiffness])


def turned_curvature(slope: ComplexArray, bend: ComplexArray, twist: float | FloatArray) -> ComplexArray:
    """u″ + ½iT₁u′, whose square is that of the bending energy and of the torque: the natural moment at an end.

    In a section of stiffness b it is b times that with T₁/b for ``twist``.
    """
    return np.asarray(bend + 0.5j * twist * slope)


def torque_density(slope: ComplexArray, bend: ComplexArray) -> FloatArray:
    """Im(ū′u″) = x′y″ − y′x″: the derivative of the density of Q by T₁."""
    return np.asarray(slope.real * bend.imag - slope.imag * bend.real)

"""Forces, moments and contact of the rod (the first strand), place by place.

Plain formulas in y(s) and its derivatives: the same functions serve compiled kernels (lanes of vector registers) and
reconstruction (arrays). Components refer to the braid frame {t₁, d₁, u₁} of the rod. Units B = L = 1;
tension is positive. The sign of the contact pressure is the paper's, (48): the wall pushes the rod along d₁
(towards the axis) with −p per length, so p < 0 is contact with a surrounding cylinder.

Of a string of sections, ``parameters`` and ``stiffness`` b = B(s)/B are those of the section: see
:mod:`rodwell.physics.on_wall.sections`. Moments are M⁽¹⁾ = (−T₁, b ω₂, b ω₃).

The one integral is avoided: without friction the cylinder carries no axial force (h = 0), so the axial
resultant of the rod alone is ``F⁽¹⁾·t₂ = N(s) = F + wₐ(s − 1)``, and the tension ``F₁⁽¹⁾`` follows from it and
from the shear ``F₃⁽¹⁾`` because ``t₂ = cos η t₁ − sin η u₁``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, LATERAL_WEIGHT, SIDE, TWIST


def axial_resultant(s: Any, parameters: Any) -> Any:
    """N(s) = F + wₐ (s − 1): axial component of the braid force, (22)–(24)."""
    return parameters[FORCE] + parameters[AXIAL_WEIGHT] * (s - 1.0)


def curvatures(y1: Any, y2: Any, y3: Any, clearance: Any) -> Any:
    """Cos η, ω₁, ω₂, ω₃ (20) and ω₂' = −η''."""
    cos_eta = np.sqrt(1.0 - y1 * y1)
    eta1 = y2 / cos_eta
    eta2 = (y3 + y1 * eta1 * eta1) / cos_eta
    return cos_eta, -y1 * cos_eta / clearance, -eta1, y1 * y1 / clearance, -eta2


def strand_force(s: Any, y1: Any, y2: Any, y3: Any, parameters: Any, stiffness: Any = 1.0) -> Any:
    """Rod force components F₁⁽¹⁾, F₂⁽¹⁾, F₃⁽¹⁾, (52)–(54), from moment balance with M⁽¹⁾ = (−T₁, b ω₂, b ω₃), (47)."""
    twist = parameters[TWIST]
    cos_eta, omega1, omega2, omega3, omega2_rate = curvatures(y1, y2, y3, parameters[CLEARANCE])
    f2 = -omega2 * (3.0 * stiffness * omega1 + twist)
    f3 = stiffness * omega2_rate - omega3 * twist - stiffness * omega1 * omega3
    f1 = (axial_resultant(s, parameters) + f3 * y1) / cos_eta
    return f1, f2, f3


def towards_lift_off(s: Any, y: Any, y1: Any, y2: Any, y3: Any, parameters: Any, stiffness: Any = 1.0) -> Any:
    """Contact pressure with the sign that makes it negative in contact: p inside the cylinder, −p outside."""
    return parameters[SIDE] * contact_pressure(s, y, y1, y2, y3, parameters, stiffness)


def contact_pressure(s: Any, y: Any, y1: Any, y2: Any, y3: Any, parameters: Any, stiffness: Any = 1.0) -> Any:
    """Contact pressure p = p₂⁽¹⁾, (55): force balance of the rod (48) along d₁.

    ``p = dF₂⁽¹⁾/ds + ω₃ F₁⁽¹⁾ − ω₁ F₃⁽¹⁾ − wₗ cos ξ₂`` with ``dF₂⁽¹⁾/ds = −ω₂'(3b ω₁ + T₁) − 3b cos 2η ω₂²/Δ``.
    Contact holds while p < 0 with a surrounding cylinder, while p > 0 with one that the rod lies on from outside.
    """
    clearance = parameters[CLEARANCE]
    _, omega1, omega2, omega3, omega2_rate = curvatures(y1, y2, y3, clearance)
    f1, _, f3 = strand_force(s, y1, y2, y3, parameters, stiffness)
    cos_2eta = 1.0 - 2.0 * y1 * y1
    lever = 3.0 * stiffness * omega1 + parameters[TWIST]
    f2_rate = -omega2_rate * lever - 3.0 * stiffness * cos_2eta * omega2 * omega2 / clearance
    return f2_rate + omega3 * f1 - omega1 * f3 - parameters[LATERAL_WEIGHT] * np.cos(y / clearance)

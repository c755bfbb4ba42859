"""The steel case that formulas of practice are tried on."""

from __future__ import annotations

import math

# Steel case of Wicks et al. 2008: OD 14.0 cm, ID 11.6 cm, hole 22.2 cm, E 207 GPa, w 315 N/m, P 100 kN, horizontal
STEEL = {"B": 207e9 * math.pi / 64.0 * (0.140**4 - 0.116**4), "w": 315.0, "alpha": 90.0, "r": 0.5 * (0.222 - 0.140)}

"""A pipe on the bottom of a hole, and the load of Dawson and Paslay at which it buckles."""

from __future__ import annotations

import math

from rodwell.analysis.loads.long_rod import PipeString

PIPE = PipeString(1.228e6, 241.0, 0.04445)  # 5 in, 19.5 lb/ft in 10 ppg, 8.5 in hole


def dawson_paslay(alpha: float) -> float:
    return 2.0 * math.sqrt(PIPE.stiffness * PIPE.weight * math.sin(math.radians(alpha)) / PIPE.clearance)

"""The types of arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
"""Numbers in double precision, of any shape; docstrings say which."""

IntArray = NDArray[np.int64]
"""Whole numbers: positions in other arrays."""

BoolArray = NDArray[np.bool_]
"""Marks."""

ComplexArray = NDArray[np.complex128]
"""Numbers of two parts in double precision: lateral displacements x + iy."""

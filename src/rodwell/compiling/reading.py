"""Machine code read from the disk without what only compiling needs.

Numba keeps a record of constants with each compiled function, and reads it together with the module that the function
comes from. For parts of Numba itself those modules are large, and only what is interpreted ever looks into them: to
import them takes as long as to read all kernels of a short command. Without them the records are the same.
"""

from __future__ import annotations

import io
import pickle
import sys
from typing import Any

from numba.core.environment import Environment, _rebuild_env, lookup_environment


def read(code: bytes | memoryview) -> Any:
    """What lies pickled in a file of machine code."""
    return _Reader(io.BytesIO(code)).load()


class _Reader(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        if (module, name) == (_rebuild_env.__module__, _rebuild_env.__name__):
            return _environment
        return super().find_class(module, name)


def _environment(module: str, constants: list[Any], name: str) -> Any:
    """Numba's record of the constants of a compiled function of a module."""
    if module in sys.modules or not module.startswith("numba."):
        return _rebuild_env(module, constants, name)
    found = lookup_environment(name)
    if found is None:
        found = Environment({"__name__": module})
        found.consts[:] = constants
        found.env_name = name
        Environment._memo[name] = found
    return found

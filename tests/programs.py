"""Programs beside the package, campaigns above all, as modules of which tests call parts."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).resolve().parents[1]
CAMPAIGNS = ROOT / "benchmarks" / "campaigns"


def loaded(file: Path) -> ModuleType:
    """The module in a file, which may import what lies beside it."""
    specification = importlib.util.spec_from_file_location(f"program_{file.stem}", file)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    sys.modules[specification.name] = module  # where classes look for the module that they are made in
    sys.path.insert(0, str(file.parent))
    try:
        specification.loader.exec_module(module)
    finally:
        sys.path.remove(str(file.parent))
    return module

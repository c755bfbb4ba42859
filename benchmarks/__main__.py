"""All benchmarks, one after the other: ``python benchmarks``.

Each prints its tables and writes them to ``benchmarks/results``. AUTO-07p takes part if bifpy, gfortran and make are
installed; the others need the package with its test extra only. Some minutes on a quiet machine; with AUTO-07p about a
quarter of an hour.
"""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

HERE = Path(__file__).parent


def main() -> int:
    names = ["spine", "peers", "scaling", "off_wall", "inclined"]
    if find_spec("bifpy") is None:
        print("AUTO-07p is left out: pip install bifpy==0.3.0 (needs gfortran and make) to measure it too.")
    else:
        names.append("auto07p")
    failed = []
    for name in names:
        print(f"== {name}", flush=True)
        if subprocess.run([sys.executable, str(HERE / f"{name}.py")], check=False).returncode != 0:
            failed.append(name)
    if failed:
        print(f"Failed: {', '.join(failed)}.")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

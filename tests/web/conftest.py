"""Where the tests of the explorer find the browser of the tests of pages."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))

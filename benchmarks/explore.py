"""How the explorer keeps up: first diagram, a dragged load, frames, a parameter that moves; and for how long it does.

    python benchmarks/explore.py                  prints each figure as it comes; all to benchmarks/results/explore.json
    python benchmarks/explore.py --soak 30        random moves for 30 minutes: memory of page and server each minute

Needs the package with its test extra and Chromium, which is started as on a machine without a graphics card: WebGL is
drawn by SwiftShader, the page itself in the way that Chromium chooses then. Under ``all_by_gl`` SwiftShader draws the
page too. Times from an input to its paint are taken in the page, the rest outside. Kernels are compiled: run it twice.
What takes longer than it may ends the run with an error that says what it was.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import platform
import random
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from explore_scripts import CANCEL, DRAG, MOVE, STEP, TURN
from playwright.sync_api import sync_playwright

HERE = Path(__file__).parent
CASE = HERE.parent / "examples" / "drill-string.toml"
RESULTS = HERE / "results" / "explore.json"
FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--enable-precise-memory-info", "--js-flags=--expose-gc"]
ALL_BY_GL = [*FLAGS, "--use-angle=swiftshader", "--disable-gpu-rasterization"]
"""Chromium asks for a graphics card then, and has SwiftShader instead: each frame of the page costs it 50 ms."""

LONGEST = 90.0
"""Seconds that one figure may take."""

LOAD = {"control": "#load-control", "from": 0.4, "to": 0.7}
INPUT = {"control": "#controls .control", "from": 0.34, "to": 0.4}


class Watch:
    """Ends the run where something takes longer than it may: what waits for a browser cannot be told to stop."""

    def __init__(self) -> None:
        self.running: list[subprocess.Popen[str]] = []

    @contextlib.contextmanager
    def over(self, what: str, limit: float = LONGEST) -> Iterator[None]:
        """What is done within takes ``limit`` seconds at most."""
        timer = threading.Timer(limit, self._give_up, (what, limit))
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()

    def _give_up(self, what: str, limit: float) -> None:
        print(f"{what}: not done after {limit:.0f} s", file=sys.stderr, flush=True)
        for process in self.running:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
        children = Path(f"/proc/self/task/{os.getpid()}/children").read_text(encoding="utf-8").split()
        for child in children:  # Playwright's, with Chromium
            os.kill(int(child), signal.SIGTERM)
        os._exit(1)


WATCH = Watch()


def told(name: str, figure: Any) -> Any:
    """Print a figure, and return it."""
    print(json.dumps({name: figure}, default=float), flush=True)
    return figure


class Explorer:
    """The command and its page."""

    def __init__(self, play: Any, flags: list[str]) -> None:
        path = next(filter(None, map(shutil.which, ("chromium", "google-chrome"))))
        self.browser = play.chromium.launch(executable_path=path, args=flags)
        self.page = self.browser.new_page(viewport={"width": 1440, "height": 900})
        self.bytes, self.known = 0, set[int]()
        self.page.on("response", self._count)
        self.began = time.perf_counter()
        command = [sys.executable, "-m", "rodwell", "explore", str(CASE), "--no-browser"]
        self.server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
        WATCH.running.append(self.server)
        assert self.server.stdout is not None
        found = re.search(r"http\S+", self.server.stdout.readline())
        assert found is not None
        self.page.goto(found[0], wait_until="commit")
        self.until("document.querySelector('#diagram path') && document.getElementById('buckles').textContent !== '…'")
        self.first = time.perf_counter() - self.began
        self.until("window.__rodwell.ready")

    def _count(self, response: Any) -> None:
        self.bytes += int(response.headers.get("content-length", 0))

    def until(self, script: str, limit: float = LONGEST) -> None:
        """Wait in the page until a script is true: looking from outside would take the processor from it."""
        waiting = f"""new Promise((done) => {{
            const end = performance.now() + {1e3 * limit};
            const look = () => ({script}) ? done(true) : performance.now() > end ? done(false) : setTimeout(look, 10);
            look();
        }})"""
        if not self.page.evaluate(waiting):
            raise TimeoutError(script)

    def measured(self, script: str, given: Any = None) -> Any:
        """What a script finds once the page is at rest."""
        self.until("window.__rodwell.ready")
        return self.page.evaluate(script, given)

    def tree(self) -> list[int]:
        """Processes of the server."""
        listed = subprocess.run(["ps", "-eo", "pid=,sid="], capture_output=True, text=True, check=True).stdout
        return [int(pid) for pid, sid in map(str.split, listed.splitlines()) if int(sid) == self.server.pid]

    def memory(self) -> dict[str, float]:
        """Megabytes of the page's heap and of the server's processes."""
        heap = self.page.evaluate("(window.gc && gc(), performance.memory.usedJSHeapSize)")
        tree = self.tree()
        self.known |= set(tree)  # one that computes and does not leave off in time is replaced
        resident = sum(map(_resident, tree))
        return {"page": heap / 1e6, "server": resident / 1e3}

    def end(self, how: int) -> int:
        """End the command and the browser; how many processes of the command are left two seconds later."""
        pids = self.tree()
        os.kill(self.server.pid, how)
        with contextlib.suppress(subprocess.TimeoutExpired):  # then it is among those that are left
            self.server.wait(20)
        time.sleep(2.0)
        left = [pid for pid in pids if Path(f"/proc/{pid}").exists()]
        self.browser.close()
        return len(left)


def _resident(pid: int) -> int:
    try:
        text = Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    except OSError:  # it has ended
        return 0
    found = re.search(r"VmRSS:\s+(\d+) kB", text)
    return int(found[1]) if found else 0


def speeds(play: Any) -> dict[str, Any]:
    """The figures that an idle machine is asked for."""
    out: dict[str, Any] = {}
    with WATCH.over("first diagram"):
        one = Explorer(play, FLAGS)
    out["first_diagram_s"] = told("first_diagram_s", one.first)
    out["first_page_kB"] = told("first_page_kB", one.bytes / 1e3)
    with WATCH.over("warming up"):  # in the first frames the browser makes its shaders
        one.measured(DRAG, LOAD | {"seconds": 3.0})
    for name, script, given in (
        ("drag", DRAG, LOAD | {"seconds": 5.0}), ("drag_an_input", DRAG, INPUT | {"seconds": 5.0}), ("turn", TURN, 3.0),
        ("one_per_cent", STEP, None), ("cancel", CANCEL, "rod.length"),
    ):  # fmt: skip
        with WATCH.over(name):
            out[name] = told(name, one.measured(script, given))
    with WATCH.over("Ctrl-C"):
        out["left_after_ctrl_c"] = told("left_after_ctrl_c", one.end(signal.SIGINT))
    with WATCH.over("all by GL", 2.0 * LONGEST):
        other = Explorer(play, ALL_BY_GL)
        other.measured(DRAG, LOAD | {"seconds": 3.0})
        drag = other.measured(DRAG, LOAD | {"seconds": 5.0})
        out["all_by_gl"] = told("all_by_gl", {"drag": drag, "turn": other.measured(TURN, 3.0)})
        other.end(signal.SIGINT)
    return out


def soak(play: Any, minutes: float) -> dict[str, Any]:
    """Random moves of load and inputs, and the memory before and after."""
    with WATCH.over("first diagram"):
        one = Explorer(play, FLAGS)
    chance = random.Random(24)
    sliders = one.page.locator("#load-control input[type=range], #controls input[type=range]")
    many = sliders.count()

    def move() -> None:
        which = 0 if chance.random() < 0.8 else chance.randrange(1, many)
        part = chance.random() if which == 0 else chance.uniform(0.3, 0.5)
        sliders.nth(which).evaluate(MOVE, part)

    begun, count, known = time.perf_counter(), 0, list[dict[str, float]]()
    while (passed := time.perf_counter() - begun) < 60.0 * minutes:
        with WATCH.over(f"move {count + 1}"):
            move()
            count += 1
            time.sleep(0.1)
            if passed > 60.0 * len(known) + 20.0:  # the first when it has warmed up, then each minute
                known.append(told("soak", {"minutes": passed / 60.0, "moves": count} | one.memory()))
    known.append(told("soak", {"minutes": minutes, "moves": count} | one.memory()))
    grown = {f"{name}_MB": known[-1][name] - known[0][name] for name in ("page", "server")}
    most = {f"{name}_MB": max(each[name] for each in known) - known[0][name] for name in ("page", "server")}
    out: dict[str, Any] = {"minutes": minutes, "moves": count, "first": known[0], "grown": grown, "most": most}
    out["processes"] = len(one.known)  # at the beginning 3: server, engine, Python's watch over what they share
    with WATCH.over("hanging up"):
        out["left_after_hang_up"] = told("left_after_hang_up", one.end(signal.SIGHUP))
    return out


def main() -> None:
    """Measure, print, and add to the results."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--soak", type=float, metavar="MINUTES", help="random moves for so long instead")
    minutes = parser.parse_args().soak
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # the command is hung up on; under nohup it would not hear that
    with sync_playwright() as play:
        found = {"soak": soak(play, minutes)} if minutes else {"speeds": speeds(play)}
    for measured in found.values():
        measured["load_average"] = os.getloadavg()[2]  # of the last 15 minutes: above 2, others were computing too
    known = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}
    known |= found
    known["machine"] = f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}"
    RESULTS.write_text(json.dumps(known, indent=2, default=float) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

"""How the explorer keeps up: first diagram, a dragged load, frames, a parameter that moves; and for how long it does.

    python benchmarks/explore.py                  prints the figures and writes benchmarks/results/explore.json
    python benchmarks/explore.py --soak 30        random moves for 30 minutes: memory of page and server

Needs the package with its test extra and Chromium; without a graphics card Chromium draws with the processor. Times
from an input to its paint are taken in the page, the rest outside. Kernels are compiled: run it twice.
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
import time
from pathlib import Path
from typing import Any

from playwright.sync_api import sync_playwright

HERE = Path(__file__).parent
CASE = HERE.parent / "examples" / "drill-string.toml"
RESULTS = HERE / "results" / "explore.json"
FLAGS = [
    "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-precise-memory-info",
    "--js-flags=--expose-gc", "--disable-gpu-rasterization",
]  # fmt: skip
DRAG = """async ({ control, from, to, seconds }) => {
    const rw = window.__rodwell, slider = document.querySelector(`${control} input[type=range]`);
    const field = document.querySelector(`${control} input[type=number]`);
    const low = Number(slider.min), high = Number(slider.max), shown = [];
    const first = rw.updates, began = performance.now();
    rw.times.length = 0;
    let seen = first;
    while (performance.now() - began < 1e3 * seconds) {
        const t = (performance.now() - began) / (1e3 * seconds);
        slider.value = low + (from + (to - from) * t) * (high - low);
        slider.dispatchEvent(new Event("input"));
        await new Promise((done) => requestAnimationFrame(done));
        if (rw.updates !== seen) { seen = rw.updates; shown.push(Number(field.value)); }
    }
    const states = (rw.updates - first) / seconds;
    slider.dispatchEvent(new Event("change"));
    const times = [...rw.times].sort((a, b) => a - b);
    return { states_per_second: states, p95_ms: times[Math.floor(0.95 * (times.length - 1))],
        median_ms: times[times.length >> 1], in_order: shown.every((value, i) => !i || value >= shown[i - 1]) };
}"""
LOAD = {"control": "#load-control", "from": 0.4, "to": 0.7}
INPUT = {"control": "#controls .control", "from": 0.34, "to": 0.4}
CANCEL = """async (name) => {
    const address = new URL("talk", location.href);
    address.protocol = "ws:";
    address.hash = "";
    const socket = new WebSocket(address), value = Number(document.querySelector("#controls input[type=number]").value);
    await new Promise((done) => { socket.onopen = done; });
    const out = [];
    for (let k = 0; k < 20; k++) {
        const ask = (id) => {
            const inputs = { [name]: value * (1 + 0.003 * id) };
            socket.send(JSON.stringify({ kind: "diagram", id, inputs }));
        };
        ask(2 * k + 1);
        await new Promise((done) => setTimeout(done, 60 + 20 * k));
        const began = performance.now();
        const ended = new Promise((done) => {
            socket.onmessage = (event) => {
                const message = JSON.parse(event.data);
                if (message.id === 2 * k + 1 && message.last) done(message.kind);
            };
        });
        ask(2 * k + 2);
        if (await ended === "cancelled") out.push(performance.now() - began);
        await new Promise((done) => {
            socket.onmessage = (event) => {
                const message = JSON.parse(event.data);
                if (message.last && message.id === 2 * k + 2) done();
            };
        });
    }
    socket.close();
    return { cancelled: out.length, longest_ms: Math.max(...out) };
}"""
TURN = """async (seconds) => {
    const stage = document.querySelector("#rod .stage"), canvas = stage.querySelector("canvas");
    Object.assign(stage.style, { width: "800px", height: "450px", position: "fixed", left: 0, top: 0, zIndex: 9 });
    await new Promise((done) => setTimeout(done, 500));
    const act = (type, x) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: x, clientY: 200,
        buttons: type === "pointerup" ? 0 : 1, button: 0, bubbles: true, isPrimary: true }));
    const drawn = window.__rodwell.drawn, gl = canvas.getContext("webgl2"), pixel = new Uint8Array(4);
    HTMLElement.prototype.setPointerCapture = () => {};
    act("pointerdown", 300);
    const first = drawn(), began = performance.now();
    let x = 300;
    while (performance.now() - began < 1e3 * seconds) {
        act("pointermove", (x += 4));
        await new Promise((done) => requestAnimationFrame(done));
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // until it has been drawn
    }
    const frames = (drawn() - first) / ((performance.now() - began) / 1e3);
    act("pointerup", x);
    await new Promise((done) => setTimeout(done, 1000));
    const rest = drawn();
    await new Promise((done) => setTimeout(done, 1000));
    stage.style = "";
    return { frames_per_second: frames, draws_when_idle: drawn() - rest };
}"""
STEP = """async () => {
    const rw = window.__rodwell, slider = document.querySelector("#controls input[type=range]");
    const text = (id) => document.getElementById(id).textContent;
    const press = () => slider.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
    const began = performance.now(), out = {};
    press();
    while (performance.now() - began < 60000) {
        await new Promise((done) => setTimeout(done, 5));
        if (!out.loads_s && text("buckles") !== "…") out.loads_s = (performance.now() - began) / 1e3;
        if (!out.state_s && text("now") !== "…") out.state_s = (performance.now() - began) / 1e3;
        const drawn = !document.body.classList.contains("updating");
        if (!out.first_branch_s && drawn) out.first_branch_s = (performance.now() - began) / 1e3;
        if (out.first_branch_s && out.loads_s && rw.ready) break;
    }
    out.whole_diagram_s = (performance.now() - began) / 1e3;
    return out;
}"""

MOVE = """(slider, part) => {
    slider.value = Number(slider.min) + part * (slider.max - slider.min);
    for (const kind of ["input", "change"]) slider.dispatchEvent(new Event(kind));
}"""


class Explorer:
    """The command and its page."""

    def __init__(self, play: Any) -> None:
        path = next(filter(None, map(shutil.which, ("chromium", "google-chrome"))))
        self.browser = play.chromium.launch(executable_path=path, args=FLAGS)
        self.page = self.browser.new_page(viewport={"width": 1440, "height": 900})
        self.bytes = 0
        self.page.on("response", self._count)
        self.began = time.perf_counter()
        command = [sys.executable, "-m", "rodwell", "explore", str(CASE), "--no-browser"]
        self.server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
        assert self.server.stdout is not None
        found = re.search(r"http\S+", self.server.stdout.readline())
        assert found is not None
        self.page.goto(found[0])
        self.until("document.querySelector('#diagram path') && document.getElementById('buckles').textContent !== '…'")
        self.first = time.perf_counter() - self.began
        self.until("window.__rodwell.ready")

    def _count(self, response: Any) -> None:
        self.bytes += len(response.body()) if response.url.startswith("http") else 0

    def until(self, script: str, limit: float = 120.0) -> None:
        end = time.perf_counter() + limit
        while not self.page.evaluate(f"Boolean({script})"):
            if time.perf_counter() > end:
                raise TimeoutError(script)
            time.sleep(0.02)

    def tree(self) -> list[int]:
        """Processes of the server."""
        listed = subprocess.run(["ps", "-eo", "pid=,sid="], capture_output=True, text=True, check=True).stdout
        return [int(pid) for pid, sid in map(str.split, listed.splitlines()) if int(sid) == self.server.pid]

    def memory(self) -> dict[str, float]:
        """Megabytes of the page's heap and of the server's processes."""
        heap = self.page.evaluate("(window.gc && gc(), performance.memory.usedJSHeapSize)")
        resident = sum(_resident(pid) for pid in self.tree())
        return {"page": heap / 1e6, "server": resident / 1e3}

    def end(self, how: int) -> list[int]:
        """End the command; the processes that are left two seconds later."""
        pids = self.tree()
        os.kill(self.server.pid, how)
        with contextlib.suppress(subprocess.TimeoutExpired):  # then it is among those that are left
            self.server.wait(20)
        time.sleep(2.0)
        return [pid for pid in pids if Path(f"/proc/{pid}").exists()]


def _resident(pid: int) -> int:
    text = Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    found = re.search(r"VmRSS:\s+(\d+) kB", text)
    return int(found[1]) if found else 0


def speeds(play: Any) -> dict[str, Any]:
    """The figures that an idle machine is asked for."""
    one = Explorer(play)
    out: dict[str, Any] = {"first_diagram_s": one.first, "first_page_kB": one.bytes / 1e3}
    one.page.evaluate(DRAG, LOAD | {"seconds": 3.0})  # in the first frames the browser makes its shaders
    one.until("window.__rodwell.ready")
    out["drag"] = one.page.evaluate(DRAG, LOAD | {"seconds": 5.0})
    one.until("window.__rodwell.ready")
    out["drag_an_input"] = one.page.evaluate(DRAG, INPUT | {"seconds": 5.0})
    one.until("window.__rodwell.ready")
    out["turn"] = one.page.evaluate(TURN, 3.0)
    out["one_per_cent"] = one.page.evaluate(STEP)
    out["cancel"] = one.page.evaluate(CANCEL, "rod.length")
    out["left_after_ctrl_c"] = len(one.end(signal.SIGINT))
    one.browser.close()
    return out


def soak(play: Any, minutes: float) -> dict[str, Any]:
    """Random moves of load and inputs, and the memory before and after."""
    one = Explorer(play)
    chance = random.Random(24)
    sliders = one.page.locator("#load-control input[type=range], #controls input[type=range]")
    many = sliders.count()

    def move() -> None:
        which = 0 if chance.random() < 0.8 else chance.randrange(1, many)
        part = chance.random() if which == 0 else chance.uniform(0.3, 0.5)
        sliders.nth(which).evaluate(MOVE, part)

    end, count, begun = time.perf_counter() + 60.0 * minutes, 0, None
    while time.perf_counter() < end:
        move()
        count += 1
        time.sleep(0.1)
        if begun is None and count == 300:
            begun = begun or one.memory()
    last = one.memory()
    begun = begun or last
    grown = {f"{name}_MB": last[name] - begun[name] for name in last}
    out = {"minutes": minutes, "moves": count, "first_MB": begun, "grown": grown}
    out["left_after_hang_up"] = len(one.end(signal.SIGHUP))
    one.browser.close()
    return out


def main() -> None:
    """Measure, print, and add to the results."""
    parser = argparse.ArgumentParser(description=__doc__)
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
    text = json.dumps(known, indent=2, default=float)
    print(text)
    RESULTS.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

"""What benchmarks/explore.py runs in the page: scripts that move something and return how long it took."""

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
CANCEL = """async (name) => {
    const address = new URL("talk", location.href);
    address.protocol = "ws:";
    address.hash = "";
    const socket = new WebSocket(address), value = Number(document.querySelector("#controls input[type=number]").value);
    const ended = new Map(); // number of a request → its last message, and who waits for that
    const last = (id) => {
        if (!ended.has(id)) { const it = {}; it.is = new Promise((done) => { it.done = done; }); ended.set(id, it); }
        return ended.get(id);
    };
    socket.onmessage = (event) => {
        const message = JSON.parse(event.data);
        if (message.last) last(message.id).done({ kind: message.kind, at: performance.now() });
    };
    await new Promise((done, fail) => { socket.onopen = done; socket.onclose = () => fail(new Error("refused")); });
    const ask = (id) => {
        const inputs = { [name]: value * (1 + 0.003 * id) };
        socket.send(JSON.stringify({ kind: "diagram", id, inputs }));
    };
    const out = [];
    for (let k = 0; k < 20; k++) {
        ask(2 * k + 1);
        await new Promise((done) => setTimeout(done, 60 + 20 * k));
        const began = performance.now();
        ask(2 * k + 2);
        const { kind, at } = await last(2 * k + 1).is; // it may have been answered before
        if (kind === "cancelled" && at >= began) out.push(at - began);
        if (k % 5 === 4) await last(2 * k + 2).is; // else it is ended by the next
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

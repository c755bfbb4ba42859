// The page: what is shown follows from one state, which stands in the address; numbers come from the server only.
import * as address from "./address.js";
import { Control } from "./controls.js";
import { Curves } from "./curves.js";
import { Diagram, has, within } from "./diagram.js";
import { Inputs } from "./inputs.js";
import { keys } from "./keys.js";
import { Link } from "./link.js";
import { Player } from "./play.js";
import { showBar, showDetails, showLoads, showState } from "./panel.js";
import { Scene } from "./scene.js";
import { Snaps } from "./snap.js";
import { blank, clear, noNumbers } from "./stale.js";
import { Taking } from "./take.js";

const $ = (id) => document.getElementById(id);
const hooks = (window.__rodwell = { ready: false, state: null, updates: 0, values: null, times: [], drawn: () => 0, widest: () => 0 });

let hello = null; // what the server says of the case
let state = null; // inputs, load, branch …: what is asked for
let diagram = null, diagramOf = ""; // the diagram shown, and for which inputs it holds
let shown = null, shownOf = ""; // the state shown, and the diagram it is of: none where it was followed to new inputs
let origin = null; // what was asked for to get it: from there it is followed
let lost = ""; // why it was not, until another one is shown
const sent = new Map(); // when which load was asked for, by number of request
let askedOf = ""; // of which branch
let load = null; // its control
let settle = 0;
let unread = ""; // what is wrong with the address; it stands until something is moved

const figure = new Diagram($("diagram"), (to) => go(chosen(to), true));
const curves = new Curves({ push: $("push"), side: $("side") }, (fraction, text) => {
  $("cursor").textContent = text || "Point at a curve to read it.";
  scene.mark(fraction);
});
const scene = new Scene($("rod"), { state: () => state, shown: () => shown, begun: (rod) => { hooks.drawn = rod.drawn; hooks.widest = rod.vertices; } });
const inputs = new Inputs({ state: () => state, hello: () => hello, go, say });
const link = new Link(heard, (isLost) => {
  $("banner").hidden = !isLost;
  $("banner").textContent = isLost ? "The server is gone: nothing can be computed until it is back. Trying again …" : "";
  if (isLost) hooks.ready = false;
});

function heard(message) {
  if (message.kind === "hello") begin(message);
  else if (message.kind === "progress") $("busy").textContent = `computing: ${message.what} …`;
  else if (message.kind === "diagram" || message.kind === "path") haveDiagram(message);
  else if (message.kind === "state" || message.kind === "followed") haveState(message);
  else if (message.kind === "verdict" && shown !== null && !shown.beyond) $("verdict").textContent = message.text;
  else if (message.kind === "details") showDetails(message.details);
  else if (message.kind === "lost") lose(message);
  else if (message.kind === "snap") snaps.play(message.scenes);
  else if (message.kind === "copy") taking.haveCopy(message);
  else if (message.kind === "file") taking.haveFile(message);
  else if (message.kind === "failed") failed(message);
}

function begin(message) {
  const again = hello !== null && hello.title === message.title;
  hello = message;
  $("title").textContent = hello.title;
  document.title = `${hello.title} · rodwell explore`;
  if (!again) {
    inputs.begin(hello);
    load = load || new Control($("load-control"), { name: "load", label: "load", hint: "", unit: "", low: 0, high: 1 }, (value, done) => go({ load: value, special: null }, done));
  }
  pending = "";
  fromAddress();
}

function fromAddress() {
  try {
    state = address.read(location.hash, hello);
    if (diagram && !diagram.ordinates.some((each) => each.name === state.y)) state.y = "";
    unread = "";
  } catch (error) {
    state = address.begun(hello);
    history.replaceState(null, "", location.pathname);
    unread = `The address could not be read: ${error.message}. The page begins with what it begins with.`;
  }
  say(unread);
  show();
}

// Go to another state: done says that it is one to come back to.
function go(changes, done) {
  unread = "";
  state = { ...state, ...changes };
  if ("load" in changes && load) load.set(state.load, { field: done });
  show("inputs" in changes && !done);
  if (!done) return;
  clearTimeout(settle);
  const hash = address.written(state, hello);
  if (hash !== location.hash) history.pushState(null, "", hash);
}

function chosen({ branch, load: at, which, special }) {
  const to = at === null ? within(diagram, branch, state.load) : at;
  return { branch, which: which || 0, special: special ?? null, load: to };
}

function wanted() {
  return { inputs: address.moved(state.inputs, hello), until: state.until, path: withPath };
}

function show(dragged = false) {
  const wants = wanted(), of = JSON.stringify([wants.inputs, state.until]);
  const fits = shown !== null && origin.load === state.load && (dragged || holds());
  inputs.show(state.inputs, { field: !(dragged && fits) });
  $("branch").value = state.branch;
  $("beyond").setAttribute("aria-pressed", String(state.path !== ""));
  hooks.state = state;
  if (of !== diagramOf || (withPath && !state.path)) {
    const underWay = of === pending && diagramOf === "";
    stale(fits);
    const off = state.path && origin?.beyond; // known where the load path is
    if (state.path && !off) $("busy").textContent = "updating: a rod off the wall is shown once its new load path has been followed …";
    if (underWay) return;
    link.drop("state", "verdict", "details", "path", ...(dragged ? [] : ["diagram", "follow"]));
    const content = (path) => ({ ...wanted(), path, load: state.load, from: origin, known: scene.known });
    const both = () => { link.ask("diagram", { ...wanted(), path: false }); return content(true); };
    sent.set(off ? link.ask("follow", both, dragged) : link.ask("diagram", () => content(false), dragged), performance.now());
    pending = of;
  } else {
    if (state.load === null) state.load = diagram.suggested; // what an address leaves out
    state.y ||= diagram.ordinate;
    askState();
    if (state.path && !withPath && !link.newest.path) askPath();
  }
}

// The rod off the wall: computed beside, while states on the wall are shown.
function askPath() {
  $("busy").textContent = "beyond lift-off …";
  hooks.ready = false;
  link.ask("path", { ...wanted(), path: true });
}
let pending = "";
let withPath = false; // whether the diagram shown has the load path

// Pictures turn pale, numbers go; those of a state stay while it is the one for the inputs displayed.
function stale(fits) {
  clear();
  snaps.stop();
  hooks.ready = false;
  diagramOf = "";
  withPath = false;
  figure.fade();
  figure.point(null);
  shownOf = "";
  if (!fits) leave();
}

// The state that was shown belongs to other inputs.
function leave() {
  blank();
  hooks.values = null;
  shown = null;
  curves.data = null;
  if (lost) $("verdict").textContent = lost;
}

function lose({ why }) {
  if (origin === null) return; // that has been said
  origin = null;
  lost = `The state shown was not followed to these inputs: ${why}. The new load path is computed.`;
  leave();
}

function followed() { return shown !== null && origin.beyond && origin.load === state.load && holds(); }
function holds() { return shown !== null && JSON.stringify(origin.inputs) === JSON.stringify(wanted().inputs); }

function haveDiagram({ diagram: data, whole, of }) {
  diagram = data;
  if (of === "path") { withPath = true; link.newest.path = null; } else diagramOf = pending;
  document.body.classList.remove("updating");
  $("busy").textContent = whole ? "" : "more is computed …";
  if (!state.y || !data.ordinates.some((each) => each.name === state.y)) state.y = data.ordinate;
  if (state.load === null) {
    state.load = data.suggested;
    history.replaceState(null, "", address.written(state, hello));
  }
  load.range(data.range[0], data.range[1]);
  load.unit.textContent = data.axis.unit;
  document.querySelector("#load-control label").textContent = data.axis.label;
  showLoads(data, state);
  inputs.read(state.inputs);
  if (!holds()) leave();
  inputs.sections.tell(data.sections);
  const fits = shown !== null && shownOf === diagramOf;
  figure.show(data, state.y, fits ? shown : null);
  if (whole || !fits) askState();
  if (whole && state.path && !withPath) askPath();
}

function askState() {
  if (state.load === null || (state.path && !withPath && (lost || link.under("follow") || followed() || !has(diagram, state.branch)))) return; // the load path comes later
  const last = diagram.range[1];
  if (state.load > last * (1 + 1e-12) + 1e-300 && state.until === null && !state.branch) { // beyond what was followed: once, farther
    state.until = Number((1.05 * state.load).toPrecision(4));
    show();
    return;
  }
  const of = JSON.stringify({ ...request(), load: null });
  if (of !== askedOf) link.drop("state"); // states on the way to a load are those of its branch and inputs
  askedOf = of;
  sent.set(link.ask("state", { ...request(), known: scene.known }), performance.now());
}

// A state of a branch, or one that was followed to other inputs before these have branches.
function haveState({ kind, state: found, id, passing, inputs: of }) {
  const moved = kind === "followed";
  if (!moved && snaps.holds(found, shown)) return; // shown once the rod has gone over
  passing ??= id !== undefined && id !== link.newest.state; // the slider is farther already
  [shown, shownOf, lost] = [found, moved ? "" : diagramOf, ""];
  origin = { inputs: moved ? of : wanted().inputs, until: moved ? null : state.until, load: found.asked, branch: found.branch, which: found.which, beyond: found.beyond };
  document.body.classList.remove("blank");
  inputs.readMoved(origin.inputs);
  if (!passing && !load.slider.matches(":active")) load.set(state.load);
  load.write(passing ? found.load : state.load);
  if (!moved) figure.point(found);
  curves.show(found.curves);
  scene.show(found);
  showBar(found.bar);
  showState(found);
  say(unread || (found.note && state.branch && found.branch !== state.branch ? found.note : ""));
  hooks.values = Object.fromEntries(Object.entries(found.values).map(([name, each]) => [name, each.value]));
  hooks.values.load = found.load;
  hooks.values.index = found.index;
  hooks.updates += 1;
  hooks.ready = $("busy").textContent === "" && !passing && !moved;
  const began = sent.get(id) ?? performance.now();
  for (const each of sent.keys()) if (each <= id) sent.delete(each);
  requestAnimationFrame(() => { hooks.times.push(performance.now() - began); if (hooks.times.length > 500) hooks.times.shift(); });
  clearTimeout(settle);
  if (!passing && !moved) settle = setTimeout(settled, 120);
}

// The load stands still: what takes longer is asked for, and the address follows.
function settled() {
  if (shown === null || shownOf === "") return;
  // at a special point the line that says which one stays; verdicts are those of a rod on the wall
  if (state.special === null && !shown.beyond) link.ask("verdict", request());
  link.ask("details", request());
  if (scene.viewer === false) taking.picture();
  if (!load.slider.matches(":active") && !player.since) history.replaceState(null, "", address.written(state, hello));
}

function request() { return { ...wanted(), load: state.load, branch: state.branch, which: state.which, special: state.special }; }
const taking = new Taking({ shown: () => (shownOf === "" ? null : shown), state: () => state, hello: () => hello, request, values: () => hooks.values, ask: (kind, content) => link.ask(kind, content), svg: () => figure.at.svg, rod: () => scene.viewer });

function failed(message) {
  if (message.of === "follow") return lose({ why: message.message });
  $("busy").textContent = "";
  say(message.message);
  if (message.of === "path") link.newest.path = null;
  if (message.of === "snap") return snaps.end();
  if (message.of === "diagram") pending = "";
  if (message.of === "state" || message.of === "diagram") {
    shown = null;
    hooks.values = null;
    figure.point(null);
    inputs.read(state.inputs);
    noNumbers();
  }
  hooks.ready = true;
  hooks.updates += 1;
}

// The rod snaps while the load moves: no number of a shape in between.
const snaps = new Snaps($("snapping"), {
  diagram: () => diagram, rod: () => scene.viewer, ask: (at) => link.ask("snap", { ...wanted(), ...at }),
  blank: () => { hooks.ready = false; hooks.values = null; figure.point(null); noNumbers(); clearTimeout(settle); },
  show: (found) => { shown = null; haveState({ state: found }); },
});

function say(text) { Object.assign($("message"), { textContent: text, hidden: !text }); }

const player = new Player($("play"), { state: () => state, diagram: () => diagram, go, held: () => Boolean(snaps.pending) });
const play = (on) => player.play(on);
$("to-lift-off").onclick = () => {
  const b = diagram?.branches[0], k = b ? b.special.findIndex((p) => p.kind === "lift_off") : -1;
  if (k >= 0) go({ branch: b.name, which: 0, special: k, load: b.special[k].load }, true);
  else if (diagram?.lifts_off) go({ branch: "", which: 0, special: null, load: diagram.lifts_off.load }, true);
};
const beyond = () => go(state.path ? { path: "", branch: "", which: 0, special: null } : { path: "followed", branch: "", which: 0, special: null }, true);
$("beyond").onclick = beyond;
$("branch").onchange = () => go(chosen({ branch: $("branch").value, load: null }), true);
$("ordinate").onchange = () => { go({ y: $("ordinate").value }, true); if (diagramOf) figure.show(diagram, state.y, shown); };
$("true-scale").addEventListener("change", () => go({ scale: $("true-scale").checked ? "true" : "" }, true));
$("reset").onclick = () => go({ ...address.begun(hello), y: state.y }, true);
addEventListener("popstate", () => {
  if (!hello) return;
  play(false);
  fromAddress();
  scene.scale();
  if (diagram && diagramOf && state.y) { $("ordinate").value = state.y; $("branch").value = state.branch; figure.show(diagram, state.y, shown); }
});
keys({ state: () => state, diagram: () => diagram, shown: () => shown, go, chosen, play: () => play(!player.since), beyond, step: (part) => go({ load: load.stepped(part, state.load), special: null }, true) });

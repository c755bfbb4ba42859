// The bifurcation diagram: each branch a line that can be focused and clicked, special points, the state shown.
import { around, element, frame } from "./draw.js";

export class Diagram {
  constructor(box, chosen) {
    this.box = box;
    this.chosen = chosen; // ({branch, load, which, special}) => void
    new ResizeObserver(() => this.draw()).observe(box);
  }

  show(data, ordinate, state) {
    this.data = data;
    this.ordinate = ordinate;
    this.state = state;
    this.pale = false;
    this.draw();
  }

  // Other inputs are computed: lines stay, what can be read of them goes, however often they are drawn again.
  fade() {
    this.pale = true;
    this.box.querySelectorAll("text, title").forEach((each) => each.remove());
    this.box.querySelectorAll(".special, .hit").forEach((each) => { each.removeAttribute("tabindex"); each.setAttribute("aria-label", "updating"); });
  }

  point(state) {
    this.state = state;
    if (!this.dot) return;
    this.dot.toggleAttribute("hidden", !state);
    if (!state) return;
    this.dot.setAttribute("cx", this.at.px(state.load));
    this.dot.setAttribute("cy", this.at.py(state.y[this.ordinate]));
    this.groups.forEach((group, name) => group.classList.toggle("chosen", name === state.branch));
  }

  draw() {
    if (!this.data || !this.box.clientWidth) return;
    const { data, ordinate } = this, named = data.ordinates.find((each) => each.name === ordinate);
    const branches = data.branches.filter((b) => b.y[ordinate]); // a rod off the wall does not have every number
    const heights = branches.flatMap((b) => [...b.y[ordinate], ...b.images.flatMap((image) => image[ordinate])]);
    const x = { low: data.range[0], high: data.range[1], label: `${data.axis.label}  [${data.axis.unit}]` };
    const span = x.high - x.low;
    x.low -= 0.02 * span;
    x.high += 0.02 * span;
    const y = { ...around([...heights, 0]), label: named.unit ? `${named.label}  [${named.unit}]` : named.label };
    const at = (this.at = frame([this.box.clientWidth || 600, this.box.clientHeight || 336], { x, y, label: "Bifurcation diagram" }));
    const focused = this.box.contains(document.activeElement) ? document.activeElement.getAttribute("data-key") : null;
    this.groups = new Map();
    const line = (points, kind) => element("path", { class: `seg ${kind}`, d: "M" + points.map((p) => p.map((v) => v.toFixed(2)).join(",")).join("L") });

    if (data.straight) { // none lies in a hole out of the vertical plane
      const rest = ordinate === "largest_pressure" ? data.branches[0].y[ordinate][0] : 0;
      const straight = element("g", { class: "m0" });
      const edge = Math.min(Math.max(data.straight.buckles, x.low), x.high);
      straight.append(line([[at.px(x.low), at.py(rest)], [at.px(edge), at.py(rest)]], "stable"));
      straight.append(line([[at.px(edge), at.py(rest)], [at.px(x.high), at.py(rest)]], "unstable"));
      this.branch(straight, "straight", "straight rod, stable until it buckles", [[x.low, rest], [edge, rest], [x.high, rest]], at);
    }

    branches.forEach((b) => {
      const group = element("g", { class: b.breaks ? "beyond" : `m${Math.min(b.mode || 6, 6)}` });
      for (const image of b.images) {
        const mirrored = element("g", { class: "image", "aria-hidden": "true" });
        pieces(b).forEach(([kind, from, to]) => mirrored.append(line(range(from, to).map((k) => [at.px(b.load[k]), at.py(image[ordinate][k])]), kind)));
        group.append(mirrored);
      }
      pieces(b).forEach(([kind, from, to]) => group.append(line(range(from, to).map((k) => [at.px(b.load[k]), at.py(b.y[ordinate][k])]), kind)));
      this.branch(group, b.name, told(b, data.branches.indexOf(b), data), b.load.map((load, k) => [load, b.y[ordinate][k]]), at);
    });
    branches.forEach((b) => b.special.forEach((p, k) => {
      if (p.kind === "end") return;
      const size = p.kind === "lift_off" ? 5.5 : 4.5, cx = at.px(p.load), cy = at.py(p.y[ordinate]);
      const where = { class: `special ${p.kind} ${b.breaks ? "beyond" : `m${Math.min(b.mode || 6, 6)}`}`, tabindex: "0", role: "button", "data-key": `${b.name}/${k}`, "aria-label": `${p.label} of ${b.name} at ${p.text}, index ${p.index_before === null ? "" : `${p.index_before} to `}${p.index_after}` };
      const shape = ["critical", "fold", "snap"].includes(p.kind) ? element("rect", { x: cx - size, y: cy - size, width: 2 * size, height: 2 * size, ...where }) : element("circle", { cx, cy, r: size, ...where });
      shape.append(element("title", {}, `${p.label}: ${p.text}`));
      this.active(shape, () => this.chosen({ branch: b.name, load: p.load, which: 0, special: k }));
      at.svg.append(shape);
    }));
    this.dot = element("circle", { class: "shown", r: 7 });
    at.svg.append(this.dot);
    clipped(at, [...this.groups.values()]);
    this.box.replaceChildren(at.svg);
    if (this.pale) this.fade();
    this.point(this.state);
    if (focused) this.box.querySelector(`[data-key="${focused}"]`)?.focus();
  }

  // The line that takes clicks and focus, above those that are seen.
  branch(group, name, label, points, at) {
    const d = "M" + points.map(([a, b]) => `${at.px(a).toFixed(2)},${at.py(b).toFixed(2)}`).join("L");
    const hit = element("path", { class: "hit", d, tabindex: "0", role: "button", "aria-label": label, "data-key": name, "data-branch": name });
    this.active(hit, (event) => {
      if (!event || event.clientX === undefined || event.type === "keydown") { this.chosen({ branch: name, load: null, which: 0, special: null }); return; }
      const box = at.svg.getBoundingClientRect(), px = event.clientX - box.left, py = event.clientY - box.top;
      const { load, before } = nearest(points, px, py, at);
      this.chosen({ branch: name, load, which: crossings(points.map((p) => p[0]), before, load), special: null });
    });
    group.append(hit);
    at.svg.append(group);
    this.groups.set(name, group);
  }

  active(item, act) {
    item.addEventListener("click", act);
    item.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      act(event);
    });
  }
}

// Whether states of a branch can be asked for: legs of the load path are there later than the others.
export const has = (data, name) => !name || name === "straight" || data.branches.some((each) => each.name === name);

// A load at which a branch has states: the one given if it does, else in its middle.
export function within(data, name, at) {
  const b = data?.branches.find((each) => each.name === name);
  if (!b) return at;
  const low = Math.min(...b.load), high = Math.max(...b.load);
  return at >= low && at <= high ? at : Number((0.5 * (low + high)).toPrecision(5));
}

function range(from, to) { return Array.from({ length: to - from + 1 }, (_, i) => from + i); }

// Lines end at the frame: a branch may go on where the diagram does not.
function clipped(at, groups) {
  const clip = element("clipPath", { id: "within-the-frame" });
  clip.append(element("rect", { x: at.left, y: at.top, width: at.right - at.left, height: at.bottom - at.top }));
  at.svg.append(clip);
  groups.forEach((group) => group.setAttribute("clip-path", "url(#within-the-frame)"));
}

// Stretches of a branch of one look: [kind, from, to].
function pieces(b) {
  const kind = (k) => `${b.index[k] > 0 ? "unstable" : "stable"}${b.off[k] ? " off" : ""}`;
  const out = [];
  let from = 0;
  for (let k = 1; k < b.load.length; k++) {
    if (b.breaks?.includes(k)) { // a snap leads here
      if (k - 1 > from) out.push([kind(from), from, k - 1]);
      from = k;
      continue;
    }
    if (k === b.load.length - 1 || kind(k) !== kind(from)) { out.push([kind(from), from, k]); from = k; }
  }
  return out;
}

function told(b, i, data) {
  const lift = b.special.find((p) => p.kind === "lift_off");
  const unstable = b.index.some((each) => each > 0) ? (b.index.every((each) => each > 0) ? "unstable" : "partly unstable") : "stable";
  const end = (k) => `${Number(b.load[k].toPrecision(4))} ${data.axis.unit}`;
  return `branch ${i + 1}, ${b.name}: from ${end(0)} to ${end(b.load.length - 1)}, ${unstable}${lift ? `, lifts off at ${lift.text}` : ""}`;
}

// How many times the line passes a load before a vertex.
export function crossings(loads, before, load) {
  let out = 0;
  for (let k = 0; k + 1 < Math.min(before, loads.length); k++) if ((loads[k] - load) * (loads[k + 1] - load) < 0) out++;
  return out;
}

function nearest(points, px, py, at) {
  let best = { load: points[0][0], before: 0 }, least = Infinity;
  for (let k = 0; k + 1 < points.length; k++) {
    const [ax, ay] = [at.px(points[k][0]), at.py(points[k][1])], [bx, by] = [at.px(points[k + 1][0]), at.py(points[k + 1][1])];
    const length = (bx - ax) ** 2 + (by - ay) ** 2 || 1;
    const t = Math.min(Math.max(((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length, 0), 1);
    const far = (ax + t * (bx - ax) - px) ** 2 + (ay + t * (by - ay) - py) ** 2;
    if (far < least) { least = far; best = { load: points[k][0] + t * (points[k + 1][0] - points[k][0]), before: k + 1 }; }
  }
  return best;
}

// Push on the wall and place around it along the rod, with one cursor for both.
import { around, element, frame, quarters, short } from "./draw.js";

export class Curves {
  constructor(boxes, told) {
    this.boxes = boxes; // {push, side}
    this.told = told; // (fraction or null, text) => void
    this.place = null;
    this.frames = {}; // of each box: what stays from state to state
    this.sizes = {}; // of the boxes: asked for while other things change, the browser would lay out the page each time
    for (const [name, box] of Object.entries(boxes)) {
      new ResizeObserver(() => { this.sizes[name] = [box.clientWidth, box.clientHeight]; this.draw(name); }).observe(box);
      box.addEventListener("pointermove", (event) => this.point(name, event.clientX));
      box.addEventListener("keydown", (event) => {
        const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (!step || !this.data) return;
        event.preventDefault();
        event.stopPropagation();
        this.at(Math.min(Math.max((this.place ?? 100) + step * (event.shiftKey ? 20 : 2), 0), this.data.s.values.length - 1));
      });
    }
  }

  show(data) {
    this.data = data;
    Object.keys(this.boxes).forEach((name) => this.draw(name));
    this.at(this.place);
  }

  draw(name) {
    const box = this.boxes[name], data = this.data;
    if (!data) { box.querySelectorAll("text").forEach((text) => text.remove()); return; }
    const size = this.sizes[name];
    if (!size?.[0]) return;
    const s = data.s.values, v = data[name].values;
    const x = { low: s[0], high: s[s.length - 1], label: `${data.s.label}  [${data.s.unit}]` };
    const y = { ...quarters(around([...v, 0]), size[1]), label: `${data[name].label}  [${data[name].unit}]` };
    const key = JSON.stringify([size, x, y]), kept = this.frames[name];
    const at = kept?.key === key && box.querySelector("text") ? kept : this.begin(name, key, frame(size, { x, y, label: data[name].label }));
    const points = s.map((each, k) => `${at.px(each).toFixed(1)},${at.py(v[k]).toFixed(1)}`).join("L");
    at.fill.setAttribute("d", `M${at.px(s[0])},${at.py(0)}L${points}L${at.px(x.high)},${at.py(0)}Z`);
    at.curve.setAttribute("d", "M" + points);
    this.mark(name);
  }

  // A frame with nothing in it yet.
  begin(name, key, at) {
    Object.assign(at, { key, fill: element("path", { class: "fill" }), curve: element("path", { class: "curve" }) });
    at.line = element("line", { class: "at", y1: at.top, y2: at.bottom, visibility: "hidden" });
    at.dot = element("circle", { class: "at", r: 3.5, visibility: "hidden" });
    at.svg.append(at.fill, at.curve, at.line, at.dot);
    this.boxes[name].replaceChildren(at.svg);
    this.frames[name] = at;
    return at;
  }

  point(name, clientX) {
    const at = this.frames[name];
    if (!at || !this.data) return;
    const s = this.data.s.values, end = s[s.length - 1];
    const along = at.back(clientX - at.svg.getBoundingClientRect().left) / end;
    this.at(Math.round(Math.min(Math.max(along, 0), 1) * (s.length - 1)));
  }

  at(place) {
    this.place = place;
    Object.keys(this.boxes).forEach((name) => this.mark(name));
    if (place === null || !this.data) { this.told(null, ""); return; }
    const { s, push, side, gap } = this.data;
    const say = (each) => `${short(each.values[place])} ${each.unit}`.replace(" °", "°");
    this.told(place / (s.values.length - 1), `s = ${say(s)}: push ${say(push)}, angle ${say(side)}${gap ? `, gap ${say(gap)}` : ""}`);
  }

  mark(name) {
    const at = this.frames[name];
    if (!at || this.place === null || !this.data) return;
    const x = at.px(this.data.s.values[this.place]), y = at.py(this.data[name].values[this.place]);
    for (const [key, value] of [["x1", x], ["x2", x], ["visibility", "visible"]]) at.line.setAttribute(key, value);
    for (const [key, value] of [["cx", x], ["cy", y], ["visibility", "visible"]]) at.dot.setAttribute(key, value);
  }
}

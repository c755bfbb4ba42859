// Small helpers for drawing with SVG: elements, scales, ticks.

const SVG = "http://www.w3.org/2000/svg";

export function element(name, attributes = {}, text = "") {
  const out = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) out.setAttribute(key, value);
  if (text) out.textContent = text;
  return out;
}

function stepOf(low, high, count) {
  const rough = (high - low) / count || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 2.5, 5, 10].map((f) => f * power).find((f) => f >= rough * 0.999);
}

export function ticks(low, high, step) {
  const out = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) out.push(i * step);
  return out;
}

export function short(value, digits = 4) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-3 ? value.toExponential(digits - 2).replace(/\.?0+e/, "e").replace(/e\+?(-?\d+)/, "×10^$1") : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, "−");
}

const top = 22, bottom = 34; // of a frame: what is left for its words
const upwards = ({ low, high }, tall) => stepOf(low, high, Math.max((tall - top - bottom) / 42, 3));

// A frame with ticks and labels: returns the functions from data to pixels, and the svg.
export function frame([width, tall], { x, y, label }) {
  const left = 62, right = 12;
  const svg = element("svg", { viewBox: `0 0 ${width} ${tall}`, role: "group", "aria-label": label });
  const px = (v) => left + ((v - x.low) / (x.high - x.low || 1)) * (width - left - right);
  const py = (v) => tall - bottom - ((v - y.low) / (y.high - y.low || 1)) * (tall - top - bottom);
  for (const v of ticks(x.low, x.high, stepOf(x.low, x.high, Math.max(width / 110, 2)))) {
    svg.append(element("line", { class: "grid", x1: px(v), x2: px(v), y1: top, y2: tall - bottom }));
    svg.append(element("text", { x: px(v), y: tall - bottom + 15, "text-anchor": "middle" }, short(v)));
  }
  for (const v of ticks(y.low, y.high, y.step || upwards(y, tall))) {
    svg.append(element("line", { class: "grid", x1: left, x2: width - right, y1: py(v), y2: py(v) }));
    svg.append(element("text", { x: left - 6, y: py(v) + 4, "text-anchor": "end" }, short(v)));
  }
  svg.append(element("rect", { class: "frame", x: left, y: top, width: width - left - right, height: tall - top - bottom }));
  svg.append(element("text", { class: "named", x: left, y: 14 }, y.label));
  svg.append(element("text", { class: "named", x: width - right, y: tall - 5, "text-anchor": "end" }, x.label));
  const back = (p) => x.low + ((p - left) / (width - left - right)) * (x.high - x.low);
  return { svg, px, py, back, left, right: width - right, top, bottom: tall - bottom, width };
}

// Writes only what differs: the browser lays out and paints again whatever is written.
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function around(values, part = 0.06) {
  let low = Math.min(...values), high = Math.max(...values);
  if (!(high > low)) { low -= Math.abs(low) || 1; high += Math.abs(high) || 1; }
  const more = part * (high - low);
  return { low: low - more, high: high + more };
}

// The same up to whole quarters of the steps between ticks: axes stay while what is drawn moves a little.
export function quarters({ low, high }, tall) {
  const step = upwards({ low, high }, tall), part = step / 4;
  return { low: Math.floor(low / part) * part, high: Math.ceil(high / part) * part, step };
}

// The state shown in numbers, what can be copied and saved.
import { write } from "./draw.js";

const $ = (id) => document.getElementById(id);

export function showNumbers(state) {
  const rows = state === null ? [] : Object.entries(state.values).map(([name, each]) => [name, each.label + (each.s === null || each.s === undefined ? "" : ` (s/L = ${each.s.toFixed(4)})`), each.text, each.error_text || "given"]);
  if (state === null) {
    document.querySelectorAll("#values tbody td").forEach((cell) => { cell.textContent = "…"; });
    document.querySelectorAll("#values tbody th").forEach((cell) => { cell.textContent = cell.textContent.split(" (s/L")[0]; });
    $("certificate").textContent = "";
    return;
  }
  const body = $("values").tBodies[0];
  if (body.rows.length !== rows.length) {
    body.replaceChildren(...rows.map(() => {
      const row = document.createElement("tr");
      row.innerHTML = '<th scope="row"></th><td></td><td></td>';
      return row;
    }));
  }
  rows.forEach(([name, label, text, error], i) => {
    body.rows[i].dataset.name = name;
    [label, text, error === "given" ? error : `± ${error}`].forEach((each, k) => write(body.rows[i].cells[k], each));
  });
}

// A state in words and numbers.
export function showState(found) {
  showNumbers(found);
  write($("certificate"), ""); // of the state before
  $("now").textContent = `${found.values.force.text}: ${found.branch}, ${found.stable ? "stable" : `unstable (index ${found.index})`}`;
  $("headline").textContent = `${found.headline[0].toUpperCase()}${found.headline.slice(1)}. ${found.note}${found.accurate ? "" : " Not every number meets the tolerance."}`;
  $("verdict").textContent = $("headline").textContent;
}

// What stands in the head and in the lists of a diagram.
export function showLoads(data, state) {
  $("ordinate").replaceChildren(...data.ordinates.map((each) => new Option(each.label, each.name)));
  $("ordinate").value = state.y;
  $("branch").replaceChildren(new Option(data.straight ? "first, else straight" : "that of the load", ""), ...(data.straight ? [new Option("straight", "straight")] : []), ...data.branches.map((each) => new Option(each.name, each.name)));
  $("branch").value = state.branch;
  $("buckles").textContent = data.buckles.text;
  $("lifts-off").textContent = data.lifts_off ? data.lifts_off.text : "not reached";
  $("snaps").textContent = data.snaps_at.text || (state.path ? "…" : "not followed");
  $("to-lift-off").disabled = !data.lifts_off;
  $("convention").textContent = `${data.convention}.${data.unexplored.length ? ` Not explored: ${data.unexplored.join("; ")}.` : ""}`;
}

let gradient = ""; // of the bar of colours

export function showBar(bar) {
  write($("bar-first"), bar.first);
  write($("bar-last"), `${bar.last} ${bar.unit}`);
  if (bar.gradient === gradient) return;
  gradient = bar.gradient;
  const stops = [...bar.gradient.matchAll(/(#[0-9a-f]{6}) ([\d.]+)%/g)];
  $("bar-gradient").innerHTML = stops.map(([, colour, where]) => `<stop offset="${where}%" stop-color="${colour}"></stop>`).join("");
}

export function showDetails(details) {
  const c = details.certificate;
  const power = (value) => value.toExponential(1).replace(/e([+-]?)(\d+)/, (_, sign, n) => ` × 10${(sign === "-" ? "⁻" : "") + [...n].map((d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("")}`);
  $("certificate").textContent = `Certificate: of the paper's equations ${power(c.worst)} is left, most in ${c.equation}; limit ${power(c.limit)}: ${c.passed ? "passed" : "not passed"}. `
    + `${details.converged ? "Every number meets" : "Not every number meets"} the tolerance ${power(details.rtol)}. Contact force in all: ${details.wall.total.text}${details.wall.torque && `; ${details.wall.torque}`}.`;
}

export function save(name, type, content) {
  const raw = atob(content), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  saveBlob(name, new Blob([bytes], { type }));
}

export function saveBlob(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const DRAWN = ["fill", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font-family", "font-size"];

// A drawing of the page as a file of its own: what the style sheet says of it is written into it.
export function standalone(svg) {
  const out = svg.cloneNode(true), { width, height } = svg.getBoundingClientRect();
  const from = [svg, ...svg.querySelectorAll("*")], to = [out, ...out.querySelectorAll("*")];
  from.forEach((each, i) => {
    const style = getComputedStyle(each);
    for (const name of DRAWN) to[i].setAttribute(name, style.getPropertyValue(name));
  });
  out.querySelectorAll(".hit, [hidden]").forEach((each) => each.remove());
  const paper = document.createElementNS(out.namespaceURI, "rect");
  for (const [name, value] of [["width", width], ["height", height], ["fill", getComputedStyle(document.body).backgroundColor]]) paper.setAttribute(name, value);
  out.prepend(paper);
  out.setAttribute("width", width);
  out.setAttribute("height", height);
  return new Blob([new XMLSerializer().serializeToString(out)], { type: "image/svg+xml" });
}

// The same in pixels, two for each of the page.
export async function pixels(drawing, svg) {
  const { width, height } = svg.getBoundingClientRect(), image = new Image();
  image.src = URL.createObjectURL(drawing);
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height: 2 * height });
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  return new Promise((done) => { canvas.toBlob(done); });
}

export async function copy(text, what) {
  try {
    await navigator.clipboard.writeText(text);
    $("copied").textContent = `${what} copied`;
  } catch {
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    $("copied").textContent = done ? `${what} copied` : "the browser does not let it be copied";
  }
  setTimeout(() => { $("copied").textContent = ""; }, 4000);
}

// The page as it is, in one file that needs neither server nor script.
export async function snapshot(state, hello, rod) {
  const css = await Promise.all(["viewer.css", "explore.css"].map(async (name) => (await fetch(name)).text()));
  const body = document.body.cloneNode(true);
  body.querySelectorAll("script, noscript, dialog, button, .row, #banner, #message, #cursor, input[type=range], .tools label, .hit").forEach((each) => each.remove());
  const still = body.querySelector("#rod img.still");
  body.querySelectorAll("#rod canvas").forEach((each) => each.remove());
  const picture = rod ? rod.picture() : document.querySelector("#rod img.still").src;
  if (picture) { still.src = picture; still.hidden = false; }
  const scale = document.createElement("p"); // what stands beside the scene is hidden with it
  scale.textContent = body.querySelector("#rod .scale").textContent;
  body.querySelector("#rod .frame").after(scale, body.querySelector("#rod .bar"));
  if (!state.inputs.sections && !body.querySelector("#section-controls .control")) body.querySelector("#sectioned").remove();
  body.querySelector("#rod").classList.remove("live");
  const live = document.body.querySelectorAll("input[type=number], select");
  body.querySelectorAll("input[type=number], select").forEach((each, i) => {
    const text = document.createElement("b");
    text.textContent = live[i].tagName === "SELECT" ? live[i].selectedOptions[0]?.textContent ?? "" : live[i].value;
    each.replaceWith(text);
  });
  const head = `<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><meta name="color-scheme" content="light dark"><title>${hello.title.replace(/[<&]/g, "")}</title><style>${css.join("\n")}</style></head>`;
  const data = JSON.stringify({ rodwell: hello.version, state }).replace(/</g, "\\u003c");
  return new Blob([head, body.outerHTML.replace("</body>", `<script type="application/json">${data}</script></body>`), "</html>"], { type: "text/html" });
}

// Sections of the rod from s = 0: those of a rod without dimensions can be changed, added and removed; of a string in
// the words of its case, what they are in the problem is told.
import { Control } from "./controls.js";

const $ = (id) => document.getElementById(id);
const COLUMNS = ["length", "stiffness", "weight"];
const RANGES = { length: [0.02, 0.98], stiffness: [0.1, 10], weight: [0, 10] };
const UNITS = { length: "L", stiffness: "B", weight: "γ" };

// Numbers of each section of a line "0.6:1:1,0.4:1/0.3:0.5"; one of a uniform rod. What tapers along it stays text.
export function parsed(line) {
  if (!line) return [[1, 1, 1]];
  return line.split(",").map((section) => {
    const numbers = section.trim().split(":").map((part) => (part.includes("/") ? part : Number(part)));
    return [...numbers, ...[1, 1].slice(0, Math.max(3 - numbers.length, 0))];
  });
}

export function line(sections) {
  const plain = sections.length === 1 && sections[0].slice(1).every((ratio) => ratio === 1);
  return plain ? "" : sections.map((section) => section.join(":")).join(",");
}

// A section of half the length of the last one, with its ratios (of one that tapers, its last), behind it.
export function added(sections) {
  const [length, ...ratios] = sections.at(-1), half = short(length / 2);
  const behind = ratios.map((ratio) => (typeof ratio === "string" ? Number(ratio.split("/").at(-1)) : ratio));
  return [...sections.slice(0, -1), [short(length - half), ...ratios], [half, ...behind]];
}

// Its neighbour takes its place.
export function removed(sections, number) {
  if (sections.length === 1) return [[1, 1, 1]];
  const heir = number === 0 ? 1 : number - 1;
  return sections.map(([length, ...more], i) => (i === heir ? [short(length + sections[number][0]), ...more] : [length, ...more])).filter((_, i) => i !== number);
}

// What a length gains the next section loses, the last one's the one before; null where that leaves nothing.
export function changed(sections, number, column, value) {
  const out = sections.map((section) => [...section]);
  out[number][column] = value;
  if (column > 0) return out;
  const other = number + 1 < out.length ? number + 1 : number - 1;
  if (other < 0) return null;
  out[other][0] = short(sections[other][0] + sections[number][0] - value);
  return value > 0 && out[other][0] > 0 ? out : null;
}

function short(value) { return Number(value.toPrecision(12)); }

export class Sections {
  constructor(put, say) {
    this.put = put; // (line, done) => void
    this.say = say; // (text) => void
    this.rows = [];
    $("add-section").onclick = () => this.put(line(added(parsed(this.line))), true);
  }

  begin(hello) {
    this.editable = hello.sections !== null;
    $("section-rows").replaceChildren();
    [this.rows, this.tapers] = [[], "[]"];
    $("add-section").hidden = !this.editable;
    $("string").hidden = this.editable || !hello.controls.some((each) => each.name.startsWith("string."));
    $("sectioned").hidden = !this.editable && $("string").hidden;
  }

  // What is wanted.
  show(line, { field = true } = {}) {
    this.line = line;
    if (!this.editable) return;
    const sections = line ? parsed(line) : [];
    const tapers = JSON.stringify(sections.map((section) => section.slice(0, 3).filter((ratio) => typeof ratio === "string")));
    if (tapers !== this.tapers) this.build(sections);
    this.tapers = tapers;
    this.each(sections, (control, value) => { if (control.value !== value) control.set(value, { field }); });
  }

  each(sections, act) {
    sections.forEach((section, i) => this.rows[i].forEach((control, k) => { if (control) act(control, section[k]); }));
  }

  // Fields show the sections of what is shown.
  read(line) {
    const sections = line ? parsed(line) : [];
    if (sections.length === this.rows.length) this.each(sections, (control, value) => control.read(value));
  }

  build(sections) {
    const at = document.activeElement?.id;
    $("section-rows").replaceChildren();
    this.rows = sections.map((section, i) => {
      const box = document.createElement("fieldset");
      box.innerHTML = '<legend></legend><button type="button">remove</button>';
      box.querySelector("legend").textContent = `section ${i + 1}${i ? "" : ", from s = 0"}`;
      const remove = box.querySelector("button");
      remove.setAttribute("aria-label", `remove section ${i + 1}`);
      remove.onclick = () => this.put(line(removed(parsed(this.line), i)), true);
      const row = COLUMNS.map((name, k) => {
        if (typeof section[k] === "string") { // as it was given: one number would not say it
          box.append(Object.assign(document.createElement("p"), { textContent: `${name} ${section[k].replaceAll("/", " → ")} ${UNITS[name]}`, className: "small" }));
          return null;
        }
        return new Control(box, {
          name: `section-${i + 1}-${name}`, label: name, hint: "", unit: UNITS[name], low: RANGES[name][0], high: RANGES[name][1],
        }, (value, done) => this.take(i, k, value, done));
      });
      $("section-rows").append(box);
      return row;
    });
    if (at) document.getElementById(at)?.focus();
  }

  take(number, column, value, done) {
    const sections = changed(parsed(this.line), number, column, value);
    if (sections) { this.put(line(sections), done); return; }
    this.rows[number][column].set(parsed(this.line)[number][column]);
    this.say(`section ${number + 1}, length = ${value}: must be above 0 and leave something of the section beside it, whose length makes up for it`);
  }

  // What the sections of a string are in the problem.
  tell(sections) {
    $("string").tBodies[0].replaceChildren(...sections.map((each) => {
      const row = document.createElement("tr");
      row.innerHTML = '<th scope="row"></th><td></td><td></td><td></td>';
      [each.name, each.length, each.stiffness, each.weight].forEach((text, k) => { row.cells[k].textContent = text; });
      return row;
    }));
  }
}

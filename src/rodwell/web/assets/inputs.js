// What stands on the left: each number of the case with its slider, ends, modes and sections.
import { begun } from "./address.js";
import { Control } from "./controls.js";
import { Sections } from "./sections.js";

const $ = (id) => document.getElementById(id);

export class Inputs {
  constructor(page) {
    this.page = page; // state(), hello(), go(changes, done), say(text)
    this.controls = new Map();
    this.sections = new Sections((line, done) => this.put({ sections: line }, { until: null }, done), page.say);
    $("ends").onchange = () => this.put({ ends: $("ends").value }, { until: null, branch: "", which: 0 });
    $("modes").onchange = () => {
      const value = $("modes").valueAsNumber;
      if (Number.isInteger(value) && value >= 1 && value <= page.hello().most_modes) this.put({ modes: value }, { branch: "", which: 0 });
      else $("modes").value = page.state().inputs.modes;
    };
  }

  put(inputs, more = {}, done = true) { this.page.go({ inputs: { ...this.page.state().inputs, ...inputs }, special: null, ...more }, done); }

  // The controls of a case, where another one was shown before.
  begin(hello) {
    for (const id of ["controls", "section-controls"]) $(id).replaceChildren();
    this.controls.clear();
    for (const each of hello.controls) {
      const place = $(each.name.startsWith("string.") ? "section-controls" : "controls");
      this.controls.set(each.name, new Control(place, each, (value, done) => this.put({ [each.name]: value }, { until: null }, done)));
    }
    this.sections.begin(hello);
    $("ends").replaceChildren(...hello.all_ends.map((each) => new Option(each.replace("-", ", "), each)));
    $("modes").max = hello.most_modes;
  }

  // What is wanted; fields show what the numbers on the page belong to, which may be older while a slider is dragged.
  show(inputs, { field = true } = {}) {
    for (const [name, control] of this.controls) if (control.value !== inputs[name]) control.set(inputs[name], { field });
    this.sections.show(inputs.sections, { field });
    if (field) this.read(inputs);
    $("ends").value = inputs.ends;
    $("modes").value = inputs.modes;
  }

  // The inputs of what is shown: all that were moved.
  readMoved(moved) { this.read({ ...begun(this.page.hello()).inputs, ...moved }); }

  read(inputs) {
    for (const [name, control] of this.controls) control.read(inputs[name]);
    this.sections.read(inputs.sections);
  }
}

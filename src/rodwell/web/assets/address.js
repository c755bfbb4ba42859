// The state of the page in its address: everything that is shown, so that an address can be pasted and Back works.

export const FREE = ["load", "branch", "which", "special", "y", "until", "path", "scale"];

export function written(state, hello) {
  const out = new URLSearchParams();
  for (const control of hello.controls) out.set(control.name, String(state.inputs[control.name]));
  if (state.inputs.sections) out.set("sections", state.inputs.sections);
  else if (hello.sections) out.set("sections", "none"); // those of the case were taken away
  out.set("ends", state.inputs.ends);
  out.set("modes", String(state.inputs.modes));
  for (const name of FREE) if (state[name] !== null && state[name] !== "" && state[name] !== undefined) out.set(name, String(state[name]));
  return "#" + out.toString();
}

export function begun(hello) {
  const inputs = Object.fromEntries(hello.controls.map((control) => [control.name, control.value]));
  return {
    inputs: { ...inputs, ...(hello.sections === null ? {} : { sections: hello.sections }), ends: hello.ends, modes: hello.modes },
    load: null, branch: "", which: 0, special: null, y: "", until: null, path: "", scale: "",
  };
}

// Returns the state, or throws with what is wrong.
export function read(hash, hello) {
  const state = begun(hello);
  const numbers = new Set(hello.controls.map((control) => control.name));
  for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
    if (numbers.has(name)) state.inputs[name] = number(name, text);
    else if (name === "sections" && hello.sections !== null) state.inputs.sections = text === "none" ? "" : sectionsLine(text);
    else if (name === "ends") state.inputs.ends = oneOf(name, text, hello.all_ends);
    else if (name === "modes") state.inputs.modes = whole(name, text, 1, hello.most_modes);
    else if (name === "load" || name === "until") state[name] = number(name, text);
    else if (name === "which" || name === "special") state[name] = whole(name, text, 0, 999);
    else if (name === "path") state.path = oneOf(name, text, ["followed"]);
    else if (name === "scale") state.scale = oneOf(name, text, ["true"]);
    else if (name === "branch" || name === "y") state[name] = text.slice(0, 80);
    else throw new Error(`${name} is not known`);
  }
  return state;
}

// What differs from the case to begin with: that alone is asked for.
export function moved(inputs, hello) {
  const first = begun(hello).inputs;
  return Object.fromEntries(Object.keys(first).filter((name) => inputs[name] !== first[name]).sort().map((name) => [name, inputs[name]]));
}

function number(name, text) {
  const value = Number(text);
  if (text.trim() === "" || !Number.isFinite(value)) throw new Error(`${name} = ${text.slice(0, 40)} is no number`);
  return value;
}

function sectionsLine(text) {
  for (const part of text.split(/[,:/]/)) number("sections", part);
  return text;
}

function whole(name, text, low, high) {
  const value = number(name, text);
  if (!Number.isInteger(value) || value < low || value > high) throw new Error(`${name} must be a whole number from ${low} to ${high}`);
  return value;
}

function oneOf(name, text, allowed) {
  if (!allowed.includes(text)) throw new Error(`${name} = ${text.slice(0, 40)} is not one of ${allowed.join(", ")}`);
  return text;
}

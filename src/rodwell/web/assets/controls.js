// Sliders with number fields.

// A slider with a field: changed(value, done) while it moves, and when it is let go.
export class Control {
  constructor(place, { name, label, hint, unit, low, high }, changed) {
    this.name = name;
    const box = document.createElement("div");
    box.className = "control";
    const id = `input-${name.replace(/\W/g, "-")}`;
    box.innerHTML = '<div class="top"><label></label><input type="number" step="any" autocomplete="off"><span class="unit"></span></div><input type="range">';
    const [text, unitText] = [box.querySelector("label"), box.querySelector(".unit")];
    [this.field, this.slider] = box.querySelectorAll("input");
    text.textContent = label;
    text.htmlFor = id;
    if (hint) box.title = hint;
    unitText.textContent = unit;
    this.unit = unitText;
    this.field.id = id;
    this.slider.setAttribute("aria-label", `${label}, slider`);
    this.range(low, high);
    this.slider.addEventListener("input", () => changed(this.clean(Number(this.slider.value)), false));
    this.slider.addEventListener("change", () => changed(this.clean(Number(this.slider.value)), true));
    this.field.addEventListener("change", () => {
      const value = this.field.valueAsNumber;
      if (Number.isFinite(value)) changed(value, true);
      else this.set(this.value);
    });
    box.addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!way || (event.target === this.field && !event.key.endsWith("Up") && !event.key.endsWith("Down"))) return;
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      changed(this.stepped(way * (event.shiftKey ? 0.1 : 0.01)), true);
    });
    place.append(box);
  }

  // By a part of the value, or of the slider where the value is 0.
  stepped(part, from = this.value) {
    const size = Math.abs(from) || this.high - this.low;
    return Number((from + part * size).toPrecision(12));
  }

  clean(value) { return Number(value.toPrecision(5)); }

  range(low, high) {
    [this.low, this.high] = [low, high];
    this.slider.min = low;
    this.slider.max = high;
    this.slider.step = (high - low) / 1000 || 1;
    if (this.value !== undefined) this.slider.value = this.value;
  }

  set(value, { field = true, slider = true } = {}) {
    this.value = value;
    if (slider) {
      if (value < this.low) this.range(value, this.high);
      if (value > this.high) this.range(this.low, value);
      this.slider.value = value;
    }
    if (field) this.write(value);
  }

  // What a number on the page belongs to; a field in which somebody writes is left alone.
  read(value) { if (document.activeElement !== this.field) this.write(value); }

  write(value) {
    const text = value === null ? "" : String(Number(value.toPrecision(12)));
    if (this.field.value !== text) this.field.value = text;
  }
}

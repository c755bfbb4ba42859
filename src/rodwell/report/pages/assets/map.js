// A map of cells over two of its parameters: coloured by a number, or by what came of a cell; the others are moved.
"use strict";

(function () {
  const $ = (id) => document.getElementById(id);
  const data = JSON.parse($("data").textContent), axes = data.axes;
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const columns = Object.fromEntries(data.columns.map((c) => [c.name, { ...c, values: new Float64Array(bytes(c.data)) }]));
  const outcome = new Uint8Array(bytes(data.outcome)), reason = new Uint32Array(bytes(data.reason));
  const strides = axes.map((_, k) => axes.slice(k + 1).reduce((product, axis) => product * axis.names.length, 1));
  const drawable = axes.map((_, k) => k).filter((k) => axes[k].numbers);
  const state = { x: drawable[0], y: drawable[1], show: "value", at: axes.map(() => 0), cell: null };
  const canvas = $("map"), pen = canvas.getContext("2d");
  const room = { left: 78, right: 96, top: 12, bottom: 48 };
  const short = (v) => (v === 0 ? "0" : (Math.abs(v) >= 1e6 || Math.abs(v) < 1e-3 ? v.toExponential(2) : String(Number(v.toPrecision(4))))).replace(/-/g, "−");
  const power = (v) => short(v).replace(/e\+?(−?)(\d+)/, (_, sign, n) => ` × 10${sign ? "⁻" : ""}${[...n].map((d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("")}`);
  const marks = { circle: ["#1f2933", "#fff"], diamond: ["#fff", "#1f2933"], square: [data.warn, "#fff"] }; // fill and edge
  const full = (v) => String(Number(v.toPrecision(10))).replace(/-/g, "−");

  // choices: what is shown, over what, and where the other parameters stand
  function choice(text, options, value, chosen) {
    const label = document.createElement("label"), select = document.createElement("select");
    select.append(...options.map(([name, words]) => new Option(words, name)));
    select.value = value;
    select.onchange = () => { chosen(select.value); refresh(); };
    label.append(text, select);
    $("choices").append(label);
  }
  function choices() {
    $("choices").replaceChildren();
    choice("show", data.columns.map((c) => [c.name, c.label]), state.show, (name) => { state.show = name; });
    if (drawable.length > 2) {
      const names = drawable.map((k) => [String(k), axes[k].name]);
      const swap = (one, other) => (k) => { if (state[other] === Number(k)) state[other] = state[one]; state[one] = Number(k); choices(); };
      choice("across", names, String(state.x), swap("x", "y"));
      choice("upwards", names, String(state.y), swap("y", "x"));
    }
    axes.forEach((axis, k) => {
      if (k === state.x || k === state.y) return;
      const label = document.createElement("label"), slider = document.createElement("input"), told = document.createElement("output");
      Object.assign(slider, { type: "range", min: 0, max: axis.names.length - 1, step: 1, value: state.at[k] });
      slider.setAttribute("aria-label", axis.name);
      const tell = () => { told.textContent = named(k, state.at[k]); slider.setAttribute("aria-valuetext", told.textContent); };
      slider.oninput = () => { state.at[k] = Number(slider.value); tell(); refresh(); };
      tell();
      label.append(axis.name, slider, told);
      $("choices").append(label);
    });
  }
  const named = (k, i) => (axes[k].numbers ? `${short(axes[k].numbers[i])}${axes[k].unit ? ` ${axes[k].unit}` : ""}` : axes[k].names[i]);

  // from cells to pixels: each reaches halfway to its neighbours, in the logarithm where the axis has one
  function edges(axis, low, high) {
    const v = axis.numbers.map((each) => (axis.log ? Math.log(each) : each)), n = v.length;
    const cut = n === 1 ? [v[0] - 1, v[0] + 1] : [v[0] - (v[1] - v[0]) / 2, ...v.slice(1).map((each, i) => (each + v[i]) / 2), v[n - 1] + (v[n - 1] - v[n - 2]) / 2];
    const scale = (each) => low + ((each - cut[0]) / (cut[n] - cut[0])) * (high - low);
    return { cut: cut.map(scale), place: (number) => scale(axis.log ? Math.log(number) : number) };
  }
  const index = (i, j) => strides.reduce((sum, stride, k) => sum + stride * (k === state.x ? i : k === state.y ? j : state.at[k]), 0);
  let x, y, width, height;

  function refresh() {
    const ratio = window.devicePixelRatio || 1, dark = matchMedia("(prefers-color-scheme: dark)").matches;
    width = canvas.clientWidth; height = canvas.clientHeight;
    canvas.width = width * ratio; canvas.height = height * ratio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    x = edges(axes[state.x], room.left, width - room.right);
    y = edges(axes[state.y], height - room.bottom, room.top);
    const nx = axes[state.x].names.length, ny = axes[state.y].names.length, numbers = columns[state.show].values;
    let low = Infinity, high = -Infinity;
    for (let i = 0; i < nx; i++) for (let j = 0; j < ny; j++) {
      const v = numbers[index(i, j)];
      if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
    }
    const logarithmic = state.show === "error" && low > 0;
    const part = (v) => (high > low ? (logarithmic ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low)) : 0.5);
    const kinds = new Set();
    for (let i = 0; i < nx; i++) for (let j = 0; j < ny; j++) {
      const k = index(i, j), v = numbers[k];
      pen.fillStyle = Number.isFinite(v) ? data.colours[Math.round(part(v) * (data.colours.length - 1))] : data.outcome_colours[outcome[k]];
      if (!Number.isFinite(v)) kinds.add(outcome[k]);
      pen.fillRect(x.cut[i] - 0.3, y.cut[j + 1] - 0.3, x.cut[i + 1] - x.cut[i] + 0.6, y.cut[j] - y.cut[j + 1] + 0.6);
    }
    frame(dark ? "#e4e9ee" : "#1f2933", low, high, logarithmic);
    const marked = jumps();
    key(kinds, marked);
    cursor();
  }

  function frame(ink, low, high, logarithmic) {
    pen.strokeStyle = pen.fillStyle = ink;
    pen.lineWidth = 1;
    pen.font = "12px system-ui, sans-serif";
    pen.strokeRect(room.left, room.top, width - room.left - room.right, height - room.top - room.bottom);
    const label = (axis, scale, across) => {
      const n = axis.numbers.length, each = Math.max(1, Math.ceil(n / (across ? Math.max(2, width / 110) : 8)));
      for (let i = 0; i < n; i += each) {
        const at = scale.place(axis.numbers[i]);
        pen.textAlign = across ? "center" : "right";
        pen.fillText(short(axis.numbers[i]), across ? at : room.left - 6, across ? height - room.bottom + 17 : at + 4);
      }
    };
    label(axes[state.x], x, true);
    label(axes[state.y], y, false);
    pen.textAlign = "center";
    pen.fillText(axes[state.x].label, (room.left + width - room.right) / 2, height - 10);
    pen.save();
    pen.translate(14, (room.top + height - room.bottom) / 2);
    pen.rotate(-Math.PI / 2);
    pen.fillText(axes[state.y].label, 0, 0);
    pen.restore();
    if (!(low <= high)) return;
    const left = width - room.right + 16, tall = height - room.top - room.bottom, n = data.colours.length;
    data.colours.forEach((colour, i) => { pen.fillStyle = colour; pen.fillRect(left, room.top + tall * (1 - (i + 1) / n), 14, tall / n + 0.5); });
    pen.fillStyle = ink;
    pen.textAlign = "left";
    for (let i = 0; i <= 4; i++) {
      const v = logarithmic ? low * (high / low) ** (i / 4) : low + ((high - low) * i) / 4;
      pen.fillText(short(v), left + 18, room.top + tall * (1 - i / 4) + 4);
    }
  }

  // jumps that lie in the plane that is drawn
  function jumps() {
    const here = data.jumps.filter((jump) => drawable.every((k) => k === state.x || k === state.y || jump.at[axes[k].name] === axes[k].numbers[state.at[k]]));
    here.forEach((jump) => {
      const px = x.place(jump.at[axes[state.x].name]), py = y.place(jump.at[axes[state.y].name]);
      const [fill, edge] = marks[jump.mark];
      pen.beginPath();
      if (jump.mark === "circle") pen.arc(px, py, 2.8, 0, 2 * Math.PI);
      else if (jump.mark === "square") pen.rect(px - 2.6, py - 2.6, 5.2, 5.2);
      else [[0, -3.6], [3.6, 0], [0, 3.6], [-3.6, 0]].forEach(([dx, dy], i) => (i ? pen.lineTo(px + dx, py + dy) : pen.moveTo(px + dx, py + dy)));
      pen.closePath();
      pen.fillStyle = fill;
      pen.fill();
      pen.strokeStyle = edge;
      pen.lineWidth = 0.9;
      pen.stroke();
    });
    return new Map(here.map((jump) => [jump.kind, jump.mark]));
  }

  function key(kinds, marked) {
    const line = (colour, text, mark) => {
      const item = document.createElement("span"), patch = document.createElement("i");
      patch.style.background = colour;
      if (mark) patch.className = `jump ${mark}`;
      item.append(patch, text);
      return item;
    };
    const seen = [...kinds].sort().map((kind) => line(data.outcome_colours[kind], data.outcomes[kind]));
    $("key").replaceChildren(...seen, ...[...marked].map(([kind, mark]) => line(marks[mark][0], kind, mark)));
  }

  // the cell that is told
  function cursor() {
    if (!state.cell) return;
    const [i, j] = state.cell, k = index(i, j), value = columns.value.values[k], error = columns.error.values[k];
    pen.strokeStyle = "#fff";
    pen.lineWidth = 3.5;
    pen.strokeRect(x.cut[i], y.cut[j + 1], x.cut[i + 1] - x.cut[i], y.cut[j] - y.cut[j + 1]);
    pen.strokeStyle = "#111";
    pen.lineWidth = 1.5;
    pen.strokeRect(x.cut[i], y.cut[j + 1], x.cut[i + 1] - x.cut[i], y.cut[j] - y.cut[j + 1]);
    const where = axes.map((axis, a) => `${axis.name} ${named(a, a === state.x ? i : a === state.y ? j : state.at[a])}`).join(", ");
    const bold = document.createElement("b");
    bold.textContent = Number.isFinite(value) ? `${full(value)} ± ${power(Number(error.toPrecision(1)))}` : data.outcomes[outcome[k]];
    const rest = [columns.value.label];
    if (Number.isFinite(columns.place.values[k])) rest.push(`at s/L = ${full(columns.place.values[k])}`);
    if (Number.isFinite(columns["half-waves"].values[k])) rest.push(`${columns["half-waves"].values[k]} half waves`);
    if (Number.isFinite(value)) rest.push(data.outcomes[outcome[k]]);
    if (data.reasons[reason[k]]) rest.push(data.reasons[reason[k]]);
    $("cell").replaceChildren(`${where}: `, bold, document.createElement("br"), rest.join("; "));
  }
  const find = (cut, at, down) => { for (let i = 0; i + 1 < cut.length; i++) if (down ? at <= cut[i] && at >= cut[i + 1] : at >= cut[i] && at <= cut[i + 1]) return i; return -1; };
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    const i = find(x.cut, event.clientX - box.left, false), j = find(y.cut, event.clientY - box.top, true);
    if (i < 0 || j < 0 || (state.cell && state.cell[0] === i && state.cell[1] === j)) return;
    state.cell = [i, j];
    refresh();
  });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const [i, j] = state.cell || [-step[0], -step[1]], clamp = (v, axis) => Math.min(Math.max(v, 0), axes[axis].names.length - 1);
    state.cell = [clamp(i + step[0], state.x), clamp(j + step[1], state.y)];
    refresh();
  });
  new ResizeObserver(refresh).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refresh);
  choices();
  refresh();
  window.__map = state; // for tests
})();

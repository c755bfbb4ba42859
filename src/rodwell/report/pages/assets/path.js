// A slider through the states of a load path: the rod in its hole, and the point in load against shortening.
"use strict";

(function () {
  const $ = (id) => document.getElementById(id);
  const data = JSON.parse($("data").textContent), frames = data.frames;
  const element = document.querySelector(".rod-viewer"), viewer = element.rodwell;
  const slider = $("at"), play = $("play");
  slider.max = frames.length - 1;

  // load against shortening: a line for each run, in the colours of the legs
  const chart = $("path"), left = 84, right = 620, top = 14, bottom = 252;
  const range = (name) => [Math.min(...frames.map((f) => f[name])), Math.max(...frames.map((f) => f[name]))];
  const [x0, x1] = range("x"), [y0, y1] = range("y");
  const across = (x) => left + 8 + ((x - x0) / (x1 - x0 || 1)) * (right - left - 16);
  const up = (y) => bottom - 8 - ((y - y0) / (y1 - y0 || 1)) * (bottom - top - 16);
  const draw = (name, given, text) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    Object.entries(given).forEach(([key, value]) => made.setAttribute(key, value));
    if (text !== undefined) made.textContent = text;
    return chart.appendChild(made);
  };
  const number = (value, whole) => // what is round-off of the whole range is nothing
    Number((Math.abs(value) < 1e-9 * whole ? 0 : value).toPrecision(4)).toString().replace("-", "−");
  draw("path", { class: "frame-line", d: `M${left} ${top}V${bottom}H${right}` });
  for (let i = 0; i < 3; i++) {
    const x = x0 + (i / 2) * (x1 - x0), y = y0 + (i / 2) * (y1 - y0);
    draw("text", { x: across(x), y: bottom + 18, "text-anchor": "middle" }, number(x, x1 - x0));
    draw("text", { x: left - 6, y: up(y) + 4, "text-anchor": "end" }, number(y, y1 - y0));
  }
  draw("text", { x: (left + right) / 2, y: bottom + 40, "text-anchor": "middle" }, data.axes.across);
  draw("text", { x: 16, y: (top + bottom) / 2, "text-anchor": "middle", transform: `rotate(-90 16 ${(top + bottom) / 2})` }, data.axes.up);
  new Set(frames.map((f) => f.run)).forEach((run) => {
    const here = frames.filter((f) => f.run === run);
    draw("path", { class: here[0].leg, d: here.map((f, i) => `${i ? "L" : "M"}${across(f.x).toFixed(1)} ${up(f.y).toFixed(1)}`).join("") });
  });
  frames.forEach((f, i) => { // a snap leads from the end of a run to the start of the next
    const next = frames[i + 1];
    if (!next || next.run === f.run || !data.events.some((each) => each.snap && frames[each.frame].run === next.run)) return;
    const x = across(next.x), y = up(next.y), dx = x - across(f.x), dy = y - up(f.y), length = Math.hypot(dx, dy);
    if (length < 4) return;
    const along = (back, side) => `${(x - (back * dx - side * dy) / length).toFixed(1)} ${(y - (back * dy + side * dx) / length).toFixed(1)}`;
    draw("path", { class: "snap", d: `M${across(f.x).toFixed(1)} ${up(f.y).toFixed(1)}L${along(6, 0)}` });
    draw("polygon", { points: `${along(0, 0)} ${along(8, 4)} ${along(8, -4)}` });
  });
  const dot = draw("circle", { r: 5.5 });

  function sceneOf(frame) {
    const { scene, triangles } = data.shared;
    const own = frame.scene.parts.map((part) => ({ ...part, triangles: triangles[part.name.startsWith("ring") ? "ring" : part.name] }));
    return { ...scene, parts: [...own, ...scene.parts] };
  }

  const bar = element.querySelector(".bar");
  function show(i) {
    const frame = frames[i];
    slider.value = i;
    slider.setAttribute("aria-valuetext", frame.says);
    $("now").textContent = frame.says;
    dot.setAttribute("cx", across(frame.x));
    dot.setAttribute("cy", up(frame.y));
    bar.style.visibility = frame.bar.first === frame.bar.last ? "hidden" : "visible"; // nothing presses along the rod
    bar.firstChild.textContent = `${frame.bar.first} `;
    bar.querySelector("i").style.background = frame.bar.gradient;
    bar.lastChild.textContent = ` ${frame.bar.last} ${frame.bar.unit}`;
    if (viewer) viewer.show(sceneOf(frame));
  }
  slider.oninput = () => { stop(); show(Number(slider.value)); };
  data.events.forEach((event) => {
    const item = document.createElement("li"), button = document.createElement("button");
    button.type = "button";
    button.textContent = event.text;
    button.onclick = () => { stop(); show(event.frame); };
    item.append(button);
    $("events").append(item);
  });

  let timer = 0;
  function stop() {
    clearInterval(timer);
    timer = 0;
    play.textContent = "▶ Play";
    play.setAttribute("aria-pressed", "false");
  }
  play.onclick = () => {
    if (timer) { stop(); return; }
    if (Number(slider.value) >= frames.length - 1) show(0);
    play.textContent = "■ Stop";
    play.setAttribute("aria-pressed", "true");
    timer = setInterval(() => {
      const next = Number(slider.value) + 1;
      if (next > frames.length - 1) stop();
      else show(next);
    }, 180);
  };
  show(0);
})();

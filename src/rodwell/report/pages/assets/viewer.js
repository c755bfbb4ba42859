// The rod in its cylinder, to be turned and zoomed. Needs THREE (three.min.js), what it is made of (parts.js) and nothing from the network.
// rodwellViewer(element, data): data as made by rodwell.report.viewer; returns false where the browser has no WebGL, else
// an object whose show(data) takes another scene, between(one, other, t) draws a shape between two, mark(fraction) marks a place along the rod, picture() is
// what is seen as PNG, and vertices() says where the rod's vertices are across the axis, in wall radii.
"use strict";

const SELDOM = 80; // milliseconds from one scene drawn to the next, where the processor draws and they come fast
const CALM = 700; // milliseconds after which scenes have come to rest: the last one is drawn with all pixels

function rodwellViewer(element, data) {
  const stage = element.querySelector(".stage");
  const slow = drawnByProcessor();
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: !slow, alpha: true, preserveDrawingBuffer: false });
  } catch (problem) {
    return false; // the still picture stays
  }
  const sharp = Math.min(window.devicePixelRatio || 1, slow ? 1 : 2);
  let coarse = slow ? 0.5 : sharp; // pixels while it is turned: fewer where frames come late
  renderer.setPixelRatio(sharp);
  stage.appendChild(renderer.domElement);
  element.classList.add("live");

  const scene = new THREE.Scene();
  const groups = { wall: new THREE.Group(), lines: new THREE.Group(), rest: new THREE.Group() };
  const all = new THREE.Group(); // what is enlarged across the axis, and is set back to true scale
  Object.values(groups).forEach((group) => all.add(group));
  scene.add(all);
  const mark = readingMark();
  all.add(mark);
  const known = new Map(); // parts by name, kept from scene to scene
  let given = data; // as it came, where data is its true scale
  let rest = [], restOf = ""; // lines, made anew of one material: with the last of its kind goes its shader, which takes long to make
  const ink = new THREE.LineBasicMaterial({ color: 0x627d98 });
  const arrow = new THREE.ArrowHelper(new THREE.Vector3(0, -1, 0), new THREE.Vector3(), 0.09, 0x52606d, 0.03, 0.018);
  groups.wall.add(arrow);
  let calm = 0, shownAt = -1e9; // when scenes have come to rest, and when the last one came
  let newest = null, late = 0, filledAt = -1e9; // a scene that waits to be drawn, until when, and when the last one was
  let marked; // where along the rod the mark stands, null: nowhere; undefined where the mark is that of the place read
  let labels = [];
  function fill() {
    const parts = new Map(data.parts.map((part, i) => [keyOf(part, i), part]));
    known.forEach((old, key) => { if (!parts.has(key)) { discard(old); known.delete(key); } });
    parts.forEach((part, key) => {
      const old = known.get(key);
      if (old && renewed(old, part)) return;
      if (old) discard(old);
      known.set(key, mesh(part));
      groups[groupOf(part)].add(known.get(key));
    });
    const of = JSON.stringify(data.lines);
    if (of !== restOf) {
      restOf = of;
      rest.forEach((line) => { line.removeFromParent(); line.geometry.dispose(); });
      rest = data.lines.map((line) => curve(line, ink));
      rest.forEach((line, i) => groups[data.lines[i].group].add(line));
    }
    arrow.visible = data.weight > 0;
    if (arrow.visible) {
      arrow.position.set(...data.arrow);
      arrow.setDirection(new THREE.Vector3(...data.gravity));
    }
    labels.splice(data.labels.length).forEach(({ box }) => box.remove());
    data.labels.forEach((label, i) => { labels[i] = tag(stage, label, labels[i]?.box); });
  }
  fill();
  light(scene);

  const camera = new THREE.PerspectiveCamera(28, 1, 0.001, 50);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.minDistance = 0.01;
  controls.maxDistance = 12;
  const reading = element.querySelector(".reading"), scale = element.querySelector(".scale");
  const along = data.along || { points: [], says: [] };
  const places = along.points.map((point) => new THREE.Vector3(...point));
  let place = -1; // which place is read

  function stand() {
    controls.target.set(0, 0, 0);
    const towards = new THREE.Vector3(-0.32, 0.36, 0.95).normalize();
    const across = 2 * Math.tan((camera.fov * Math.PI) / 360);
    const distance = Math.max(1.52 / (across * camera.aspect), (data.height * 2.6) / across, 0.2);
    camera.position.copy(towards.multiplyScalar(distance));
    controls.update();
  }
  const home = () => { stand(); draw(); };
  let wide = 0, tall = 0; // of the stage: asked for at each label, the browser would lay out the page anew each time
  function draw() {
    if (newest) take();
    if (marked !== undefined) placeMark();
    renderer.render(scene, camera);
    labels.forEach(({ box, at }) => {
      const p = all.localToWorld(at.clone()).project(camera);
      const [left, top] = [`${((p.x * 0.5 + 0.5) * wide).toFixed(1)}px`, `${((-p.y * 0.5 + 0.5) * tall).toFixed(1)}px`];
      if (box.style.left !== left) box.style.left = left;
      if (box.style.top !== top) box.style.top = top;
    });
  }
  function fit() {
    const width = stage.clientWidth, height = stage.clientHeight;
    if (!width || !height) return;
    [wide, tall] = [width, height];
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  }
  const zoom = (factor) => {
    camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
    controls.update();
    draw();
  };
  // one frame for each that the screen shows, with fewer pixels while it is turned
  let waiting = false, last = 0;
  controls.addEventListener("change", () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      const began = performance.now();
      draw();
      if (turning && began - last < 1000 && performance.now() - began > 60 && coarse > 0.25) pixels((coarse *= 0.7));
      last = began;
    });
  });
  let turning = false;
  const pixels = (ratio) => { renderer.setPixelRatio(ratio); renderer.setSize(wide, tall, false); };
  controls.addEventListener("start", () => { turning = true; if (coarse < sharp) pixels(coarse); });
  controls.addEventListener("end", () => { turning = false; if (coarse < sharp) pixels(sharp); draw(); });
  function turn(across, up) {
    const from = camera.position.clone().sub(controls.target), far = from.length();
    const around = Math.atan2(from.x, from.z) + across;
    const down = Math.min(Math.max(Math.acos(from.y / far) + up, 0.05), Math.PI - 0.05);
    from.set(Math.sin(down) * Math.sin(around), Math.cos(down), Math.sin(down) * Math.cos(around));
    camera.position.copy(from.multiplyScalar(far).add(controls.target));
    controls.update();
    draw();
  }
  function read(number) {
    if (!places.length) return;
    place = Math.min(Math.max(number, 0), places.length - 1);
    reading.textContent = along.says[place];
    mark.position.copy(places[place]);
    mark.visible = true;
    draw();
  }
  function nearest(event) {
    const box = renderer.domElement.getBoundingClientRect();
    let best = -1, least = 60 * 60; // pixels, squared: farther from the rod nothing is read
    places.forEach((at, i) => {
      const p = all.localToWorld(at.clone()).project(camera);
      const dx = (p.x * 0.5 + 0.5) * box.width - (event.clientX - box.left);
      const dy = (-p.y * 0.5 + 0.5) * box.height - (event.clientY - box.top);
      if (dx * dx + dy * dy < least) { least = dx * dx + dy * dy; best = i; }
    });
    return best;
  }
  renderer.domElement.addEventListener("pointermove", (event) => {
    if (event.buttons) return;
    const found = nearest(event);
    if (found >= 0 && found !== place) read(found);
  });
  const keys = {
    ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, -0.1), ArrowDown: () => turn(0, 0.1),
    "+": () => zoom(0.8), "=": () => zoom(0.8), "-": () => zoom(1.25), Home: () => home(),
    ",": () => read(place - 1), ".": () => read(place + 1), PageUp: () => read(place + 20), PageDown: () => read(place - 20),
  };
  stage.addEventListener("keydown", (event) => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    action();
    event.preventDefault();
  });
  new ResizeObserver(fit).observe(stage);
  if (data.embedded) wheelAfterClick(controls, renderer.domElement); // a page that scrolls must go on scrolling

  element.querySelector("[data-do=home]").onclick = home;
  element.querySelector("[data-do=in]").onclick = () => zoom(0.8);
  element.querySelector("[data-do=out]").onclick = () => zoom(1.25);
  for (const name of ["wall", "lines"]) {
    const box = element.querySelector(`[data-show=${name}]`);
    box.onchange = () => { groups[name].visible = box.checked; draw(); };
  }
  const trueScale = element.querySelector("[data-show=true-scale]");
  function scaled() {
    const really = Boolean(trueScale) && trueScale.checked;
    const across = really && !given.true_scale ? 1 / data.enlarged : 1;
    all.scale.set(1, across, across);
    const shown = really && given.true_scale ? { ...given, ...given.true_scale } : given;
    if (shown !== data && given.true_scale) { data = shown; fill(); } // a bent hole has a scene of its own
    const says = really ? "true scale" : data.says;
    if (scale.textContent !== says) scale.textContent = says;
  }
  if (trueScale) trueScale.onchange = () => { scaled(); draw(); };
  fit();
  home();
  return { show, between, mark: markAt, picture, vertices, drawn: () => renderer.info.render.frame };

  // Many scenes after each other are drawn with fewer pixels, and not each of them; the last one with all.
  function show(other) {
    newest = other;
    if (!slow) { draw(); return; }
    const now = performance.now(), follows = now - shownAt < CALM, full = renderer.getPixelRatio() === sharp;
    shownAt = now;
    if (follows && full) pixels(0.5 * sharp);
    clearTimeout(calm);
    if (follows || !full) calm = setTimeout(() => { pixels(sharp); draw(); }, CALM);
    clearTimeout(late);
    if (!follows || full || now - filledAt > SELDOM) draw();
    else late = setTimeout(draw, SELDOM);
  }
  // The scene that came last becomes the one that is drawn.
  function take() {
    const taller = Math.abs(newest.height / data.height - 1) > 0.02;
    given = data = newest;
    newest = null;
    filledAt = performance.now();
    fill();
    scaled();
    if (taller) stand();
  }
  // Read in the task in which it is drawn: what has been shown is not kept.
  function picture() {
    if (renderer.getPixelRatio() !== sharp) pixels(sharp);
    draw();
    return renderer.domElement.toDataURL("image/png");
  }
  // A shape between those of two scenes of the same rod, t from 0 to 1, in the colours that stand there: not computed.
  function between(one, other, t) {
    const parts = one.parts.filter((part) => /^(rod|material|cylinder)/.test(part.name)); // no contacts in between
    if (t === 0) show({ ...one, parts, lines: one.lines.filter((line) => line.group === "wall") });
    if (newest) take();
    for (const part of parts) {
      const end = other.parts.find((each) => each.name === part.name), geometry = known.get(part.name).geometry;
      const at = geometry.getAttribute("position"), from = positions(part), to = end ? positions(end) : from;
      if (part.name === "cylinder" || from.length !== to.length || at.array.length !== from.length) continue;
      for (let i = 0; i < from.length; i++) at.array[i] = from[i] + t * (to[i] - from[i]);
      at.needsUpdate = true;
      setNormals(geometry);
      geometry.computeBoundingSphere();
    }
    draw();
  }
  // A place along the rod, 0 to 1, or null: it stays marked in the scenes that come.
  function markAt(fraction) {
    if (fraction === marked) return;
    marked = fraction;
    if (!newest) draw();
  }
  // The middle of the rod's vertices there.
  function placeMark() {
    const rod = known.get("rod"), sides = data.sides;
    mark.visible = marked !== null && Boolean(rod && sides);
    if (!mark.visible) return;
    const at = rod.geometry.getAttribute("position"), rings = Math.floor(at.count / sides);
    const first = Math.min(Math.max(Math.round(marked * (rings - 1)), 0), rings - 1) * sides;
    mark.position.set(0, 0, 0);
    for (let i = first; i < first + sides; i++) mark.position.add(new THREE.Vector3().fromBufferAttribute(at, i));
    mark.position.multiplyScalar(1 / sides);
  }
  function vertices() {
    if (newest) take();
    const at = known.get("rod").geometry.getAttribute("position");
    let widest = 0;
    for (let i = 0; i < at.count; i++) widest = Math.max(widest, Math.hypot(at.getY(i), at.getZ(i)));
    return widest / (data.height / 2);
  }

  // A ring that moves along the rod is called by its place there: it is the same ring.
  function keyOf(part, i) { return / at s = /.test(part.name) ? `ring ${i}` : part.name; }
  function groupOf(part) {
    return part.name === "cylinder" ? "wall" : part.name.startsWith("material") ? "lines" : "rest";
  }
}

// Whether the browser draws with the processor (no graphics card): then fewer pixels, no smoothing of edges.
function drawnByProcessor() {
  const gl = document.createElement("canvas").getContext("webgl");
  const known = gl && gl.getExtension("WEBGL_debug_renderer_info");
  return Boolean(known) && /swiftshader|llvmpipe|software|basic render/i.test(gl.getParameter(known.UNMASKED_RENDERER_WEBGL));
}

function wheelAfterClick(controls, canvas) {
  controls.enableZoom = false;
  canvas.addEventListener("pointerdown", () => { controls.enableZoom = true; });
  canvas.addEventListener("pointerleave", () => { controls.enableZoom = false; });
}

document.querySelectorAll(".rod-viewer").forEach((element) => {
  const scene = element.querySelector("script[type='application/json']");
  if (scene) element.rodwell = rodwellViewer(element, JSON.parse(scene.textContent)); // else: shown by another script
});

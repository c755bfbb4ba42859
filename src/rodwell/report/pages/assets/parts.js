// What the viewer's scene is made of: meshes and lines of data as made by rodwell.report.viewer, light, labels, the dot
// at the place that is read. Needs THREE (three.min.js).
"use strict";

function bytes(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text).buffer;
  const raw = atob(text), out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) out[i] = raw.charCodeAt(i);
  return out.buffer;
}

// A colour of a picture, 0 to 255, in linear light.
const LIGHT = Float32Array.from({ length: 256 }, (_, value) => new THREE.Color().setRGB(value / 255, 0, 0, "srgb").r);

// Positions come as 16-bit numbers between the corners of the part's box.
function positions(part) {
  const q = new Uint16Array(bytes(part.positions)), out = new Float32Array(q.length);
  for (let i = 0; i < q.length; i++) {
    const k = i % 3;
    out[i] = part.low[k] + (q[i] / 65535) * (part.high[k] - part.low[k]);
  }
  return out;
}

function mesh(part) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions(part), 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(bytes(part.triangles)), 1));
  setNormals(geometry);
  const clear = part.opacity < 1;
  const material = new THREE.MeshStandardMaterial({
    metalness: 0, roughness: 0.55, transparent: clear, opacity: part.opacity, depthWrite: !clear,
    side: clear ? THREE.DoubleSide : THREE.FrontSide, vertexColors: typeof part.colours === "string",
    forceSinglePass: true, // three.js draws what is clear twice, from behind and in front: for a thin wall that is one
  });
  if (material.vertexColors) {
    geometry.setAttribute("color", new THREE.BufferAttribute(colours(part), 3));
  } else {
    material.color.setRGB(...part.colours, "srgb");
  }
  const out = new THREE.Mesh(geometry, material);
  out.renderOrder = clear ? 1 : 0;
  out.userData.triangles = part.triangles;
  return out;
}

// Another shape of a part that has as many vertices: false if it has not, or its triangles are others.
function renewed(old, part) {
  const at = old.geometry.getAttribute("position"), moved = positions(part);
  if (at.array.length !== moved.length || (part.triangles && part.triangles !== old.userData.triangles)) {
    part.triangles = part.triangles || old.userData.triangles;
    return false;
  }
  at.array.set(moved);
  at.needsUpdate = true;
  setNormals(old.geometry);
  old.geometry.computeBoundingSphere();
  if (typeof part.colours === "string") {
    const colour = old.geometry.getAttribute("color");
    colour.array.set(colours(part));
    colour.needsUpdate = true;
  }
  return true;
}

// As computeVertexNormals of three.js, in a fraction of its time: shapes come twenty times a second.
function setNormals(geometry) {
  const p = geometry.getAttribute("position").array, triangles = geometry.index.array;
  const n = geometry.getAttribute("normal")?.array.fill(0) || new Float32Array(p.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = p[c] - p[b], uy = p[c + 1] - p[b + 1], uz = p[c + 2] - p[b + 2];
    const vx = p[a] - p[b], vy = p[a + 1] - p[b + 1], vz = p[a + 2] - p[b + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx; // as long as twice the area: large triangles count more
    n[a] += x; n[a + 1] += y; n[a + 2] += z;
    n[b] += x; n[b + 1] += y; n[b + 2] += z;
    n[c] += x; n[c + 1] += y; n[c + 2] += z;
  }
  for (let i = 0; i < n.length; i += 3) {
    const size = Math.sqrt(n[i] ** 2 + n[i + 1] ** 2 + n[i + 2] ** 2) || 1; // Math.hypot takes ten times as long
    n[i] /= size; n[i + 1] /= size; n[i + 2] /= size;
  }
  if (geometry.getAttribute("normal")) geometry.getAttribute("normal").needsUpdate = true;
  else geometry.setAttribute("normal", new THREE.BufferAttribute(n, 3));
}

function discard(item) {
  item.removeFromParent();
  item.traverse((each) => {
    if (each.geometry) each.geometry.dispose();
    if (each.material) each.material.dispose();
  });
}

function colours(part) {
  return Float32Array.from(new Uint8Array(bytes(part.colours)), (value) => LIGHT[value]);
}

function curve(line, material) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(line.points.flat()), 3));
  return new THREE.Line(geometry, material);
}

function light(scene) {
  scene.add(new THREE.HemisphereLight(0xffffff, 0xc3ccd6, 2.2));
  const sun = new THREE.DirectionalLight(0xffffff, 1.6);
  sun.position.set(-0.6, 1.4, 1.0);
  scene.add(sun);
}

// A label, in the box of one before where there is one.
function tag(stage, label, before) {
  const box = before || stage.appendChild(document.createElement("span"));
  box.className = label.above ? "tag above" : "tag";
  if (box.textContent !== label.text) box.textContent = label.text;
  return { box, at: new THREE.Vector3(...label.at) };
}

// A dot at the place that is read.
function readingMark() {
  const size = 0.012, corners = [size, 0, 0, -size, 0, 0, 0, size, 0, 0, -size, 0, 0, 0, size, 0, 0, -size];
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(corners), 3));
  geometry.setIndex([0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5]);
  geometry.computeVertexNormals();
  const material = new THREE.MeshStandardMaterial({ emissive: 0xeb7500, color: 0xeb7500, depthTest: false });
  const dot = new THREE.Mesh(geometry, material);
  dot.renderOrder = 2;
  dot.visible = false;
  return dot;
}

// The rod in its hole, as the viewer draws it.

const $ = (id) => document.getElementById(id);

export class Scene {
  constructor(element, page) {
    this.element = element;
    this.page = page; // state(), shown(), begun(viewer)
    this.viewer = null; // false without WebGL
    this.known = false; // whether the viewer has the triangles of the scene
  }

  show(found) {
    if (typeof rodwellViewer === "undefined") { // read after the page's scripts, which ask first
      addEventListener("load", () => { if (this.page.shown() === found) this.show(found); }, { once: true });
      return;
    }
    this.element.querySelectorAll(".tag, .scale").forEach((each) => { each.style.visibility = ""; });
    const content = { ...found.scene, embedded: true };
    if (this.viewer === null) this.begin(content);
    else if (this.viewer) this.viewer.show(content);
    this.known = Boolean(this.viewer);
  }

  begin(content) {
    $("true-scale").checked = this.page.state().scale === "true";
    this.viewer = rodwellViewer(this.element, content);
    if (!this.viewer) return;
    this.page.begun(this.viewer);
    $("true-scale").onchange?.();
  }

  mark(fraction) { if (this.viewer) this.viewer.mark(fraction); }

  // The scale is that of the state, which an address may have changed.
  scale() {
    const isTrue = this.page.state().scale === "true";
    if (!this.viewer || $("true-scale").checked === isTrue) return;
    $("true-scale").checked = isTrue;
    $("true-scale").onchange?.();
  }
}

// The load from one end of its range to the other, in nine seconds.

export class Player {
  constructor(button, page) {
    this.button = button;
    this.page = page; // state(), diagram(), go(changes, done), held()
    this.since = 0;
    button.onclick = () => this.turn();
  }

  turn() { this.play(!this.since); }

  play(on) {
    this.since = on ? performance.now() : 0;
    this.button.textContent = on ? "■ Stop" : "▶ Play";
    this.button.setAttribute("aria-pressed", String(Boolean(on)));
    if (on) this.begin();
  }

  begin() { // at once, or as soon as there is a diagram
    if (!this.since) return;
    const diagram = this.page.diagram();
    if (!diagram) {
      requestAnimationFrame(() => this.begin());
      return;
    }
    const [low, high] = diagram.range, state = this.page.state();
    let at = state.load < high - 0.01 * (high - low) ? state.load : low;
    let before = performance.now();
    const step = (now) => {
      if (!this.since) return;
      if (this.page.held()) { before = now; requestAnimationFrame(step); return; } // the rod snaps: the load waits
      at += ((high - low) * Math.min(Math.max(now - before, 0), 200)) / 9000;
      before = now;
      const branch = state.branch === "straight" ? "" : state.branch;
      this.page.go({ load: Number(Math.min(at, high).toPrecision(6)), special: null, branch }, at >= high);
      if (at >= high) this.play(false);
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}

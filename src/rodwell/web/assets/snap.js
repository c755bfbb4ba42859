// A snap of the load path: the rod goes from one of its two states to the other, at a pace that is the page's own.

const LASTS = 700; // milliseconds
const PATIENCE = 4000; // for the two states; then the new state is shown without them

export class Snaps {
  constructor(label, page) {
    this.label = label;
    this.page = page; // diagram(), rod(), ask({branch, special}), blank(), show(state)
    this.pending = null; // the newest state, while the rod goes over
  }

  // Whether a state is to wait: the rod snaps on the way to it from the one shown, or is just going over.
  holds(found, before) {
    if (this.pending) { this.pending = found; return true; }
    const snap = before && this.page.rod() && !matchMedia("(prefers-reduced-motion: reduce)").matches ? crossed(this.page.diagram(), before, found) : null;
    if (!snap) return false;
    this.pending = found;
    this.page.blank();
    this.page.ask(snap);
    this.waiting = setTimeout(() => this.end(), PATIENCE);
    return true;
  }

  // Between the scenes of its two states.
  play([from, to]) {
    if (!this.pending) return;
    clearTimeout(this.waiting);
    this.label.hidden = false;
    const rod = this.page.rod(), began = performance.now();
    rod.between(from, to, 0);
    const step = (now) => {
      if (!this.pending) return;
      const t = Math.min(Math.max(now - began, 0) / LASTS, 1);
      rod.between(from, to, t * t * (3 - 2 * t));
      if (t < 1) this.frame = requestAnimationFrame(step);
      else this.end();
    };
    this.frame = requestAnimationFrame(step);
  }

  end() {
    const found = this.pending;
    this.stop();
    if (found) this.page.show(found);
  }

  // Other inputs are wanted, or it is over.
  stop() {
    clearTimeout(this.waiting);
    cancelAnimationFrame(this.frame);
    this.label.hidden = true;
    this.pending = null;
  }
}

// The last snap that the load passes from one state to another on the same leg, or from the rod on the wall to the leg.
export function crossed(diagram, before, after) {
  const leg = diagram.branches.find((b) => b.breaks && b.name === after.branch);
  if (!leg) return null;
  const loading = leg === diagram.branches.find((b) => b.breaks);
  if (before.branch !== leg.name && (!loading || before.beyond)) return null;
  const way = loading ? 1 : -1; // the load grows on the first leg
  const passed = (p) => p.kind === "snap" && way * (p.load - before.load) > 0 && way * (after.load - p.load) >= 0;
  const special = leg.special.findLastIndex(passed);
  return special < 0 ? null : { branch: leg.name, special };
}

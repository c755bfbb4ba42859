// The connection to the server: requests of one kind take each other's place, answers that come too late are dropped.
// States on the way to the newest load are shown: a load that is dragged asks for more than can be computed. Where an
// input is dragged, the next one waits until the state shown has been followed to the one before.

const ON_THE_WAY = "state";
const OF_INPUTS = ["diagram", "follow"];
const PATIENCE = 1000; // milliseconds for a state to be followed: on a busy machine it takes hundreds, and what is broken off shows none

export class Link {
  constructor(heard, lost) {
    this.heard = heard; // (message) => void, for answers that are still wanted
    this.lost = lost; // (isLost) => void
    this.newest = {}; // number of the newest request of each kind
    this.dropped = {}; // number of the last request of each kind that is no longer wanted, whatever comes
    this.number = 0;
    this.waiting = {}; // requests not sent yet: one of each kind
    this.running = {}; // kind → number of the request that is being answered
    this.following = null; // number of the diagram before which a state is being followed
    this.wait = 200;
    this.open();
  }

  open() {
    const address = new URL("talk", location.href);
    address.protocol = "ws:";
    address.hash = "";
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.onopen = () => { this.wait = 200; this.running = {}; this.following = null; };
    socket.onmessage = (event) => this.take(JSON.parse(event.data));
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.running = {};
      this.lost(true);
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(this.wait * 1.6, 2000);
    };
  }

  take(message) {
    if (message.kind === "hello") { this.lost(false); this.heard(message); return; }
    const release = message.id === this.following;
    if (message.kind === "followed" || message.kind === "lost") { // for a diagram that a newer one may be about to end
      const kind = message.last ? "follow" : "diagram"; // a state of the load path is all that was asked for
      if (message.last && this.running[kind] === message.id) delete this.running[kind];
      if (message.id > (this.dropped[kind] ?? 0)) this.heard({ ...message, passing: message.id !== this.newest[kind] });
    } else this.answered(message);
    if (release) this.release();
  }

  answered(message) {
    const kind = Object.keys(this.running).find((each) => this.running[each] === message.id);
    if (message.last && kind) delete this.running[kind];
    const late = kind === ON_THE_WAY && this.newest[kind] && message.id > (this.dropped[kind] ?? 0);
    const wanted = kind && (this.newest[kind] === message.id || late);
    if (message.last) this.next(kind); // computed while this one is drawn
    if (wanted && message.kind !== "cancelled") this.heard({ ...message, of: kind });
  }

  // Ask; what was asked of the same kind before is no longer wanted. Returns the number of the request. Its content may
  // be a function, called when it is sent: that of one which is patient waits until a state has been followed.
  ask(kind, content, patient = false) {
    this.number += 1;
    this.newest[kind] = this.number;
    this.waiting[kind] = { id: this.number, content };
    if (!patient || this.following === null) this.next(kind);
    return this.number;
  }

  // Whether a request of a kind waits, or is being answered.
  under(kind) { return Boolean(this.waiting[kind] || this.running[kind]); }

  release() {
    clearTimeout(this.tired);
    this.following = null;
    this.next("diagram");
    this.next("follow");
  }

  // What is no longer wanted, whatever comes.
  drop(...kinds) {
    kinds.forEach((kind) => { this.newest[kind] = null; this.dropped[kind] = this.number; delete this.waiting[kind]; });
  }

  next(kind) {
    const waiting = this.waiting[kind];
    // for newer inputs it goes out at once and ends the older one; of the others one is under way at a time
    if (!waiting || this.socket.readyState !== WebSocket.OPEN || (this.running[kind] && !OF_INPUTS.includes(kind))) return;
    delete this.waiting[kind];
    const { id, content } = waiting, request = { kind, id, ...(typeof content === "function" ? content() : content) };
    this.running[kind] = id;
    if (request.from) {
      clearTimeout(this.tired);
      this.following = id;
      this.tired = setTimeout(() => this.release(), PATIENCE);
    }
    this.socket.send(JSON.stringify(request));
  }
}

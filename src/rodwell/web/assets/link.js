// The connection to the server: requests of one kind take each other's place, answers that come too late are dropped.
// States on the way to the newest load are shown: a load that is dragged asks for more than can be computed.

const ON_THE_WAY = "state";

export class Link {
  constructor(heard, lost) {
    this.heard = heard; // (message) => void, for answers that are still wanted
    this.lost = lost; // (isLost) => void
    this.newest = {}; // number of the newest request of each kind
    this.dropped = {}; // number of the last request of each kind that is no longer wanted, whatever comes
    this.number = 0;
    this.waiting = {}; // requests not sent yet: one of each kind
    this.running = {}; // kind → number of the request that is being answered
    this.wait = 200;
    this.open();
  }

  open() {
    const address = new URL("talk", location.href);
    address.protocol = "ws:";
    address.hash = "";
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.onopen = () => { this.wait = 200; this.running = {}; };
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
    const kind = Object.keys(this.running).find((each) => this.running[each] === message.id);
    if (message.last && kind) delete this.running[kind];
    const late = kind === ON_THE_WAY && this.newest[kind] && message.id > (this.dropped[kind] ?? 0);
    const wanted = kind && (this.newest[kind] === message.id || late);
    if (wanted && message.kind !== "cancelled") this.heard({ ...message, of: kind });
    if (message.last) this.next(kind);
  }

  // Ask; what was asked of the same kind before is no longer wanted. Returns the number of the request.
  ask(kind, content) {
    this.number += 1;
    this.newest[kind] = this.number;
    this.waiting[kind] = { kind, id: this.number, ...content };
    this.next(kind);
    return this.number;
  }

  // What is no longer wanted, whatever comes.
  drop(...kinds) {
    kinds.forEach((kind) => { this.newest[kind] = null; this.dropped[kind] = this.number; delete this.waiting[kind]; });
  }

  next(kind) {
    const request = this.waiting[kind];
    // a newer diagram goes out at once and ends the older one; of the others one is under way at a time
    if (!request || this.socket.readyState !== WebSocket.OPEN || (this.running[kind] && kind !== "diagram")) return;
    delete this.waiting[kind];
    this.running[kind] = request.id;
    this.socket.send(JSON.stringify(request));
  }
}

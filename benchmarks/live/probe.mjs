// What runs in the page before its own modules, and notes when the hand moved, what the server was asked, and when the
// answers were in the picture. The page knows nothing of it.

/** Installs the notes. Runs in the page. */
export function installProbe() {
  const HEADER = 32;
  const asked = new Map();
  const probes = new Map();
  let hand = 0;
  const noteHand = (event) => (hand = event.timeStamp);
  for (const told of ["pointerrawupdate", "pointermove"]) addEventListener(told, noteHand, true);

  /** Notes once what came until now is drawn, and the browser composes the picture. */
  const noteDrawn = (of, name) => {
    if (name in of) return;
    of[name] = undefined;
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => (of[name] = performance.now());
    requestAnimationFrame(() => port2.postMessage(0));
  };

  const takeTiles = (bytes) => {
    const view = new DataView(bytes);
    for (let at = 0; at + HEADER <= bytes.byteLength; at += view.getUint32(at, true)) {
      const move = asked.get(view.getUint32(at + 4, true));
      if (!move) continue;
      noteDrawn(move, "firstDrawn");
      // Once the last pass begins, the one before is over.
      if (view.getUint8(at + 10) === 1) noteDrawn(move, "ninthDrawn");
    }
  };
  const takeText = ({ type, seq }) => {
    if (type === "done" && asked.has(seq)) noteDrawn(asked.get(seq), "allDrawn");
    if (type === "probe" && probes.has(seq)) noteDrawn(probes.get(seq), "drawn");
  };

  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(...address) {
      super(...address);
      this.addEventListener("message", ({ data }) =>
        typeof data === "string" ? takeText(JSON.parse(data)) : takeTiles(data),
      );
    }
    send(text) {
      const { type, seq } = JSON.parse(text);
      const sent = performance.now();
      if (type === "view" || type === "move") asked.set(seq, { type, input: type === "move" ? hand : sent, sent });
      if (type === "probe") probes.set(seq, { input: sent });
      super.send(text);
    }
  };
  window.figures = {
    /** All moves and views since the last call. */
    take: () => {
      const all = { moves: [...asked.values()], probes: [...probes.values()] };
      asked.clear();
      probes.clear();
      return all;
    },
    settled: () => [...asked.values()].at(-1)?.allDrawn !== undefined,
    probed: () => [...probes.values()].at(-1)?.drawn !== undefined,
  };
}

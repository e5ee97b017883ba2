// A decoder of what arrives on a line, in any pieces: messages, unknown frames and noise.
"use strict";

// What arrives is copied into blocks of so many bytes, which the events of a line show parts of.
const BLOCK = 1 << 16;

function makeStreams(layout, { weigh, waits }, Event) {
  const Reason = layout.protocol.reasons;

  // What stands at `at`: a "message", an "unknown" frame, "noise", or something "begun" that the
  // bytes to come, from `end` on, decide.
  function judged(verdict, line, look, at, end) {
    const { frame, reason, claim, provable, proven } = verdict;
    if (frame) return "message";
    if (provable) return claim > end - at ? "begun" : proven ? "unknown" : "noise";
    if (reason === Reason.tooShort) return "begun";
    return claim ? fateOf(line, look, at, at + claim, end) : "noise";
  }

  // What becomes of a frame of unknown id, from `at` to `claimed`, that nothing proves: a message that
  // begins, or may begin, among its own bytes is worth more. Looked for from the end, where a begun
  // header is found at once. Places where no frame can begin are remembered, with as many bytes as
  // that takes to know.
  function fateOf(line, look, at, claimed, end) {
    const whole = claimed <= end, limit = whole ? claimed : end;
    for (let inside = limit - 1; inside > at; inside--) {
      if (!line.begins[look.bytes[inside]] || look.dead.get(inside) <= limit) continue;
      const verdict = weigh(line, look, inside, limit), waiting = waits(verdict, limit - inside);
      if (verdict.frame || verdict.proven || (whole && waiting)) return "noise";
      if (!waiting) look.dead.set(inside, limit);
    }
    return whole ? "unknown" : "begun";
  }

  // Whether a frame begins at `at`, as far as its header goes.
  function isHeader(line, bytes, at, end) {
    return line.listeners.some(({ envelope: { header, begins } }) => {
      if (!header.length) return !begins.size || begins.has(bytes[at]);
      if (at + header.length > end) return false;
      for (let i = 0; i < header.length; i++) if (bytes[at + i] !== header[i]) return false;
      return true;
    });
  }

  // A decoder of one line. `feed` and `flush` return events, which together hold every byte. What has
  // begun is kept back until it is decided, at most `maxFrame` bytes, or as many as the largest frame
  // has.
  return function makeStream({ direction = null, maxFrame = Infinity } = {}) {
    const line = makeLine(layout, direction, maxFrame);
    // Bytes from `at` to `end` of the block are undecided; its first one stands at `base` on the line.
    let block = new Uint8Array(0), at = 0, end = 0, base = 0, look = lookAt(block);
    // The noise at hand, which grows: why it is none, and where on the line that showed. A refused
    // header begins a new piece of it, unless it overlaps the one before and is refused alike, as in a
    // run of header bytes.
    let why = null, piece = null;

    function take(arrived) {
      const bytes = arrived instanceof Uint8Array ? arrived : Uint8Array.from(arrived);
      if (end + bytes.length > block.length) {
        const held = block.subarray(at, end);
        block = new Uint8Array(Math.max(BLOCK, held.length + bytes.length));
        block.set(held);
        [base, at, end] = [base + at, 0, held.length];
        look = lookAt(block);
      }
      block.set(bytes, end);
      end += bytes.length;
    }

    function addNoise(events, verdict, size) {
      const header = isHeader(line, block, at, end), place = base + at;
      if (header && why && why.header === place - 1 && why.reason === verdict.reason) {
        why.header = place;
      } else if (header || !why) {
        const { reason } = header ? verdict : { reason: Reason.header };
        why = { reason, header: header ? place : NaN, refusedAt: place + verdict.offset };
        piece = null;
      }
      if (!piece) {
        piece = new Event("noise", place, 0, null, why.reason, why.refusedAt, block, at);
        events.push(piece);
      }
      piece.size += size;
    }

    // How many bytes from `at` on, the first among them, cannot begin a frame before the next one can.
    function noiseFrom(start) {
      let next = start + 1;
      while (next < end && !line.begins[block[next]]) next++;
      return next - start;
    }

    function search(arrived, quiet) {
      take(arrived);
      const events = [];
      piece = null;
      while (at < end) {
        if (at > look.base + WINDOW) look = lookAt(block, at);
        const verdict = weigh(line, look, at, end, quiet);
        const type = judged(verdict, line, look, at, end);
        if (type === "begun" && !quiet) break;
        if (type !== "message" && type !== "unknown") {
          const size = noiseFrom(at);
          addNoise(events, verdict, size);
          at += size;
          continue;
        }
        const { frame, reason, offset, claim } = verdict, size = frame ? frame.size : claim;
        why = piece = null;
        events.push(new Event(type, base + at, size, frame, frame ? null : reason,
          frame ? null : base + at + offset, block, at));
        at += size;
      }
      if (quiet) why = null;
      return events;
    }

    return {
      // These bytes have arrived, and more may follow.
      feed: (bytes) => search(bytes, false),
      // The line has gone quiet, after these bytes: what has begun goes no further.
      flush: (bytes = []) => search(bytes, true),
      // How many bytes are kept back.
      get pending() { return end - at; },
      // How many bytes are decided.
      get position() { return base + at; },
    };
  };
}

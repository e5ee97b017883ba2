// A conversation over a line: bytes and the time go in, and what they say comes out. Times are in
// milliseconds. It has no clock, no port and no page.
"use strict";

// So long after the last byte a frame that has begun is given up; the Python client waits as long: an
// adapter gathers bytes for up to 16 ms.
const QUIET_MS = 50;
// So long after its last byte has left, the echo of a frame is lost.
const ECHO_MS = 250;

// `show(entry)` gets all that passes: {at, sender, isSent, event, names}. `answered(answer)` gets the
// answers of makeReplies, `unanswered(question, isEnded)` the questions that have none. `direction` is what
// is listened to, null for both ends of the line.
function makeSession({ codec, protocol, direction, baud, localEcho, timeout, show, answered, unanswered }) {
  const data = protocol.line, stream = codec.makeStream({ direction }), limits = makeLimits(data);
  const replies = makeReplies(data, baud, timeout), echo = localEcho ? makeLocalEcho() : null;
  const counts = { bytes: 0, frames: 0, noise: 0, errors: 0, sent: 0, echoes: 0 };
  const senders = new Map(protocol.directions.map(({ key, sender }) => [key, sender]));
  let fed = 0, decided = 0, lastByteAt = 0;

  // The names of the messages that some bytes may be, and who has sent them, null for either.
  function origin(event) {
    if (direction !== null) {
      return { names: event.message ? [event.message] : [], sender: senders.get(direction) };
    }
    if (event.type !== "message") return { names: [], sender: null };
    const found = protocol.directions.filter(({ key }) => codec.decodeFrame(event.bytes, key).message);
    const names = found.map(({ key }) => codec.decodeFrame(event.bytes, key).message);
    return { names, sender: found.length === 1 ? found[0].sender : null };
  }

  function takeIn(events, now) {
    for (const event of events) {
      decided += event.bytes.length;
      if (event.type === "message") counts.frames += 1;
      else counts.noise += event.bytes.length;
      const answer = event.type === "message" ? replies.received(event, now) : null;
      show({ at: now, isSent: false, event, ...origin(event), answer });
      if (answer) answered(answer);
    }
  }

  function read(bytes, now) {
    fed += bytes.length;
    takeIn(stream.feed(bytes), now);
  }

  function loseEchoes(lost) {
    counts.errors += lost;
  }

  return {
    counts,

    // Bytes have come.
    received(bytes, now) {
      counts.bytes += bytes.length;
      lastByteAt = now;
      if (!echo) return read(bytes, now);
      const { bytes: others, echoes, lost } = echo.takeOut(bytes);
      counts.echoes += echoes;
      loseEchoes(lost);
      return read(others, now);
    },

    // A frame is about to be handed to the line; the question that it asks, or null where nothing answers
    // it. Throws Unusable for what the Python client does not send within these bounds, null for any.
    sent(bytes, now, bounds = limits.usual) {
      const event = codec.decodeFrame(bytes, data.sent);
      limits.check(event, bounds);
      counts.sent += 1;
      if (echo) echo.sent(bytes, now + (1000 * bytes.length * data.bitsPerByte) / baud + ECHO_MS);
      show({ at: now, isSent: true, event, names: [event.message], sender: senders.get(data.sent) });
      return replies.sent(event, now);
    },

    // A question was not sent after all.
    forget: replies.forget,

    // So late is it now; all that came before has been received. Says whether half a frame was given up.
    tick(now) {
      if (echo) {
        const { bytes, lost } = echo.expire(now);
        loseEchoes(lost);
        if (bytes.length) read(bytes, lastByteAt);
      }
      const quiet = fed > decided && now >= lastByteAt + QUIET_MS;
      if (quiet) takeIn(stream.flush(), lastByteAt);
      // A reply that is just arriving gets a little longer.
      const until = fed > decided ? now - REPLY_TIMEOUT_MS : now;
      for (const question of replies.expire(until)) unanswered(question, false);
      return quiet;
    },

    // The line is gone, or closed: what had begun goes no further.
    end() {
      const pending = fed > decided;
      if (pending) takeIn(stream.flush(), lastByteAt);
      echo?.clear();
      for (const question of replies.clear()) unanswered(question, true);
      return pending;
    },

    // When to call `tick`, at the latest; null while nothing is due.
    get due() {
      const times = [fed > decided ? lastByteAt + QUIET_MS : null, echo?.due ?? null, replies.due];
      const known = times.filter((time) => time !== null);
      return known.length ? Math.max(Math.min(...known), fed > decided ? lastByteAt + QUIET_MS : 0) : null;
    },

    get waiting() { return replies.waiting; },
  };
}

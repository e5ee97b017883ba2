// Reads and writes the frames of the protocol that `protocol` describes: bytes in, messages and
// noise out. It says what framegen's reference says, byte for byte, and touches no page.
"use strict";

function makeCodec(protocol) {
  const layout = makeLayout(protocol), { kinds, frameOf } = layout;
  const verdicts = makeVerdicts(layout), values = makeValues(layout), rows = makeRows(layout, values);
  const Event = makeEvent({ ...values, ...rows });
  const lines = new Map();

  function lineOf(direction) {
    if (!lines.has(direction)) lines.set(direction, makeLine(layout, direction, Infinity));
    return lines.get(direction);
  }

  // What bytes are as exactly one frame: the frame, or the reason and byte where not.
  function judge(bytes, direction) {
    const { frame, reason, offset } = verdicts.weigh(lineOf(direction), lookAt(bytes), 0, bytes.length);
    const isLonger = frame && frame.size < bytes.length;
    return isLonger ? { frame: null, reason: protocol.reasons.trailing, offset } : { frame, reason, offset };
  }

  // One frame, whole and with nothing after it, as an event; or the reason and byte where not.
  function decodeFrame(given, direction = null) {
    const bytes = Uint8Array.from(given), { frame, reason, offset } = judge(bytes, direction);
    return frame ? new Event("message", 0, bytes.length, frame, null, null, bytes, 0) : { reason, offset };
  }

  // The event of a message whose place and size are known.
  function frameAt(bytes, at, size, kind, start = at) {
    return new Event("message", at, size, frameOf(kind, size), null, null, bytes, start);
  }

  const codec = {
    kinds,
    directions: protocol.directions,
    makeStream: makeStreams(layout, verdicts, Event),
    encode: makeEncode(layout, verdicts),
    decodeFrame,
    frameAt,
    inWords,
  };
  // Pages that explain nothing have no script for it.
  if (typeof makeExplain === "function") codec.explain = makeExplain(layout, { ...verdicts, ...rows, judge });
  return codec;
}

// What some bytes are as one frame; or where and why they are none, and what they may be instead. In
// the words of `framegen explain`.
"use strict";

function makeExplain(layout, { judge, checksumOf, rowOf, rowsOf, isField }) {
  const { protocol } = layout, Reason = protocol.reasons, nearby = makeClosest(layout);
  const { closest, lengthOf, layOutAt, headOf } = nearby;

  // A checksum that a whole frame should have; `ids` are those of its message.
  function rightOf(envelope, slot, bytes, ids) {
    return writeNumber(slot, checksumOf(envelope, slot, ids, bytes.length, lookAt(bytes), 0));
  }

  // A whole frame with the checksums that it should have.
  function sealed(envelope, bytes, ids) {
    const mended = Uint8Array.from(bytes);
    for (const slot of envelope.checksums) {
      const right = rightOf(envelope, slot, mended, ids);
      mended.set(right, slot.at < 0 ? bytes.length + slot.at : slot.at);
    }
    return mended;
  }

  const tools = { judge, rightOf, sealed, isField };
  const refusals = makeRefusals(layout, tools, nearby);
  const { hintsOn } = makeHints(layout, tools, nearby, refusals, makeLookalikes(layout, tools, nearby));

  function readingOf(frame, bytes, way) {
    const { kind } = frame, hex = toHex(bytes);
    const examples = kind.documented.filter((each) => each.hex === hex).map(({ text }) => ["example", text]);
    const facts = [...kind.facts.slice(0, -1), ...examples, ...kind.facts.slice(-1)];
    return { message: kind.name, kind, direction: way.arrow, way, summary: kind.summary,
      rows: rowsOf(frame, bytes), facts };
  }

  function refusalOf(bytes, way, { reason, offset }) {
    const attempts = closest(way, bytes, reason, offset), expected = new Map();
    for (const attempt of attempts) {
      const due = refusals.expected({ ...attempt, bytes, reason, offset, way });
      if (!expected.has(due)) expected.set(due, attempt.name);
    }
    const words = [...expected].map(([due, name]) => (expected.size > 1 ? `${name}: ${due}` : due));
    const [{ envelope, kind }] = attempts, known = attempts.length === 1 ? kind : null;
    const rows = slotsUpTo(envelope, kind, bytes, offset).map((placed) => rowOf(placed, bytes, known));
    return { direction: way.arrow, way, reason, offset, expected: words.join("; "), rows };
  }

  // The slots up to an offset, in frames of a message if it is known.
  function slotsUpTo(envelope, kind, bytes, end) {
    const head = headOf(envelope), length = kind && lengthOf(kind, bytes);
    const isInHead = head.length && end < endOf(head[head.length - 1]);
    const slots = !kind || length === null || isInHead ? head : layOutAt(kind, length);
    return slots.filter((placed) => endOf(placed) <= end);
  }

  // The direction in which the bytes came closest to a frame is first.
  const distance = ({ reason, rows }) => (reason === Reason.unknown ? 1e9 : 0) - rows.length;

  // The bytes as one frame sent in a direction, or in any where it is null.
  return function explain(given, direction = null) {
    const bytes = Uint8Array.from(given), readings = [], found = [];
    for (const way of protocol.directions) {
      if (direction !== null && way.key !== direction) continue;
      const judgement = judge(bytes, way.key);
      if (judgement.frame) readings.push(readingOf(judgement.frame, bytes, way));
      else found.push(refusalOf(bytes, way, judgement));
    }
    found.sort((one, other) => distance(one) - distance(other));
    const hints = readings.length ? [] : hintsOn(bytes, found);
    return { protocol: protocol.title, bytes, readings, refusals: found, hints };
  };
}

// Reads and writes the frames of the protocol that `protocol` describes: bytes in, messages and
// noise out. It says what framegen's reference says, byte for byte, and touches no page.
"use strict";

// What was typed cannot be used; the message says why.
class Unusable extends Error {}

// Hex as people paste it: spaced or glued, with 0x or \x, commas, colons, dashes and # comments.
// What framegen's hextext.py reads, and nothing else.
function parseHex(text) {
  const bytes = [];
  const plain = text.replace(/#[^\n]*/g, " ");
  for (const [word] of plain.matchAll(/[^ \t\n\r\v\f\u00a0\ufeff,:;_-]+/g)) {
    if (!/^(?:(?:0x|\\x)?[0-9a-f]{2})*(?:(?:0x|\\x)[0-9a-f])?$/i.test(word)) {
      const wrong = /[^0-9a-f]/i.exec(word.replace(/0x|\\x/gi, ""));
      if (wrong) throw new Unusable(`“${wrong[0]}” in “${word}” is no hex digit`);
      throw new Unusable(`“${word}” is no whole number of bytes`);
    }
    for (const [, digits] of word.matchAll(/(?:0x|\\x)?([0-9a-f]{1,2})/gi)) {
      bytes.push(parseInt(digits, 16));
    }
  }
  return bytes;
}

function toHex(bytes) {
  return bytes.map((byte) => byte.toString(16).toUpperCase().padStart(2, "0")).join(" ");
}

// The number of a slot whose bytes begin at `at`.
function readNumber({ size, order, signed }, bytes, at) {
  let value = 0;
  for (let i = 0; i < size; i++) {
    value = value * 256 + bytes[at + (order === "little" ? size - 1 - i : i)];
  }
  return signed && value >= 2 ** (8 * size - 1) ? value - 2 ** (8 * size) : value;
}

// The bytes that stand for `value` in a slot.
function writeNumber({ size, order }, value) {
  let rest = value < 0 ? value + 2 ** (8 * size) : value;
  const bytes = [];
  for (let i = 0; i < size; i++, rest = Math.floor(rest / 256)) bytes.push(rest % 256);
  return order === "little" ? bytes : bytes.reverse();
}

// A number of an element: `targets[0].position`, or `ids[0]`.
function pathOf(list, index, field) {
  return `${list.name}[${index}]` + (list.element === null ? "" : `.${field.name}`);
}

// What stands where in a frame of `size` bytes with `count` elements, in its order.
function layOut(slots, size, count) {
  return slots.flatMap((slot) => {
    const at = slot.at < 0 ? size + slot.at : slot.at;
    if (slot.role !== "list") return { path: slot.name, at, slot };
    return Array.from({ length: count }, (_, index) => slot.fields.map((field) => (
      { path: pathOf(slot, index, field), at: at + index * slot.size + field.at, slot: field }
    ))).flat();
  });
}

function makeCodec(protocol) {
  const { reasons: Reason, frame: { least, uncounted, slots: envelope } } = protocol;
  const bodyIndex = envelope.findIndex((slot) => slot.role === "body");
  const head = envelope.slice(0, bodyIndex), tail = envelope.slice(bodyIndex + 1);
  const bodyAt = envelope[bodyIndex].at;
  const headerSize = envelope.find((slot) => slot.role !== "constant").at;
  const lengthSlot = envelope.find((slot) => slot.role === "length");
  const kinds = protocol.messages.map((message) => {
    const list = message.fields.find((slot) => slot.role === "list");
    const given = message.fields.filter((slot) => slot.role !== "count");
    return { ...message, slots: [...head, ...message.fields, ...tail], list, given, frames: new Map() };
  });

  // ---- What frames there are

  function sizeOf(kind, count) {
    return kind.size + (kind.list ? count * kind.list.size : 0);
  }

  // The frame of `size` bytes that a message has, and what stands where in it; null where it has none.
  function frameOf(kind, size) {
    const count = kind.list ? (size - kind.size) / kind.list.size : 0;
    const { low, high } = kind.counts;
    if (!Number.isInteger(count) || count < low || count > high || size !== sizeOf(kind, count)) {
      return null;
    }
    if (!kind.frames.has(size)) {
      const placed = layOut(kind.slots, size, count)
        .map((each) => ({ ...each, due: due(each.slot, kind, size, count) }));
      kind.frames.set(size, { kind, size, count, placed, inner: placed.slice(head.length) });
    }
    return kind.frames.get(size);
  }

  // The bytes that follow from the rest of the frame; none where a user gives them.
  function due(slot, kind, size, count) {
    switch (slot.role) {
      case "constant": return slot.bytes;
      case "length": return writeNumber(slot, size - uncounted);
      case "id": return writeNumber(slot, kind.id);
      case "count": return writeNumber(slot, count);
      default: return [];
    }
  }

  // What a line may carry: the messages of one direction by id, or of all where it is null; and how
  // large their frames can be there.
  function listenTo(direction, maxFrame) {
    const ways = protocol.directions.filter(({ key }) => direction === null || key === direction);
    const carried = ways.flatMap(({ key }) => kinds.filter((kind) => kind.direction === key));
    const named = new Map(carried.map(({ id }) => [id, carried.filter((kind) => kind.id === id)]));
    const sizes = carried.map((kind) => sizeOf(kind, kind.counts.high));
    return { named, largest: Math.min(maxFrame, Math.max(0, ...sizes)) };
  }

  // ---- Why bytes are no frame

  const refused = (reason, offset) => ({ frame: null, reason, offset });

  // Why the bytes `offset` bytes into a frame at `at` are not those of a slot; null where they are.
  // Those that it must have are `expected`; nothing from `limit` on is looked at.
  function misfit(slot, offset, expected, bytes, at, limit) {
    const start = at + offset;
    const wrong = expected.findIndex((byte, i) => start + i < limit && bytes[start + i] !== byte);
    if (wrong >= 0 && slot.role === "constant") return refused(Reason.header, offset + wrong);
    if (wrong >= 0) return refused(Reason.count, offset);
    if (start + slot.size > limit) return refused(Reason.tooShort, limit - at);
    if (slot.role === "constant") return null;
    const value = readNumber(slot, bytes, start);
    return value < slot.low || value > slot.high ? refused(Reason.range, offset) : null;
  }

  // What the bytes from `at` to `limit` begin: a frame; or none, for which reason, and at which
  // offset that shows. They are tested in the order in which they come, and the first that no frame
  // can have decides. "Too short" is what may become a frame.
  function weigh(line, bytes, at, limit) {
    let size = null, named = null, frames = [];
    for (const slot of head) {
      const wrong = misfit(slot, slot.at, slot.bytes || [], bytes, at, limit);
      if (wrong) return wrong;
      if (slot.role === "length") {
        size = readNumber(slot, bytes, at + slot.at) + uncounted;
        if (size < least || size > line.largest) return refused(Reason.length, slot.at);
      }
      if (slot.role === "id") {
        named = line.named.get(readNumber(slot, bytes, at + slot.at));
        if (!named) return refused(Reason.unknown, slot.at);
      }
      if (size !== null && named) {
        frames = named.map((kind) => frameOf(kind, size)).filter((frame) => frame);
        if (!frames.length) return refused(Reason.length, lengthSlot.at);
      }
    }
    return best(frames.map((frame) => weighFields(frame, bytes, at, limit)));
  }

  // What follows the head, as the rest of one frame.
  function weighFields(frame, bytes, at, limit) {
    for (const placed of frame.inner) {
      const wrong = misfit(placed.slot, placed.at, placed.due, bytes, at, limit);
      if (wrong) return wrong;
    }
    return { frame, reason: null, offset: frame.size };
  }

  // Of what several directions say, the first frame; or else the first of those that came furthest.
  function best(verdicts) {
    const furthest = Math.max(...verdicts.map(({ offset }) => offset));
    return verdicts.find(({ frame }) => frame) || verdicts.find(({ offset }) => offset === furthest);
  }

  // One frame, whole and with nothing after it: its message, or the reason and byte where not.
  function decodeFrame(bytes, direction) {
    const { frame, reason, offset } = weigh(listenTo(direction, Infinity), bytes, 0, bytes.length);
    if (!frame) return { reason, offset };
    return frame.size < bytes.length ? { reason: Reason.trailing, offset } : messageOf(frame, bytes);
  }

  // ---- What a line says

  // What stands at `at`: a "message", an "unknown" frame, "noise", or something "begun" that the
  // bytes to come decide; and how many bytes go with it.
  function judge(line, bytes, at) {
    const verdict = weigh(line, bytes, at, bytes.length);
    if (verdict.frame) return { type: "message", size: verdict.frame.size, ...verdict };
    if (verdict.reason === Reason.tooShort) return { type: "begun", size: 1, ...verdict };
    const claimed = verdict.reason === Reason.unknown ? claimOf(line, bytes, at) : 0;
    const type = claimed ? fateOf(line, bytes, at, at + claimed) : "noise";
    return { type, size: type === "unknown" ? claimed : 1, ...verdict };
  }

  // How many bytes a frame of unknown id says that it has, at the least; 0 where no frame has them.
  function claimOf(line, bytes, at) {
    if (at + bodyAt > bytes.length) return least;
    const size = readNumber(lengthSlot, bytes, at + lengthSlot.at) + uncounted;
    return size < least || size > line.largest ? 0 : size;
  }

  // What becomes of a frame of unknown id, from `at` to `end`. Nothing proves it: a message that
  // begins, or may begin, among its own bytes is worth more. Looked for from the end, where a begun
  // header is found at once.
  function fateOf(line, bytes, at, end) {
    const whole = end <= bytes.length, limit = whole ? end : bytes.length;
    for (let inside = limit - 1; inside > at; inside--) {
      const { frame, reason } = weigh(line, bytes, inside, limit);
      if (frame || (whole && reason === Reason.tooShort)) return "noise";
    }
    return whole ? "unknown" : "begun";
  }

  // A message or an unknown frame, as it is shown.
  function eventOf({ type, frame, reason, offset }, at, bytes) {
    const said = frame ? messageOf(frame, bytes) : { reason, refusedAt: at + offset };
    return { type, at, bytes, ...said };
  }

  // A decoder of what arrives on one line. `feed` and `flush` return events: messages, unknown
  // frames and noise, which together hold every byte. What has begun is kept back until it is
  // decided, at most `maxFrame` bytes, or as many as the largest frame has.
  function makeStream({ direction = null, maxFrame = Infinity } = {}) {
    const line = listenTo(direction, maxFrame);
    // What is kept back, and where on the line that stands.
    let held = [], base = 0;
    // The noise at hand, which grows. A refused header begins a new piece of it, unless it overlaps
    // the one before and is refused alike, as in a run of header bytes.
    let noise = null;

    function noiseWith({ reason, offset }, at) {
      const isHeader = offset >= headerSize;
      if (noise && !isHeader) return noise;
      if (noise?.header === at - 1 && noise.reason === reason) return Object.assign(noise, { header: at });
      const why = isHeader ? { reason, header: at } : { reason: Reason.header };
      return { type: "noise", at, bytes: [], refusedAt: at + offset, ...why };
    }

    function search(arrived, quiet) {
      held = [...held, ...arrived];
      const events = [];
      let at = 0;
      while (at < held.length) {
        const found = judge(line, held, at);
        if (found.type === "begun" && !quiet) break;
        const bytes = held.slice(at, at + found.size);
        if (found.type === "message" || found.type === "unknown") {
          noise = null;
          events.push(eventOf(found, base + at, bytes));
        } else {
          noise = noiseWith(found, base + at);
          if (events.at(-1) !== noise) events.push(noise);
          noise.bytes.push(...bytes);
        }
        at += found.size;
      }
      [held, base] = [held.slice(at), base + at];
      // What was returned is the caller's: what may follow goes into a piece of its own.
      noise = quiet || !noise ? null : { ...noise, at: base, bytes: [] };
      return events;
    }

    return {
      // These bytes have arrived, and more may follow.
      feed: (bytes) => search(bytes, false),
      // The line has gone quiet, after these bytes: what has begun goes no further.
      flush: (bytes = []) => search(bytes, true),
    };
  }

  // ---- Values

  // The message in a whole frame. Its `rows` are the slots with what stands in them.
  function messageOf(frame, bytes) {
    const { kind } = frame;
    const rows = frame.placed.map((placed) => ({
      ...placed,
      bytes: bytes.slice(placed.at, placed.at + placed.slot.size),
      value: placed.slot.role === "constant" ? null : readNumber(placed.slot, bytes, placed.at),
    }));
    const values = new Map(rows.map(({ path, value }) => [path, value]));
    const fields = kind.given.map((slot) => [slot.name, slot.role !== "list"
      ? values.get(slot.name)
      : Array.from({ length: frame.count }, (_, index) => itemOf(slot, index, values))]);
    return { kind, message: kind.name, fields: Object.fromEntries(fields), rows };
  }

  function itemOf(list, index, values) {
    const numbers = list.fields.map((field) => [field.name, values.get(pathOf(list, index, field))]);
    return list.element === null ? numbers[0][1] : Object.fromEntries(numbers);
  }

  // The frame that carries `fields`, as decodeFrame gives them. Throws Unusable.
  function encode(name, fields) {
    const kind = kinds.find((each) => each.name === name);
    const count = kind.list ? fields[kind.list.name].length : 0;
    const frame = frameOf(kind, sizeOf(kind, count));
    if (!frame) {
      const { low, high } = kind.counts;
      throw new Unusable(`${kind.list.name}: ${count} items is outside ${low}..${high}`);
    }
    const values = valuesOf(kind, fields);
    return frame.placed.flatMap(({ path, slot, due: known }) =>
      known.length ? known : writeNumber(slot, checked(path, values.get(path), slot)));
  }

  // The numbers that are given, by path.
  function valuesOf(kind, fields) {
    return new Map(kind.given.flatMap((slot) => slot.role !== "list"
      ? [[slot.name, fields[slot.name]]]
      : fields[slot.name].flatMap((item, index) => slot.fields.map((field) =>
        [pathOf(slot, index, field), slot.element === null ? item : item[field.name]]))));
  }

  function checked(path, value, { low, high }) {
    if (!Number.isInteger(value)) throw new Unusable(`${path}: a whole number is due`);
    if (value < low || value > high) throw new Unusable(`${path}: ${value} is outside ${low}..${high}`);
    return value;
  }

  return { kinds, makeStream, decodeFrame, encode };
}

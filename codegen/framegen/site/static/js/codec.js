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

// The number of a slot whose bytes begin at `at`; a BigInt where a number has too few digits.
function readNumber({ size, order, signed, float, wide }, bytes, at) {
  const own = bytes.slice(at, at + size);
  if (order === "little") own.reverse();
  if (float) {
    const view = new DataView(Uint8Array.from(own).buffer);
    return size === 4 ? view.getFloat32(0) : view.getFloat64(0);
  }
  if (wide) {
    const value = own.reduce((so, byte) => so * 256n + BigInt(byte), 0n);
    return signed ? BigInt.asIntN(8 * size, value) : value;
  }
  const value = own.reduce((so, byte) => so * 256 + byte, 0);
  return signed && value >= 2 ** (8 * size - 1) ? value - 2 ** (8 * size) : value;
}

// The bytes that stand for `value` in a slot.
function writeNumber({ size, order, float }, value) {
  const view = new DataView(new ArrayBuffer(8));
  if (float && size === 4) view.setFloat32(4, value);
  else if (float) view.setFloat64(0, value);
  else view.setBigInt64(0, BigInt.asIntN(64, BigInt(value)));
  const bytes = [...new Uint8Array(view.buffer)].slice(8 - size);
  return order === "little" ? bytes.reverse() : bytes;
}

// Numbers of `width` bits that stand behind each other, and back.
function readPacked({ size, order, width, count, wide }, bytes, at) {
  const whole = readNumber({ size, order, wide: true }, bytes, at);
  const values = Array.from({ length: count }, (_, i) => BigInt.asUintN(width, whole >> BigInt(i * width)));
  if (order === "big") values.reverse();
  return wide ? values : values.map(Number);
}

function writePacked({ size, order, width }, values) {
  const lowestFirst = order === "big" ? [...values].reverse() : values;
  const whole = lowestFirst.reduceRight((so, value) => (so << BigInt(width)) | BigInt(value), 0n);
  const bytes = Array.from({ length: size }, (_, i) => Number((whole >> BigInt(8 * i)) & 255n));
  return order === "big" ? bytes.reverse() : bytes;
}

// Text without the zeros at its end, and back; those of a list are all of it.
const textOf = (bytes) => String.fromCharCode(...bytes);
const bytesOf = (text) => [...text].map((character) => character.codePointAt(0));

// A number of an element: `targets[0].position`, or `ids[0]`.
function pathOf(list, index, field) {
  return `${list.name}[${index}]` + (list.element === null ? "" : `.${field.name}`);
}

function makeCodec(protocol) {
  const Reason = protocol.reasons, begins = new Set(protocol.begins);
  const isNumber = (slot) => "order" in slot && slot.role !== "packed";
  const fixed = (slot) => (slot.role === "constant" ? slot.bytes : []);
  const countsList = ({ role }) => role === "count" || role === "size";

  // Numbers with more digits than those of a browser come as text. The `fields` of a list are those
  // slots of an element that have a value.
  function prepared(slot) {
    if (slot.wide) Object.assign(slot, { low: BigInt(slot.low), high: BigInt(slot.high) });
    if (slot.slots) slot.fields = slot.slots.map(prepared).filter((each) => !("bytes" in each));
    return slot;
  }

  const envelopes = new Map(protocol.frames.map((frame) => {
    const slots = frame.slots.map(prepared), body = slots.findIndex(({ role }) => role === "body");
    const head = slots.slice(0, body), tail = slots.slice(body + 1);
    return [frame.name, {
      ...frame, head, tail, bodyAt: slots[body].at, begins: new Set(frame.begins),
      tailSize: tail.reduce((sum, { size }) => sum + size, 0),
      lengthSlot: slots.find(({ role }) => role === "length"),
      checksums: slots.filter(({ role }) => role === "checksum"),
    }];
  }));
  const kinds = protocol.messages.map((message) => {
    const envelope = envelopes.get(message.frame), fields = message.fields.map(prepared);
    const list = fields.find((slot) => slot.role === "list" && !("count" in slot));
    const slots = [...envelope.head, ...fields, ...envelope.tail];
    return {
      ...message, envelope, slots, list,
      given: message.given.map((name) => slots.find((slot) => slot.name === name)),
      optional: fields.filter((slot) => slot.optional),
      counter: list && fields.find((slot) => slot.name === list.counter),
    };
  });

  // ---- What frames there are

  // How many elements a list has, or how many of the fields that may be absent are there.
  function sizeOf(kind, count) {
    if (kind.sizes) return kind.sizes[count];
    return kind.size + (kind.list ? count * kind.list.size : 0);
  }

  // The frame of a message with such a count; null where it has none.
  function frameWith(kind, count) {
    const { low, high } = kind.counts;
    if (!Number.isInteger(count) || count < low || count > high) return null;
    return { kind, count, size: sizeOf(kind, count) };
  }

  function frameOf(kind, size) {
    if (kind.sizes) return frameWith(kind, kind.sizes.indexOf(size));
    const count = kind.list ? (size - kind.size) / kind.list.size : 0;
    return sizeOf(kind, count) === size ? frameWith(kind, count) : null;
  }

  // The slots that a frame has, with its lists whole, and where they stand.
  function slotsIn({ kind, size }) {
    const end = size - kind.envelope.tailSize;
    return kind.slots.filter((slot) => !slot.optional || slot.at < end)
      .map((slot) => ({ path: slot.name, at: slot.at < 0 ? size + slot.at : slot.at, slot }));
  }

  // What stands where in a frame, number by number.
  function layOut(frame) {
    return slotsIn(frame).flatMap((placed) => {
      const { slot: list, at } = placed;
      if (list.role !== "list") return [placed];
      // Text is one piece, all of it.
      if (list.text) return [{ path: list.name, at, slot: { ...list, role: "text", size: frame.count } }];
      return Array.from({ length: list.count ?? frame.count }, (_, index) => list.slots.map((slot) => (
        { path: pathOf(list, index, slot), at: at + index * list.size + slot.at, slot }
      ))).flat();
    });
  }

  // The bytes that follow from the rest of the frame; none where a user gives them.
  function due(slot, { kind, size, count }) {
    switch (slot.role) {
      case "constant": case "reserved": return slot.bytes;
      case "length": return writeNumber(slot, size - kind.envelope.uncounted);
      case "id": return writeNumber(slot, kind.ids[idNumber(kind.envelope, slot)]);
      case "count": return writeNumber(slot, count);
      case "size": return writeNumber(slot, count * kind.list.size);
      default: return [];
    }
  }

  const idNumber = ({ ids }, slot) => ids.findIndex(({ name }) => name === slot.name);

  // What a line may carry: the messages of one direction, or of all where it is null, by envelope;
  // and how large their frames can be there.
  function listenTo(direction, maxFrame) {
    const ways = protocol.directions.filter(({ key }) => direction === null || key === direction);
    const carried = ways.flatMap(({ key }) => kinds.filter((kind) => kind.direction === key));
    const sizes = carried.map((kind) => sizeOf(kind, kind.counts.high));
    const known = new Set(carried.map(({ envelope }) => envelope));
    return {
      largest: Math.min(maxFrame, Math.max(0, ...sizes)),
      envelopes: [...envelopes.values()].filter((each) => known.has(each)).map((envelope) => [
        envelope,
        carried.filter((kind) => kind.envelope === envelope
          && (envelope.lengthSlot || sizeOf(kind, kind.counts.low) <= maxFrame)),
      ]),
    };
  }

  // ---- Why bytes are no frame

  const refused = (reason, offset) => ({ frame: null, reason, offset });

  // Some bytes that are looked at, with what is remembered of them: so that nothing is worked out
  // again at each of the headers in a run.
  function lookAt(bytes) {
    return { bytes, checksums: new Map(), fitting: new Map() };
  }

  // Why the bytes `offset` bytes into a frame at `at` are not those of a slot; null where they are.
  // Those that it must have are `expected`; nothing from `limit` on is looked at.
  function misfit(slot, offset, expected, { bytes }, at, limit) {
    const start = at + offset;
    const wrong = expected.findIndex((byte, i) => start + i < limit && bytes[start + i] !== byte);
    if (wrong >= 0 && slot.role === "constant") {
      const outside = slot.at < 0 ? Reason.trailer : Reason.header;
      return refused(slot.field ? Reason.range : outside, offset + wrong);
    }
    if (wrong >= 0 && countsList(slot)) return refused(Reason.count, offset);
    if (start + slot.size > limit) return refused(Reason.tooShort, limit - at);
    if (slot.role === "text") {
      const strange = bytes.slice(start, start + slot.size).findIndex((byte) => byte > 0x7f);
      return strange < 0 ? null : refused(Reason.range, offset + strange);
    }
    return holds(slot, bytes, start) ? null : refused(Reason.range, offset);
  }

  function holds(slot, bytes, start) {
    if (slot.role === "packed") return readPacked(slot, bytes, start).every((value) => inside(slot, value));
    return !isNumber(slot) || slot.float || inside(slot, readNumber(slot, bytes, start));
  }

  function inside({ low, high, beyond = [] }, value) {
    return (value >= low && value <= high) || beyond.includes(Number(value));
  }

  // The same of a list: elements that were found to fit before are not looked at again.
  function misfitOfList(list, offset, count, look, at, limit) {
    const start = at + offset, end = start + count * list.size;
    if (list.free) return end > limit ? refused(Reason.tooShort, limit - at) : null;
    const known = fittingFrom(list, start, look);
    for (let element = known.to; element < end; element += list.size) {
      for (const slot of list.slots) {
        const wrong = misfit(slot, element + slot.at - at, fixed(slot), look, at, limit);
        if (wrong) return wrong;
      }
      known.to = element + list.size;
    }
    return end > limit ? refused(Reason.tooShort, limit - at) : null;
  }

  // Up to where elements are known to fit that begin at `start`.
  function fittingFrom(list, start, { fitting }) {
    if (!fitting.has(list)) fitting.set(list, []);
    const known = fitting.get(list), phase = start % list.size;
    const { from, to } = known[phase] || { from: start, to: start };
    if (start < from || start > to || !known[phase]) known[phase] = { from: start, to: start };
    return known[phase];
  }

  // What the bytes from `at` to `limit` begin: a frame; or none, for which reason, and at which
  // offset that shows. They are tested in the order in which they come, and the first that no frame
  // can have decides. "Too short" is what may become a frame. A frame of an id that no message has
  // has a `claim`, the size that it says it has, and a checksum may prove it.
  function weigh(line, look, at, limit) {
    if (begins.size && at < limit && !begins.has(look.bytes[at])) return refused(Reason.header, 0);
    const verdicts = line.envelopes.flatMap(([envelope, known]) =>
      weighIn(envelope, known, line, look, at, limit));
    return best(verdicts, limit - at) || refused(Reason.header, 0);
  }

  // Of verdicts on so many bytes, that on the smallest frame, whatever follows it; or else the one
  // that came furthest, of what may still become a frame if there is any.
  function best(verdicts, size) {
    const sizeOfFrame = ({ frame, claim }) => (frame ? frame.size : claim);
    const certain = verdicts.filter(({ frame, proven }) => frame || proven);
    const smallest = Math.min(...certain.map(sizeOfFrame));
    const found = certain.filter((each) => sizeOfFrame(each) === smallest);
    if (found.length) return found.find(({ frame }) => frame) || found[0];
    const waiting = verdicts.filter((verdict) => waits(verdict, size));
    const possible = waiting.length ? waiting : verdicts;
    const furthest = Math.max(...possible.map(({ offset }) => offset));
    return possible.find(({ offset }) => offset === furthest);
  }

  // Whether more than so many bytes could still make a certain frame of it.
  function waits({ reason, provable, claim }, size) {
    return reason === Reason.tooShort || (provable && claim > size);
  }

  // The same for frames of one envelope: a verdict for each message that may be meant.
  function weighIn(envelope, known, line, look, at, limit) {
    if (envelope.least > line.largest) return [];
    let size = null, meant = known;
    let idsLeft = envelope.head.filter(({ role }) => role === "id").length;
    for (const slot of envelope.head) {
      const wrong = misfit(slot, slot.at, fixed(slot), look, at, limit);
      if (wrong) return [wrong];
      if (slot.role === "length") {
        size = Number(readNumber(slot, look.bytes, at + slot.at)) + envelope.uncounted;
        if (size < envelope.least || size > line.largest) return [refused(Reason.length, slot.at)];
      }
      if (slot.role === "id") {
        const id = Number(readNumber(slot, look.bytes, at + slot.at));
        meant = meant.filter((kind) => kind.ids[idNumber(envelope, slot)] === id);
        if (!meant.length) return [weighUnknown(envelope, slot.at, line, look, at, limit)];
        idsLeft--;
      }
      if (size !== null && !idsLeft) {
        meant = meant.filter((kind) => frameOf(kind, size));
        if (!meant.length) return [refused(Reason.length, envelope.lengthSlot.at)];
      }
    }
    return meant.map((kind) => {
      const frame = size === null ? frameAt(kind, line, look, at, limit) : frameOf(kind, size);
      return frame.reason ? frame : weighFields(frame, look, at, limit);
    });
  }

  // The frame of a message that says nothing of its length, but perhaps of its list; or why not.
  function frameAt(kind, line, look, at, limit) {
    const least = frameWith(kind, kind.counts.low);
    if (!kind.counter) return least;
    for (const { slot, at: offset } of slotsIn(least).slice(kind.envelope.head.length)) {
      if (slot !== kind.counter) {
        const wrong = misfitOf(slot, offset, least, look, at, limit);
        if (wrong) return wrong;
        continue;
      }
      const wrong = misfit({ ...slot, low: -Infinity, high: Infinity }, offset, [], look, at, limit);
      if (wrong) return wrong;
      const value = Number(readNumber(slot, look.bytes, at + offset));
      const frame = frameWith(kind, slot.role === "size" ? value / kind.list.size : value);
      return frame && frame.size <= line.largest ? frame : refused(Reason.count, offset);
    }
    return least;
  }

  function misfitOf(slot, offset, frame, look, at, limit) {
    if (slot.role === "list") {
      return misfitOfList(slot, offset, slot.count ?? frame.count, look, at, limit);
    }
    return misfit(slot, offset, countsList(slot) ? due(slot, frame) : fixed(slot), look, at, limit);
  }

  // What follows the head, as the rest of one frame. The checksums are the last test.
  function weighFields(frame, look, at, limit) {
    for (const { slot, at: offset } of slotsIn(frame).slice(frame.kind.envelope.head.length)) {
      const wrong = misfitOf(slot, offset, frame, look, at, limit);
      if (wrong) return wrong;
    }
    const { kind, size } = frame;
    return misproof(kind.envelope, kind.ids, size, look, at) || { frame, reason: null, offset: size };
  }

  // Why the checksums of a whole frame are not right; null where they are.
  function misproof(envelope, ids, size, look, at) {
    for (const slot of envelope.checksums) {
      const offset = slot.at < 0 ? size + slot.at : slot.at;
      const value = readNumber(slot, look.bytes, at + offset);
      if (BigInt(value) !== BigInt(checksumOf(envelope, slot, ids, size, look, at))) {
        return refused(Reason.checksum, offset);
      }
    }
    return null;
  }

  // The checksum that a frame should have.
  function checksumOf(envelope, slot, ids, size, look, at) {
    if (!look.checksums.has(slot)) look.checksums.set(slot, makeChecksum(slot.method, look.bytes));
    const fromEnd = (place) => at + (place > 0 ? place : size + place);
    return look.checksums.get(slot)(slot.covers.map((piece) => (Array.isArray(piece)
      ? [piece[0] < 0 ? fromEnd(piece[0]) : at + piece[0], fromEnd(piece[1])]
      : { unsent: writeNumber(envelope.ids[piece], ids[piece]) })));
  }

  // A frame of an id that no message has, which is seen at `offset`.
  function weighUnknown(envelope, offset, line, look, at, limit) {
    const claim = claimOf(envelope, line, look, at, limit), provable = envelope.proves && claim > 0;
    const isWhole = envelope.bodyAt <= claim && at + claim <= limit;
    const proven = provable && isWhole && !envelope.tail.some((slot) => slot.role === "constant"
      && misfit(slot, claim + slot.at, slot.bytes, look, at, limit))
      && !misproof(envelope, [], claim, look, at);
    return { ...refused(Reason.unknown, offset), claim, provable, proven };
  }

  // How many bytes a frame of unknown id says that it has, at the least; 0 where no frame has them.
  function claimOf({ bodyAt, least, lengthSlot, uncounted }, line, { bytes }, at, limit) {
    if (at + bodyAt > limit) return least;
    if (!lengthSlot) return 0;
    const size = Number(readNumber(lengthSlot, bytes, at + lengthSlot.at)) + uncounted;
    return size < least || size > line.largest ? 0 : size;
  }

  // One frame, whole and with nothing after it: its message, or the reason and byte where not.
  function decodeFrame(bytes, direction) {
    const line = listenTo(direction, Infinity);
    const { frame, reason, offset } = weigh(line, lookAt(bytes), 0, bytes.length);
    if (!frame) return { reason, offset };
    return frame.size < bytes.length ? { reason: Reason.trailing, offset } : messageOf(frame, bytes);
  }

  // ---- What a line says

  // What stands at `at`: a "message", an "unknown" frame, "noise", or something "begun" that the
  // bytes to come decide; and how many bytes go with it.
  function judge(line, look, at) {
    const left = look.bytes.length - at, verdict = weigh(line, look, at, look.bytes.length);
    const { frame, reason, claim = 0, provable, proven } = verdict;
    const as = (type, size) => ({ ...verdict, type, size });
    if (frame) return as("message", frame.size);
    if (provable) return claim > left ? as("begun", 1) : as(proven ? "unknown" : "noise", proven ? claim : 1);
    if (reason === Reason.tooShort) return as("begun", 1);
    const type = claim ? fateOf(line, look, at, at + claim) : "noise";
    return as(type, type === "unknown" ? claim : 1);
  }

  // What becomes of a frame of unknown id, from `at` to `end`, that nothing proves: a message that
  // begins, or may begin, among its own bytes is worth more. Looked for from the end, where a begun
  // header is found at once.
  function fateOf(line, look, at, end) {
    const whole = end <= look.bytes.length, limit = whole ? end : look.bytes.length;
    for (let inside = limit - 1; inside > at; inside--) {
      const verdict = weigh(line, look, inside, limit);
      if (verdict.frame || verdict.proven || (whole && waits(verdict, limit - inside))) return "noise";
    }
    return whole ? "unknown" : "begun";
  }

  // A message or an unknown frame, as it is shown.
  function eventOf({ type, frame, reason, offset }, at, bytes) {
    const said = frame ? messageOf(frame, bytes) : { reason, refusedAt: at + offset };
    return { type, at, bytes, ...said };
  }

  // Whether a frame begins at `at`, as far as its header goes.
  function isHeader(line, bytes, at) {
    return line.envelopes.some(([{ header, begins: first }]) => (header.length
      ? header.every((byte, i) => bytes[at + i] === byte)
      : !first.size || first.has(bytes[at])));
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

    function noiseWith({ reason, offset }, at, header) {
      if (noise && !header) return noise;
      if (noise?.header === at - 1 && noise.reason === reason) return Object.assign(noise, { header: at });
      const why = header ? { reason, header: at } : { reason: Reason.header };
      return { type: "noise", at, bytes: [], refusedAt: at + offset, ...why };
    }

    function search(arrived, quiet) {
      held = [...held, ...arrived];
      const events = [], look = lookAt(held);
      let at = 0;
      while (at < held.length) {
        const found = judge(line, look, at);
        if (found.type === "begun" && !quiet) break;
        const bytes = held.slice(at, at + found.size);
        if (found.type === "message" || found.type === "unknown") {
          noise = null;
          events.push(eventOf(found, base + at, bytes));
        } else {
          noise = noiseWith(found, base + at, isHeader(line, held, at));
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

  // What stands in a slot at `at`; null in one that says nothing.
  function valueAt(slot, bytes, at) {
    if (slot.role === "packed") return readPacked(slot, bytes, at);
    if (slot.role === "text") {
      const text = textOf(bytes.slice(at, at + slot.size));
      return slot.text ? text : text.replace(/\0+$/, "");
    }
    return isNumber(slot) ? readNumber(slot, bytes, at) : null;
  }

  // The message in a whole frame. Its `rows` are the slots with what stands in them.
  function messageOf(frame, bytes) {
    const { kind } = frame;
    const rows = layOut(frame).map((placed) => ({
      ...placed,
      bytes: bytes.slice(placed.at, placed.at + placed.slot.size),
      value: valueAt(placed.slot, bytes, placed.at),
    }));
    const values = new Map(rows.map(({ path, value }) => [path, value]));
    const fields = kind.given.map((slot) => [slot.name, slot.role !== "list" || slot.text
      ? values.get(slot.name) ?? null
      : itemsOf(slot, slot.count ?? frame.count, values)]);
    return { kind, message: kind.name, fields: Object.fromEntries(fields), rows };
  }

  function itemsOf(list, count, values) {
    return Array.from({ length: count }, (_, index) => {
      const numbers = list.fields.map((field) => [field.name, values.get(pathOf(list, index, field))]);
      return list.element === null ? numbers[0][1] : Object.fromEntries(numbers);
    });
  }

  // The frame that carries `fields`, as decodeFrame gives them. Throws Unusable.
  function encode(name, fields) {
    const kind = kinds.find((each) => each.name === name);
    const values = valuesOf(kind, fields), frame = frameWith(kind, countOf(kind, fields));
    if (!frame) {
      const { low, high } = kind.counts;
      throw new Unusable(`${kind.list.name}: ${fields[kind.list.name].length} items is outside ${low}..${high}`);
    }
    const placed = layOut(frame);
    const bytes = placed.flatMap(({ path, slot }) => {
      const known = due(slot, frame);
      if (known.length) return countsList(slot) ? checkedCount(slot, known, frame) : known;
      return slot.role === "checksum" ? Array(slot.size).fill(0) : written(path, slot, values.get(path));
    });
    for (const { at, slot } of placed.filter((each) => each.slot.role === "checksum")) {
      const value = checksumOf(kind.envelope, slot, kind.ids, frame.size, lookAt(bytes), 0);
      bytes.splice(at, slot.size, ...writeNumber(slot, value));
    }
    return bytes;
  }

  // The count that values have: of their list, or of those that may be absent.
  function countOf(kind, fields) {
    if (kind.list) return fields[kind.list.name].length;
    if (!kind.optional.length) return 0;
    const isGiven = ({ name }) => fields[name] !== null && fields[name] !== undefined;
    const given = kind.optional.filter(isGiven);
    const fitting = kind.sizes.findIndex((_, count) => {
      const there = slotsIn(frameWith(kind, count)).filter(({ slot }) => slot.optional);
      return there.length === given.length && there.every(({ slot }, i) => slot === given[i]);
    });
    if (fitting < 0) {
      const names = given.map(({ name }) => name).join(", ") || "none of them";
      throw new Unusable(`${kind.optional[0].name}: no frame has ${names} of the fields that may be absent`);
    }
    return fitting;
  }

  // What is given, by path.
  function valuesOf(kind, fields) {
    return new Map(kind.given.flatMap((slot) => {
      const items = slot.role === "counter" ? fields[slot.name] ?? 0 : fields[slot.name];
      if (slot.role !== "list" || slot.text) return [[slot.name, items]];
      const { count = items.length } = slot;
      if (items.length !== count) {
        throw new Unusable(`${slot.name}: ${items.length} items, and it has ${count}`);
      }
      return items.flatMap((item, index) => slot.fields.map((field) =>
        [pathOf(slot, index, field), slot.element === null ? item : item[field.name]]));
    }));
  }

  function written(path, slot, value) {
    if (slot.role === "text") {
      const bytes = bytesOf(checkedText(path, value));
      if (bytes.length <= slot.size) return [...bytes, ...Array(slot.size - bytes.length).fill(0)];
      throw new Unusable(`${path}: ${bytes.length} characters, and it has room for ${slot.size}`);
    }
    if (slot.role !== "packed") return writeNumber(slot, checked(path, value, slot));
    if (value.length !== slot.count) {
      throw new Unusable(`${path}: ${value.length} numbers, and it has ${slot.count}`);
    }
    return writePacked(slot, value.map((each, i) => checked(`${path}[${i}]`, each, slot)));
  }

  function checkedText(path, value) {
    const strange = [...value].find((character) => character.codePointAt(0) > 0x7f);
    if (strange) throw new Unusable(`${path}: “${strange}” is not ASCII`);
    return value;
  }

  function checked(path, value, slot) {
    if (slot.float) {
      if (typeof value !== "number") throw new Unusable(`${path}: a number is due`);
      if (slot.size > 4 || !Number.isFinite(value) || Number.isFinite(Math.fround(value))) return value;
      throw new Unusable(`${path}: ${value} does not fit`);
    }
    if (typeof value !== "bigint" && !Number.isInteger(value)) {
      throw new Unusable(`${path}: a whole number is due`);
    }
    if (inside(slot, value)) return value;
    throw new Unusable(`${path}: ${value} is outside ${slot.low}..${slot.high}`);
  }

  function checkedCount(slot, known, { kind, count }) {
    checked(slot.name, slot.role === "size" ? count * kind.list.size : count, slot);
    return known;
  }

  return { kinds, makeStream, decodeFrame, encode };
}

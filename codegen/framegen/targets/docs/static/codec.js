// Reads and writes the frames of the protocol that `protocol` describes: bytes in, messages and
// noise out. It says what the Python library's StreamDecoder says, and touches no page.
"use strict";

const Reason = {
  tooShort: "too short", trailing: "trailing bytes", header: "bad header",
  length: "length mismatch", count: "count mismatch", unknown: "unknown command",
  range: "out of range",
};

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

function makeCodec(protocol) {
  const { header, length: lengthPart, id: idPart, bodyAt, uncounted } = protocol;
  const little = protocol.byteOrder === "little";

  function read(bytes, at, { size, signed }) {
    let value = 0;
    for (let i = 0; i < size; i++) value = value * 256 + bytes[at + (little ? size - 1 - i : i)];
    return signed && value >= 2 ** (8 * size - 1) ? value - 2 ** (8 * size) : value;
  }

  function write(value, { size }) {
    let rest = value < 0 ? value + 2 ** (8 * size) : value;
    const bytes = [];
    for (let i = 0; i < size; i++, rest = Math.floor(rest / 256)) bytes.push(rest % 256);
    return little ? bytes : bytes.reverse();
  }

  // The messages of one direction, or of all where `direction` is null.
  function tableFor(direction) {
    const kinds = protocol.messages.filter((kind) => !direction || kind.direction === direction);
    return { kinds, largest: Math.max(...kinds.map((kind) => kind.lengths.last)) + uncounted };
  }

  function fits(kind, length) {
    const { first, last, step } = kind.lengths;
    return length >= first && length <= last && (length - first) % step === 0;
  }

  function countOf(kind, length) {
    return kind.list ? kind.list.low + (length - kind.lengths.first) / kind.lengths.step : 0;
  }

  // The messages whose frame may begin so, with where their count stands and what it must be.
  function entries(table, bytes, at) {
    const length = read(bytes, at + lengthPart.at, lengthPart);
    const id = read(bytes, at + idPart.at, idPart);
    return table.kinds.filter((kind) => kind.id === id && fits(kind, length)).map((kind) => {
      const counter = kind.list && kind.numbers.find((field) => field.name === kind.list.counter);
      const count = counter ? write(countOf(kind, length), counter) : [];
      return { kind, size: length + uncounted, countAt: counter ? counter.at : 0, count };
    });
  }

  // Each number of a whole frame: its path, where it stands, its field and its value.
  function numbersOf(kind, frame) {
    const found = kind.numbers.map((field) => ({ path: field.name, at: field.at, field }));
    const list = kind.list;
    for (let i = 0; list && list.at + i * list.size < frame.length; i++) {
      for (const field of list.fields) {
        const path = `${list.name}[${i}]` + (list.element ? `.${field.name}` : "");
        found.push({ path, at: list.at + i * list.size + field.at, field });
      }
    }
    return found.map((each) => ({ ...each, value: read(frame, each.at, each.field) }));
  }

  function outOfRange(kind, frame) {
    return numbersOf(kind, frame).find(({ field, value }) => value < field.low || value > field.high);
  }

  function starts(bytes, at, expected, limit) {
    for (let i = 0; i < expected.length && at + i < limit; i++) {
      if (bytes[at + i] !== expected[i]) return false;
    }
    return true;
  }

  function knows(table, bytes, at) {
    const id = read(bytes, at + idPart.at, idPart);
    return table.kinds.some((kind) => kind.id === id);
  }

  // What stands at `at`, by the bytes in front of `limit`: a message and its end; or no message
  // and the size at which more can be told; or neither, a reason, and the byte where it shows.
  function weigh(table, bytes, at, limit) {
    const no = (reason, offset) => ({ kind: null, end: 0, reason, offset });
    const wait = (end) => ({ kind: null, end, reason: Reason.tooShort, offset: limit - at });
    const here = limit - at;
    if (!starts(bytes, at, header, limit)) {
      return no(Reason.header, header.findIndex((byte, i) => bytes[at + i] !== byte));
    }
    const begun = here < bodyAt;
    if (begun && here < lengthPart.at + lengthPart.size) return wait(limit + 1);
    const size = read(bytes, at + lengthPart.at, lengthPart) + uncounted;
    if (size < bodyAt || size > table.largest) return no(Reason.length, lengthPart.at);
    if (begun) return wait(limit + 1);
    let refusal = knows(table, bytes, at)
      ? no(Reason.length, lengthPart.at) : no(Reason.unknown, idPart.at);
    for (const { kind, size: needed, countAt, count } of entries(table, bytes, at)) {
      const countEnd = at + countAt + count.length;
      const misfit = !starts(bytes, at + countAt, count, limit);
      if (misfit) { refusal = no(Reason.count, countAt); continue; }
      if (countEnd > limit) return wait(countEnd);
      if (at + needed > limit) return wait(at + needed);
      const wrong = outOfRange(kind, bytes.slice(at, at + needed));
      if (!wrong) return { kind, end: at + needed, reason: null, offset: needed };
      refusal = no(Reason.range, wrong.at);
    }
    return refusal;
  }

  // Where a frame of unknown command at `at` would end; 0 where none begins.
  function claimedEnd(table, bytes, at) {
    if (at + bodyAt > bytes.length || !starts(bytes, at, header, bytes.length)) return 0;
    const size = read(bytes, at + lengthPart.at, lengthPart) + uncounted;
    const sane = size >= bodyAt && size <= table.largest;
    return sane && !knows(table, bytes, at) ? at + size : 0;
  }

  // The next place from `at` on where a header stands, or may begin just before `limit`.
  function nextHeader(bytes, at, limit) {
    while (at < limit && !starts(bytes, at, header, limit)) at++;
    return Math.min(at, limit);
  }

  // All that a stream says, to its end and the silence after it: messages, noise, unknown frames.
  function decodeStream(bytes, direction) {
    const table = tableFor(direction);
    const events = [];
    let start = 0, at = 0, candidate = 0, lastReason = Reason.header, lastOffset = 0;

    function tell(type, from, to, more) {
      if (from < to) events.push({ type, at: from, bytes: bytes.slice(from, to), ...more });
    }

    function tellPiece(from, to) {
      tell("noise", from, to, { reason: lastReason, offset: lastOffset });
    }

    function tellUnknown(from, to) {
      tell("unknown", from, to, { reason: Reason.unknown, offset: idPart.at });
      [lastReason, lastOffset] = [Reason.header, 0];
    }

    // A piece of noise for each refused header and its wreck; headers in a row share one.
    function tellNoise(from, to) {
      let piece = from, header_ = -2;
      for (let here = from; here < to; ) {
        if (here + header.length <= bytes.length && starts(bytes, here, header, bytes.length)) {
          const claimed = claimedEnd(table, bytes, here);
          if (claimed && claimed <= to) {
            tellPiece(piece, here);
            tellUnknown(here, claimed);
            piece = here = claimed;
            continue;
          }
          const { reason, offset } = weigh(table, bytes, here, bytes.length);
          if (reason !== lastReason || here !== header_ + 1) {
            tellPiece(piece, here);
            [piece, lastReason, lastOffset] = [here, reason, offset];
          }
          header_ = here;
        }
        here = nextHeader(bytes, here + 1, to);
      }
      tellPiece(piece, to);
    }

    function search(quiet) {
      for (;;) {
        const whole = candidate > 0 && candidate <= bytes.length;
        const limit = whole ? candidate : bytes.length;
        if (at === limit) {
          if (!whole && !quiet && candidate) return;
          if (whole) tellUnknown(start, candidate); else tellNoise(start, at);
          [start, candidate] = [at, 0];
          if (!whole) return;
          continue;
        }
        const { kind, end } = weigh(table, bytes, at, limit);
        if (kind) {
          tellNoise(start, at);
          tell("message", at, end, messageAt(kind, bytes.slice(at, end)));
          [lastReason, lastOffset] = [Reason.header, 0];
          [start, at, candidate] = [end, end, 0];
        } else if (end && whole) {
          // What may begin here goes on behind the unknown frame, and is worth more than it.
          tellNoise(start, at);
          [start, candidate] = [at, 0];
        } else if (end && !quiet) {
          if (!candidate) { tellNoise(start, at); start = at; }
          return;
        } else {
          const claimed = candidate ? 0 : claimedEnd(table, bytes, at);
          if (claimed) { tellNoise(start, at); [start, candidate] = [at, claimed]; }
          at = nextHeader(bytes, at + 1, Math.min(bytes.length, candidate || bytes.length));
        }
      }
    }

    search(false);
    search(true);
    return events;
  }

  function messageAt(kind, frame) {
    const rows = numbersOf(kind, frame), list = kind.list, fields = {};
    for (const { field, value } of rows.slice(0, kind.numbers.length)) {
      if (!list || field.name !== list.counter) fields[field.name] = value;
    }
    const values = rows.slice(kind.numbers.length).map((row) => row.value);
    if (list && !list.element) fields[list.name] = values;
    if (list && list.element) {
      const width = list.fields.length;
      fields[list.name] = Array.from({ length: values.length / width }, (_, i) =>
        Object.fromEntries(list.fields.map((field, j) => [field.name, values[i * width + j]])));
    }
    return { kind, message: kind.name, fields, rows };
  }

  // One frame, whole and with nothing after it: its message, or the reason and byte where not.
  function decodeFrame(bytes, direction) {
    const table = tableFor(direction);
    if (bytes.length < bodyAt || !starts(bytes, 0, header, bytes.length)) {
      const at = header.findIndex((byte, i) => bytes[i] !== byte);
      const wrong = at >= 0 && at < bytes.length;
      return { reason: wrong ? Reason.header : Reason.tooShort, offset: wrong ? at : bytes.length };
    }
    if (!knows(table, bytes, 0)) return { reason: Reason.unknown, offset: idPart.at };
    let best = { reason: Reason.length, offset: lengthPart.at, none: true };
    for (const { kind, size, countAt, count } of entries(table, bytes, 0)) {
      const misfit = starts(bytes, countAt, count, bytes.length) ? null : countAt;
      const wrong = bytes.length === size && misfit === null && outOfRange(kind, bytes);
      let refusal = null;
      if (bytes.length < size) refusal = { reason: Reason.tooShort, offset: bytes.length };
      else if (bytes.length > size) refusal = { reason: Reason.trailing, offset: size };
      else if (misfit !== null) refusal = { reason: Reason.count, offset: countAt };
      else if (wrong) refusal = { reason: Reason.range, offset: wrong.at };
      if (!refusal) return messageAt(kind, bytes);
      if (best.none || refusal.offset > best.offset) best = refusal;
    }
    return { reason: best.reason, offset: best.offset };
  }

  function checked(path, value, field) {
    if (!Number.isInteger(value)) throw new Unusable(`${path}: a whole number is due`);
    if (value < field.low || value > field.high) {
      throw new Unusable(`${path}: ${value} is outside ${field.low}..${field.high}`);
    }
    return write(value, field);
  }

  // The frame that carries `fields`, as decodeFrame gives them. Throws Unusable.
  function encode(name, fields) {
    const kind = protocol.messages.find((each) => each.name === name), list = kind.list;
    const items = list ? fields[list.name] : [];
    if (list && (items.length < list.low || items.length > list.high)) {
      throw new Unusable(`${list.name}: ${items.length} items is outside ${list.low}..${list.high}`);
    }
    const body = kind.numbers.flatMap((field) => list && field.name === list.counter
      ? write(items.length, field) : checked(field.name, fields[field.name], field));
    items.forEach((item, i) => list.fields.forEach((field) => body.push(...(list.element
      ? checked(`${list.name}[${i}].${field.name}`, item[field.name], field)
      : checked(`${list.name}[${i}]`, item, field)))));
    const head = Array(bodyAt).fill(0);
    head.splice(0, header.length, ...header);
    const length = bodyAt + body.length - uncounted;
    head.splice(lengthPart.at, lengthPart.size, ...write(length, lengthPart));
    head.splice(idPart.at, idPart.size, ...write(kind.id, idPart));
    return [...head, ...body];
  }

  return { decodeStream, decodeFrame, encode, read };
}

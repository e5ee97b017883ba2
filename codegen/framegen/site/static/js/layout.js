// What frames a protocol has: which slots stand where in a frame of which size.
"use strict";

// A number of an element: `targets[0].position`, or `ids[0]`.
function pathOf(list, index, field) {
  return `${list.name}[${index}]` + (list.element === null ? "" : `.${field.name}`);
}

// The object without what every object has, such as `constructor`: a name may be like that.
const bare = (named) => Object.assign(Object.create(null), named);

const isNumber = (slot) => slot.order !== undefined && slot.role !== "packed";
const countsList = ({ role }) => role === "count" || role === "size";
// What a user gives. No two of these have one name; a part of the frame may be called like a field.
const GIVEN = new Set(["field", "list", "packed", "text", "address", "counter"]);
const isGiven = ({ role }) => GIVEN.has(role);
// The bytes that a slot has in every frame.
const fixed = (slot) => (slot.role === "constant" ? slot.bytes : []);

// Numbers with more digits than those of a browser come as text. The `fields` of a list are those
// slots of an element that have a value.
function prepared(slot) {
  const made = { ...slot, beyond: slot.beyond || [] };
  for (const key of ["names", "bits", "meanings"]) if (made[key]) made[key] = bare(made[key]);
  if (made.wide) {
    const names = Object.entries(made.names).map(([name, value]) => [name, BigInt(value)]);
    Object.assign(made, { low: BigInt(made.low), high: BigInt(made.high) });
    Object.assign(made.names, Object.fromEntries(names));
  }
  if (made.slots) {
    made.slots = made.slots.map(prepared);
    made.fields = made.slots.filter((each) => !("bytes" in each));
  }
  if (isNumber(made) && !made.float && !made.wide) {
    // Any bytes are such a number.
    const values = 2 ** (8 * made.size), lowest = made.signed ? -values / 2 : 0;
    made.free = made.low <= lowest && made.high >= lowest + values - 1;
  }
  if (made.covers) made.pieces = made.covers.map(() => [0, 0]);
  return made;
}

// A value as it is decoded, from one of JSON: with all its digits.
function exact(slot, value) {
  if (value === null) return null;
  if (slot.role === "list" && !slot.text) {
    return value.map((item) => (slot.element === null ? exact(slot.fields[0], item)
      : Object.fromEntries(slot.fields.map((field) => [field.name, exact(field, item[field.name])]))));
  }
  if (!slot.wide) return value;
  return Array.isArray(value) ? value.map(BigInt) : BigInt(value);
}

function preparedEnvelope(frame) {
  const slots = frame.slots.map(prepared), body = slots.findIndex(({ role }) => role === "body");
  const head = slots.slice(0, body), tail = slots.slice(body + 1);
  return {
    ...frame, slots, head, tail, bodyAt: slots[body].at, begins: new Set(frame.begins),
    tailSize: tail.reduce((sum, { size }) => sum + size, 0),
    lengthSlot: slots.find(({ role }) => role === "length"),
    checksums: frame.turns.map((name) => slots.find((slot) => slot.name === name)),
    headIds: head.filter(({ role }) => role === "id"),
    // What is looked at in a frame of unknown id, besides its checksums.
    around: slots.filter(({ role }) => role === "constant" || role === "address"),
  };
}

// The layouts of all messages of a protocol.
function makeLayout(protocol) {
  const envelopes = new Map(protocol.frames.map((frame) => [frame.name, preparedEnvelope(frame)]));
  const kinds = protocol.messages.map((message) => {
    const envelope = envelopes.get(message.frame), fields = message.fields.map(prepared);
    const list = fields.find((slot) => slot.role === "list" && !("count" in slot));
    const slots = [...envelope.head, ...fields, ...envelope.tail];
    const given = message.given.map((name) => slots.find((slot) => isGiven(slot) && slot.name === name));
    return {
      ...message, envelope, slots, body: fields, list, frames: new Map(),
      given,
      example: Object.fromEntries(given.map((slot) => [slot.name, exact(slot, message.example[slot.name])])),
      optional: fields.filter((slot) => slot.optional),
      counter: counterOf(list, fields),
    };
  });

  // The number that counts the elements of a list; what it may be, the list says.
  function counterOf(list, fields) {
    const counter = list && fields.find((slot) => slot.name === list.counter);
    return counter && Object.assign(counter, { whole: { ...counter, free: true } });
  }
  const kindOf = new Map(kinds.map((kind) => [kind.name, kind]));

  // How many bytes a frame has, by the elements of its list, or by how many of the fields that may be
  // absent are there.
  function sizeOf(kind, count) {
    if (kind.sizes) return kind.sizes[count];
    return kind.size + (kind.list ? count * kind.list.size : 0);
  }

  // The frame of a message with such a count, always the same one; null where it has none.
  function frameWith(kind, count) {
    const known = kind.frames.get(count);
    if (known) return known;
    const { low, high } = kind.counts;
    if (!Number.isInteger(count) || count < low || count > high) return null;
    const frame = { kind, count, size: sizeOf(kind, count), placed: null };
    kind.frames.set(count, frame);
    return frame;
  }

  function frameOf(kind, size) {
    if (kind.sizes) return frameWith(kind, kind.sizes.indexOf(size));
    const count = kind.list ? (size - kind.size) / kind.list.size : 0;
    return sizeOf(kind, count) === size ? frameWith(kind, count) : null;
  }

  // The slots that a frame has, with its lists whole, where they stand, and the bytes that each must
  // have there.
  function slotsIn(frame) {
    const { kind, size } = frame, end = size - kind.envelope.tailSize;
    frame.placed ??= kind.slots.filter((slot) => !slot.optional || slot.at < end)
      .map((slot) => ({
        path: slot.name, at: slot.at < 0 ? size + slot.at : slot.at, slot,
        expected: countsList(slot) ? due(slot, frame) : fixed(slot),
      }));
    return frame.placed;
  }

  // What stands where in a frame, number by number.
  function layOut(frame) {
    return slotsIn(frame).flatMap((placed) => {
      const { slot: list, at } = placed, count = list.count ?? frame.count;
      if (list.role !== "list") return [placed];
      // Text is one piece, all of it.
      if (list.text) {
        const { about } = list.slots[0];
        return [{ path: list.name, at, slot: { ...list, role: "text", size: count, about, list } }];
      }
      return Array.from({ length: count }, (_, index) => list.slots.map((slot) => (
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

  return { protocol, envelopes, kinds, kindOf, sizeOf, frameWith, frameOf, slotsIn, layOut, due, idNumber };
}

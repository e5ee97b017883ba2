// Words for what a frame should have had where bytes stop being one, as
// framewire/explain/refusals.py has them.
"use strict";

const pluralized = (number, noun) => `${number} ${noun}${number === 1 ? "" : "s"}`;
const listed = (names, last = "and") => (names.length > 1
  ? `${names.slice(0, -1).join(", ")} ${last} ${names[names.length - 1]}` : names[0]);

function makeRefusals(layout, { rightOf, isField }, nearby) {
  const { protocol: { reasons: Reason }, kinds, sizeOf, frameOf } = layout;
  const { sent, lengthOf, leastLength, layOutAt, layOutEnvelope, headOf } = nearby;

  const largest = (way) => kinds.filter(({ direction }) => direction === way.key)
    .reduce((most, kind) => Math.max(most, sizeOf(kind, kind.counts.high)), 0);

  // What was due. `kind` is the message that the bytes began, if it is known.
  function expected(refused) {
    switch (refused.reason) {
      case Reason.tooShort: return more(refused);
      case Reason.trailing: return sizeDue(refused);
      case Reason.header: return refused.way.opening;
      case Reason.length: return legalLengths(refused);
      case Reason.count: return countDue(refused);
      case Reason.unknown: return idDue(refused);
      case Reason.range: return rangeDue(refused);
      case Reason.checksum: return checksumDue(refused);
      default: return constantDue(placedAt(refused));
    }
  }

  // How much more there should be.
  function more(refused) {
    const { slot, at } = placedAt(refused), { envelope, kind, way } = refused;
    if (slot.role === "constant" && slot.at >= 0 && !isField(slot)) return way.opening;
    if (at < envelope.bodyAt || lengthIn(refused) === null) {
      const least = !kind || envelope.lengthSlot ? envelope.least : leastLength(kind);
      return `the shortest frame has ${pluralized(least, "byte")}`;
    }
    return sizeDue(refused);
  }

  // How long a frame of the length is that these bytes have.
  function sizeDue(refused) {
    const { envelope } = refused, length = lengthIn(refused) || 0;
    const bytes = pluralized(length + envelope.uncounted, "byte");
    if (!envelope.lengthSlot) return `this frame of ${likelyName(refused)} has ${bytes}`;
    return `a ${envelope.lengthSlot.name} of ${length} makes ${bytes}`;
  }

  const likelyName = ({ kind }) => (kind ? kind.name : "a message");

  function countDue(refused) {
    const { envelope, kind, bytes } = refused, { slot, path, at, size } = placedAt(refused);
    const length = lengthIn(refused), found = bytes.slice(at, at + size);
    if (length === null || !envelope.lengthSlot) {
      const { low, high } = (kind && kind.list && kind.counts) || {};
      const bounds = low === undefined ? "" : `, of ${low}..${high} elements`;
      return `no ${likelyName(refused)} has a ${path} of ${readPart(slot, found)}${bounds}`;
    }
    const frame = kind && kind.list && frameOf(kind, length + envelope.uncounted);
    const count = frame ? frame.count * (slot.role === "size" ? kind.list.size : 1) : 0;
    const has = `a ${envelope.lengthSlot.name} of ${length} makes ${path} ${count}`;
    return found.length < size ? has : `${has}, not ${readPart(slot, found)}`;
  }

  function idDue({ envelope, bytes, offset, way }) {
    const there = sentIds(envelope).filter((part) => part.at <= offset);
    const ids = there.map((part) => `${part.name} ${readIn(part, bytes)}`).join(" and ");
    return `no message ${way.arrow} has the ${ids}`;
  }

  function rangeDue(refused) {
    const { bytes, offset } = refused, placed = placedAt(refused), { slot, path } = placed;
    if (slot.role === "constant") return constantDue(placed);
    if (slot.role === "text") return `${path} has the byte ${toHex([bytes[offset]])}, which is not ASCII`;
    const outside = `, outside ${slot.low}..${slot.high}`;
    if (slot.role !== "packed") return `${path} is ${readNumber(slot, bytes, placed.at)}${outside}`;
    const values = readPacked(slot, bytes, placed.at);
    const index = values.findIndex((value) => !(value >= slot.low && value <= slot.high));
    return `${path}[${index}] is ${values[index]}${outside}`;
  }

  function checksumDue(refused) {
    const { envelope, kind, bytes } = refused, { slot, path, at, size } = placedAt(refused);
    const whole = bytes.slice(0, (lengthIn(refused) || 0) + envelope.uncounted);
    const right = rightOf(envelope, slot, whole, kind ? kind.ids : []);
    return `${path} is ${toHex(bytes.slice(at, at + size))}; the ${slot.means} is ${toHex(right)}`;
  }

  const constantDue = ({ path, slot }) => `${path} is always ${toHex(slot.bytes)}`;

  // The length that the bytes claim, or that a message has with them.
  function lengthIn({ envelope, kind, bytes }) {
    if (envelope.lengthSlot) return readIn(envelope.lengthSlot, bytes);
    return kind ? lengthOf(kind, bytes) : null;
  }

  // The slot at the offset. At the end of them all, what is missing is more than any frame has.
  function placedAt(refused) {
    const { envelope, kind, bytes, offset } = refused, slots = headOf(envelope);
    if (kind && (!slots.length || offset >= endOf(slots[slots.length - 1]))) {
      slots.push(...layOutAt(kind, lengthIn(refused) ?? leastLength(kind)));
    }
    slots.push(...layOutEnvelope(envelope, Math.max(bytes.length, envelope.least)));
    return slots.find((placed) => offset < endOf(placed)) || slots[slots.length - 1];
  }

  function legalLengths(refused) {
    const { envelope, way } = refused, found = named(refused);
    const name = envelope.lengthSlot ? envelope.lengthSlot.name : "size";
    const most = largest(way) - envelope.uncounted, least = envelope.least - envelope.uncounted;
    const has = found.map((kind) => `${kind.name} has a ${name} of ${kind.lengths}`).join(" or ")
      || `the ${name} of a frame is ${least}..${most}`;
    return `${has}, not ${lengthIn(refused)}`;
  }

  // The messages that have the ids of these bytes, whatever precedes them.
  function named({ envelope, bytes, way }) {
    const parts = sentIds(envelope);
    if (!parts.every((part) => isIn(part, bytes))) return [];
    const ids = parts.map((part) => readIn(part, bytes));
    return sent(way, envelope).filter((kind) => ids.every((id, i) => kind.ids[i] === id));
  }

  return { expected, largest };
}

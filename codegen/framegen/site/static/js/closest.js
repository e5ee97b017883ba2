// Which frame comes closest to bytes that are none: its envelope and, if it is known, its message.
// What framewire/explain/closest.py says.
"use strict";

// Whole numbers in their bytes, as far as there are any.
function readPart(slot, bytes) {
  return Number(readNumber({ ...slot, size: bytes.length }, bytes, 0));
}

const readIn = (slot, bytes) => {
  const at = slot.at < 0 ? bytes.length + slot.at : slot.at;
  return readPart(slot, bytes.slice(at, at + slot.size));
};
const isIn = (slot, bytes) => slot.at >= 0 && slot.at <= bytes.length - slot.size;
const endOf = ({ at, size }) => at + size;
const ownBytes = ({ at, size }, bytes) => bytes.slice(at, at + size);

function makeClosest(layout) {
  const { protocol: { reasons: Reason }, envelopes, kinds, frameOf, frameWith, layOut } = layout;

  // Which slots bytes are refused by, as far as the reason tells.
  const roles = {
    [Reason.header]: ["constant"],
    [Reason.trailer]: ["constant"],
    [Reason.length]: ["length"],
    [Reason.count]: ["count", "size"],
    [Reason.unknown]: ["id"],
    [Reason.checksum]: ["checksum"],
  };

  const sent = (way, envelope) => kinds.filter(
    (kind) => kind.direction === way.key && kind.envelope === envelope);
  const idsIn = (envelope, bytes) => sentIds(envelope).filter((part) => isIn(part, bytes))
    .map((part) => readIn(part, bytes));

  // The messages of a direction that bytes begin: none until their ids tell.
  function begun(way, envelope, bytes) {
    const ids = idsIn(envelope, bytes);
    const found = sent(way, envelope).filter((kind) => ids.every((id, i) => kind.ids[i] === id));
    if (found.length === 1) return found;
    if (ids.length < sentIds(envelope).length) return [];
    if (!envelope.lengthSlot || !isIn(envelope.lengthSlot, bytes)) return found;
    const fitting = found.filter((kind) => lengthOf(kind, bytes) !== null);
    return fitting.length ? fitting : found;
  }

  // The legal length of the frame that bytes begin; null if there is none.
  function lengthOf(kind, bytes) {
    const { envelope, counter, list } = kind;
    if (envelope.lengthSlot) return legal(kind, readIn(envelope.lengthSlot, bytes));
    if (!counter) return leastLength(kind);
    if (!isIn(counter, bytes)) return null;
    const value = readIn(counter, bytes);
    const frame = frameWith(kind, counter.role === "size" ? value / list.size : value);
    return frame && frame.size - envelope.uncounted;
  }

  const legal = (kind, length) => (frameOf(kind, length + kind.envelope.uncounted) ? length : null);
  const leastLength = (kind) => frameWith(kind, kind.counts.low).size - kind.envelope.uncounted;

  // The slots of a frame with this length, from its first byte on.
  function layOutAt(kind, length) {
    const size = length + kind.envelope.uncounted;
    const frame = frameOf(kind, size) || { kind, size, count: kind.counts.low, placed: null };
    return layOut(frame).map(whole);
  }

  const whole = (placed) => ({ ...placed, size: placed.slot.size });

  // The slots of an envelope in a frame of so many bytes, the fields as one.
  function layOutEnvelope({ slots, least }, size) {
    return slots.map((slot) => ({ path: slot.name, at: slot.at < 0 ? size + slot.at : slot.at, slot,
      size: slot.role === "body" ? size - least : slot.size }));
  }

  const headOf = ({ head }) => head.map((slot) => ({ path: slot.name, at: slot.at, slot, size: slot.size }));

  // Whether a slot may have these bytes, as far as they tell it by themselves.
  function fits(slot, bytes) {
    if (slot.role === "constant") {
      return bytes.length === slot.size && slot.bytes.every((byte, i) => byte === bytes[i]);
    }
    if (slot.role === "text") return bytes.every((byte) => byte <= 0x7f);
    if (slot.role === "packed") return readPacked(slot, bytes, 0).every((value) => inside(slot, value));
    if (!isNumber(slot) || slot.float) return true;
    return inside(slot, readNumber({ ...slot, size: bytes.length }, bytes, 0));
  }

  // What bytes were refused as, for a reason at an offset: several, where nothing tells them apart.
  function closest(way, bytes, reason, offset) {
    const frames = [...envelopes.values()], own = frames.filter((each) => sent(way, each).length);
    const found = (own.length ? own : frames).flatMap((envelope) => {
      const messages = begun(way, envelope, bytes.subarray(0, offset));
      return (messages.length ? messages : [null]).map((kind) => {
        const attempt = { envelope, kind, name: kind ? kind.name : envelope.name };
        return { ...attempt, nearness: nearness(attempt, bytes, reason, offset) };
      });
    });
    const best = Math.max(...found.map((each) => each.nearness));
    return found.filter((each) => each.nearness === best);
  }

  function slotsOf({ envelope, kind }, bytes) {
    return kind ? layOutAt(kind, lengthOf(kind, bytes) ?? leastLength(kind)) : headOf(envelope);
  }

  // Whether all is right in front of the offset, and then whether it is wrong there as the reason says.
  function nearness(attempt, bytes, reason, offset) {
    const slots = slotsOf(attempt, bytes);
    const before = slots.filter((placed) => endOf(placed) <= offset)
      .every((placed) => fits(placed.slot, ownBytes(placed, bytes)));
    return 2 * before + isRefused(attempt, slots, bytes, reason, offset);
  }

  function isRefused({ envelope, kind }, slots, bytes, reason, offset) {
    // There is no message of these ids, and that would have been the reason.
    const read = bytes.subarray(0, offset);
    if (!kind && sentIds(envelope).every((part) => isIn(part, read))) return false;
    const end = slots.length ? endOf(slots[slots.length - 1]) : 0;
    if (reason === Reason.trailing) return end === offset;
    if (reason === Reason.tooShort) return end > bytes.length;
    const placed = slots.find((each) => each.at <= offset && offset < endOf(each));
    if (!placed) return false;
    if (reason === Reason.range) return !fits(placed.slot, ownBytes(placed, bytes));
    return roles[reason].includes(placed.slot.role);
  }

  return { closest, sent, lengthOf, leastLength, layOutAt, layOutEnvelope, headOf, fits };
}

// What bytes begin: a frame, or why none. They are tested in the order in which they come, and the
// first that no frame can have decides.
"use strict";

// So many bytes are looked at with what is remembered of them.
const WINDOW = 1 << 16;

// Some bytes from `base` on, with what is remembered of them: so that nothing is worked out again at
// each of the headers in a run.
function lookAt(bytes, base = 0) {
  return { bytes, base, checksums: new Map(), fitting: new Map(), dead: new Map() };
}

function makeVerdicts(layout) {
  const { frameWith, frameOf, slotsIn } = layout, Reason = layout.protocol.reasons;

  const verdict = (frame, reason, offset, claim, provable, proven) => (
    { frame, reason, offset, claim, provable, proven });
  const refused = (reason, offset) => verdict(null, reason, offset, 0, false, false);
  const otherwise = Object.freeze(refused(Reason.header, 0));

  // Why the bytes `offset` bytes into a frame at `at` are not those of a slot; null where they are.
  // Those that it must have are `expected`; nothing from `limit` on is looked at.
  function misfit(slot, offset, expected, { bytes }, at, limit) {
    const start = at + offset;
    for (let i = 0; i < expected.length && start + i < limit; i++) {
      if (bytes[start + i] === expected[i]) continue;
      if (slot.role === "constant") {
        const outside = slot.at < 0 ? Reason.trailer : Reason.header;
        return refused(slot.field ? Reason.range : outside, offset + i);
      }
      if (countsList(slot)) return refused(Reason.count, offset);
      break;
    }
    if (start + slot.size > limit) return refused(Reason.tooShort, limit - at);
    if (slot.role === "text") {
      for (let i = 0; i < slot.size; i++) {
        if (bytes[start + i] > 0x7f) return refused(Reason.range, offset + i);
      }
      return null;
    }
    return holds(slot, bytes, start) ? null : refused(Reason.range, offset);
  }

  function holds(slot, bytes, start) {
    if (slot.free) return true;
    if (slot.role === "packed") return readPacked(slot, bytes, start).every((value) => inside(slot, value));
    return !isNumber(slot) || slot.float || inside(slot, readNumber(slot, bytes, start));
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
  // offset that shows. "Too short" is what may become a frame. A frame of an id that no message has
  // has a `claim`, the size that it says it has, and a checksum may prove it. Unless the line is
  // quiet, a frame that is there is none as long as a longer one may come.
  function weigh(line, look, at, limit, quiet = true) {
    if (at < limit && !line.begins[look.bytes[at]]) return otherwise;
    line.count = 0;
    for (const listener of line.listeners) weighIn(listener, line, look, at, limit);
    if (line.count === 1) return line.found[0];
    return line.count ? best(line, limit - at, quiet) : otherwise;
  }

  // Of the verdicts of a line on so many bytes, that on the longest frame, which may begin as a shorter
  // one by chance; or else the one that came furthest, of what may still become a frame if there is
  // any. Of equals, the first.
  function best({ found, count }, size, quiet) {
    let certain = null, waiting = null, furthest = null;
    for (let i = 0; i < count; i++) {
      const each = found[i];
      if ((each.frame || each.proven) && (!certain || precedes(each, certain))) certain = each;
      if (waits(each, size) && (!waiting || each.offset > waiting.offset)) waiting = each;
      if (!furthest || each.offset > furthest.offset) furthest = each;
    }
    return (quiet || !waiting) && certain ? certain : waiting || furthest;
  }

  const sizeOfFrame = ({ frame, claim }) => (frame ? frame.size : claim);

  // Whether a certain frame is longer than another, or is that of a message, and the other is none.
  function precedes(one, other) {
    const sizes = sizeOfFrame(one) - sizeOfFrame(other);
    return sizes > 0 || (sizes === 0 && one.frame !== null && other.frame === null);
  }

  // Whether more than so many bytes could still make a certain frame of it.
  function waits({ reason, provable, claim }, size) {
    return reason === Reason.tooShort || (provable && claim > size);
  }

  const add = (line, found) => { line.found[line.count++] = found; };

  // The same for frames of one envelope: a verdict for each message that may be meant.
  function weighIn({ envelope, messages }, line, look, at, limit) {
    let size = -1, meant = messages, idsLeft = envelope.headIds.length, frames = null;
    for (const slot of envelope.head) {
      const wrong = misfit(slot, slot.at, fixed(slot), look, at, limit);
      if (wrong) return add(line, wrong);
      if (slot.role === "length") {
        size = Number(readNumber(slot, look.bytes, at + slot.at)) + envelope.uncounted;
        if (size < envelope.least || size > line.largest) {
          return add(line, refused(Reason.length, slot.at));
        }
      }
      if (slot.role === "id") {
        meant = meant.next.get(Number(readNumber(slot, look.bytes, at + slot.at)));
        if (!meant) return add(line, weighUnknown(envelope, slot.at, line, look, at, limit));
        idsLeft--;
      }
      if (size >= 0 && !idsLeft && !frames) {
        frames = framesOf(meant, size, frameOf);
        if (!frames.length) return add(line, refused(Reason.length, envelope.lengthSlot.at));
      }
    }
    if (frames) {
      for (const frame of frames) add(line, weighFields(frame, look, at, limit));
      return;
    }
    for (const kind of meant.kinds) {
      const frame = frameAt(kind, line, look, at, limit);
      add(line, frame.reason ? frame : weighFields(frame, look, at, limit));
    }
  }

  // The frame of a message that says nothing of its length, but perhaps of its list; or why not.
  function frameAt(kind, line, look, at, limit) {
    const least = frameWith(kind, kind.counts.low);
    if (!kind.counter) return least;
    for (const placed of slotsIn(least).slice(kind.envelope.head.length)) {
      const { slot, at: offset } = placed;
      if (slot !== kind.counter) {
        const wrong = misfitOf(placed, least, look, at, limit);
        if (wrong) return wrong;
        continue;
      }
      const wrong = misfit(slot.whole, offset, [], look, at, limit);
      if (wrong) return wrong;
      const value = Number(readNumber(slot, look.bytes, at + offset));
      const frame = frameWith(kind, slot.role === "size" ? value / kind.list.size : value);
      return frame && frame.size <= line.largest ? frame : refused(Reason.count, offset);
    }
    return least;
  }

  function misfitOf({ slot, at: offset, expected }, frame, look, at, limit) {
    if (slot.role !== "list") return misfit(slot, offset, expected, look, at, limit);
    return misfitOfList(slot, offset, slot.count ?? frame.count, look, at, limit);
  }

  // What follows the head, as the rest of one frame. The checksums are the last test.
  function weighFields(frame, look, at, limit) {
    const { kind, size } = frame, slots = slotsIn(frame);
    for (let i = kind.envelope.head.length; i < slots.length; i++) {
      const wrong = misfitOf(slots[i], frame, look, at, limit);
      if (wrong) return wrong;
    }
    const wrong = misproof(kind.envelope, kind.ids, size, look, at);
    // The same frame is always the same verdict.
    return wrong || (frame.verdict ??= verdict(frame, null, size, 0, false, false));
  }

  // Why the checksums of a whole frame are not right; null where they are.
  function misproof(envelope, ids, size, look, at) {
    for (const slot of envelope.checksums) {
      const offset = slot.at < 0 ? size + slot.at : slot.at;
      const value = readNumber(slot, look.bytes, at + offset);
      const right = checksumOf(envelope, slot, ids, size, look, at);
      if (value !== right && BigInt(value) !== BigInt(right)) return refused(Reason.checksum, offset);
    }
    return null;
  }

  // The checksum that a frame should have.
  function checksumOf(envelope, slot, ids, size, look, at) {
    if (!look.checksums.has(slot)) look.checksums.set(slot, makeChecksum(slot.method, look.bytes, look.base));
    const { covers, pieces } = slot;
    for (let i = 0; i < covers.length; i++) {
      if (!Array.isArray(covers[i])) {
        const id = ids[covers[i]];
        pieces[i] = { unsent: id === undefined ? [] : writeNumber(envelope.ids[covers[i]], id) };
        continue;
      }
      const [start, end] = covers[i];
      pieces[i][0] = at + (start < 0 ? size + start : start);
      pieces[i][1] = at + (end > 0 ? end : size + end);
    }
    return look.checksums.get(slot)(pieces);
  }

  // A frame of an id that no message has, which is seen at `offset`.
  function weighUnknown(envelope, offset, line, look, at, limit) {
    const claim = claimOf(envelope, line, look, at, limit), provable = envelope.proves && claim > 0;
    const isWhole = envelope.bodyAt <= claim && at + claim <= limit;
    const placeOf = (slot) => (slot.at < 0 ? claim + slot.at : slot.at);
    const proven = provable && isWhole
      && !envelope.around.some((slot) => misfit(slot, placeOf(slot), fixed(slot), look, at, limit))
      && !misproof(envelope, [], claim, look, at);
    return verdict(null, Reason.unknown, offset, claim, provable, proven);
  }

  // How many bytes a frame of unknown id says that it has, at the least; 0 where no frame has them.
  function claimOf({ bodyAt, least, lengthSlot, uncounted }, line, { bytes }, at, limit) {
    if (at + bodyAt > limit) return least;
    if (!lengthSlot) return 0;
    const size = Number(readNumber(lengthSlot, bytes, at + lengthSlot.at)) + uncounted;
    return size < least || size > line.largest ? 0 : size;
  }

  return { weigh, waits, checksumOf };
}

// Whether a number may stand in a slot.
function inside({ low, high, beyond }, value) {
  return (value >= low && value <= high) || beyond.includes(Number(value));
}

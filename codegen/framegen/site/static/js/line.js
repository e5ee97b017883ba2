// What a line may carry: the messages of one direction, or of all, by envelope and then by ids.
"use strict";

// A line of a direction, or of all where it is null. Its frames have up to `maxFrame` bytes.
function makeLine({ protocol, kinds, envelopes, sizeOf, frameOf, idNumber }, direction, maxFrame) {
  const ways = protocol.directions.filter(({ key }) => direction === null || key === direction);
  const carried = ways.flatMap(({ key }) => kinds.filter((kind) => kind.direction === key));
  const largest = Math.min(maxFrame, carried.reduce(
    (most, kind) => Math.max(most, sizeOf(kind, kind.counts.high)), 0));
  const known = new Set(carried.map(({ envelope }) => envelope));

  // Messages that have the same ids as far as these were read; `next` are those by their next id.
  function branch(among, ids) {
    const [id, ...rest] = ids, next = new Map();
    if (id) {
      const number = idNumber(among.envelope, id);
      for (const kind of among.kinds) {
        const same = next.get(kind.ids[number]) || { envelope: among.envelope, kinds: [] };
        same.kinds.push(kind);
        next.set(kind.ids[number], same);
      }
      for (const [value, same] of next) next.set(value, branch(same, rest));
    }
    return { kinds: among.kinds, next, sizes: new Map() };
  }

  const roomy = (envelope) => known.has(envelope) && envelope.least <= largest;
  const listeners = [...envelopes.values()].filter(roomy).map((envelope) => ({
    envelope,
    messages: branch({ envelope, kinds: carried.filter((kind) => kind.envelope === envelope
      && (envelope.lengthSlot || sizeOf(kind, kind.counts.low) <= maxFrame)) }, envelope.headIds),
  }));
  // Those that frames may begin with at all.
  const begins = new Uint8Array(256).fill(protocol.begins.length ? 0 : 1);
  for (const byte of protocol.begins) begins[byte] = 1;
  return { largest, begins, listeners, found: [], count: 0 };
}

// The frames of so many bytes of the messages of a branch.
function framesOf({ kinds, sizes }, size, frameOf) {
  const known = sizes.get(size);
  if (known) return known;
  const frames = kinds.map((kind) => frameOf(kind, size)).filter(Boolean);
  if (frames.length) sizes.set(size, frames);
  return frames;
}

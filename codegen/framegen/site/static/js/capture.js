// A capture that was decoded: its bytes, and in compact columns what stands where. Events are made
// again when they are looked at, so that millions of them take little room.
"use strict";

// What is no message has one of these codes, with its reason; messages come behind them.
const CAPTURE_NOISE = 0, CAPTURE_UNKNOWN = 32, CAPTURE_KINDS = 64;

// `direction` is that of bytes which do not say who sent them; null if either end may have.
function makeCapture(codec, protocol, direction = null) {
  const reasons = Object.values(protocol.reasons), channels = new Map(), wires = [];
  const starts = makeColumn(Uint32Array), codes = makeColumn(Uint16Array);
  // On which wire each event is and where it stands there, once there are several.
  const wireOf = makeColumn(Uint16Array), places = makeColumn(Uint32Array);
  const counts = new Map();
  const seen = { size: 0, messages: 0, noise: 0, unknown: 0, isTimed: false, isClock: false };
  const numbers = new Map(codec.kinds.map((kind, number) => [kind, number]));
  // The directions in which the same bytes may be another message.
  const rivals = codec.kinds.map((kind) => protocol.directions.map(({ key }) => key)
    .filter((key) => key !== kind.direction && codec.kinds.some((each) => each.direction === key
      && each.frame === kind.frame && String(each.ids) === String(kind.ids))));

  // Bytes of one sender, or of one wire: they are decoded apart from those of others.
  function wireFor(channel, way) {
    const name = `${way} ${channel}`;
    if (!channels.has(name)) {
      const made = {
        number: wires.length, channel, direction: way, log: makeByteLog(), stream: null, taken: 0, last: null,
        marks: makeColumn(Uint32Array), times: makeColumn(Float64Array),
      };
      channels.set(name, made);
      wires.push(made);
    }
    return channels.get(name);
  }

  // Take further bytes, of which is said what makeTextReader says.
  function add(bytes, said = {}) {
    const way = said.direction === undefined ? direction : said.direction;
    const wire = wireFor(said.channel || "", way);
    if (typeof said.time === "number") {
      seen.isTimed = true;
      seen.isClock = seen.isClock || Boolean(said.isClock);
      wire.marks.push(wire.log.size);
      wire.times.push(said.time);
    }
    wire.log.add(bytes);
    if (!wire.stream) wire.stream = codec.makeStream({ direction: way });
    if (typeof said.noise === "string") {
      quiet(wire);
      if (bytes.length) put(wire, codeOfNoise(wire, bytes, way, said.noise), bytes.length);
      wire.last = null;
      return;
    }
    if (said.whole) {
      take(wire, wire.stream.flush(bytes));
      wire.last = null;
    } else take(wire, wire.stream.feed(bytes));
  }

  function take(wire, events) {
    let isFirst = true;
    for (const event of events) {
      const size = event.size ?? event.bytes.length;
      if (event.type === "message") put(wire, codeOf(wire, event, size), size);
      else {
        const base = event.type === "unknown" ? CAPTURE_UNKNOWN : CAPTURE_NOISE;
        const code = base + reasons.indexOf(event.reason);
        put(wire, code, size, isFirst && wire.last === code && event.type === "noise");
      }
      isFirst = false;
    }
  }

  // The code of what was recorded as noise: it stays that, even if it would be a message by itself; save
  // for a frame whose command was not known.
  function codeOfNoise(wire, bytes, way, reason) {
    const events = codec.makeStream({ direction: way }).flush(bytes);
    if (reason === protocol.reasons.unknown && events.length === 1 && events[0].type !== "noise") {
      const isKnown = events[0].type === "message";
      return isKnown ? codeOf(wire, events[0], bytes.length) : CAPTURE_UNKNOWN + reasons.indexOf(reason);
    }
    const found = events.find(({ type }) => type !== "message");
    return CAPTURE_NOISE + reasons.indexOf(reason || (found ? found.reason : protocol.reasons.header));
  }

  // The code of a message: an odd one, if the bytes may have been sent in another direction as well.
  function codeOf(wire, { kind }, size) {
    const number = numbers.get(kind), code = CAPTURE_KINDS + 2 * number;
    if (wire.direction !== null || !rivals[number].length) return code;
    const bytes = wire.log.slice(wire.taken, wire.taken + size);
    return code + Number(rivals[number].some((key) => codec.decodeFrame(bytes, key).message));
  }

  // Add an event, or to the one before: noise goes on in what arrives next.
  function put(wire, code, size, goesOn = false) {
    const isJoined = goesOn && starts.size && (wireOf.size ? wireOf.at(starts.size - 1) : 0) === wire.number;
    wire.last = code;
    if (!isJoined) {
      starts.push(seen.size);
      codes.push(code);
      if (wires.length > 1) placeAll(wire);
      if (!counts.has(code)) counts.set(code, { events: 0, bytes: 0 });
      counts.get(code).events++;
    }
    counts.get(code).bytes += size;
    wire.taken += size;
    seen.size += size;
    if (code >= CAPTURE_KINDS) {
      seen.messages++;
      return;
    }
    seen.noise += size;
    seen.unknown += Number(code >= CAPTURE_UNKNOWN);
  }

  // As long as there was one wire, an event stood on it where it stands among all.
  function placeAll(wire) {
    while (places.size < starts.size - 1) {
      wireOf.push(0);
      places.push(starts.at(places.size));
    }
    wireOf.push(wire.number);
    places.push(wire.taken);
  }

  // A wire has gone quiet: half a frame on it goes no further.
  function quiet(wire) {
    if (wire.stream) take(wire, wire.stream.flush(new Uint8Array(0)));
    wire.last = null;
  }

  const end = () => wires.forEach(quiet);

  function sizeOf(index) {
    return (index + 1 < starts.size ? starts.at(index + 1) : seen.size) - starts.at(index);
  }

  function timeOf(wire, place) {
    const mark = wire.marks.lastUpTo(place);
    return mark < 0 ? null : wire.times.at(mark);
  }

  // What an event is, from its code alone.
  function meaning(code) {
    if (code >= CAPTURE_KINDS) {
      const kind = codec.kinds[(code - CAPTURE_KINDS) >> 1];
      return { type: "message", kind, isEither: Boolean(code & 1), reason: null };
    }
    const type = code >= CAPTURE_UNKNOWN ? "unknown" : "noise";
    return { type, kind: null, isEither: false, reason: reasons[code % CAPTURE_UNKNOWN] };
  }

  // An event as it is shown: its bytes up to `most` of them.
  function event(index, most = Infinity) {
    const wire = wires[index < wireOf.size ? wireOf.at(index) : 0];
    const at = starts.at(index), size = sizeOf(index);
    const place = index < places.size ? places.at(index) : at, said = meaning(codes.at(index));
    const bytes = wire.log.slice(place, place + Math.min(size, most));
    const direction = said.kind && !said.isEither ? said.kind.direction : wire.direction;
    return {
      ...said, index, at, size, bytes, direction, channel: wire.channel, time: timeOf(wire, place),
      names: namesOf(said, bytes),
      rest: (from, to) => wire.log.slice(place + from, place + Math.min(to, size)),
    };
  }

  // The names of the messages that bytes may be.
  function namesOf({ kind, isEither }, bytes) {
    if (!kind) return [];
    const ways = isEither ? rivals[numbers.get(kind)] : [];
    return [kind.name, ...ways.map((key) => codec.decodeFrame(bytes, key).message).filter(Boolean)];
  }

  return {
    add, end, event, meaning, counts, seen, sizeOf,
    // The bytes from one place to another, where there is one wire.
    slice: (start, end) => (wires.length ? wires[0].log.slice(start, end) : new Uint8Array(0)),
    quiet: (way) => wires.filter((wire) => wire.direction === way).forEach(quiet),
    codeAt: (index) => codes.at(index),
    startAt: (index) => starts.at(index),
    // The event in which a byte stands.
    indexAt: (offset) => starts.lastUpTo(offset),
    get size() {
      return starts.size;
    },
    get wires() {
      return wires.length;
    },
  };
}

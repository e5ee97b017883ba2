// Lines that give back what is sent, as adapters for half-duplex wires do.
"use strict";

// The echoes that are expected, one for each frame sent, taken out of what arrives. What the other end
// sends passes through: in front of an echo, behind it, and in its place.
function makeLocalEcho() {
  // Frames that have not come back, each with when it should have; and the last bytes that have
  // arrived, if they may be the start of an echo.
  let expected = [], held = [];

  function find(bytes, frame) {
    for (let at = 0; at + frame.length <= bytes.length; at++) {
      if (frame.every((byte, i) => bytes[at + i] === byte)) return at;
    }
    return -1;
  }

  // How many of the last bytes begin a frame, and are not all of it.
  function overlap(bytes, frame) {
    for (let size = Math.min(bytes.length, frame.length - 1); size > 0; size--) {
      const start = bytes.length - size;
      if (frame.slice(0, size).every((byte, i) => bytes[start + i] === byte)) return size;
    }
    return 0;
  }

  return {
    sent(bytes, until) { expected.push({ frame: [...bytes], until }); },

    // The bytes of the other end, with how many echoes were among them, and how many are lost.
    takeOut(arrived) {
      let bytes = [...held, ...arrived], echoes = 0, lost = 0;
      const others = [];
      held = [];
      while (expected.length) {
        const found = expected.map(({ frame }, i) => [find(bytes, frame), i]).filter(([at]) => at >= 0);
        if (!found.length) {
          const kept = Math.max(...expected.map(({ frame }) => overlap(bytes, frame)));
          held = bytes.slice(bytes.length - kept);
          bytes = bytes.slice(0, bytes.length - kept);
          break;
        }
        const [at, number] = found.reduce((one, other) => (other[0] < one[0] ? other : one));
        others.push(...bytes.slice(0, at));
        bytes = bytes.slice(at + expected[number].frame.length);
        expected = expected.slice(number + 1);
        echoes += 1;
        lost += number;
      }
      return { bytes: [...others, ...bytes], echoes, lost };
    },

    // What was held back in vain, and how many echoes should have come by now.
    expire(now) {
      const late = expected.filter(({ until }) => until <= now).length;
      if (!late) return { bytes: [], lost: 0 };
      expected = expected.filter(({ until }) => until > now);
      const bytes = held;
      held = [];
      return { bytes, lost: late };
    },

    clear() { [expected, held] = [[], []]; },

    // When the next echo should have come; null while none is expected.
    get due() { return expected.length ? Math.min(...expected.map(({ until }) => until)) : null; },
  };
}

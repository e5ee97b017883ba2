// A recording as a file.
"use strict";

// The file of a recording of the port `name`. It is made in slices, after each of which `rest()` lets the
// page live.
async function fileOf(recording, { name, codec, protocol, rest }) {
  const directions = new Map(protocol.directions.map(({ key, sender }) => [sender, key]));
  const say = ({ who, bytes }) => {
    const event = directions.has(who) ? codec.decodeFrame(bytes, directions.get(who)) : {};
    return event.message && saysOf(event);
  };
  const parts = [];
  for (const piece of recording.pieces(name, say)) {
    parts.push(piece);
    await rest();
  }
  const day = dayAndZone(new Date()).slice(0, 19).replace(" ", "_").replaceAll(":", "");
  return new File(parts, `${protocol.name}_${day}.hex`, { type: "text/plain" });
}

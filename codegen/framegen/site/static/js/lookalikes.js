// Frames of protocols that are easily taken for this one, as framewire/explain/lookalikes.py
// finds them.
"use strict";

function makeLookalikes(layout, { sealed }, { layOutEnvelope, fits }) {
  const lookalikes = layout.protocol.lookalikes.map((said) => ({
    ...said, own: Boolean(said.frame),
    envelope: said.frame ? preparedEnvelope(said.frame) : [...layout.envelopes.values()][0],
  }));

  // The look-alike of which bytes are exactly one frame; null for none.
  function recognise(bytes) {
    return lookalikes.find(({ own, envelope, commands }) => {
      const isKnown = Object.keys(commands).length > 0, id = lastId(envelope);
      if (!own && !isKnown) return false;
      return id && isFrame(envelope, bytes) && (!isKnown || readIn(id, bytes) in commands);
    }) || null;
  }

  function isFrame(envelope, bytes) {
    if (bytes.length < envelope.least) return false;
    const placed = layOutEnvelope(envelope, bytes.length);
    const sizes = new Map(placed.map(({ path, size }) => [path, size]));
    const unsent = envelope.ids.length > sentIds(envelope).length;
    const isProven = unsent || toHex(sealed(envelope, bytes, [])) === toHex(bytes);
    return isProven && placed.every(({ slot, at, size }) => {
      const own = bytes.slice(at, at + size);
      if (slot.role === "length") {
        return readPart(slot, own) === slot.of.reduce((sum, name) => sum + (sizes.get(name) || 0), 0);
      }
      return !["constant", "address"].includes(slot.role) || fits(slot, own);
    });
  }

  return { lookalikes, recognise };
}

// What bytes may be that are no frame, as framewire/explain/explanation.py suggests it.
"use strict";

// So many of the frames inside other bytes are shown.
const MOST_WITHIN = 8;

function makeHints(layout, { judge, sealed }, nearby, { largest }, { lookalikes, recognise }) {
  const { protocol, kinds } = layout, Reason = protocol.reasons, { layOutEnvelope } = nearby;
  const hint = (text, frame = new Uint8Array(0)) => ({ text, frame });
  const the = (title) => `the ${title.replace(/^The /, "")}`;

  // The messages that bytes are, at most one for each direction; empty for none.
  function namesOf(ways, bytes) {
    return ways.map((way) => [way, judge(bytes, way.key).frame]).filter(([, frame]) => frame)
      .map(([way, frame]) => `${frame.kind.name} (${way.arrow})`).join(" or ");
  }

  function hintsOn(bytes, refusals) {
    const otherwise = namesOf(protocol.directions, bytes);
    if (otherwise) return [hint(`sent the other way, they are ${otherwise}`)];
    const found = recognise(bytes), hints = [];
    if (found && found.own) {
      const about = found.about.split(/\s+/).filter(Boolean).join(" ");
      hints.push(hint(`this looks like a frame of ${the(found.title)}. ${about}`));
    }
    const within = framesWithin(bytes), ways = refusals.map(({ way }) => way);
    if (!within.length) hints.push(...idHints(bytes, refusals));
    for (const envelope of envelopesOf(ways)) {
      hints.push(...lengthHints(envelope, bytes, ways));
      if (refusals.some(({ reason }) => reason === Reason.checksum)) {
        for (const { frame, names } of sealedFrames(envelope, bytes, ways)) {
          hints.push(hint(`with ${its(envelope, bytes, frame)} they would be ${names}`, frame));
        }
      }
    }
    return unique([...hints, ...within]);
  }

  function unique(hints) {
    return [...new Map(hints.map((each) => [`${each.text}\n${toHex(each.frame)}`, each])).values()];
  }

  // The envelopes that frames of these directions have.
  function envelopesOf(ways) {
    const keys = ways.map(({ key }) => key);
    const carried = kinds.filter(({ direction }) => keys.includes(direction));
    return [...new Set(carried.map(({ envelope }) => envelope))];
  }

  // What an unknown id means elsewhere, or why it is reserved.
  function idHints(bytes, refusals) {
    const unknown = refusals.filter(({ reason }) => reason === Reason.unknown).map(({ way }) => way);
    if (!unknown.length) return [];
    for (const envelope of envelopesOf(refusals.map(({ way }) => way))) {
      const part = lastId(envelope);
      if (!part || !isIn(part, bytes)) continue;
      const hints = meaningsOf(readIn(part, bytes), unknown);
      if (envelope.checksums.length && isProven(envelope, bytes)) {
        hints.push(hint("the checksum is right: a frame that this spec does not have"));
      }
      if (hints.length) return hints;
    }
    return [];
  }

  function meaningsOf(number, ways) {
    const elsewhere = lookalikes.find(({ own, commands }) => !own && number in commands);
    if (elsewhere) return [hint(`in ${the(elsewhere.title)}, ${number} ${elsewhere.commands[number]}`)];
    const arrows = ways.map(({ arrow }) => arrow);
    return protocol.reserved
      .filter(({ id, direction = arrows[0] }) => id === number && arrows.includes(direction))
      .map(({ why }) => hint(`${number} is reserved: ${why}`));
  }

  // Whether bytes are as long as they say, with the right checksums.
  function isProven(envelope, bytes) {
    const { lengthSlot, uncounted, ids, least } = envelope;
    if (!lengthSlot || ids.length > sentIds(envelope).length || bytes.length < least) return false;
    const isWhole = readIn(lengthSlot, bytes) + uncounted === bytes.length;
    return isWhole && toHex(sealed(envelope, bytes, [])) === toHex(bytes);
  }

  // The length that so many bytes should have is tried, also with the checksum made to fit.
  function lengthHints(envelope, bytes, ways) {
    const { lengthSlot, uncounted, bodyAt } = envelope, size = bytes.length, length = size - uncounted;
    if (!lengthSlot || length < 0 || length > lengthSlot.high || size < bodyAt) return [];
    const mended = Uint8Array.from(bytes);
    mended.set(writeNumber(lengthSlot, length), lengthSlot.at);
    if (toHex(mended) === toHex(bytes)) return [];
    const has = `${size} bytes have a ${lengthSlot.name} of ${length}`, names = namesOf(ways, mended);
    if (names) return [hint(`${has}; with that they are ${names}`, mended)];
    return sealedFrames(envelope, mended, ways).map(({ frame, names: those }) => (
      hint(`${has}; with that and ${its(envelope, mended, frame)} they would be ${those}`, frame)));
  }

  // Frames with the right checksums, and which messages they are.
  function sealedFrames(envelope, bytes, ways) {
    if (!envelope.checksums.length || bytes.length < envelope.least) return [];
    const own = kinds.filter((kind) => kind.envelope === envelope), sentCount = sentIds(envelope).length;
    const hidden = new Map(own.map(({ ids }) => [ids.slice(sentCount).join(), ids]));
    return [...hidden.values()].map((ids) => {
      const frame = sealed(envelope, bytes, ids);
      return { frame, names: namesOf(ways, frame) };
    }).filter(({ frame, names }) => names && toHex(frame) !== toHex(bytes));
  }

  // The checksums of a frame that are right only where it is sealed.
  function its(envelope, bytes, frame) {
    const wrong = layOutEnvelope(envelope, bytes.length)
      .filter((placed) => toHex(ownBytes(placed, bytes)) !== toHex(ownBytes(placed, frame)));
    return `the right ${listed(wrong.map(({ path }) => path))}`;
  }

  // Whole frames among the bytes, from the first byte on.
  function framesWithin(bytes) {
    // A byte more than any frame has shows where one ends.
    const enough = Math.max(0, ...protocol.directions.map(largest)) + 1, hints = [];
    for (let at = 0; at < bytes.length;) {
      const frame = frameIn(bytes.slice(at, at + enough));
      if (!frame.length) {
        at++;
        continue;
      }
      if (hints.length === MOST_WITHIN) return [...hints, hint(`more frames follow, from byte ${at} on`)];
      hints.push(hint(`a frame begins at byte ${at}: ${namesOf(protocol.directions, frame)}`, frame));
      at += frame.length;
    }
    return hints;
  }

  // The whole frame that some bytes begin with; none where there is none.
  function frameIn(bytes) {
    for (const { key } of protocol.directions) {
      const { frame, reason, offset } = judge(bytes, key);
      if (frame) return bytes;
      if (reason === Reason.trailing) return bytes.slice(0, offset);
    }
    return bytes.slice(0, 0);
  }

  return { hintsOn };
}

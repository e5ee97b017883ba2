// What bytes in a search are: frames, parts of documented frames, or none. It touches no page.
"use strict";

// More than this is not judged here, but in the workbench.
const MOST_BYTES = 2048;
const MOST_EXPLAINED = 300;
const MOST_ITEMS = 3;

// The bytes that a query consists of, if it can be read so: `certain` where it can hardly be anything
// else, `left` half a byte at the end, and `problem` why what looks like bytes is none.
function bytesIn(query) {
  const text = query.replace(/bytes\.fromhex|bytearray|bytes|\bb(?=["'])/g, " ")
    .replace(/[[\](){}"'“”]/g, " ").replace(/\b([0-9a-f]{2})h\b/gi, "$1").trim();
  const words = text.split(/[\s,:;_-]+/).filter(Boolean);
  const isMarked = (word) => /^(?:0x|\\x)/i.test(word);
  const isHex = (word) => /^(?:0x|\\x)?[0-9a-f]+$/i.test(word) || /^(?:\\x[0-9a-f]{1,2})+$/i.test(word);
  const pairs = words.filter((word) => /^(?:0x|\\x)?[0-9a-f]{2}$/i.test(word)).length;
  const odd = words.find((word) => !isHex(word));
  if (odd !== undefined) {
    const looksLike = pairs > 2 && pairs === words.length - 1;
    return looksLike ? { problem: `“${odd}” is no byte in hex` } : null;
  }
  const digits = words.map((word) => word.replace(/0x|\\x/gi, ""));
  const half = words.findIndex((word, at) => digits[at].length % 2 && !isMarked(word));
  if (half >= 0 && half < words.length - 1) {
    const looksLike = pairs > 1;
    return looksLike ? { problem: `“${words[half]}” is no whole number of bytes` } : null;
  }
  const left = half < 0 ? "" : digits[half].slice(-1);
  const whole = left ? text.slice(0, text.length - 1) : text;
  let bytes;
  try {
    bytes = parseHex(whole);
  } catch (error) {
    if (!(error instanceof Unusable)) throw error;
    return { problem: error.message };
  }
  if (bytes.length < 2) return null;
  return { bytes, left, certain: (words.length > 1 || isMarked(words[0])) && /[0-9]/.test(text) };
}

function makeBytesSearch({ protocols, entries }) {
  const codecs = protocols.map((protocol) => ({ ...protocol, codec: null }));
  const codecOf = (protocol) => (protocol.codec ??= makeCodec(protocol.data));
  const frames = entries.filter(({ hex }) => hex).map((entry) => [entry, parseHex(entry.hex)]);

  function addressOf(protocol, bytes, way) {
    const hex = toHex(bytes).replace(/ /g, "").toLowerCase();
    return `${protocol.folder}decoder.html?hex=${hex}${way ? `&direction=${way.key}` : ""}`;
  }

  // What is shown of some bytes in a protocol; `path` leads to the message, if it is one.
  const shown = (protocol, bytes, way, title, where, text, path = "") => ({
    kind: "frame", protocol: protocol.name, title, where, text, hex: toHex(bytes),
    decoder: addressOf(protocol, bytes, way), path: path || addressOf(protocol, bytes, way),
  });

  // The frames that these bytes are, in every protocol, both ways where both fit.
  function wholeFrames(bytes) {
    return codecs.flatMap((protocol) => protocol.data.directions.flatMap((way) => {
      const said = codecOf(protocol).decodeFrame(bytes, way.key);
      if (said.message === undefined) return [];
      const where = `A frame of the ${protocol.title}, ${way.text}`;
      const page = `${protocol.folder}${said.kind.page}.html`;
      return [shown(protocol, bytes, way, said.message, where, inShort(said), page)];
    }));
  }

  // The frames among these bytes: of each protocol the direction that has the most.
  function framesAmong(bytes) {
    return codecs.flatMap((protocol) => {
      const ways = protocol.data.directions.map((way) => {
        const events = codecOf(protocol).makeStream({ direction: way.key }).flush(bytes);
        const messages = events.filter(({ type }) => type === "message");
        return { way, names: messages.map(({ message }) => message) };
      });
      const { way, names } = ways.reduce((so, each) => (each.names.length > so.names.length ? each : so));
      if (!names.length) return [];
      const rest = names.length > MOST_ITEMS ? ` and ${names.length - MOST_ITEMS} more` : "";
      const title = `${pluralized(names.length, "frame")} among these bytes`;
      return [shown(protocol, bytes, way, title, `${protocol.title}, ${way.text}`,
        names.slice(0, MOST_ITEMS).join(", ") + rest)];
    });
  }

  // Why bytes with the header of a frame are none, in the direction that knows their id, or else
  // believes them for longest; a protocol that has a hint comes first.
  function refusals(bytes) {
    return codecs.flatMap((protocol) => {
      const { data } = protocol;
      const begins = (header) => header.length && header.every((byte, at) => (at < bytes.length
        ? bytes[at] === byte : at > 0));
      if (!data.frames.some(({ header }) => begins(header))) return [];
      const { refusals: all, hints } = codecOf(protocol).explain(bytes.slice(0, MOST_EXPLAINED), null);
      const known = all.filter(({ reason }) => reason !== data.reasons.unknown);
      const { reason, offset, expected } = (known.length ? known : all)
        .reduce((so, each) => (each.offset > so.offset ? each : so));
      const begun = reason === data.reasons.tooShort;
      const hinted = begun ? [] : hints.map((hint) => hint.text);
      const said = begun ? "A frame may begin like this; its end is missing"
        : `${reason} at byte ${offset}: ${expected}`;
      const title = `${begun ? "The beginning of a frame" : "No frame"} of the ${protocol.title}`;
      const text = [said, ...hinted].map(sentence).join(" ");
      return [{ ...shown(protocol, bytes, null, title, "", text), hints: hints.length }];
    }).sort((one, other) => other.hints - one.hints);
  }

  // The documented frames that hold these bytes, and how many bytes are in front of them.
  function documented(bytes) {
    return frames.flatMap(([entry, all]) => {
      const last = all.length - bytes.length;
      for (let at = 0; at <= last; at++) {
        const isHere = bytes.every((byte, place) => byte === all[at + place]);
        if (isHere) return [{ ...entry, at, size: bytes.length }];
      }
      return [];
    });
  }

  // All that is known of some bytes: what they are, and which documented frames hold them.
  function find(bytes) {
    if (bytes.length > MOST_BYTES) {
      return { judged: codecs.map((protocol) => shown(protocol, bytes, null, `${bytes.length} bytes`,
        protocol.title, "So many are for the workbench.")), known: [] };
    }
    const known = documented(bytes), whole = wholeFrames(bytes);
    if (whole.length) return { judged: whole, known, whole: true };
    const among = framesAmong(bytes);
    if (among.length) return { judged: among, known, whole: true };
    const isPart = known.length > 0 && known.every(({ at }) => at > 0);
    return { judged: isPart ? [] : refusals(bytes), known, whole: false };
  }

  return { find };
}

// What is said, with a capital in front and a full stop behind it.
function sentence(text) {
  return text.replace(/^./, (first) => first.toUpperCase()).replace(/[^.!?]$/, "$&.");
}

// The fields of a frame in a line.
function inShort({ kind, fields }) {
  const one = (slot, value) => {
    const name = Object.keys(slot?.names ?? {}).find((each) => String(slot.names[each]) === String(value));
    const unit = slot?.unit ? ` ${slot.unit}` : "";
    return name ? `${value} (${name})` : `${value}${unit}`;
  };
  const said = Object.entries(fields).map(([name, value]) => {
    const slot = kind.given.find((each) => each.name === name);
    if (!Array.isArray(value)) return value === null ? "" : `${name} ${one(slot, value)}`;
    const items = value.slice(0, MOST_ITEMS).map((item) => (item === null || typeof item !== "object"
      ? one(slot.fields?.[0], item)
      : slot.fields.map((field) => `${field.name} ${one(field, item[field.name])}`).join(" ")));
    const rest = value.length > MOST_ITEMS ? [`… ${value.length} in all`] : [];
    return `${name}: ${[...items, ...rest].join("; ") || "none"}`;
  });
  return said.filter(Boolean).join(", ");
}

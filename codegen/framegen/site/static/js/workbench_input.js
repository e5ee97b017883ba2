// Reads what was typed, pasted, dropped or chosen, a slice at a time, so that the page stays alive.
"use strict";

// So many milliseconds are worked at once; as much of a file, or of bytes, is looked at in one go.
const INPUT_SLICE = 12, INPUT_FILE = 1 << 18, INPUT_BYTES = 4096, INPUT_TEXT = 32768;
// Up to so many characters of a text are decoded before anything else happens.
const INPUT_SHORT = 20000;

// Come back when the page has had its turn.
const inputTurns = new MessageChannel(), inputWaiting = [];
inputTurns.port1.onmessage = () => inputWaiting.shift()();
const nextTurn = () => new Promise((resolve) => {
  inputWaiting.push(resolve);
  inputTurns.port2.postMessage(null);
});

// The encoding of a text file by how it begins; null for one that holds raw bytes.
function encodingOf(bytes) {
  if (bytes[0] === 0xff && bytes[1] === 0xfe) return "utf-16le";
  if (bytes[0] === 0xfe && bytes[1] === 0xff) return "utf-16be";
  const isText = bytes.every((byte) => (byte >= 0x20 && byte !== 0x7f) || (byte >= 0x09 && byte <= 0x0d));
  if (!isText) return null;
  try {
    new TextDecoder("utf-8", { fatal: true }).decode(bytes, { stream: true });
    return "utf-8";
  } catch {
    return null;
  }
}

// The slices of a file with their places. All of them come in the same room, so that nothing is left
// behind of a long one.
async function* readSlices(file) {
  const reader = file.stream().getReader({ mode: "byob" });
  let room = new ArrayBuffer(INPUT_FILE);
  try {
    for (let at = 0; at < file.size;) {
      const { value, done } = await reader.read(new Uint8Array(room));
      if (done || !value.length) return;
      yield [at, value];
      at += value.length;
      room = value.buffer;
    }
  } finally {
    reader.cancel();
  }
}

// A task that reads into captures. Each input ends the one before. `progress(done)` is told of slices.
function makeInput({ says, progress }) {
  let latest = 0;

  // What tells a task when it has worked long enough, and whether it goes on.
  function begin() {
    const own = ++latest;
    let since = performance.now();
    return {
      isOver: () => own !== latest,
      isDue: () => performance.now() - since > INPUT_SLICE,
      async turn(done) {
        progress(done);
        await nextTurn();
        since = performance.now();
      },
    };
  }

  // Read a text into a capture; a short one at once.
  async function readText(text, capture) {
    const task = begin(), reader = makeTextReader(says, capture.add);
    for (let at = 0; at < text.length; at += INPUT_TEXT) {
      reader.feed(text.slice(at, at + INPUT_TEXT));
      if (text.length > INPUT_SHORT && task.isDue()) {
        await task.turn(at / text.length);
        if (task.isOver()) return null;
      }
    }
    return { ...reader.end(), ...(capture.end() ?? {}) };
  }

  // Read a text that is short enough without giving the page a turn.
  function readShort(text, capture) {
    begin();
    const seen = readCaptureText(text, says, capture.add);
    capture.end();
    return seen;
  }

  // Read a file: text in any form, or raw bytes.
  async function readFile(file, capture, { isRaw = false } = {}) {
    const task = begin();
    const encoding = isRaw ? null : encodingOf(new Uint8Array(await file.slice(0, 4096).arrayBuffer()));
    const text = encoding ? new TextDecoder(encoding) : null;
    const reader = text ? makeTextReader(says, capture.add) : null;
    for await (const [at, bytes] of readSlices(file)) {
      const piece = text ? text.decode(bytes, { stream: true }) : bytes;
      const step = text ? INPUT_TEXT : INPUT_BYTES;
      for (let from = 0; from < piece.length; from += step) {
        if (task.isOver()) return null;
        if (reader) reader.feed(piece.slice(from, from + step));
        else capture.add(piece.subarray(from, from + step));
        if (task.isDue()) await task.turn((at + from * (bytes.length / piece.length)) / file.size);
      }
    }
    if (task.isOver()) return null;
    const seen = reader ? reader.end() : { name: "raw bytes", lines: 0, bytes: file.size };
    capture.end();
    return seen;
  }

  return { readText, readShort, readFile, cancel: () => { latest++; } };
}

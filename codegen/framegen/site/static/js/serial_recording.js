// What a line has carried, kept in little memory, and written in the form that `decode` and `replay` read.
"use strict";

// So many bytes are kept at the most, in chunks; of a longer recording the oldest chunk is dropped.
const RECORDING_BOUND = 32 * 1024 * 1024;
const CHUNK_SIZE = 64 * 1024;
// What comes before the bytes of an entry has at most so many bytes.
const HEAD_SIZE = 32;

// The time of day as a recording begins with it: `2026-01-02 09:08:07.250000 +0000`.
function dayAndZone(date) {
  const two = (number) => String(Math.trunc(number)).padStart(2, "0");
  const day = [date.getFullYear(), two(date.getMonth() + 1), two(date.getDate())].join("-");
  const clock = [date.getHours(), date.getMinutes(), date.getSeconds()].map(two).join(":");
  const zone = -date.getTimezoneOffset(), sign = zone < 0 ? "-" : "+";
  const part = String(1000 * date.getMilliseconds()).padStart(6, "0");
  return `${day} ${clock}.${part} ${sign}${two(Math.abs(zone) / 60)}${two(Math.abs(zone) % 60)}`;
}

// Entries have a `time` in seconds, their `bytes`, `who` sent them, and `what` they are; a `what` without
// bytes is a comment of its own. `began` is the day and time of second 0.
function makeRecording(began, { bound = RECORDING_BOUND, chunkSize = CHUNK_SIZE } = {}) {
  // `who` and `what` repeat: each is kept once, and entries have their numbers.
  const words = [], numbers = new Map();
  let chunks = [], size = 0, count = 0, dropped = 0;

  function numberOf(word) {
    if (!numbers.has(word)) numbers.set(word, words.push(word) - 1);
    return numbers.get(word);
  }

  // Whole numbers of any size, seven bits a byte.
  function put(chunk, value) {
    let rest = value;
    for (; rest > 127; rest = Math.floor(rest / 128)) chunk.bytes[chunk.end++] = 128 | (rest % 128);
    chunk.bytes[chunk.end++] = rest;
  }

  function chunkFor(room, micros) {
    const last = chunks.at(-1);
    if (last && last.end + room <= last.bytes.length) return last;
    const bytes = new Uint8Array(Math.max(chunkSize, room));
    const chunk = { bytes, end: 0, count: 0, first: micros, last: micros };
    chunks.push(chunk);
    size += chunk.bytes.length;
    while (size > bound && chunks.length > 1) {
      const oldest = chunks.shift();
      size -= oldest.bytes.length;
      dropped += oldest.count;
      count -= oldest.count;
    }
    return chunk;
  }

  function add({ time, bytes, who, what }) {
    const micros = Math.round(1e6 * time), chunk = chunkFor(HEAD_SIZE + bytes.length, micros);
    // The clock of a page never goes back, but the numbers here must not either.
    const at = Math.max(micros, chunk.last);
    for (const value of [at - chunk.last, numberOf(who), numberOf(what), bytes.length]) put(chunk, value);
    chunk.bytes.set(bytes, chunk.end);
    chunk.end += bytes.length;
    [chunk.last, chunk.count] = [at, chunk.count + 1];
    count += 1;
  }

  function* entriesOf({ bytes, end, first }) {
    let at = 0, micros = first;
    const take = () => {
      let value = 0, factor = 1;
      for (; bytes[at] > 127; factor *= 128) value += factor * (bytes[at++] - 128);
      return value + factor * bytes[at++];
    };
    while (at < end) {
      micros += take();
      const [who, what, length] = [words[take()], words[take()], take()];
      yield { time: micros / 1e6, who, what, bytes: bytes.subarray(at, at += length) };
    }
  }

  // One line; `say(entry)` may know more of what an entry is than its name.
  function lineOf(entry, say) {
    if (!entry.bytes.length) return `# ${entry.what}\n`;
    return `${toHex(entry.bytes)}  # ${entry.time.toFixed(6)} s, ${entry.who}: ${say(entry) ?? entry.what}\n`;
  }

  // The text, piece by piece.
  function* pieces(name, say = () => undefined) {
    yield `# recorded of '${name}' from ${dayAndZone(began)} on\n`;
    if (dropped) yield `# the ${dropped} oldest entries were dropped\n`;
    for (const chunk of [...chunks]) yield [...entriesOf(chunk)].map((entry) => lineOf(entry, say)).join("");
  }

  return {
    add, pieces,
    get size() { return size; },
    get count() { return count; },
    get dropped() { return dropped; },
  };
}

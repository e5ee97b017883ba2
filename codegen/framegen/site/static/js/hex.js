// Hex as people paste it: spaced or glued, with 0x or \x, commas, colons, dashes and # comments.
// What framegen's hextext.py reads, and nothing else.
"use strict";

// What was given cannot be used; the message says why. `at` and `size` are its place in a text,
// `path` is its place among the values of a message, as far as there is one.
class Unusable extends Error {
  constructor(message, { at = null, size = 0, path = "" } = {}) {
    super(message);
    this.name = "Unusable";
    Object.assign(this, { at, size, path });
  }
}

// The digits of every byte from 00 to FF.
const HEX = Array.from({ length: 256 }, (_, byte) => byte.toString(16).toUpperCase().padStart(2, "0"));

// The bytes that a text says. Throws Unusable with the place of what is no hex.
function parseHex(text) {
  const bytes = new Uint8Array(Math.ceil(text.length / 2));
  const plain = text.replace(/#[^\n]*/g, (comment) => " ".repeat(comment.length));
  let size = 0;
  for (const { 0: word, index } of plain.matchAll(/[^ \t\n\r\v\f\u00a0\ufeff,:;_-]+/g)) {
    if (word.length === 2 && /^[0-9a-f]{2}$/i.test(word)) {
      bytes[size++] = parseInt(word, 16);
      continue;
    }
    for (const digits of digitsIn(word, index)) bytes[size++] = parseInt(digits, 16);
  }
  return bytes.slice(0, size);
}

// The digits of each byte in a word that stands at `at`.
function digitsIn(word, at) {
  if (/^(?:(?:0[x\u00d7]|\\x)?[0-9a-f]{2})*(?:(?:0[x\u00d7]|\\x)[0-9a-f])?$/i.test(word)) {
    return Array.from(word.matchAll(/(?:0[x\u00d7]|\\x)?([0-9a-f]{1,2})/gi), ([, digits]) => digits);
  }
  const digits = word.replace(/0[x\u00d7]|\\x/gi, (prefix) => "0".repeat(prefix.length));
  const wrong = /[^0-9a-f]/iu.exec(digits);
  const place = wrong ? { at: at + wrong.index, size: wrong[0].length } : { at, size: word.length };
  if (!wrong) throw new Unusable(`“${word}” is no whole number of bytes`, place);
  throw new Unusable(`“${wrong[0]}” in “${word}” is no hex digit`, place);
}

// Bytes as text: `0A 1B 02 FF`.
function toHex(bytes) {
  return Array.from(bytes, (byte) => HEX[byte]).join(" ");
}

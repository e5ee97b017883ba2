// Hex as people paste it: `0A 1B`, `0A1B`, `0x0A, 0x1B`, `\x0A\x1B`, `0Ah`, `0b00011011`, with commas,
// colons, dashes and comments. All that framewire/codec/hextext.py reads means the same here.
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

// Text that is no capture: which part, where, what is wrong with it, and what would be right.
class Unreadable extends Unusable {
  constructor(found, at, problem, hint) {
    super(`“${shortened(found)}” ${problem}`, { at, size: Math.max(1, found.length) });
    Object.assign(this, { found, hint });
  }

  // The line and column of a place in `text`, both from 1.
  placeIn(text) {
    const before = text.slice(0, this.at), start = before.lastIndexOf("\n") + 1;
    return { line: before.split("\n").length, column: this.at - start + 1 };
  }
}

function shortened(text) {
  return text.length <= 40 ? text : `${text.slice(0, 37)}…`;
}

// The digits of every byte from 00 to FF.
const HEX = Array.from({ length: 256 }, (_, byte) => byte.toString(16).toUpperCase().padStart(2, "0"));

// What is no digit makes a sum of it and any digit negative.
const HEX_DIGITS = new Int16Array(0x10000).fill(-1000);
for (let digit = 0; digit < 16; digit++) {
  const text = digit.toString(16);
  for (const each of [text, text.toUpperCase()]) HEX_DIGITS[each.charCodeAt(0)] = digit;
}
const HEX_BETWEEN = new Uint8Array(0x10000);
for (const character of " \t\n\r\v\f\u00a0\ufeff,:;_-") HEX_BETWEEN[character.charCodeAt(0)] = 1;

const HASH = 35, SLASH = 47;
const HEX_PREFIXED = /^(?:(?:0[x\u00d7]|\\x)?[0-9a-f]{2})*(?:(?:0[x\u00d7]|\\x)[0-9a-f])?$/i;
const HEX_BINARY = /^0b[01]{8}$/;
const HEX_SUFFIXED = /^(?:0?[0-9a-f]{1,2}h)+$/i;

// The bytes that a text says. Throws Unreadable, with the place of what is no hex.
function parseHex(text) {
  return makeHexReader().read(text).slice();
}

// A reader of text in pieces, each cut between words: `read` returns bytes. Throws Unreadable.
function makeHexReader() {
  let comment = "";

  // The place behind a comment that is open at `at`; it may go on in the next piece.
  function behindComment(text, at) {
    const end = text.indexOf(comment, at), size = comment.length;
    if (end < 0) return text.length;
    comment = "";
    return end + size;
  }

  // The end of what begins a comment at `at`; `at` where none does.
  function commentAt(text, at) {
    const two = text.slice(at, at + 2);
    if (text[at] === "#" || two === "//") comment = "\n";
    else if (two === "/*") comment = "*/";
    return comment ? behindComment(text, at + (text[at] === "#" ? 1 : 2)) : at;
  }

  function read(text) {
    const bytes = new Uint8Array((text.length >> 1) + 1);
    let size = 0, at = comment ? behindComment(text, 0) : 0;
    while (at < text.length) {
      const code = text.charCodeAt(at);
      if (HEX_BETWEEN[code]) {
        at++;
        continue;
      }
      const behind = code === HASH || code === SLASH ? commentAt(text, at) : at;
      if (behind > at) {
        at = behind;
        continue;
      }
      const end = endOfWord(text, at);
      size = readHexWord(text, at, end, bytes, size);
      at = end;
    }
    return bytes.subarray(0, size);
  }

  return { read };
}

function endOfWord(text, at) {
  let end = at;
  for (; end < text.length; end++) {
    const code = text.charCodeAt(end);
    if (HEX_BETWEEN[code] || code === HASH) break;
    if (code === SLASH && /^\/[/*]/.test(text.slice(end, end + 2))) break;
  }
  return end;
}

// Put the bytes of a word behind `size` others, and return how many there are.
function readHexWord(text, start, end, bytes, size) {
  if (end - start === 10 && HEX_BINARY.test(text.slice(start, end))) {
    bytes[size] = parseInt(text.slice(start + 2, end), 2);
    return size + 1;
  }
  let at = start, plain = (end - start) % 2 === 0, count = size;
  for (; plain && at < end; at += 2) {
    const value = 16 * HEX_DIGITS[text.charCodeAt(at)] + HEX_DIGITS[text.charCodeAt(at + 1)];
    plain = value >= 0;
    bytes[count++] = value;
  }
  if (plain) return count;
  const word = text.slice(start, end);
  const form = HEX_PREFIXED.test(word) ? /(?:0[x\u00d7]|\\x)?([0-9a-f]{1,2})/gi : /0?([0-9a-f]{1,2})h/gi;
  if (!HEX_PREFIXED.test(word) && !HEX_SUFFIXED.test(word)) throw refusedHex(word, start);
  count = size;
  for (const [, digits] of word.matchAll(form)) bytes[count++] = parseInt(digits, 16);
  return count;
}

// What is wrong with a word.
function refusedHex(word, at) {
  const whole = /^(?:(?:0[x\u00d7]|\\x)?[0-9a-f]{2})*/i.exec(word)[0].length;
  const prefix = /^(?:0[x\u00d7]|\\x)/i.exec(word.slice(whole));
  const start = whole + (prefix ? prefix[0].length : 0);
  if (prefix && start === word.length) {
    const hint = `write the byte whole, like ${prefix[0]}1B`;
    return new Unreadable(prefix[0], at + whole, "has no digits after it", hint);
  }
  const wrong = /[^0-9a-f]/iu.exec(word.slice(start));
  if (wrong) {
    const said = `${word === wrong[0] ? "" : `in “${shortened(word)}” `}is no hex digit`;
    return new Unreadable(wrong[0], at + start + wrong.index, said, "write two digits a byte, like 0A 1B FF");
  }
  const run = /(?:^|0[x\u00d7]|\\x)([0-9a-f]+)$/i.exec(word), digits = run ? run[1] : word;
  const place = at + word.length - digits.length;
  if (digits.length === 1) {
    const hint = `did you mean 0${digits}? Decimal numbers are read in brackets: [10, 27, 255]`;
    return new Unreadable(digits, place, "is half a byte", hint);
  }
  const problem = `is ${digits.length} digits, which is no whole number of bytes`;
  return new Unreadable(digits, place, problem, "look for a digit that was lost or added");
}

// Bytes as text: `0A 1B 02 FF`.
function toHex(bytes) {
  return Array.from(bytes, (byte) => HEX[byte]).join(" ");
}

// Bytes as programs write them: arrays of C, lists and bytes literals of Python, strings of hex.
"use strict";

const CODE_TOKEN = new RegExp([
  /(?<comment>#[^\n]*|\/\/[^\n]*|\/\*[^]*?(?:\*\/|$))/,
  /(?<literal>[bB])?(?<quote>"""|'''|"|')(?<text>(?:\\[^]|(?!\k<quote>)[^])*)(?<close>\k<quote>)?/,
  /(?<number>[0-9][0-9A-Za-z_]*(?:\.[0-9]+)?)/,
  /(?<word>[A-Za-z_][0-9A-Za-z_]*)/,
  /(?<open>[[{(])|(?<shut>[\]})])/,
  /(?<other>[^])/,
].map((each) => each.source).join("|"), "gu");
const CODE_ESCAPES = { n: 10, r: 13, t: 9, a: 7, b: 8, f: 12, v: 11, 0: 0, "\\": 92, "'": 39, '"': 34 };
const CODE_PAIRS = { "[": "]", "{": "}", "(": ")" };

// The bytes of all literals and lists in `text`, in order, and what they were. Throws Unreadable.
function readCode(text) {
  const bytes = [], open = [], kinds = new Set();
  let before = "";
  for (const token of text.matchAll(CODE_TOKEN)) {
    const { groups, index: at } = token;
    if (groups.comment !== undefined || !token[0].trim()) continue;
    if (groups.quote) readLiteral(token, bytes, kinds);
    else if (groups.open) open.push(opened(groups.open, at, before));
    else if (groups.shut) close(open, token, bytes, kinds);
    else if (groups.number || groups.word) takeWord(token, open, text, before, kinds);
    else if (open.length ? !/[,;.]/.test(token[0]) : /[^ -~]/.test(token[0])) {
      throw new Unreadable(token[0], at, "is no part of a list", "put commas between the bytes");
    }
    before = token[0];
  }
  if (open.length) {
    const { mark, at } = open.pop();
    throw new Unreadable(mark, at, "is never closed", `end the list with ${CODE_PAIRS[mark]}`);
  }
  return { bytes: Uint8Array.from(bytes), kinds: [...kinds] };
}

// `frame[4]` has a size in its brackets, and `bytes(…)` an argument; a list has neither before it.
function opened(mark, at, before) {
  const named = /^[\w\])]+$/.test(before);
  return { mark, at, numbers: [], isIndex: mark === "[" && named, isCall: mark === "(" && named };
}

function takeWord({ 0: word, groups, index: at }, open, text, before, kinds) {
  const inside = open.at(-1), isPair = /^[0-9A-F]{2}$/i.test(word);
  if (inside?.isIndex) return;
  // `unsigned int data_len = 24;` goes with an array, as xxd -i writes it.
  if (!inside && kinds.size && before === "=" && /^[0-9]+\s*;/.test(text.slice(at, at + 12))) return;
  if (inside?.isCall && groups.number) {
    throw new Unreadable(word, at, "is an argument, not a byte", "write a list, like bytes([10, 27])");
  }
  if (inside && (groups.number || (isPair && inside.mark !== "("))) inside.numbers.push([word, at]);
  else if (groups.number || (!inside && isPair && !/^\s*[=([:.]/.test(text.slice(at + word.length)))) {
    throw new Unreadable(word, at, "stands outside of the list",
      "put it into the brackets, or write hex alone");
  } else if (inside && inside.mark !== "(" && !/^(?:u?int8_t|u8|byte|char|unsigned)$/i.test(word)) {
    throw new Unreadable(word, at, "is no byte", "write numbers, like 0x1B or 27");
  }
}

function close(open, { 0: mark, index: at }, bytes, kinds) {
  const group = open.pop();
  if (!group || CODE_PAIRS[group.mark] !== mark) {
    throw new Unreadable(mark, at, "closes nothing", "look for a bracket that was lost");
  }
  if (group.isIndex || !group.numbers.length) return;
  // `0F` or `07` is no number of C or Python: somebody wrote hex without 0x.
  const prefixed = group.numbers.filter(([word]) => /^0x/i.test(word)).length;
  const asHex = !prefixed && group.numbers.some(([word]) => /^0[0-9A-F]$|^[0-9]?[A-F][0-9A-F]?$/i.test(word));
  kinds.add(prefixed || asHex ? "a list in hex" : "a list of decimal numbers");
  for (const [word, place] of group.numbers) bytes.push(numberIn(word, place, asHex));
}

function numberIn(word, at, asHex) {
  const plain = word.replace(/(?<=[0-9a-f])u?l*$/i, ""), digits = plain.replace(/^0x/i, "");
  const isHex = asHex || digits !== plain;
  if (!(isHex ? /^[0-9a-f]+$/i : /^(?:0?[0-9]|[1-9][0-9]+)$/).test(digits)) {
    throw new Unreadable(word, at, "is no number", "write it like 0x1B or 27");
  }
  const value = parseInt(digits, isHex ? 16 : 10);
  if (value > 255) {
    throw new Unreadable(word, at, "is no byte: the highest is 255, 0xFF", "write one number a byte");
  }
  return value;
}

function readLiteral({ 0: all, groups, index: at }, bytes, kinds) {
  const { literal, quote, text } = groups;
  const begin = at + (literal ? literal.length : 0), start = begin + quote.length;
  if (groups.close === undefined) {
    throw new Unreadable(quote, begin, "is never closed", `end the text with ${quote}`);
  }
  if (!literal && !text.includes("\\")) {
    kinds.add("hex in quotes");
    try {
      bytes.push(...parseHex(text));
    } catch (error) {
      if (error instanceof Unreadable) error.at += start;
      throw error;
    }
    return;
  }
  kinds.add(literal ? "a bytes literal" : "a string with escapes");
  for (const { 0: piece, index } of text.matchAll(/\\x[0-9a-f]{1,2}|\\[0-7]{1,3}|\\\r?\n|\\[^]|[^]/giu)) {
    bytes.push(...pieceOf(piece, start + index));
  }
}

function pieceOf(piece, at) {
  if (/^\\\r?\n$/.test(piece)) return [];
  if (/^\\x[0-9a-f]/i.test(piece)) return [parseInt(piece.slice(2), 16)];
  if (/^\\[0-7]/.test(piece)) {
    const value = parseInt(piece.slice(1), 8);
    if (value < 256) return [value];
  } else if (piece[0] === "\\" && piece.length > 1) {
    if (piece[1] in CODE_ESCAPES) return [CODE_ESCAPES[piece[1]]];
  } else if (piece.codePointAt(0) < 0x80) {
    return [piece.charCodeAt(0)];
  }
  throw new Unreadable(piece, at, "stands for no byte", "write it like \\x1B");
}

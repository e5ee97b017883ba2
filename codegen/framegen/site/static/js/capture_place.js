// Where text cannot be read, and lines with their places: what all readers of captures share.
"use strict";

// Text that is no capture: which part, where, what is wrong with it, and what would be right.
class Unreadable extends Error {
  constructor(found, at, problem, hint) {
    super(`“${shortened(found)}” ${problem}`);
    Object.assign(this, { found, at, size: Math.max(1, found.length), hint });
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

// Each line that holds something, without its end, and the place where it begins.
function* linesOf(text) {
  for (let at = 0; at < text.length;) {
    let end = text.indexOf("\n", at);
    if (end < 0) end = text.length;
    const line = text.slice(at, text[end - 1] === "\r" ? end - 1 : end);
    if (line.trim()) yield [line, at];
    at = end + 1;
  }
}

// The seconds of `12.5`, or of the clock in `09:08:07.25`.
function secondsOf(text) {
  return text.split(":").reduce((sum, part) => 60 * sum + Number(part), 0);
}

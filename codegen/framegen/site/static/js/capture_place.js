// Lines with their places, and clocks: what all readers of captures share.
"use strict";

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

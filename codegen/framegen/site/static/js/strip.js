// The strip of a frame: its parts in order, each with its place, its bytes, its name and its value.
"use strict";

// The cells of `rows`, as the codec gives them; `start` is the place of the first byte.
function stripCells(rows, start = 0) {
  const part = (name, text) => make("span", { class: name }, text);
  return rows.map(({ role, at, bytes, path, text }) => make("li", { class: role },
    part("offset", String(start + at)), " ", part("bytes", toHex(bytes)), " ", part("name", path),
    text ? " " : null, text ? part("value", text) : null));
}

// The strip of a frame: its parts in order, each with its place, its bytes, its name and its value.
"use strict";

// The cells of `rows`, as the codec gives them; `start` is the place of the first byte.
function stripCells(rows, start = 0) {
  const part = (name, text) => make("span", { class: name }, text);
  const said = (text) => (text ? [" ", part("value", text)] : []);
  return rows.map(({ role, at, bytes, path, text, slot }) => make("li", { class: role },
    part("offset", String(start + at)), " ", part("bytes", toHex(bytes)), " ", part("name", path),
    ...said(text), ...said(orderInWords(slot))));
}

// Which byte of a number comes first, and in which bits the first of packed ones is; "" for all others.
function orderInWords({ role, order, size }) {
  const first = order === "little" ? "low" : "high", isPacked = role === "packed";
  if (!order || (size < 2 && !isPacked)) return "";
  const bytes = size > 1 ? `${first} byte` : "", bits = isPacked ? `${first} bits` : "";
  return `${[bytes, bits].filter(Boolean).join(" and ")} first`;
}

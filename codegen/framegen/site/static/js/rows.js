// The slots of a frame with what stands in them, in words.
"use strict";

function makeRows({ layOut }, { valueAt }) {
  // The slot as it is shown: its path and place, its bytes, its value and what that means. `kind` is
  // the message that the bytes began, if it is known.
  function rowOf({ path, at, slot }, bytes, kind) {
    const own = bytes.subarray(at, at + slot.size), value = valueAt(slot, bytes, at);
    const row = { path, at, slot, role: slot.role, bytes: own, value, text: "", meaning: slot.about || "" };
    if (value === null) return row;
    if (isField(slot) || ["address", "packed", "text"].includes(slot.role)) {
      return { ...row, text: inWords(slot, value), meaning: meaningOf(slot, value) };
    }
    row.text = String(value);
    if (slot.role === "length" && kind) row.meaning = kind.means.length;
    if (slot.role === "checksum") row.meaning = slot.means;
    if (slot.role === "id") row.meaning = kind && slot === lastId(kind.envelope) ? kind.means.id : "";
    return row;
  }

  const isField = (slot) => ["count", "size", "field", "text"].includes(slot.role) || slot.field === true;

  // The rows of a whole frame.
  function rowsOf(frame, bytes) {
    return layOut(frame).map((placed) => rowOf(placed, bytes, frame.kind));
  }

  return { rowOf, rowsOf, isField };
}

// The ids that a frame holds, and the last of them.
const sentIds = ({ slots }) => slots.filter(({ role }) => role === "id");
const lastId = (envelope) => sentIds(envelope).pop();

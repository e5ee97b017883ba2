// The values of a message: out of its frame, by name.
"use strict";

function makeValues({ layOut }) {
  // What stands in a slot at `at`; null in one that says nothing.
  function valueAt(slot, bytes, at) {
    if (slot.role === "packed") return readPacked(slot, bytes, at);
    if (slot.role === "text") {
      const text = textOf(bytes.subarray(at, at + slot.size));
      return slot.text ? text : text.replace(/\0+$/, "");
    }
    return isNumber(slot) ? readNumber(slot, bytes, at) : null;
  }

  // The values of a whole frame, as `encode` takes them.
  function fieldsOf(frame, bytes) {
    const values = new Map(layOut(frame).filter(({ slot }) => isGiven(slot))
      .map(({ path, slot, at }) => [path, valueAt(slot, bytes, at)]));
    return Object.fromEntries(frame.kind.given.map((slot) => [slot.name, slot.role !== "list" || slot.text
      ? values.get(slot.name) ?? null
      : itemsOf(slot, slot.count ?? frame.count, values)]));
  }

  function itemsOf(list, count, values) {
    return Array.from({ length: count }, (_, index) => {
      const numbers = list.fields.map((field) => [field.name, values.get(pathOf(list, index, field))]);
      return list.element === null ? numbers[0][1] : Object.fromEntries(numbers);
    });
  }

  return { valueAt, fieldsOf };
}

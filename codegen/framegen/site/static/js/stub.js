"use strict";
var makeFields = typeof makeFields === "function" ? makeFields : (codec, kind, { values, onInput }) => {
  const element = make("div", {});
  const inputs = kind.given.map((slot) => { const i = make("input", { id: `value-${slot.name}`, "aria-label": slot.name, value: writeField(slot, values[slot.name] ?? null) }); i.addEventListener("input", onInput); element.append(make("label", { for: `value-${slot.name}` }, slot.name), i); return [slot, i]; });
  return { element, values: () => Object.fromEntries(inputs.map(([slot, i]) => [slot.name, readField(slot, i.value)])), show(v) { for (const [slot, i] of inputs) i.value = writeField(slot, v[slot.name] ?? null); } };
};

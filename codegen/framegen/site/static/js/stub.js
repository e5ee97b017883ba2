"use strict";
var makeFields = typeof makeFields === "function" ? makeFields : (codec, kind, { values, onInput }) => {
  const element = make("div", {});
  const inputs = kind.given.map((slot) => { const i = make("input", { id: `value-${slot.name}`, "aria-label": slot.name, value: writeField(slot, values[slot.name] ?? null) }); i.addEventListener("input", onInput); element.append(make("label", { for: `value-${slot.name}` }, slot.name), i); return [slot, i]; });
  return { element, values: () => Object.fromEntries(inputs.map(([slot, i]) => [slot.name, readField(slot, i.value)])), show(v) { for (const [slot, i] of inputs) i.value = writeField(slot, v[slot.name] ?? null); } };
};
function stubExplain(codec) {
  return codec.explain || ((bytes, direction) => {
    const ways = protocol.directions.filter(({ key }) => direction === null || key === direction);
    const out = { readings: [], refusals: [], hints: [] };
    for (const { key, text } of ways) {
      const found = codec.decodeFrame(bytes, key);
      if (found.message) out.readings.push({ message: found.message, direction: text, summary: found.kind.summary, rows: found.rows.map((r) => ({ offset: r.at, bytes: r.bytes, path: r.path, role: r.slot.role, text: r.text })), facts: [] });
      else out.refusals.push({ direction: text, reason: found.reason, offset: found.offset, expected: "", rows: [] });
    }
    return out;
  });
}

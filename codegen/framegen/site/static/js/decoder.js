// The decoder and the encoder: from the forms of the page to the codec, and back.
"use strict";

const protocol = JSON.parse(document.getElementById("protocol").textContent);
const codec = makeCodec(protocol);
const byId = (id) => document.getElementById(id);

// An element with its attributes and what is in it; text goes in as text, never as HTML.
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

function cell(role, offset, bytes, name, value) {
  return make("li", { class: role },
    make("span", { class: "offset" }, String(offset)), make("span", { class: "bytes" }, toHex(bytes)),
    make("span", { class: "name" }, name), make("span", { class: "value" }, value));
}

// A value in its larger unit, exactly: 7500 steps of 0.001 V are 7.500 V.
function scaled(value, { step, unit, offset = "0" }) {
  if (!Number.isInteger(value) && typeof value !== "bigint") {
    return `${value * Number(step) + Number(offset)} ${unit}`.trimEnd();
  }
  const places = (text) => (text.split(".")[1] || "").length;
  const digits = Math.max(places(step), places(offset));
  const whole = (text) => BigInt(text.replace(".", "") + "0".repeat(digits - places(text)));
  const steps = BigInt(value) * whole(step) + whole(offset);
  const shown = String(steps < 0 ? -steps : steps).padStart(digits + 1, "0");
  const point = shown.length - digits;
  const text = digits ? `${shown.slice(0, point)}.${shown.slice(point)}` : shown;
  return `${steps < 0 ? "-" : ""}${text} ${unit}`.trimEnd();
}

// The named bits of a number that are set, those of several bits with their value.
function setBits(value, bits = {}) {
  return Object.entries(bits).flatMap(([name, [low, high]]) => {
    const found = BigInt.asUintN(high - low + 1, BigInt(value) >> BigInt(low));
    return found ? [low === high ? name : `${name} ${found}`] : [];
  });
}

// A value as people say it: `7500 mV = 7.500 V`, `0 (unlimited)`.
function inWords(value, { unit, scale, names, bits }) {
  if (value === null) return "";
  if (typeof value === "string") return `“${value}”`;
  if (Array.isArray(value)) return value.join(" ");
  const larger = scale ? ` = ${scaled(value, scale)}` : "";
  const found = bits ? setBits(value, bits) : [];
  const name = Object.keys(names).find((key) => BigInt(names[key]) === asWhole(value));
  return `${value} ${unit}`.trimEnd() + larger + (found.length ? ` (${found.join(", ")})` : "")
    + (name ? ` (${name})` : "");
}

function asWhole(value) {
  return typeof value === "bigint" || Number.isInteger(value) ? BigInt(value) : null;
}

function strip(event) {
  return make("ol", { class: "strip" }, ...event.rows.map(({ path, at, slot, bytes, value }) =>
    cell(slot.role, event.at + at, bytes, path, inWords(value, slot))));
}

function shown(event) {
  if (event.type === "message") {
    const link = make("a", { href: `${event.kind.page}.html` }, event.message);
    const way = protocol.directions.find((each) => each.key === event.kind.direction).text;
    return make("li", { class: "frame" }, make("h3", { class: "yes" }, "✓ ", link),
      make("p", {}, `${way}: ${event.kind.summary}`), strip(event));
  }
  const what = event.type === "unknown" ? "Unknown frame" : "Noise";
  const size = event.bytes.length === 1 ? "1 byte" : `${event.bytes.length} bytes`;
  return make("li", { class: "frame" },
    make("h3", { class: "no" }, `✗ ${what}: ${event.reason}`),
    make("p", {}, `${size} from byte ${event.at} on; refused at byte ${event.refusedAt}`),
    make("ol", { class: "strip" }, cell("bad", event.at, event.bytes, event.type, event.reason)));
}

function report(field, output, error) {
  field.setAttribute("aria-invalid", String(Boolean(error)));
  output.textContent = error;
  output.className = error ? "error" : "";
}

function decode() {
  const field = byId("hex"), status = byId("decoded");
  byId("events").replaceChildren();
  try {
    const bytes = parseHex(field.value), direction = byId("direction").value || null;
    const events = codec.makeStream({ direction }).flush(bytes);
    report(field, status, "");
    status.textContent = summary(events, codec.decodeFrame(bytes, direction));
    byId("events").append(...events.map(shown));
  } catch (error) {
    if (!(error instanceof Unusable)) throw error;
    report(field, status, error.message);
  }
}

// What was decoded, in a line; and, of bytes that may have been meant as one frame, why they are none.
function summary(events, { message, reason, offset }) {
  if (!events.length) return "";
  const others = events.filter(({ type }) => type !== "message");
  const frames = events.length - others.length;
  const noise = others.reduce((sum, { bytes }) => sum + bytes.length, 0);
  const single = message || frames > 1 ? "" : ` Taken as one frame: ${reason} at byte ${offset}.`;
  return `Frames: ${frames}. Bytes of noise: ${noise}.${single}`;
}

// A number as it is typed, for a slot; NaN where the text is none.
function numberOf(slot, text) {
  const digits = text.trim();
  if (slot.float) return /^[-+]?([0-9.]+(e[-+]?[0-9]+)?|Infinity)$/i.test(digits) ? Number(digits) : "";
  if (!/^[-+]?(0x[0-9a-f]+|[0-9]+)$/i.test(digits)) return NaN;
  return slot.wide && !/^[-+]0x/i.test(digits) ? BigInt(digits.replace("+", "")) : Number(digits);
}

// A list is typed as `1:800, 9:800`: items apart by commas, their fields by colons. Text is typed as
// it is, and what may be absent is, if nothing is typed.
function valueOf(slot, text) {
  if (slot.role === "text" || slot.text) return text;
  if (slot.optional && !text.trim()) return null;
  if (slot.role !== "list" && slot.role !== "packed") return numberOf(slot, text);
  const items = text.split(",").filter((item) => item.trim());
  if (slot.role === "packed") return items.map((item) => numberOf(slot, item));
  const { fields } = slot;
  return items.map((item) => {
    const values = item.split(":").map((each, i) => (fields[i] ? valueOf(fields[i], each) : NaN));
    if (slot.element === null) return values.length === 1 ? values[0] : NaN;
    return Object.fromEntries(fields.map((field, i) => [field.name, values[i]]));
  });
}

function tellEncoded(bytes) {
  const detail = { message: byId("message").value, bytes };
  window.workbench.encoded = detail;
  document.dispatchEvent(new CustomEvent("encoded", { detail }));
}

function chosen() {
  return codec.kinds.find((kind) => kind.name === byId("message").value);
}

function encode() {
  const kind = chosen();
  const inputs = [...byId("values").querySelectorAll("input")];
  const status = byId("encoded"), button = byId("copy-frame");
  try {
    const fields = Object.fromEntries(
      kind.given.map((slot) => [slot.name, valueOf(slot, byId(`value-${slot.name}`).value)]));
    const frame = toHex(codec.encode(kind.name, fields));
    inputs.forEach((input) => input.setAttribute("aria-invalid", "false"));
    report(byId("message"), status, "");
    status.textContent = button.dataset.copy = frame;
    button.disabled = false;
    tellEncoded(parseHex(frame));
  } catch (error) {
    if (!(error instanceof Unusable)) throw error;
    button.disabled = true;
    tellEncoded(null);
    report(byId("message"), status, error.message);
    inputs.forEach((input) => input.setAttribute("aria-invalid", error.message.startsWith(input.name)));
  }
}

// A value as it is typed, from one as the codec has it.
function typed(value) {
  if (!Array.isArray(value)) return value === null ? "" : String(value);
  const item = (each) => (typeof each === "object" ? Object.values(each).join(":") : each);
  return value.map(item).join(", ");
}

function offer() {
  const { given, counts, example } = chosen();
  byId("values").replaceChildren(...given.flatMap((slot) => [
    make("label", { for: `value-${slot.name}` }, `${slot.name} `,
      make("small", { class: "quiet" }, hint(slot, counts))),
    make("input", { id: `value-${slot.name}`, name: slot.name, autocomplete: "off",
      value: typed(example[slot.name]) })]));
  encode();
}

// Which values a field takes.
function hint(slot, counts) {
  if (slot.role === "text") return `up to ${slot.size} characters`;
  const absent = slot.optional ? ", or nothing" : "";
  const bounds = slot.float ? "a number" : `${slot.low}..${slot.high}`;
  if (slot.role === "packed") return `${slot.count} of ${bounds}, apart by commas`;
  if (slot.role !== "list") return `${bounds} ${slot.unit}`.trimEnd() + absent;
  const many = slot.count ?? `${counts.low}..${counts.high}`;
  if (slot.text) return `${many} characters`;
  return `${many} of ${slot.fields.map(({ name }) => name).join(":")}, apart by commas`;
}

// The direction that an address asks for: by its key, or by its sender where that sends one way.
function wayOf(word) {
  const ways = protocol.directions.filter(({ key, sender }) => word === key || word === sender);
  return ways.length === 1 ? ways[0].key : "";
}

window.workbench = {};
const query = new URLSearchParams(location.search);
byId("hex").value = query.get("hex") || byId("hex").value;
byId("direction").value = wayOf(query.get("direction"));
byId("hex").addEventListener("input", decode);
byId("direction").addEventListener("change", decode);
byId("message").addEventListener("change", offer);
byId("values").addEventListener("input", encode);
for (const form of document.forms) form.addEventListener("submit", (event) => event.preventDefault());
decode();
offer();

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
function scaled(value, { step, unit }) {
  const [whole, fraction = ""] = step.split(".");
  const steps = BigInt(value) * BigInt(whole + fraction);
  const digits = String(steps < 0 ? -steps : steps).padStart(fraction.length + 1, "0");
  const point = digits.length - fraction.length;
  const text = fraction ? `${digits.slice(0, point)}.${digits.slice(point)}` : digits;
  return `${steps < 0 ? "-" : ""}${text} ${unit}`;
}

// A value as people say it: `7500 mV = 7.500 V`, `0 (unlimited)`.
function inWords(value, { unit, scale, names }) {
  const larger = scale ? ` = ${scaled(value, scale)}` : "";
  const name = Object.keys(names).find((key) => names[key] === value);
  return `${value} ${unit}`.trimEnd() + larger + (name ? ` (${name})` : "");
}

function strip(event) {
  return make("ol", { class: "strip" }, ...event.rows.map(({ path, at, slot, bytes, value }) =>
    cell(slot.role, event.at + at, bytes, path, value === null ? "" : inWords(value, slot))));
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

// A list is typed as `1:800, 9:800`: items apart by commas, their fields by colons.
function valueOf(slot, text) {
  const number = (digits) => (/^\s*[-+]?(0x[0-9a-f]+|[0-9]+)\s*$/i.test(digits) ? Number(digits) : NaN);
  if (slot.role !== "list") return number(text);
  return text.split(",").filter((item) => item.trim()).map((item) => {
    const numbers = item.split(":").map(number);
    if (slot.element === null) return numbers.length === 1 ? numbers[0] : NaN;
    return Object.fromEntries(slot.fields.map((field, i) => [field.name, numbers[i]]));
  });
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
  } catch (error) {
    if (!(error instanceof Unusable)) throw error;
    button.disabled = true;
    report(byId("message"), status, error.message);
    inputs.forEach((input) => input.setAttribute("aria-invalid", error.message.startsWith(input.name)));
  }
}

// A list as it is typed, from values as the codec has them.
function typed(value) {
  if (!Array.isArray(value)) return String(value);
  const item = (each) => (typeof each === "number" ? each : Object.values(each).join(":"));
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
  if (slot.role !== "list") return `${slot.low}..${slot.high} ${slot.unit}`.trimEnd();
  return `${counts.low}..${counts.high} of ${slot.fields.map(({ name }) => name).join(":")}, apart by commas`;
}

// The direction that an address asks for: by its key, or by its sender where that sends one way.
function wayOf(word) {
  const ways = protocol.directions.filter(({ key, sender }) => word === key || word === sender);
  return ways.length === 1 ? ways[0].key : "";
}

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

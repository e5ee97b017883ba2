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

function strip(event) {
  const cells = protocol.parts.map((part) => {
    const value = part.is === "constant" ? "" : codec.read(event.bytes, part.at, part);
    const bytes = event.bytes.slice(part.at, part.at + part.size);
    return cell(part.is, event.at + part.at, bytes, part.name, String(value));
  });
  for (const { path, at, field, value } of event.rows) {
    const name = Object.keys(field.names).find((key) => field.names[key] === value);
    const said = `${value} ${field.unit}`.trim() + (name ? ` (${name})` : "");
    cells.push(cell("field", event.at + at, event.bytes.slice(at, at + field.size), path, said));
  }
  return make("ol", { class: "strip" }, ...cells);
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
    make("p", {}, `${size} from byte ${event.at} on; refused at byte ${event.at + event.offset}`),
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
    const events = codec.decodeStream(bytes, direction);
    const messages = events.filter((event) => event.type === "message").length;
    const noise = events.reduce((sum, { type, bytes }) => sum + (type === "message" ? 0 : bytes.length), 0);
    report(field, status, "");
    const single = codec.decodeFrame(bytes, direction);
    status.textContent = `Frames: ${messages}. Bytes of noise: ${noise}.`;
    if (!single.message) {
      status.textContent += ` Taken as one frame: ${single.reason} at byte ${single.offset}.`;
    }
    byId("events").append(...events.map(shown));
  } catch (error) {
    if (!(error instanceof Unusable)) throw error;
    report(field, status, error.message);
  }
}

// A list is typed as `1:800, 9:800`: items apart by commas, their fields by colons.
function valueOf(input, kind) {
  const number = (text) => (/^\s*[-+]?(0x[0-9a-f]+|[0-9]+)\s*$/i.test(text) ? Number(text) : NaN);
  if (!kind.list || input.name !== kind.list.name) return number(input.value);
  return input.value.split(",").filter((item) => item.trim()).map((item) => {
    const numbers = item.split(":").map(number);
    if (!kind.list.element) return numbers.length === 1 ? numbers[0] : NaN;
    return Object.fromEntries(kind.list.fields.map((field, i) => [field.name, numbers[i]]));
  });
}

function encode() {
  const kind = protocol.messages.find((each) => each.name === byId("message").value);
  const inputs = [...byId("values").querySelectorAll("input")];
  const status = byId("encoded"), button = byId("copy-frame");
  try {
    const fields = Object.fromEntries(inputs.map((input) => [input.name, valueOf(input, kind)]));
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
  const { numbers, list, example } = protocol.messages.find((each) => each.name === byId("message").value);
  const ask = (name, hint) => [
    make("label", { for: `value-${name}` }, `${name} `, make("small", { class: "quiet" }, hint)),
    make("input", { id: `value-${name}`, name, value: typed(example[name]), autocomplete: "off" })];
  const rows = numbers.filter((field) => field.name in example).flatMap((field) =>
    ask(field.name, `${field.low}..${field.high} ${field.unit}`));
  if (list) {
    const names = list.fields.map((field) => field.name).join(":");
    rows.push(...ask(list.name, `${list.low}..${list.high} of ${names}, apart by commas`));
  }
  byId("values").replaceChildren(...rows);
  encode();
}

const asked = new URLSearchParams(location.search);
byId("hex").value = asked.get("hex") || byId("hex").value;
byId("direction").value = protocol.directions.some((each) => each.key === asked.get("direction"))
  ? asked.get("direction") : "";
byId("hex").addEventListener("input", decode);
byId("direction").addEventListener("change", decode);
byId("message").addEventListener("change", offer);
byId("values").addEventListener("input", encode);
for (const form of document.forms) form.addEventListener("submit", (event) => event.preventDefault());
decode();
offer();

// Events in words, as `decode` prints them: for the list, and for the tables to download.
"use strict";

// The fields of a message with units and names: `delay=10 ms items=1:20,2:30`.
function fieldsInWords(kind, fields) {
  return kind.given.filter(({ name }) => fields[name] !== null && fields[name] !== undefined)
    .map((slot) => `${slot.name}=${valueInWords(slot, fields[slot.name])}`).join(" ");
}

function valueInWords(slot, value) {
  const plain = writeField(slot, value);
  if (Array.isArray(value) || typeof value === "string") return plain;
  const named = Object.keys(slot.names || {}).filter((name) => String(slot.names[name]) === String(value));
  if (slot.bits) named.push(...setBits(value, slot.bits));
  return `${plain} ${slot.unit || ""}`.trimEnd() + (named.length ? ` (${named.join(", ")})` : "");
}

// A value as Python writes it in JSON: blanks behind commas, all digits of whole numbers.
function inJson(value, slot = {}) {
  if (value === null || value === undefined) return "null";
  if (typeof value === "bigint") return String(value);
  if (typeof value === "number") return slot.float ? floatInJson(value) : String(value);
  if (typeof value === "string") return asciiJson(value);
  if (Array.isArray(value)) {
    const of = slot.element === null && slot.fields ? slot.fields[0] : slot;
    return `[${value.map((each) => inJson(each, of)).join(", ")}]`;
  }
  const within = (name) => (slot.fields || []).find((each) => each.name === name) || {};
  return objectInJson(Object.entries(value).map(([name, each]) => [name, inJson(each, within(name))]));
}

// What JSON cannot say is a text.
function floatInJson(value) {
  return Number.isFinite(value) ? floatInWords(value) : `"${floatInWords(value)}"`;
}

const asciiJson = (text) => JSON.stringify(text).replace(/[^ -~]/g,
  (each) => `\\u${each.charCodeAt(0).toString(16).padStart(4, "0")}`);

const objectInJson = (pairs) => `{${pairs.map(([name, text]) => `${asciiJson(name)}: ${text}`).join(", ")}}`;

function fieldsInJson(kind, fields) {
  return objectInJson(kind.given.map((slot) => [slot.name, inJson(fields[slot.name], slot)]));
}

// A number of things, with its noun: `1 byte`, `12,345 bytes`.
const counted = (number, noun) => `${number.toLocaleString("en")} ${noun}${number === 1 ? "" : "s"}`;

// A time as the list shows it: seconds, or a time of day.
function timeInWords(time, isClock) {
  if (time === null) return "";
  if (!isClock) return time.toFixed(6);
  const pad = (number) => String(Math.floor(number)).padStart(2, "0");
  return `${pad(time / 3600)}:${pad((time / 60) % 60)}:${(time % 60).toFixed(6).padStart(9, "0")}`;
}

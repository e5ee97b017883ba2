// The fields of a message as the command takes them: `time_ms=800 targets=1:600,2:400`, named values
// and bits by their names. What is not understood is refused, with its place.
"use strict";

const NOTATION_WHOLE = /^-?(?:0x[0-9a-f]+|0o[0-7]+|0b[01]+|0+|[1-9][0-9]*)$/i;
const NOTATION_FLOAT = /^[-+]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[-+]?[0-9]+)?|inf(?:inity)?|nan)$/i;

// What was typed cannot be used: the part, where it stands, and why.
function notUnderstood(path, found, at, why) {
  const said = found ? `“${shortened(found)}” ${why}` : why;
  return new Unusable(`${path}: ${said}`, { at, size: found.length, path });
}

// The values of all fields in `text`, by name.
function readNotation(kind, text) {
  const values = bare({});
  for (const { 0: word, index } of text.matchAll(/[^ \t\n]+/g)) {
    const sign = word.indexOf("="), name = sign < 0 ? word : word.slice(0, sign);
    const slot = kind.given.find((each) => each.name === name);
    if (!slot) throw notUnderstood(kind.name, name, index, `is no field: it has ${fieldNames(kind)}`);
    if (sign < 0) throw notUnderstood(name, word, index, `has no value: write ${name}=…`);
    if (name in values) throw notUnderstood(name, word, index, "is given twice");
    values[name] = readField(slot, word.slice(sign + 1), index + sign + 1);
  }
  for (const slot of kind.given) {
    if (slot.name in values) continue;
    if (slot.optional) values[slot.name] = null;
    else if (slot.role === "counter") values[slot.name] = 0;
    else throw notUnderstood(slot.name, "", text.length, `is not given: write ${slot.name}=…`);
  }
  return values;
}

const fieldNames = (kind) => kind.given.map(({ name }) => name).join(", ") || "none";

// The value of one field; `at` is where its text stands.
function readField(slot, text, at = 0) {
  if (slot.role === "text" || slot.text) return unescaped(text);
  if (slot.optional && !text) return null;
  if (slot.role !== "list" && slot.role !== "packed") return readNumberIn(slot, slot.name, text, at);
  let place = at;
  return (text ? text.split(",") : []).map((item, index) => {
    const path = `${slot.name}[${index}]`, start = place;
    place += item.length + 1;
    if (slot.role === "packed") return readNumberIn(slot, path, item, start);
    return readItem(slot, path, item, start);
  });
}

function readItem({ fields, element }, path, item, at) {
  if (element === null) return readNumberIn(fields[0], path, item, at);
  const parts = item.split(":"), names = fields.map(({ name }) => name).join(":");
  if (parts.length !== fields.length) throw notUnderstood(path, item, at, `is not ${names}`);
  let place = at;
  return Object.fromEntries(fields.map((field, i) => {
    const start = place;
    place += parts[i].length + 1;
    return [field.name, readNumberIn(field, `${path}.${field.name}`, parts[i], start)];
  }));
}

function readNumberIn(slot, path, text, at) {
  if (slot.role === "text") return unescaped(text);
  if (slot.float) {
    if (!NOTATION_FLOAT.test(text)) {
      throw notUnderstood(path, text, at, "is no number: write it like 1.5");
    }
    return Number(text.replace(/inf(inity)?/i, "Infinity").replace(/nan/i, "NaN"));
  }
  const names = slot.names || bare({}), named = names[text] ?? maskOf(slot, text);
  if (named !== undefined) return slot.wide ? BigInt(named) : Number(named);
  if (!NOTATION_WHOLE.test(text)) {
    const all = [...Object.keys(names), ...Object.keys(slot.bits || {})];
    const known = all.map((name) => `, or ${name}`).join("");
    const why = `${text ? "is no number" : "a number is missing"}: write it like 12 or 0x0C${known}`;
    throw notUnderstood(path, text, at, why);
  }
  const value = text[0] === "-" ? -BigInt(text.slice(1)) : BigInt(text);
  return slot.wide || !Number.isSafeInteger(Number(value)) ? value : Number(value);
}

// The number in which bits of these names are set.
function maskOf({ bits = bare({}) }, text) {
  const parts = text.split("+");
  if (!parts.every((name) => name in bits)) return undefined;
  return parts.reduce((sum, name) => {
    const [low, high] = bits[name];
    return sum | (((1n << BigInt(high - low + 1)) - 1n) << BigInt(low));
  }, 0n);
}

const unescaped = (text) =>
  text.replace(/%([0-9A-Fa-f]{2})/g, (_, digits) => String.fromCharCode(parseInt(digits, 16)));
const asNotationWord = (text) =>
  text.replace(/[^!-~]|[%,:]/g, (each) => `%${HEX[each.charCodeAt(0)]}`);

// A value as it is typed.
function writeField(slot, value) {
  if (value === null) return "";
  if (typeof value === "string") return asNotationWord(value);
  if (Object.is(value, -0)) return "-0";
  if (!Array.isArray(value)) return String(value).replace("Infinity", "inf").replace("NaN", "nan");
  const item = (each) => (each !== null && typeof each === "object"
    ? Object.values(each).map((part) => writeField({}, part) || "%00").join(":") : writeField({}, each));
  return value.map(item).join(",");
}

// All fields as they are typed; those that are absent are left out.
function writeNotation(kind, values) {
  return kind.given.filter(({ name }) => values[name] !== null && values[name] !== undefined)
    .map((slot) => `${slot.name}=${writeField(slot, values[slot.name])}`).join(" ");
}

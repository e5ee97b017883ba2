// Answers questions in the line language (framegen.conformance.language) with the codec of a page, with
// the module that others import, or with the scripts alone, about the protocol of the last line
// `protocol JSON`. Of several files it is the first, until a line `use N` names the number of another:
//     node answer.js site/reference/busservo/decoder.html
//     node answer.js busservo.mjs lxservo.mjs
//     node answer.js codec.js
"use strict";

const fs = require("fs");
const readline = require("readline");
const vm = require("vm");
const { pathToFileURL } = require("url");

// The codec as it is published: the scripts of the page, and the protocol that they read.
function ofPage(page) {
  const text = fs.readFileSync(page, "utf8");
  const [, data] = /<script type="application\/json" id="protocol">(.*?)<\/script>/s.exec(text);
  const scripts = [...text.matchAll(/<script>(.*?)<\/script>/gs)].map(([, script]) => script);
  return ofScripts(scripts.find((each) => each.includes("function makeCodec")))(JSON.parse(data));
}

// What makes the codec of a protocol.
function ofScripts(text) {
  const { makeCodec, Unusable } = vm.runInThisContext(`(() => {${text}\nreturn { makeCodec, Unusable };})()`);
  return (protocol) => {
    const { kinds, decodeFrame, encode, makeStream } = makeCodec(protocol);
    return { kinds, decode: decodeFrame, encode, makeStream, Unusable };
  };
}

// The same of a module.
async function ofModule(file) {
  const { protocol, decode, encode, StreamDecoder, Unusable } = await import(pathToFileURL(file));
  const kinds = protocol.messages.map(({ name, fields }) => ({ name, given: fields }));
  return { kinds, decode, encode, makeStream: (options) => new StreamDecoder(options), Unusable };
}

const toHex = (bytes) => Buffer.from(bytes).toString("hex");
const fromHex = (text) => [...Buffer.from(text, "hex")];
const dashed = (reason) => reason.replaceAll(" ", "-");

// What ends a text, or is no character that can be seen, and how that is written.
const escaped = (text) => text.replace(/[^!-~]|[%,:]/g,
  (character) => `%${character.codePointAt(0).toString(16).toUpperCase().padStart(2, "0")}`);
const unescaped = (text) => text.replace(/%([0-9A-Fa-f]{2})/g, (_, digits) => String.fromCharCode(parseInt(digits, 16)));
const word = (value) => (typeof value === "string" ? escaped(value) : String(value));
const inList = (value) => word(value) || "%00";

// A message as it is written: `message ServoMove 5555… time_ms=1000 targets=1:800,9:800`.
function messageLine({ message, fields }, bytes) {
  const { given: slots } = codec.kinds.find(({ name }) => name === message);
  const given = slots.filter(({ name }) => fields[name] !== null);
  const values = given.map(({ name }) => {
    const value = fields[name];
    if (!Array.isArray(value)) return `${name}=${word(value)}`;
    const items = value.map((item) => (item !== null && typeof item === "object"
      ? Object.values(item).map(inList).join(":") : inList(item)));
    return `${name}=${items.join(",")}`;
  });
  return ["message", message, toHex(bytes), ...values].join(" ");
}

// The values of a question, as the codec takes them.
function valuesIn(kind, words) {
  const given = new Map(words.map((word) => word.split(/=(.*)/s)));
  return Object.fromEntries(kind.given.map((slot) => [slot.name, valueIn(slot, given.get(slot.name))]));
}

function valueIn(slot, text) {
  if (text === undefined) return null;
  if (slot.role === "packed") return text === "" ? [] : text.split(",").map((each) => numberIn(slot, each));
  if (slot.role === "list" && !slot.text) return itemsIn(slot, text);
  return single(slot, text);
}

// A fixed text has no zeros at its end.
function single(slot, text) {
  if (slot.role === "list") return unescaped(text);
  return slot.role === "text" ? unescaped(text).replace(/\0+$/, "") : numberIn(slot, text);
}

function numberIn(slot, text) {
  if (slot.wide) return BigInt(text);
  return Number({ inf: "Infinity", "-inf": "-Infinity" }[text] ?? text);
}

function itemsIn(list, text) {
  const items = text === "" ? [] : text.split(",");
  return items.map((item) => {
    const values = item.split(":").map((each, i) => single(list.fields[i], each));
    if (list.element === null) return values[0];
    return Object.fromEntries(list.fields.map((field, i) => [field.name, values[i]]));
  });
}

const answers = {
  decode(way, hex = "") {
    const bytes = fromHex(hex), found = codec.decode(bytes, way);
    if (found.message) return [messageLine(found, bytes)];
    return [`refused ${dashed(found.reason)} ${found.offset}`];
  },

  encode(name, ...words) {
    const kind = codec.kinds.find((each) => each.name === name);
    try {
      return [`frame ${toHex(codec.encode(name, valuesIn(kind, words)))}`];
    } catch (error) {
      if (error instanceof codec.Unusable) return ["refused"];
      throw error;
    }
  },

  stream(way, largest, ...parts) {
    const stream = codec.makeStream({ direction: way, maxFrame: Number(largest) });
    return parts.flatMap((part) => (part === "quiet"
      ? [...stream.flush().map(eventLine), "quiet"]
      : stream.feed(fromHex(part)).map(eventLine)));
  },
};

function eventLine(event) {
  if (event.type === "message") return messageLine(event, event.bytes);
  const what = event.type === "unknown" ? "unknown" : `noise ${dashed(event.reason)}`;
  return `${what} ${toHex(event.bytes)}`;
}

let codec;

async function main(files) {
  if (files[0].endsWith(".js")) {
    const make = ofScripts(fs.readFileSync(files[0], "utf8"));
    answers.protocol = (...words) => {
      codec = make(JSON.parse(words.join(" ")));
      return [];
    };
  } else {
    const codecs = await Promise.all(files.map((file) => (file.endsWith(".mjs") ? ofModule(file) : ofPage(file))));
    answers.use = (number) => {
      codec = codecs[number];
      return [];
    };
    answers.use(0);
  }
  readline.createInterface({ input: process.stdin }).on("line", (question) => {
    const [verb, ...words] = question.split(" ");
    const lines = Object.hasOwn(answers, verb) ? answers[verb](...words) : ["unsupported"];
    process.stdout.write([...lines, "end", ""].join("\n"));
  });
}

main(process.argv.slice(2));

// Answers questions in the line language (framegen.conformance.language) with the codec of a page:
//     node answer.js build/site/busservo/decoder.html
"use strict";

const fs = require("fs");
const readline = require("readline");
const vm = require("vm");

// The codec as it is published: the scripts of the page, and the protocol that they read.
function published(page) {
  const text = fs.readFileSync(page, "utf8");
  const [, data] = /<script type="application\/json" id="protocol">(.*?)<\/script>/s.exec(text);
  const scripts = [...text.matchAll(/<script>(.*?)<\/script>/gs)].map(([, script]) => script);
  const script = scripts.find((each) => each.includes("function makeCodec"));
  const { makeCodec, Unusable } = vm.runInThisContext(`${script}\n({ makeCodec, Unusable })`);
  return { codec: makeCodec(JSON.parse(data)), Unusable };
}

const { codec, Unusable } = published(process.argv[2]);

const toHex = (bytes) => Buffer.from(bytes).toString("hex");
const fromHex = (text) => [...Buffer.from(text, "hex")];
const dashed = (reason) => reason.replaceAll(" ", "-");

// A message as it is written: `message ServoMove 5555… time_ms=1000 targets=1:800,9:800`.
function messageLine({ message, kind, fields }, bytes) {
  const values = kind.given.map(({ name }) => {
    const value = fields[name];
    if (!Array.isArray(value)) return `${name}=${value}`;
    const items = value.map((item) => (typeof item === "number" ? item : Object.values(item).join(":")));
    return `${name}=${items.join(",")}`;
  });
  return ["message", message, toHex(bytes), ...values].join(" ");
}

// The values of a question, as the codec takes them.
function valuesIn(kind, words) {
  const given = new Map(words.map((word) => word.split("=")));
  return Object.fromEntries(kind.given.map((slot) => {
    const text = given.get(slot.name);
    return [slot.name, slot.role === "list" ? itemsIn(slot, text) : Number(text)];
  }));
}

function itemsIn(list, text) {
  const items = text === "" ? [] : text.split(",");
  return items.map((item) => {
    const numbers = item.split(":").map(Number);
    if (list.element === null) return numbers[0];
    return Object.fromEntries(list.fields.map((field, i) => [field.name, numbers[i]]));
  });
}

const answers = {
  decode(way, hex = "") {
    const bytes = fromHex(hex), found = codec.decodeFrame(bytes, way);
    if (found.message) return [messageLine(found, bytes)];
    return [`refused ${dashed(found.reason)} ${found.offset}`];
  },

  encode(name, ...words) {
    const kind = codec.kinds.find((each) => each.name === name);
    try {
      return [`frame ${toHex(codec.encode(name, valuesIn(kind, words)))}`];
    } catch (error) {
      if (error instanceof Unusable) return ["refused"];
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

readline.createInterface({ input: process.stdin }).on("line", (question) => {
  const [verb, ...words] = question.split(" ");
  const lines = Object.hasOwn(answers, verb) ? answers[verb](...words) : ["unsupported"];
  process.stdout.write([...lines, "end", ""].join("\n"));
});

// How fast the codec of a page decodes a line, and how much memory that takes:
//     framegen docs --out site && node --expose-gc benchmarks/page_codec.js site/reference/busservo/decoder.html
"use strict";

const fs = require("fs");
const vm = require("vm");

function published(page) {
  const text = fs.readFileSync(page, "utf8");
  const [, data] = /<script type="application\/json" id="protocol">(.*?)<\/script>/s.exec(text);
  const scripts = [...text.matchAll(/<script>(.*?)<\/script>/gs)].map(([, script]) => script);
  const script = scripts.find((each) => each.includes("function makeCodec"));
  return vm.runInThisContext(`${script}\n({ makeCodec })`).makeCodec(JSON.parse(data));
}

const codec = published(process.argv[2]);
let seed = 1;
const chance = (below) => {
  seed = (seed * 48271) % 0x7fffffff;
  return seed % below;
};
const frames = codec.kinds.map(({ name, example }) => [...codec.encode(name, example)]);
const { headers } = { headers: frames.map((frame) => frame.slice(0, 2)) };

// Some bytes of a kind of line, as many as asked for.
function line(size, piece) {
  const bytes = new Uint8Array(size);
  for (let at = 0; at < size;) {
    const next = piece();
    bytes.set(next.slice(0, size - at), at);
    at += next.length;
  }
  return bytes;
}

const header = headers[0];
const noise = () => Array.from({ length: 1 + chance(20) }, () => chance(256));
const LINES = {
  "clean frames": () => frames[chance(frames.length)],
  "frames and noise": () => (chance(3) ? frames[chance(frames.length)] : noise()),
  "noise": noise,
  "runs of the first byte": () => [header[0]],
  "headers": () => header,
  "false headers": () => [...header, chance(256), chance(32)],
  "unknown ids": () => [...header, 0xff, 0x63],
  "unknown ids and refused lengths": () => (chance(9) ? [...header, 1] : [...header, 0xff, 0x63]),
  "unknown ids, each of which ends where the first does": (() => {
    let length = 255;
    return () => [...header, (length = length > 8 ? length - 4 : 255), 0x63];
  })(),
};

const time = (task) => {
  const start = process.hrtime.bigint();
  const found = task();
  return [Number(process.hrtime.bigint() - start) / 1e6, found];
};

for (const [title, piece] of Object.entries(LINES)) {
  const bytes = line(300000, piece);
  const whole = [];
  let events;
  for (let i = 0; i < 3; i++) {
    const [ms, found] = time(() => codec.makeStream().flush(bytes));
    whole.push(ms);
    events = found;
  }
  const [singly] = time(() => {
    const stream = codec.makeStream();
    for (let at = 0; at < bytes.length; at++) stream.feed(bytes.subarray(at, at + 1));
    stream.flush();
  });
  console.log(`${title}: 300 kB in ${whole.map((ms) => ms.toFixed(0)).join(", ")} ms, `
    + `${events.length} events; byte by byte in ${singly.toFixed(0)} ms`);
}

const chunk = line(1 << 16, LINES["frames and noise"]);
const stream = codec.makeStream();
let most = 0, count = 0;
const [ms] = time(() => {
  for (let fed = 0; fed < 50e6; fed += chunk.length) {
    count += stream.feed(chunk).length;
    most = Math.max(most, process.memoryUsage().rss);
  }
});
console.log(`50 MB in chunks: ${ms.toFixed(0)} ms, ${count} events, at most ${(most / 1e6).toFixed(0)} MB`);

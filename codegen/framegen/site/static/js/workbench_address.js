// The state of the workbench in its address, so that a colleague can be sent a link.
"use strict";

// A longer address is cut by programs that pass it on.
const ADDRESS_LONGEST = 8000;
const ADDRESS_KEYS = ["hex", "direction", "message"];

// The direction that a word asks for: by its key, or by its sender where that sends one way.
function directionOf(protocol, word) {
  const ways = protocol.directions.filter(({ key, sender }) => word === key || word === sender);
  return ways.length === 1 ? ways[0].key : "";
}

// A field whose name is a key of the address has a mark before it.
const addressKey = (name) => (ADDRESS_KEYS.includes(name) ? `.${name}` : name);

// What an address says; null for what it leaves out.
function readAddress(search, protocol, kinds) {
  const query = new URLSearchParams(search), kind = kinds.find(({ name }) => name === query.get("message"));
  const given = kind ? kind.given.filter(({ name }) => query.has(addressKey(name))) : [];
  return {
    text: query.get("hex"),
    direction: directionOf(protocol, query.get("direction") || ""),
    message: kind ? kind.name : null,
    words: given.length ? given.map(({ name }) => `${name}=${query.get(addressKey(name))}`).join(" ") : null,
  };
}

// The query of a state, and whether the capture is in it: one that is too long is left out.
function writeAddress({ text, direction, message, kind, words }) {
  const query = new URLSearchParams();
  if (direction) query.set("direction", direction);
  if (message) query.set("message", message);
  if (kind && words !== null) {
    for (const word of words.split(/\s+/).filter((each) => each.includes("="))) {
      const sign = word.indexOf("="), name = word.slice(0, sign);
      if (kind.given.some((slot) => slot.name === name)) query.set(addressKey(name), word.slice(sign + 1));
    }
  }
  const rest = String(query), whole = new URLSearchParams({ hex: text ?? "" });
  const isWhole = text !== null && String(whole).length + rest.length <= ADDRESS_LONGEST;
  const plain = [isWhole ? String(whole) : "", rest].filter(Boolean).join("&");
  // These two are as safe in a query as they are readable.
  return { query: plain.replace(/%3A/g, ":").replace(/%2C/g, ","), isWhole };
}

// Runs what each line of the input says, one after the other: {text, given}, where the text is the body
// of an async function that takes what is given as JSON, and a new `kept` object for each process.
// The answer is a line, too: {answer}, which is JSON again, or {failure}.
"use strict";

const { createInterface } = require("node:readline");

const AsyncFunction = (async () => {}).constructor;
const programs = new Map(), kept = {};

function compiled(text) {
  if (!programs.has(text)) programs.set(text, new AsyncFunction("given", "kept", "require", text));
  return programs.get(text);
}

// As a process of its own ends: once nothing waits any more.
async function untilQuiet() {
  while (process.getActiveResourcesInfo().includes("Timeout")) {
    await new Promise((resolve) => { setImmediate(resolve); });
  }
}

const say = (said) => process.stdout.write(`${JSON.stringify(said)}\n`);
const fail = (error) => say({ failure: String(error?.stack ?? error) });

process.on("uncaughtException", fail);
createInterface({ input: process.stdin }).on("line", async (line) => {
  const { text, given } = JSON.parse(line);
  try {
    const answer = await compiled(text)(given, kept, require);
    await untilQuiet();
    say({ answer });
  } catch (error) {
    fail(error);
  }
});

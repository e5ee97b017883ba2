// Runs what each line of the input says, one after the other: {text, given}, where the text is the body
// of an async function that takes what is given as JSON, and what others have kept in this process.
// The answer is a line, too: {answer}, which is JSON again, or {failure}. What a program leaves to fail
// later, or waits for in vain, is its failure as well, and the end of the process.
"use strict";

const { createInterface } = require("node:readline");

const PAUSE_MS = 5, PATIENCE = 100;
const AsyncFunction = (async () => {}).constructor;
const programs = new Map(), kept = {};

function compiled(text) {
  if (!programs.has(text)) programs.set(text, new AsyncFunction("given", "kept", text));
  return programs.get(text);
}

let isOver = false;
function say(said, then) {
  if (!isOver) process.stdout.write(`${JSON.stringify(said)}\n`, then);
}
const failure = (error) => String(error?.stack ?? error);
const fail = (error) => say({ failure: failure(error) });
function end(error) {
  say({ failure: failure(error), isEnd: true }, () => process.exit(1));
  isOver = true;
}

// Timers of programs keep a process alive; ours do not.
const isWaiting = () => process.getActiveResourcesInfo().includes("Timeout");
const pause = () => new Promise((resolve) => { setTimeout(resolve, PAUSE_MS).unref(); });

async function run({ text, given }) {
  let isDone = false;
  const answer = compiled(text)(given, kept).finally(() => { isDone = true; });
  const watch = async () => {
    for (let idle = 0; !isDone; idle = isWaiting() ? 0 : idle + 1) {
      if (idle > PATIENCE) end(new Error("a promise is never kept"));
      await pause();
    }
  };
  await Promise.race([answer, watch()]);
  // A promise that nobody waits for has failed by then.
  await new Promise((resolve) => { setImmediate(resolve); });
  while (isWaiting()) await pause();
  return answer;
}

process.on("uncaughtException", end);
createInterface({ input: process.stdin })
  .on("line", (line) => run(JSON.parse(line)).then((answer) => say({ answer }), fail));

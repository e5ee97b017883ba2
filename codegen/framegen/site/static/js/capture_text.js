// Text that holds a capture, in whichever form people have it: what form that is, and its bytes.
"use strict";

// So much of a text decides its form.
const CAPTURE_SAMPLE = 65536;

// The form that a text which begins so has. `says` holds the names of those who send and the reasons
// of noise, as `captureWords` gives them.
function recognise(sample, says) {
  const lines = firstLines(sample);
  const form = lineFormOf(lines);
  const log = logReader(lines, says);
  // A line of one byte may be an annotation as well.
  const hasForm = form && (lines.every(([line]) => form.pattern.test(line)) || !lines.every(isLogLine));
  if (log && !hasForm) return { name: "a log of a line", byLine: true, make: () => log };
  if (form) return { name: form.name, byLine: true, make: () => makeLineReader(form, says) };
  const header = csvHeader(lines);
  if (header) {
    const name = header.isOurs ? "a table of the command" : "a table of a logic analyser";
    const make = () => makeCsvReader(header, lines, says.senders);
    return { name, byLine: true, make };
  }
  const plain = sample.replace(/#[^\n]*|\/\/[^\n]*|\/\*[^]*?(?:\*\/|$)/g, " ");
  if (/[[{('"]/.test(plain)) return { name: "code", whole: true, make: makeCodeReader };
  return { name: "hex", make: makePlainReader };
}

// The lines that a form is looked for in; of a very long one, as much as shows that it is none.
function firstLines(text) {
  const found = [];
  for (const line of linesOf(text)) {
    if (found.push(line) === 50) break;
  }
  return found;
}

// `received` is the direction of what comes to the end that records, if there is one.
function captureWords(protocol, received = null) {
  const way = protocol.directions.find(({ key }) => key === received);
  const ways = protocol.directions.filter(({ sender }) => sender === way?.receiver);
  return {
    received,
    sent: ways.length === 1 ? ways[0].key : null,
    senders: new Map(protocol.directions.map(({ key, sender }) => [sender, key])),
    reasons: protocol.reasons,
  };
}

function makePlainReader() {
  const reader = makeHexReader();
  return {
    read(text, take) {
      const bytes = reader.read(text);
      if (bytes.length) take(bytes, {});
    },
  };
}

// Code is read whole; what has no literal in it is taken for hex, which says what is wrong with it.
function makeCodeReader() {
  const reader = {
    read(text, take) {
      const { bytes, kinds } = readCode(text);
      if (!kinds.length) parseHex(text);
      reader.name = kinds.join(" and ");
      if (bytes.length) take(bytes, {});
    },
  };
  return reader;
}

// A reader of text in pieces: `feed` takes some, and `end` what was kept back of it. It counts lines,
// so that Unreadable is thrown with the place in all that was fed. `take` gets bytes and what is said
// of them: direction, channel, time, isClock; `whole` if nothing goes on in the next; and the
// reason for which they are noise, which is empty if they do not say it.
function makeTextReader(says, take) {
  let form = null, reader = null, held = "", line = 1, column = 1, place = 0;
  const seen = { name: "", lines: 0, bytes: 0 };

  function counted(bytes, said) {
    seen.bytes += bytes.length;
    take(bytes, said);
  }

  function read(text) {
    if (!text) return;
    try {
      reader.read(text, counted);
    } catch (error) {
      if (error instanceof Unreadable && error.line === undefined) {
        const found = error.placeIn(text);
        Object.assign(error, {
          line: line + found.line - 1, column: found.column + (found.line === 1 ? column - 1 : 0),
          at: error.at + place,
        });
      }
      throw error;
    }
    const ends = text.split("\n").length - 1;
    if (form.byLine) seen.lines += text.split("\n").filter((each) => each.trim()).length;
    column = ends ? text.length - text.lastIndexOf("\n") : column + text.length;
    [line, place] = [line + ends, place + text.length];
  }

  function begin(sample) {
    form = recognise(sample, says);
    reader = form.make();
  }

  function feed(text) {
    // A mark of the byte order is no part of the first line.
    const isMarked = !form && !held && text.startsWith("\ufeff");
    if (isMarked) place = 1;
    held += isMarked ? text.slice(1) : text;
    if (!form) {
      if (held.length < CAPTURE_SAMPLE) return;
      begin(held.slice(0, CAPTURE_SAMPLE));
    }
    const end = form.whole ? 0 : lastCut(held, form.byLine);
    const piece = held.slice(0, end);
    held = held.slice(end);
    read(piece);
  }

  // What the text was: the name of its form, how many lines it had if it is one of lines, and bytes.
  function end() {
    if (!form) begin(held.slice(0, CAPTURE_SAMPLE));
    const piece = held;
    held = "";
    read(piece);
    try {
      if (reader.end) reader.end();
    } catch (error) {
      throw error instanceof Unreadable ? Object.assign(error, { line, column, at: place }) : error;
    }
    return { ...seen, name: reader.name || form.name };
  }

  return { feed, end };
}

// The place up to which text can be read without what follows it: behind a line, or else a word.
function lastCut(text, byLine) {
  const line = text.lastIndexOf("\n") + 1;
  if (line || byLine) return line;
  const last = /[\s,;][^\s,;]*$/.exec(text.slice(-256));
  return last ? Math.max(0, text.length - 256) + last.index + 1 : 0;
}

// All of a text at once.
function readCaptureText(text, says, take) {
  const reader = makeTextReader(says, take);
  reader.feed(text);
  return reader.end();
}

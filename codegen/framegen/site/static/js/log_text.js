// Logs of other programs: what serial monitors, Python's logging and tables of two wires say of a line.
// What framewire/recording/form.py reads, and nothing else.
"use strict";

const LOG_CLOCK = (name) => String.raw`(?<${name}>(?:[0-9]{4}-[0-9]{2}-[0-9]{2}[ T])?`
  + String.raw`[0-9]{2}(?::[0-9]{2}){2}(?:[.,][0-9]{1,9})?)`;
const LOG_LEVEL = "(?:DEBUG|INFO|WARNING|ERROR|CRITICAL)";
const LOG_MONITORED = inPieces("i",
  String.raw`^\s*(?:${LOG_CLOCK("at")}(?:\s*->|(?=\s+[TR]X\s*:))|\[${LOG_CLOCK("bracketed")}\])?`,
  String.raw`\s*(?:(?<way>[TR]X)\s*:)?\s*(?<said>.*)`);
const LOG_LOGGED = inPieces("",
  String.raw`^\s*(?:${LOG_CLOCK("at")}\s+(?:-\s+)?`,
  String.raw`(?:${LOG_LEVEL}\s+[\w.-]+:|[\w.-]+\s+-\s+${LOG_LEVEL}\s+-)`,
  String.raw`|${LOG_LEVEL}:[\w.-]+:)\s*(?<said>.*)`);
const LOG_LITERAL = /b(?:'(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")/g;
const LOG_BEGIN = /^(?:b['"]|(?:0x|\\x)?[0-9a-f]{2}(?![g-z]))/i;
// Letters alone are a word rather than bytes; unless they are one byte.
const LOG_WORD = /^(?:0x)?(?=[a-f]*[0-9]|..,?$)(?:[0-9a-f]{2})+,?$/i;
const LOG_SENT = new Set("tx sent send sends sending write writing wrote written".split(" "));
const LOG_CAME = new Set("rx received receive receiving recv read reading got".split(" "));
const LOG_TIMES = new Set(["t", "time", "timestamp", "time [s]", "time (s)", "t [s]", "t_s", "time_s"]);

// A reader of a text that begins with these lines; null where they are no log.
function logReader(lines, says) {
  const [first] = lines.find(([line]) => line.split("#")[0].trim()) || [];
  if (first === undefined) return null;
  return logTable(first, says) || (isLogged(first) ? makeLogReader(says, readLogLine) : null);
}

function isLogged(first) {
  const logged = LOG_LOGGED.exec(first)?.groups;
  if (logged?.at) return true;
  if (logged) {
    try {
      return Boolean(saidInLog(logged.said, 0));
    } catch {
      return false;
    }
  }
  const { at, bracketed, way, said } = LOG_MONITORED.exec(first).groups;
  return Boolean(at || bracketed || way) && LOG_BEGIN.test(said);
}

function logTable(first, says) {
  const mark = [";", ",", "\t"].find((each) => first.includes(each)) || null;
  const names = mark ? first.split(mark).map((name) => unquoted(name).toLowerCase()) : [];
  const wires = ["tx", "rx"].filter((way) => names.includes(way));
  if (!wires.length || new Set(names).size < names.length) return null;
  const time = names.findIndex((name) => LOG_TIMES.has(name));
  return makeLogReader(says, (line, start) => {
    if (line === first) return [];
    const cells = line.split(mark);
    if (cells.length !== names.length) {
      throw new Unreadable(line, start, `has ${cells.length} columns, and the header has ${names.length}`,
        "paste whole lines");
    }
    const at = time < 0 ? null : unquoted(cells[time]);
    const isTime = at !== null
      && (/^[0-9]{1,9}\.[0-9]{1,9}$/.test(at) || inPieces("", `^${LOG_CLOCK("at")}$`).test(at));
    return wires.map((way) => [way, names.indexOf(way)]).filter(([, column]) => unquoted(cells[column]))
      .map(([way, column]) => {
        const place = start + cells.slice(0, column).join(mark).length + (column ? 1 : 0);
        return { way, at: isTime ? at : null, bytes: readHexOf(cells[column].replace(/"/g, " "), place) };
      });
  });
}

const unquoted = (cell) => cell.trim().replace(/^"|"$/g, "");

// What goes each way is one stream; times are seconds since the first line.
function makeLogReader({ sent, received }, readLine) {
  let began = null, last = 0;

  function secondsSince(clock) {
    const [time, day = ""] = clock.replace("T", " ").split(" ").reverse();
    let at = secondsOf(time.replace(",", ".")) + (day ? Date.parse(day) / 1000 : 0);
    // A clock without a day goes on after midnight.
    while (!day && time.includes(":") && at < last - 43200) at += 86400;
    last = at;
    began ??= at;
    return Math.round((at - began) * 1e9) / 1e9;
  }

  function read(text, take) {
    for (const [line, start] of linesOf(text)) {
      if (!line.split("#")[0].trim()) continue;
      for (const { way, at, bytes } of readLine(line, start)) {
        const time = at ? secondsSince(at) : null;
        const ways = { tx: { channel: "tx", direction: sent }, rx: { channel: "rx", direction: received } };
        const said = ways[way];
        take(bytes, { time, ...said });
      }
    }
  }

  return { read };
}

// The way, the clock and the bytes of a line.
function readLogLine(line, start) {
  const logged = LOG_LOGGED.exec(line)?.groups;
  if (logged) return [{ at: logged.at, ...saidInLog(logged.said, start + line.length - logged.said.length) }];
  const { at, bracketed, way, said } = LOG_MONITORED.exec(line).groups;
  if (!at && !bracketed && !way) {
    throw new Unreadable(line.trim(), start + line.search(/\S/),
      "is no line of a log, with a time or a direction, as other lines are",
      "remove the line, or paste it apart");
  }
  const place = start + line.length - said.length, [literal] = said.match(LOG_LITERAL) || [];
  const bytes = literal === said.trim() ? readCode(literal).bytes : readHexOf(said, place);
  return [{ at: at || bracketed, way: (way || "").toLowerCase(), bytes }];
}

function isLogLine([line, start]) {
  try {
    return Boolean(readLogLine(line, start));
  } catch {
    return false;
  }
}

// The bytes in what somebody logged, and the way that they went.
function saidInLog(message, place) {
  const literals = [...message.matchAll(LOG_LITERAL)];
  if (literals.length > 1) {
    throw new Unreadable(literals[1][0], place + literals[1].index,
      "is one of several bytes literals, and nothing says which was on the line", "paste one of them");
  }
  if (literals.length) {
    const [{ 0: literal, index }] = literals;
    try {
      return { bytes: readCode(literal).bytes, way: wayInLog(message.slice(0, index).split(/\s+/)) };
    } catch (error) {
      if (error instanceof Unreadable) error.at += place + index;
      throw error;
    }
  }
  const words = [...message.matchAll(/\S+/g)];
  let begin = words.length;
  while (begin && LOG_WORD.test(words[begin - 1][0])) begin--;
  const before = words.slice(0, begin).map(([word]) => word), last = before.at(-1) || ":";
  if (begin === words.length) {
    throw new Unreadable(message.trim() || "…", place, "is a line of a log without bytes at its end",
      "remove it, or put a # before it");
  }
  if (!last.endsWith(":") && !LOG_SENT.has(last.toLowerCase()) && !LOG_CAME.has(last.toLowerCase())) {
    throw new Unreadable(last, place + words[begin - 1].index,
      `stands before “${words[begin][0]}”, so that this may be no byte`,
      "put “sent”, “received” or a colon between them");
  }
  const at = words[begin].index;
  return { bytes: readHexOf(message.slice(at), place + at), way: wayInLog(before) };
}

function wayInLog(words) {
  const said = words.map((word) => word.replace(/^[:,]+|[:,]+$/g, "").toLowerCase());
  const sent = said.some((word) => LOG_SENT.has(word)), came = said.some((word) => LOG_CAME.has(word));
  return sent === came ? "" : sent ? "tx" : "rx";
}

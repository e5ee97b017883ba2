// Captures of a line an event: what the command prints and records, candump, hex dumps, analysers.
"use strict";

// So many bytes at most are left out of a hex dump by one `*`.
const DUMP_MOST = 1 << 26;
const LINE_SKIPPED = /^\s*(?:#|\$ |\^C$|hint: |[0-9]+ bytes?: )/;

// A pattern written in pieces.
const inPieces = (flags, ...pieces) => new RegExp(pieces.join(""), flags);

// Forms by lines: what the form is called, the pattern of a line, and what `begins` one that decides
// for the form. `who` is a sender, `either`, `noise` or `unknown`; `channel` is a wire whose sender is
// not known, and what came on it is `joined`.
const LINE_FORMS = [
  {
    name: "lines of a recording",
    isReceived: true,
    pattern: /^(?<hex>[^#]*)#+ *(?<at>[0-9]{1,9}(?:\.[0-9]{1,9})?) s, (?<who>[^:]*): ?(?<what>.*)$/,
  },
  {
    name: "lines of monitor or decode",
    pattern: inPieces("",
      String.raw`^\s*(?:(?<at>[0-9]+\.[0-9]+|[0-9]{2}:[0-9]{2}:[0-9]{2}\.[0-9]+)|[0-9]+)\s+`,
      String.raw`(?<who>[a-z][\w-]*)\s+(?<what>.*?) ?\| (?<hex>[0-9A-Fa-f ]*)$`),
  },
  {
    name: "lines of JSON",
    pattern: /^\s*\{.*"(?:hex|noise)":.*\}\s*$/,
    read: readJson,
  },
  {
    name: "lines of candump",
    pattern: inPieces("i",
      String.raw`^\s*(?:\((?<at>[0-9.]+)\)\s+)?(?<channel>[a-z]*can[0-9]*)\s+`,
      String.raw`(?:[0-9A-F]{3,8}#(?<hex>[0-9A-F.]*)(?:\s+[RT])?`,
      String.raw`|[0-9A-F]{3,8}\s+\[[0-9]+\]\s+(?<spaced>[0-9A-F ]*?)(?:\s+'.*')?)\s*$`),
    joined: true,
  },
  {
    name: "a hex dump",
    begins: /^(?:0{7,8}(?::|\s\s)|[0-9A-F]{8}(?:: (?:[0-9A-F]{2})+\s|\s\s.*\|$))/i,
    pattern: inPieces("i",
      String.raw`^(?:(?<place>[0-9A-F]{7,8})(?=\s*$|:\s|\s\s)`,
      String.raw`(?:\s\s(?<hex>(?:[0-9A-F]{2}\s{1,2}){0,15}[0-9A-F]{2})(?:\s+\|.*\|)?`,
      String.raw`|:\s(?<spaced>(?:(?:[0-9A-F]{2})+\s)+)\s.*|)|\*)\s*$`),
    joined: true,
  },
  {
    name: "annotations of a logic analyser",
    begins: /^\s*(?:[0-9]+-[0-9]+:?\s+)?(?=[^:]*[g-z])[\w-]+(?: [\w-]+)*: /i,
    pattern: inPieces("i",
      String.raw`^\s*(?:[0-9]+-[0-9]+:?\s+)?(?<channel>[\w-]+(?: [\w-]+)*(?:: [^:]*)?): `,
      String.raw`(?<hex>[0-9A-F]{2})\s*$`),
    joined: true,
  },
];

function lineFormOf(lines) {
  const fits = (line, { pattern, begins }) => pattern.test(line) && (!begins || begins.test(line));
  return LINE_FORMS.find((form) => lines.some(([line]) => !/^\s*#/.test(line) && fits(line, form)));
}

// A reader of whole lines. `senders` are directions by the name of who sends them, and `reasons`
// those that noise has. It hands `take` the bytes of a line with what the line says of them.
function makeLineReader(form, { senders, reasons, received }) {
  const repeated = makeRepeatedLines();

  function read(text, take) {
    for (const [line, start] of linesOf(text)) {
      const found = form.pattern.exec(line);
      if (found) {
        const said = form.read ? form.read(line, start) : found.groups;
        if ("place" in said && !repeated.take(said, start, take)) continue;
        takeLine(said, line, start, take);
      } else if (!LINE_SKIPPED.test(line) && !isAnnotation(line)) {
        const at = start + line.search(/\S/);
        throw new Unreadable(line.trim(), at, `is not one of ${form.name}, as other lines are`,
          "remove the line, or paste it apart");
      }
    }
  }

  // Other rows of an analyser say where bits begin and end.
  function isAnnotation(line) {
    return form.name.startsWith("annotations") && /^\s*(?:[0-9]+-[0-9]+:?\s+)?[\w-]+[^:]*:/.test(line);
  }

  function takeLine(said, line, start, take) {
    const hex = said.hex ?? said.spaced ?? "";
    const time = said.at === undefined || said.at === null ? null : secondsOf(String(said.at));
    const bytes = readHexOf(hex.replace(/\./g, " "), start + Math.max(0, hex ? line.indexOf(hex) : 0));
    const isClock = String(said.at).includes(":");
    if (form.joined) {
      take(bytes, { channel: said.channel || "", time });
      return;
    }
    take(bytes, { whole: true, time, isClock, ...senderOf(said, line, start) });
  }

  function senderOf({ who, what = "" }, line, start) {
    const words = who.split(" "), isNoise = words.at(-1) === "noise";
    const sender = isNoise ? words.slice(0, -1).join(" ") : who;
    if (sender && sender !== "either" && sender !== "unknown" && !senders.has(sender)) {
      const known = [...senders.keys(), "either", "unknown", "noise"].join(", ");
      throw new Unreadable(sender, start + line.indexOf(sender), "is none of those who send",
        `write one of ${known}`);
    }
    const why = Object.values(reasons).find((reason) => what === reason || what.startsWith(`${reason}:`));
    // A recording names no sender where noise came to the end that recorded.
    const unnamed = form.isReceived && !sender ? received : null;
    return { direction: senders.get(sender) ?? unnamed, noise: isNoise ? why || "" : null };
  }

  return { read, end: repeated.end };
}

// In a hex dump, `*` stands for lines like the one before, as many as the place on the next one says.
function makeRepeatedLines() {
  let star = null, place = 0, before = "";

  function refused(hint, at = star) {
    return new Unreadable("*", at, "leaves out lines, and nothing says how many", hint);
  }

  // Take a line; whether it has bytes of its own.
  function take(said, start, give) {
    if (said.place === undefined) {
      star = start;
      if (!before) throw refused("paste the line in front of it as well");
      return false;
    }
    const at = parseInt(said.place, 16);
    if (star !== null) {
      const bytes = readHexOf(before, start), left = at - place - bytes.length;
      if (left < 0 || left % bytes.length || left > DUMP_MOST) throw refused("dump it whole, by -v", start);
      for (let done = 0; done < left; done += bytes.length) give(bytes, { channel: "", time: null });
    }
    [star, place, before] = [null, at, said.hex ?? said.spaced ?? ""];
    return true;
  }

  function end() {
    if (star !== null) throw refused("paste the line behind it as well", 0);
  }

  return { take, end };
}

function readHexOf(hex, at) {
  try {
    return parseHex(hex);
  } catch (error) {
    if (error instanceof Unreadable) error.at += at;
    throw error;
  }
}

// What `--json` prints of an event.
function readJson(line, start) {
  let said;
  try {
    said = JSON.parse(line);
  } catch {
    throw new Unreadable(line.trim(), start, "is no JSON", "paste the whole line");
  }
  const { hex = "", noise, time, from = "either", reason = "" } = said;
  const isNoise = typeof noise === "string" && !("parameters" in said);
  const who = isNoise ? `${from === "either" ? "" : `${from} `}noise` : from;
  return { hex: typeof noise === "string" ? noise : hex, at: time, who, what: reason };
}

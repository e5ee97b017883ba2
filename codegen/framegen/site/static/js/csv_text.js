// Tables of bytes with a header line: exports of logic analysers, and those of the command.
"use strict";

// What a column is called that holds bytes, in the order in which it is looked for; and times.
const CSV_VALUES = [
  "hex", "data", "value", "byte", "bytes", "payload", "rx data", "tx data", "uart: rx data",
  "uart: tx data", "data(hex)", "decoded protocol result",
];
const CSV_TIMES = [
  "time [s]", "start_time", "time", "time(s)", "time (s)", "timestamp", "start", "start time",
];
const CSV_WIRES = ["name", "channel", "wire", "analyzer name", "direction", "from"];
const CSV_FORMS = [
  [/^0x[0-9a-f]{1,2}$/i, "hex", (cell) => parseInt(cell, 16)],
  [/^0b[01]{1,8}$/i, "binary", (cell) => parseInt(cell.slice(2), 2)],
  [/^(?:[0-9]|[1-9][0-9]|1[0-9]{2}|2[0-4][0-9]|25[0-5])$/, "decimal", Number],
  [/^.*\(0x[0-9a-f]{1,2}\)$/i, "hex", (cell) => parseInt(cell.slice(cell.lastIndexOf("(") + 1), 16)],
  [/^[0-9a-f]{2}$/i, "hex", (cell) => parseInt(cell, 16)],
];

// The header of a table that begins so; null where it is none.
function csvHeader(lines) {
  const head = lines.find(([line]) => !/^\s*[#;]/.test(line));
  if (!head) return null;
  const [line, at] = head, mark = [",", ";", "\t"].find((each) => line.includes(each));
  if (!mark) return null;
  const names = cellsOf(line, mark).map(([text]) => text.trim().toLowerCase());
  const find = (known) => known.map((name) => names.indexOf(name)).find((column) => column >= 0) ?? -1;
  const value = find(CSV_VALUES), time = find(CSV_TIMES);
  if (names.length < 2 || (value < 0 && time < 0)) return null;
  return {
    at, line, mark, names, value, time, wire: find(CSV_WIRES), type: names.indexOf("type"),
    reason: names.indexOf("reason"), isOurs: names.includes("hex") && names.includes("from"),
  };
}

// The cells of a line with their columns; those in quotes without them.
function cellsOf(line, mark) {
  const cells = [], quoted = /"((?:[^"]|"")*)"/y;
  for (let at = 0; at <= line.length;) {
    const start = at + /^ */.exec(line.slice(at))[0].length;
    quoted.lastIndex = start;
    const found = line[start] === '"' && quoted.exec(line);
    let end = line.indexOf(mark, found ? quoted.lastIndex : at);
    if (end < 0) end = line.length;
    cells.push(found ? [found[1].replace(/""/g, '"'), start + 1] : [line.slice(at, end), at]);
    at = end + 1;
  }
  return cells;
}

// The form in which all cells of a sample are numbers.
function csvNumbers(lines, header) {
  const sample = lines.filter(([, at]) => at > header.at).map(([line]) => cellsOf(line, header.mark))
    .map((cells) => (cells[header.value]?.[0] || "").trim()).filter(Boolean);
  return CSV_FORMS.find(([pattern]) => sample.every((cell) => pattern.test(cell)));
}

// A reader of whole lines behind the header; `sample` are the first lines of the table.
function makeCsvReader(header, sample, senders) {
  const form = header.isOurs ? null : csvNumbers(sample, header);
  let isBegun = false;

  function read(text, take) {
    if (header.value < 0) {
      throw new Unreadable(header.line, header.at, "names no column of bytes",
        `name it ${CSV_VALUES.slice(0, 4).join(", ")} or ${CSV_VALUES[4]}`);
    }
    for (const [line, start] of linesOf(text)) {
      const isHead = !isBegun && line === header.line;
      isBegun = isBegun || isHead;
      if (!isHead && isBegun) takeRow(cellsOf(line, header.mark), line, start, take);
    }
  }

  const textIn = (cells, column) => (column < 0 || !cells[column] ? "" : cells[column][0].trim());

  function takeRow(cells, line, start, take) {
    if (header.isOurs) {
      if (cells.length >= header.names.length) takeOurs(cells, start, take);
      else if (!LINE_SKIPPED.test(line)) {
        throw new Unreadable(line, start, "has fewer columns than the header", "paste whole lines");
      }
      return;
    }
    const type = textIn(cells, header.type);
    if (type && type !== "data") return;
    const cell = textIn(cells, header.value), place = start + (cells[header.value]?.[1] ?? 0);
    const [pattern, , valueOf] = form || CSV_FORMS[0];
    if (!pattern.test(cell)) {
      const problem = `is no byte, in the column “${header.names[header.value]}”`;
      const hint = "export the values in hex, like 0x1B";
      throw new Unreadable(cell || line, cell ? place : start, problem, hint);
    }
    const time = Number(textIn(cells, header.time) || NaN);
    take(Uint8Array.of(valueOf(cell)), {
      channel: textIn(cells, header.wire), time: Number.isFinite(time) ? time : null,
    });
  }

  // A row that the command has written.
  function takeOurs(cells, start, take) {
    const who = textIn(cells, header.names.indexOf("from")), reason = textIn(cells, header.reason);
    const known = senders.has(who) || who === "either" ? who : "either";
    const isNoise = reason && !textIn(cells, header.names.indexOf("message"));
    const time = textIn(cells, header.time), hex = textIn(cells, header.value);
    take(readHexOf(hex, start + cells[header.value][1]), {
      whole: true, direction: senders.get(known) ?? null, noise: isNoise ? reason : null,
      time: /^[0-9.]+$/.test(time) ? Number(time) : null,
    });
  }

  const isPlain = !form || form[1] === "hex";
  return { read, name: isPlain ? "" : `a table of a logic analyser in ${form[1]}` };
}

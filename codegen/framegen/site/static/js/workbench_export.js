// A decoded capture as a file: the columns and keys of the command's `decode --csv` and `--json`.
"use strict";

const EXPORT_COLUMNS = "offset,time,from,direction,message,or,fields,hex,reason";
// What is said of an unknown frame beside its numbers.
const NOISE_KEYS = ["offset", "time", "from", "noise", "reason", "parameters"];

// A line of text for an event, without its end.
function makeExport(codec, protocol) {
  const senderOf = (key) => protocol.directions.find((each) => each.key === key).sender;
  const originOf = ({ direction, names }) =>
    (direction === null || names.length > 1 ? "either" : senderOf(direction));
  const cell = (text) => (/[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);

  function fieldsOf({ kind, bytes }) {
    return fieldsInJson(kind, codec.decodeFrame(bytes, kind.direction).fields);
  }

  function asCsv(event) {
    const { kind, names: [name, ...others] } = event, time = event.time === null ? "" : event.time.toFixed(6);
    const said = kind ? [kind.direction, name, others.join(" "), fieldsOf(event), toHex(event.bytes), ""]
      : ["", "", "", "", toHex(event.bytes), event.reason];
    return [event.at, time, originOf(event), ...said].map((each) => cell(String(each))).join(",");
  }

  function asJson(event) {
    const time = event.time === null ? "" : `, "time": ${floatInJson(Number(event.time.toFixed(6)))}`;
    const begin = `{"offset": ${event.at}${time}, "from": ${asciiJson(originOf(event))}`;
    if (!event.kind) {
      const numbers = event.type === "unknown" ? numbersOf(event.bytes) : "";
      return `${begin}, "noise": "${toHex(event.bytes)}", "reason": ${asciiJson(event.reason)}${numbers}}`;
    }
    const [name, ...others] = event.names;
    const either = others.length ? `, "or": [${others.map(asciiJson).join(", ")}]` : "";
    const what = `"direction": "${event.kind.direction}", "message": "${name}", "fields": ${fieldsOf(event)}`;
    return `${begin}, ${what}, "hex": "${toHex(event.bytes)}"${either}}`;
  }

  // What an unknown frame says of itself: who it is from, its command, and its parameters.
  function numbersOf(bytes) {
    const frame = protocol.frames.find(({ header }) => header.every((byte, i) => bytes[i] === byte));
    if (!frame) return "";
    const body = frame.slots.findIndex(({ role }) => role === "body");
    const numbers = ["address", "id"].flatMap((each) =>
      frame.slots.filter(({ role }) => role === each));
    const tail = frame.slots.slice(body + 1).reduce((sum, { size }) => sum + size, 0);
    const keyOf = (name) => asciiJson(NOISE_KEYS.includes(name) ? `${name}_` : name);
    const said = numbers.map(({ name, at, size, order }) =>
      `, ${keyOf(name)}: ${readWide({ size, order, signed: false }, bytes, at)}`);
    const parameters = bytes.slice(frame.slots[body].at, bytes.length - tail);
    return `${said.join("")}, "parameters": "${toHex(parameters)}"`;
  }

  // A line of a recording, which `decode`, `replay` and this page read.
  function asRecording(event) {
    const who = originOf(event), time = (event.time ?? 0).toFixed(6);
    const what = event.kind ? `${who}: ${event.names.join(" or ")}`
      : `${event.type === "unknown" ? who : `${who} noise`}: ${event.reason}`;
    return `${toHex(event.bytes)}  # ${time} s, ${what}`;
  }

  return {
    csv: { head: `${EXPORT_COLUMNS}\n`, line: asCsv, type: "text/csv", ending: "csv" },
    json: { head: "", line: asJson, type: "application/x-ndjson", ending: "jsonl" },
    recording: { head: "", line: asRecording, type: "text/plain", ending: "hex" },
  };
}

// Write a capture as a file, a slice at a time.
async function saveCapture(capture, { head, line, type, ending }, title) {
  const parts = [head], name = `${title}-capture.${ending}`;
  let lines = [], since = performance.now();
  for (let index = 0; index < capture.size; index++) {
    lines.push(line(capture.event(index)));
    if (lines.length < 4096 && index + 1 < capture.size) continue;
    parts.push(new Blob([`${lines.join("\n")}\n`]));
    lines = [];
    if (performance.now() - since > INPUT_SLICE) {
      await nextTurn();
      since = performance.now();
    }
  }
  saveFile(new File(parts, name, { type }));
  announce(`${counted(capture.size, "event")} saved as ${name}`);
}

// What is said of a line: why a browser has none, why a port cannot be opened, and what was lost.
"use strict";

function nameOfPort(port) {
  const { usbVendorId, usbProductId, bluetoothServiceClassId } = port.getInfo();
  const hex = (number) => number.toString(16).toUpperCase().padStart(4, "0");
  if (usbVendorId !== undefined) return `USB ${hex(usbVendorId)}:${hex(usbProductId ?? 0)}`;
  return bluetoothServiceClassId === undefined ? "a serial port" : "a Bluetooth port";
}

// Why there is no port to be had in this browser; null where there is.
function whyNoSerial({ isSecure, hasSerial, protocol }) {
  if (hasSerial) return null;
  if (!isSecure) {
    return `This page came over ${protocol}//, and browsers give a serial port only to pages that nobody `
      + "can have changed on the way.";
  }
  return "This browser cannot open a serial port: it has no Web Serial.";
}

const reasonOf = (error) => (error.message ? ` The browser says: “${error.message}”` : "");

// Why no port was chosen, or the port that was chosen is not open: what has happened, and what to do.
function wordsOfFailure(error, isOpening) {
  if (error.name === "NotFoundError") {
    return ["No port was chosen.", "If the port of the board is not in the list: plug it in, see that the "
      + "cable carries data, and that the driver of the adapter is installed."];
  }
  if (error.name === "SecurityError") {
    return ["This page may not use serial ports.",
      `A policy of the browser, or of the page around this one, forbids it.${reasonOf(error)}`];
  }
  if (error.name === "InvalidStateError") {
    return ["The port is open already.", "Disconnect it where this page uses it, or load the page again."];
  }
  if (error.name === "NetworkError" && isOpening) {
    return ["The port cannot be opened: it is in use, or this user may not open it.",
      "It may be open in another tab of this browser, or in another program: disconnect it there, then "
      + `connect again. On Linux, the user must be in the group of the port, often dialout.`
      + reasonOf(error)];
  }
  if (error instanceof TypeError) return ["The port does not take these settings.", reasonOf(error).trim()];
  return ["The port cannot be opened.", reasonOf(error).trim()];
}

function wordsOfLoss(error) {
  const why = error && error.name !== "NetworkError" ? reasonOf(error) : "";
  return ["The line was lost: the cable was pulled, or the board went off.",
    "Plug it in again. It is opened by itself where the browser remembers the adapter; some adapters, such "
    + `as those without a serial number, have to be chosen anew.${why}`];
}

const WORDS_OF_STATE = {
  closed: "Not connected.",
  choosing: "Choose the port of the board in the list that the browser shows.",
  opening: "Opening the port …",
  closing: "Closing the port …",
};

// What went wrong on a line that goes on.
const FAULTS = {
  BufferOverrunError: "Bytes were lost: they came faster than this computer took them.",
  BreakError: "The line was held down (a break): see that both grounds are joined.",
  FramingError: "A byte had no stop bit: the rate of the line may be wrong.",
  ParityError: "A byte had the wrong parity: the settings of the line may be wrong.",
};

function wordsOfFault(error) {
  return FAULTS[error.name] ?? `The line had an error.${reasonOf(error)}`;
}

const milliseconds = (ms) => (ms < 10 ? `${ms.toFixed(1)} ms` : `${Math.round(ms)} ms`);

// What becomes of a message that cannot be sent yet; `waiting` are as many, null where it is not among them.
function wordsOfWaiting(name, waiting) {
  if (waiting === null) return `${name} is not sent: ${QUEUE_BOUND} messages wait to be sent already.`;
  const others = waiting > 1 ? ` ${waiting} messages wait.` : "";
  return `${name} is sent once the question before it is answered, or given up.${others}`;
}

// What comes back for a message, before it is sent.
function wordsOfExchange(name, kind, data) {
  if (!kind) return "";
  if (kind.direction !== data.sent) {
    return `${name} is what the ${data.device} sends: choose a frame of the ${data.client} to send one.`;
  }
  const { reply, refusal, reports } = data.exchanges[name];
  if (reply) return `Answered by ${reply}${refusal ? `, or by ${refusal}` : ""}.`;
  const told = reports.length ? `, though the ${data.device} may report ${reports.join(" or ")}` : "";
  return `Nothing answers it${told}.`;
}

function wordsOfAnswer({ question, event, took, late, missing }) {
  if (late) {
    return `${event.message} came after all, ${milliseconds(took)} after ${question.event.message}: too `
      + "late to be waited for.";
  }
  const incomplete = missing.length ? ` It is incomplete: nothing of ${missing.join(" or ")}.` : "";
  return `${saysOf(event)}, ${milliseconds(took)} after ${question.event.message} was sent.${incomplete}`;
}

// What it may mean that nothing has come, in two sentences.
function wordsOfSilence({ event, within }, counts, isEnded) {
  if (isEnded) return [`No reply to ${event.message}:`, "the line was closed while it was waited for."];
  const heard = counts.bytes
    ? "Something else was heard on this line, so that it is not dead: the board may be busy, or not know "
      + "this question."
    : "Nothing was ever heard on this line: is the board on, are RX and TX crossed, are the grounds joined, "
      + "is the rate right?";
  return [`No reply to ${event.message} within ${milliseconds(within)}.`, heard];
}

// A message on one line: its name, and its fields with their units.
function saysOf({ message, kind, fields }) {
  const plain = (value) => {
    if (value !== null && typeof value === "object") return Object.values(value).join(":");
    return value === null ? "none" : String(value);
  };
  const shown = kind.given.map((slot) => {
    const value = fields[slot.name];
    const text = Array.isArray(value) ? value.map(plain).join(",") : plain(value);
    return ` ${slot.name}=${text}${slot.unit && !Array.isArray(value) ? ` ${slot.unit}` : ""}`;
  });
  return message + shown.join("");
}

// An entry of the list; a reply has its time with it.
function wordsOfEntry(event, names, answer) {
  if (event.type !== "message") return `${event.type}: ${event.reason}`;
  const says = saysOf(event);
  const named = names.length > 1 ? says.replace(event.message, names.join(" or ")) : says;
  return answer && !answer.late ? `${named} (${milliseconds(answer.took)})` : named;
}

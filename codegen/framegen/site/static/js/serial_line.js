// A serial port that comes and goes: chosen, opened, read, written, lost, opened again, closed.
// `serial` is the browser's navigator.serial, or something that behaves alike. No page is touched.
"use strict";

// A port that has come back cannot always be opened at once; so long after each attempt the next one.
const REOPEN_AFTER_MS = [0, 250, 500, 1000, 2000];

// `received(bytes)` gets what arrives. `changed(state, error)` says that the line is "closed", "choosing",
// "opening", "open", "lost" (and opened again when the port is back) or "closing", and why. `failed(error)`
// says that something went wrong after which the line goes on. `wait(ms)` lets time pass.
function makeSerialLine({ serial, received, changed, failed, wait }) {
  let state = "closed", port = null, settings = null;
  let reader = null, writer = null;
  // What ends when the attempt to open, the reading, the last write and the closing have ended.
  let opening = Promise.resolve(), reading = Promise.resolve(), writing = Promise.resolve(), closing = null;

  const ignore = () => {};

  function become(next, error = null) {
    state = next;
    changed(state, error);
  }

  // Let the user choose a port, and open it. Must be called by a click or a key.
  async function choose(wanted) {
    if (state !== "closed" && state !== "lost") return;
    become("choosing");
    try {
      const chosen = await serial.requestPort();
      if (state === "choosing") await open(chosen, wanted);
    } catch (error) {
      if (state === "choosing") become("closed", error);
    }
  }

  // Open a port that was granted before. Where that fails, the line is what it was `otherwise`.
  function open(given, wanted, otherwise = "closed") {
    if (!["closed", "choosing", "lost"].includes(state)) return opening;
    [port, settings] = [given, wanted];
    become("opening");
    opening = attempt(otherwise);
    return opening;
  }

  async function attempt(otherwise) {
    const mine = port;
    try {
      await mine.open(settings);
    } catch (error) {
      if (state === "opening") become(otherwise, error);
      return;
    }
    if (state !== "opening") {
      await mine.close().catch(ignore);
      return;
    }
    become("open");
    reading = read(mine);
  }

  // Read until the port is closed or lost, and free it then. After an error of the line, such as a
  // framing error or an overrun, the port has a new stream; after the loss of the port it has none.
  async function read(from) {
    let error = null;
    while (state === "open" && from.readable) {
      error = await readStream(from.readable);
      if (error && from.readable && state === "open") failed(error);
      // A line that fails again and again leaves time for the page.
      await wait(0);
    }
    if (state === "open") become("lost", error);
    await writer?.abort().catch(ignore);
    await writing;
    await from.close().catch(ignore);
  }

  // Read a stream to its end, and return the error that ended it, or null.
  async function readStream(stream) {
    reader = stream.getReader();
    try {
      for (;;) {
        const { value, done } = await reader.read();
        if (done) return null;
        if (value.length) received(value);
      }
    } catch (error) {
      return error;
    } finally {
      reader.releaseLock();
      reader = null;
    }
  }

  // Send bytes, after those before. Rejects where they cannot be sent.
  function write(bytes) {
    const done = writing.then(() => put(bytes));
    writing = done.catch(ignore);
    return done;
  }

  async function put(bytes) {
    if (state !== "open" || !port.writable) {
      throw new DOMException("The line is not open.", "InvalidStateError");
    }
    writer = port.writable.getWriter();
    try {
      await writer.write(Uint8Array.from(bytes));
    } finally {
      writer.releaseLock();
      writer = null;
    }
  }

  // End the use of the port, whatever is going on. Any number of times.
  function close() {
    closing ??= shut().finally(() => { closing = null; });
    return closing;
  }

  async function shut() {
    if (state === "closed") return;
    become("closing");
    reader?.cancel().catch(ignore);
    writer?.abort().catch(ignore);
    await opening;
    await reading;
    port = null;
    become("closed");
  }

  // Whether a port is the one that was lost. One that is plugged in again is a new object.
  function isLost(found) {
    const [one, other] = [found.getInfo(), port.getInfo()];
    return found === port
      || (one.usbVendorId === other.usbVendorId && one.usbProductId === other.usbProductId);
  }

  async function reopen(back) {
    await reading;
    for (const ms of REOPEN_AFTER_MS) {
      await wait(ms);
      if (state !== "lost") return;
      await open(back, settings, "lost");
    }
  }

  serial.addEventListener("connect", ({ target }) => {
    if (state === "lost" && isLost(target)) reopen(target);
    else changed(state, null);
  });
  serial.addEventListener("disconnect", ({ target }) => {
    if (state === "open" && target === port) {
      become("lost");
      reader?.cancel().catch(ignore);
    } else {
      changed(state, null);
    }
  });

  return {
    choose, open, write, close,
    get state() { return state; },
    get port() { return port; },
    // The ports that the user has allowed before, and that are plugged in.
    granted: () => serial.getPorts(),
  };
}

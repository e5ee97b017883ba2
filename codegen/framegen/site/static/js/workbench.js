// The page: what is typed, dropped or comes from a line goes to the list, and the state to the address.
"use strict";

// A longer text is kept like a file, out of the field.
const WORKBENCH_FIELD = 1_000_000;
// What a line says is drawn after so long, together with what comes until then.
const WORKBENCH_FOLLOWS_MS = 100;

const protocol = JSON.parse(byId("protocol").textContent);
const codec = makeCodec(protocol);

window.workbench = (() => {
  const field = byId("hex"), direction = byId("direction"), status = byId("decoded");
  const problem = byId("problem"), bar = byId("progress"), source = byId("source");
  const incoming = [...direction.options].filter(({ dataset }) => dataset.variant === "from");
  const says = captureWords(protocol, incoming.length === 1 ? incoming[0].value : null);
  const exports = makeExport(codec, protocol);
  // What is decoded: a file, a pasted text that is too long for the field, or what the field holds.
  let file = null, capture = null, seen = null, isLive = false, isReading = false;
  let addressTimer = 0, drawn = 0, isFollowing = false;

  const detail = makeDetail(byId("event"), { codec, protocol, take: takeFrame, edit: editEvent });
  const list = makeEventList({ codec, protocol, detail });
  const input = makeInput({ says, progress: showProgress });
  const encoder = makeEncoder({
    codec, changed: keepAddress, decode: (frame) => setText(toHex(frame), "push"),
  });

  // ---- Decoding

  function newCapture() {
    capture = makeCapture(codec, protocol, direction.value || null);
    [seen, drawn, isLive] = [null, 0, false];
    problem.hidden = true;
    field.setAttribute("aria-invalid", "false");
    list.show(capture);
  }

  async function decode() {
    newCapture();
    const own = capture, text = field.value;
    isReading = true;
    try {
      if (file) seen = await input.readFile(file.blob, own, file);
      else if (text.length <= INPUT_SHORT) seen = input.readShort(text, own);
      else seen = await input.readText(text, own);
      if (own !== capture) return;
      finish();
    } catch (error) {
      if (own !== capture) return;
      if (!(error instanceof Unreadable)) throw error;
      refuse(error);
    }
  }

  function finish() {
    isReading = false;
    bar.hidden = byId("cancel").hidden = true;
    list.show(capture, { grew: drawn > 0 });
    if (capture.size && list.chosen < 0) list.choose(0);
    showStatus();
    keepAddress();
  }

  function showStatus() {
    const { size, messages, noise, unknown } = capture.seen;
    const lines = seen && seen.lines ? `, ${counted(seen.lines, "line")}` : "";
    const form = seen && seen.bytes ? `Read as ${seen.name}${lines}. ` : "";
    const frames = unknown ? `, ${counted(unknown, "unknown frame")} in it` : "";
    const totals = `${counted(size, "byte")}: ${counted(messages, "message")}`;
    const empty = file || isLive ? "" : "Paste bytes, or drop a file here.";
    status.textContent = size ? `${form}${totals}, ${counted(noise, "byte")} of noise${frames}.` : empty;
    byId("exporting").hidden = !size;
  }

  function showProgress(done) {
    bar.hidden = byId("cancel").hidden = false;
    bar.value = done;
    const now = performance.now();
    if (drawn && now - drawn < 200) return;
    list.show(capture, { grew: drawn > 0 });
    drawn = now;
  }

  // Say what could not be read, where, and what would be right.
  function refuse(error) {
    newCapture();
    isReading = false;
    bar.hidden = byId("cancel").hidden = true;
    const show = button("Show the place", () => {
      field.focus();
      field.setSelectionRange(error.at, error.at + error.size);
      revealSelection(error.line);
    });
    const raw = button("Read the file as raw bytes", () => openFile(file.blob, { isRaw: true }));
    const hint = error.hint[0].toUpperCase() + error.hint.slice(1) + (/[?.]$/.test(error.hint) ? "" : ".");
    const said = `Line ${error.line}, column ${error.column}: ${error.message}. ${hint}`;
    problem.replaceChildren(make("p", {}, said), file ? raw : show);
    problem.hidden = false;
    field.setAttribute("aria-invalid", String(!file));
    status.textContent = "";
    byId("exporting").hidden = true;
    keepAddress();
  }

  function revealSelection(line) {
    const lines = field.value.split("\n").length;
    field.scrollTop = (field.scrollHeight * Math.max(0, line - 3)) / lines;
  }

  function setText(text, how = "replace") {
    if (how === "push") keepAddress(true);
    file = null;
    source.hidden = true;
    field.value = text;
    decode();
  }

  function openFile(blob, { name = blob.name, isRaw = false } = {}) {
    file = { blob, isRaw, name };
    field.value = "";
    source.replaceChildren(make("b", {}, name || "A file"), `, ${counted(blob.size, "byte")} `,
      button("Close it", () => { setText(""); field.focus(); }));
    source.hidden = false;
    decode();
  }

  // A short text file goes into the field, where it can be edited and sent as a link.
  async function takeFile(chosen) {
    if (chosen.size < INPUT_SHORT) {
      const bytes = new Uint8Array(await chosen.arrayBuffer()), encoding = encodingOf(bytes);
      if (encoding) {
        setText(new TextDecoder(encoding).decode(bytes));
        return;
      }
    }
    openFile(chosen);
  }

  // Put a frame in the place of an event's bytes.
  function takeFrame(event, frame) {
    const { size } = capture.seen, isAlone = file || capture.wires > 1 || size > INPUT_SHORT;
    const before = isAlone ? [] : capture.slice(0, event.at);
    const after = isAlone ? [] : capture.slice(event.at + event.size, size);
    setText(toHex([...before, ...frame, ...after]), "push");
    list.choose(capture.indexAt(isAlone ? 0 : event.at));
    byId("events").focus();
  }

  function editEvent(event) {
    const kind = event.kind, { fields } = codec.decodeFrame(event.bytes, kind.direction);
    keepAddress(true);
    encoder.choose(kind.name, fields);
    byId("encode").scrollIntoView({ block: "start" });
    byId("message").focus({ preventScroll: true });
  }

  // ---- The address

  function addressNow() {
    const isPlain = seen && seen.name === "hex" && capture.size && capture.seen.size <= ADDRESS_LONGEST / 2;
    const hex = isPlain ? toHex(capture.slice(0, capture.seen.size)).replace(/ /g, "") : field.value;
    const text = file || isLive ? null : hex;
    return writeAddress({ text, direction: direction.value, ...encoder.state() });
  }

  function keepAddress(isStep = false) {
    if (!capture) return;
    clearTimeout(addressTimer);
    const write = () => history.replaceState(null, "", `?${addressNow().query}`);
    if (isStep !== true) {
      addressTimer = setTimeout(write, 250);
      return;
    }
    write();
    history.pushState(null, "", location.search);
  }

  function openAddress(isFirst) {
    const { text, direction: way, message, words } = readAddress(location.search, protocol, codec.kinds);
    direction.value = way;
    encoder.open(message || protocol.line.first, words);
    if (text !== null || !isFirst) field.value = text ?? "";
    file = null;
    source.hidden = true;
    decode();
  }

  async function copyLink() {
    if (isReading) return;
    const { query, isWhole } = addressNow();
    history.replaceState(null, "", `?${query}`);
    await copyText(location.href);
    announce(isWhole ? "The link was copied" : "The link was copied without the capture, which is too long "
      + "for an address: save it as a recording, and send the file");
  }

  // ---- Live traffic

  function begin(name) {
    input.cancel();
    file = null;
    field.value = "";
    newCapture();
    isLive = true;
    source.replaceChildren(make("b", {}, name));
    source.hidden = false;
  }

  // Take events of a line: {time, sender, event}, as the codec's stream gives them. A busy line says more
  // than can be drawn each time.
  function append(entries) {
    if (!isLive) begin("From the line");
    for (const { time, sender, event } of entries) {
      const way = directionOf(protocol, sender || "") || null;
      const noise = event.type === "noise" ? event.reason : null;
      capture.add(event.bytes, { whole: true, time, direction: way, noise });
    }
    if (isFollowing) return;
    isFollowing = true;
    setTimeout(requestAnimationFrame, WORKBENCH_FOLLOWS_MS, follow);
  }

  function follow() {
    isFollowing = false;
    if (!isLive) return;
    list.show(capture, { grew: "follow" });
    showStatus();
  }

  // ---- What people do

  function typed() {
    file = null;
    source.hidden = true;
    decode();
  }

  field.addEventListener("input", typed);
  // Browsers take a minute to insert some thousands of lines as if they were typed.
  field.addEventListener("beforeinput", (event) => {
    const text = event.data ?? event.dataTransfer?.getData("text/plain") ?? "";
    if (text.length < INPUT_SHORT) return;
    event.preventDefault();
    if (text.length > WORKBENCH_FIELD) openFile(new Blob([text]), { name: "What was pasted" });
    else {
      field.setRangeText(text, field.selectionStart, field.selectionEnd, "end");
      typed();
    }
  });
  direction.addEventListener("change", () => {
    keepAddress(true);
    decode();
  });
  byId("file").addEventListener("change", ({ target }) => {
    if (target.files.length) takeFile(target.files[0]);
    target.value = "";
  });
  byId("choose").addEventListener("click", () => byId("file").click());
  byId("clear").addEventListener("click", () => {
    keepAddress(true);
    setText("");
    field.focus();
  });
  byId("copy-link").addEventListener("click", copyLink);
  byId("cancel").addEventListener("click", () => {
    input.cancel();
    capture.end();
    finish();
    announce("Stopped: what was read up to here is shown");
  });
  byId("next-noise").addEventListener("click", () => list.next("noise"));
  byId("next-unknown").addEventListener("click", () => list.next("unknown"));
  byId("go").addEventListener("submit", () => {
    const text = byId("offset").value.trim();
    if (/^(0x[0-9a-f]+|[0-9]+)$/i.test(text)) list.goTo(Number(text));
    else announce("Write the offset of a byte, like 120 or 0x78");
  });
  for (const [name, form] of Object.entries(exports)) {
    byId(`save-${name}`).addEventListener("click", () => saveCapture(capture, form, protocol.name));
  }
  for (const form of document.forms) form.addEventListener("submit", (event) => event.preventDefault());
  addEventListener("popstate", () => openAddress(false));
  addEventListener("dragover", (event) => {
    event.preventDefault();
    document.body.classList.add("dropping");
  });
  addEventListener("dragleave", (event) => {
    if (!event.relatedTarget) document.body.classList.remove("dropping");
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    document.body.classList.remove("dropping");
    const [dropped] = event.dataTransfer.files, text = event.dataTransfer.getData("text/plain");
    if (dropped) takeFile(dropped);
    else if (text) setText(text);
  });

  openAddress(true);
  return {
    openFile: takeFile, append, begin,
    // What the encoder has: the message, and its frame or null.
    get encoded() {
      return { message: encoder.state().message, bytes: encoder.frame() };
    },
  };
})();

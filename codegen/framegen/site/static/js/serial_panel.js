// The board on the line, in the page: from the buttons to the port, and from the port to the list.
"use strict";

// So many entries of a line go to the list of the page, before it begins anew.
const LISTED_BOUND = 500_000;

function showLine(protocol, codec) {
  const byId = (id) => document.getElementById(id);
  const data = protocol.line, panel = byId("line-panel");
  const wait = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); });
  const why = whyNoSerial({
    isSecure: isSecureContext, hasSerial: "serial" in navigator, protocol: location.protocol,
  });
  byId("line-unavailable").hidden = why === null;
  byId("line-why-not").textContent = why ?? "";
  panel.hidden = why !== null;
  byId("line-send").closest(".line-send").hidden = why !== null;
  if (why !== null) return;

  const line = makeSerialLine({ serial: navigator.serial, received, changed, failed, wait });
  const log = makeLineLog(byId("line-log"));
  // The session at hand and the one before it, whose counters go on being shown.
  let session = null, last = null, isCounting = false;
  let recording = null, startedAt = 0, name = "a serial port", timer = 0, isSaving = false, listed = 0;
  // What the encoder has, and the state that was shown last.
  let encoded = encodedSoFar(), shownState = "";

  const seconds = (at) => (at - startedAt) / 1000;

  // What the encoder has made before this script came; later it says so.
  function encodedSoFar() {
    const hex = byId("copy-frame").dataset.copy;
    return { message: byId("message").value, bytes: hex ? parseHex(hex) : null };
  }

  // ---- Settings

  function settings() {
    const baudRate = byId("line-baud").valueAsNumber;
    const { dataBits, stopBits, parity } = data;
    return { baudRate, dataBits, stopBits, parity, flowControl: "none" };
  }

  function showSettings() {
    const { baudRate, dataBits, stopBits, parity } = settings();
    const rate = Number.isInteger(baudRate) && baudRate > 0 ? `${baudRate} baud` : "no rate";
    const echo = byId("line-echo").checked ? ", local echo" : "";
    byId("line-summary").textContent = `${rate}, ${dataBits} data bits, `
      + `${parity === "none" ? "no" : parity} parity, ${stopBits} stop bit${stopBits > 1 ? "s" : ""}${echo}`;
    byId("line-baud").setAttribute("aria-invalid", String(!byId("line-baud").validity.valid || rate === "no rate"));
  }

  // ---- What happens on the line

  function begin() {
    if (!recording) {
      startedAt = performance.now();
      recording = makeRecording(new Date());
    }
    const direction = byId("line-listen").value === "any" ? null : data.received;
    session = makeSession({
      codec, protocol, direction, baud: settings().baudRate, localEcho: byId("line-echo").checked,
      show, answered, unanswered,
    });
    window.workbench.begin(name);
    listed = 0;
    comment(`connected to ${name}`);
    byId("line-traffic").hidden = false;
  }

  function comment(text) {
    if (!recording) return;
    const time = seconds(performance.now());
    recording.add({ time, who: "", what: text, bytes: [] });
    log.add({ comment: `${time.toFixed(3)} s: ${text}` });
  }

  function end() {
    if (!session) return;
    session.end();
    session = null;
    clearTimeout(timer);
    comment("disconnected");
    count();
  }

  function received(bytes) {
    const now = performance.now();
    // A page in the background is not woken in time: what came then was not in one piece.
    if (document.hidden && session.due !== null && now > session.due) tick(now);
    session.received(bytes, now);
    tick(now);
  }

  // A timer that comes late says nothing of the line: bytes may have come that are not yet read.
  function tick(now, isLate = false) {
    if (!session) return;
    if (!isLate && session.tick(now)) recording.add({ time: seconds(now), who: "", what: "quiet", bytes: [] });
    clearTimeout(timer);
    const due = session.due;
    if (due !== null) {
      const at = isLate ? Math.max(due, now + QUIET_MS) : due;
      timer = setTimeout(() => {
        const then = performance.now();
        tick(then, then > at + QUIET_MS && !document.hidden && !isLate);
      }, Math.max(0, at - now));
    }
    count();
  }

  function show({ at, isSent, event, names, sender, answer }) {
    const time = seconds(at), isNoise = event.type !== "message", bytes = Uint8Array.from(event.bytes);
    const [noise, either] = ["noise", "either"];
    let who = sender ?? either;
    if (isNoise) who = sender === null ? `${either} ${noise}` : noise;
    recording.add({ time, who, what: isNoise ? event.reason : names.join(" or "), bytes });
    let says = isNoise ? `${event.type}: ${event.reason}` : saysOf(event);
    if (names.length > 1) says = says.replace(event.message, names.join(" or "));
    if (answer && !answer.late) says += ` (${milliseconds(answer.took)})`;
    log.add({ time, way: wayOf(sender), says, bytes, isSent, isNoise });
    // The list above grows as long as it can be searched with ease, and begins anew then.
    if (listed === LISTED_BOUND) {
      window.workbench.begin(name);
      listed = 0;
      comment(`the list above begins anew after ${LISTED_BOUND.toLocaleString("en")} entries`);
    }
    listed += 1;
    window.workbench.append([{ time, sender, event }]);
  }

  const wayOf = (sender) => protocol.directions.find((way) => way.sender === sender)?.text.replace(" to ", " → ")
    ?? "either";

  function count() {
    if (isCounting) return;
    isCounting = true;
    requestAnimationFrame(() => {
      isCounting = false;
      const counts = (session ?? last)?.counts;
      if (session) last = session;
      if (!counts) return;
      for (const each of ["bytes", "frames", "noise", "errors", "sent"]) {
        byId(`line-${each}`).textContent = counts[each].toLocaleString("en");
      }
      byId("line-bound").hidden = !recording?.dropped;
      byId("line-bound").textContent = recording?.dropped
        ? `The recording holds ${RECORDING_BOUND / 1024 / 1024} MB: the ${recording.dropped.toLocaleString("en")} oldest entries were dropped.`
        : "";
    });
  }
  function failed(error) {
    if (session) session.counts.errors += 1;
    comment(wordsOfFault(error));
    count();
  }

  // ---- Sending

  function reply(text, look = "") {
    byId("line-reply").textContent = text;
    byId("line-reply").className = `line-reply ${look}`.trim();
  }

  function answered(answer) {
    reply(wordsOfAnswer(answer), answer.late || answer.missing.length ? "no" : "yes");
  }

  function unanswered(question) {
    session.counts.errors += 1;
    const [what, why] = wordsOfSilence(question, session.counts);
    reply(`${what} ${why}`, "no");
    comment(what);
  }

  async function send() {
    const { message, bytes } = encoded;
    if (!session || !bytes) return;
    if (session.waiting && data.exchanges[message].reply) {
      reply("One question at a time: the reply to the one before is still waited for.");
      return;
    }
    const question = session.sent([...bytes], performance.now());
    reply(question ? `${message} is sent; ${question.exchange.reply} is waited for.`
      : `${message} is sent. ${wordsOfExchange(message, kindOf(message), data)}`);
    tick(performance.now());
    try {
      await line.write(bytes);
    } catch (error) {
      if (session) session.counts.errors += 1;
      reply(`${message} was not sent.${reasonOf(error)}`, "no");
      comment(`${message} was not sent`);
      count();
    }
  }

  const kindOf = (message) => codec.kinds.find((kind) => kind.name === message);

  function offerToSend() {
    const { message, bytes } = encoded, kind = kindOf(message);
    const isOurs = kind?.direction === data.sent;
    byId("line-send").disabled = line.state !== "open" || !bytes || !isOurs;
    const first = line.state === "open" || !isOurs ? "" : " Connect a board to send it.";
    byId("line-expects").textContent = wordsOfExchange(message, kind, data) + first;
  }

  // ---- The port

  const STATES = {
    closed: "Not connected.",
    choosing: "Choose the port of the board in the list that the browser shows.",
    opening: "Opening the port …",
    closing: "Closing the port …",
  };

  function changed(state, error) {
    if (state === "open" && shownState !== "open") {
      name = nameOfPort(line.port);
      begin();
    }
    if (state !== "open" && shownState === "open") {
      if (state === "lost") comment("the line was lost");
      end();
    }
    let [text, advice] = [STATES[state], ""];
    if (state === "open") text = `Connected to ${name}, at ${settings().baudRate} baud.`;
    if (state === "lost") [text, advice] = wordsOfLoss(error);
    else if (error) [text, advice] = wordsOfFailure(error, shownState === "opening");
    // News of other ports changes nothing of what is said of this one.
    if (state !== shownState || error) {
      byId("line-status").textContent = text;
      byId("line-advice").textContent = advice;
      byId("line-advice").hidden = !advice;
    }
    shownState = state;
    showButtons();
    offerToSend();
    offerGranted();
  }

  function showButtons() {
    const isFree = ["closed", "choosing", "lost"].includes(line.state);
    const [connect, close] = [byId("line-connect"), byId("line-close")];
    const hadFocus = document.activeElement === connect || document.activeElement === close;
    connect.hidden = !isFree;
    connect.textContent = line.state === "lost" ? "Choose the port again" : "Connect your board";
    close.hidden = isFree && line.state !== "lost";
    close.textContent = line.state === "lost" ? "Give up" : "Disconnect";
    if (hadFocus && document.activeElement === document.body) (connect.hidden ? close : connect).focus();
    for (const field of ["line-baud", "line-listen", "line-echo"]) byId(field).disabled = !isFree || line.state === "lost";
  }

  // The ports that were allowed before need no choice.
  async function offerGranted() {
    const ports = line.state === "closed" ? await line.granted().catch(() => []) : [];
    if (line.state !== "closed") ports.length = 0;
    byId("line-granted").replaceChildren(...ports.map((port) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = `Connect to ${nameOfPort(port)} again`;
      button.addEventListener("click", () => connect((wanted) => line.open(port, wanted)));
      return button;
    }));
  }

  function connect(start) {
    showSettings();
    if (byId("line-baud").getAttribute("aria-invalid") === "true") {
      byId("line-baud").closest("details").open = true;
      byId("line-status").textContent = "The rate of the line is a whole number of bits per second, such as "
        + `${data.baud}.`;
      byId("line-baud").focus();
      return;
    }
    start(settings());
  }

  // ---- The recording

  // The text as parts of a file, made in slices, so that the page stays alive.
  async function recorded() {
    const directions = new Map(protocol.directions.map(({ key, sender }) => [sender, key]));
    const say = ({ who, bytes }) => {
      const event = directions.has(who) ? codec.decodeFrame(bytes, directions.get(who)) : {};
      return event.message && saysOf(event);
    };
    const parts = [];
    for (const piece of recording.pieces(name, say)) {
      parts.push(piece);
      await wait(0);
    }
    const day = dayAndZone(new Date()).slice(0, 19).replace(" ", "_").replaceAll(":", "");
    return new File(parts, `${protocol.name}_${day}.hex`, { type: "text/plain" });
  }

  async function withRecording(use) {
    if (isSaving || !recording) return;
    isSaving = true;
    byId("line-saving").textContent = "Writing the recording …";
    try {
      const file = await recorded();
      use(file);
      byId("line-saving").textContent = `${file.name}: ${recording.count.toLocaleString("en")} entries.`;
    } finally {
      isSaving = false;
    }
  }

  function download(file) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(file);
    link.download = file.name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  }

  function clear() {
    recording = session ? makeRecording(new Date()) : null;
    startedAt = performance.now();
    if (session) for (const each of Object.keys(session.counts)) session.counts[each] = 0;
    log.clear();
    byId("line-saving").textContent = "";
    if (!session) byId("line-traffic").hidden = true;
    byId("line-bound").hidden = true;
    count();
  }

  byId("line-connect").addEventListener("click", () => connect(line.choose));
  byId("line-close").addEventListener("click", () => line.close());
  byId("line-send").addEventListener("click", send);
  byId("line-download").addEventListener("click", () => withRecording(download));
  byId("line-load").addEventListener("click", () => withRecording((file) => window.workbench.openFile(file)));
  byId("line-clear").addEventListener("click", clear);
  byId("line-hold").addEventListener("click", ({ target }) => {
    const isHeld = target.getAttribute("aria-pressed") !== "true";
    target.setAttribute("aria-pressed", String(isHeld));
    log.hold(isHeld);
  });
  for (const field of ["line-baud", "line-echo"]) byId(field).addEventListener("input", showSettings);
  addEventListener("pagehide", () => line.close());
  document.addEventListener("encoded", ({ detail }) => {
    encoded = detail;
    offerToSend();
  });

  if (data.received === null) byId("line-listen").value = "any";
  showSettings();
  changed("closed", null);
}

showLine(protocol, codec);

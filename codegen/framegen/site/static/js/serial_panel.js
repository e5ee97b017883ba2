// The board on the line, in the page: from the buttons to the port, and from the port to the list.
"use strict";

// So many entries of a line go to the list of the page, before it begins anew.
const LISTED_BOUND = 500_000;

function showLine(protocol, codec) {
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

  const settings = makeLineSettings(data);
  const line = makeSerialLine({ serial: navigator.serial, received, changed, failed, wait });
  const log = makeLineLog(byId("line-log"));
  // The session at hand and the one before it, whose counters go on being shown.
  let session = null, last = null, isCounting = false;
  let recording = null, startedAt = 0, name = "a serial port", timer = 0, isSaving = false, listed = 0;
  // What is not in the list yet.
  const fresh = [];
  // What the encoder has, and the state that was shown last.
  let encoded = encodedSoFar(), shownState = "";

  const seconds = (at) => Math.max(0, at - startedAt) / 1000;

  // What the encoder has made before this script came; later it says so.
  function encodedSoFar() {
    const hex = byId("copy-frame").dataset.copy;
    return { message: byId("message").value, bytes: hex ? parseHex(hex) : null };
  }

  const counted = (number) => number.toLocaleString("en");

  // ---- What happens on the line

  function begin() {
    if (!recording) {
      startedAt = performance.now();
      recording = makeRecording(new Date());
    }
    session = makeSession({ codec, protocol, ...settings.ofSession(), show, answered, unanswered });
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

  function end(why) {
    if (!session) return;
    session.end();
    for (const { message } of queue.clear()) comment(`${message} was not sent`);
    session = null;
    clearTimeout(timer);
    comment(why);
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
    const isQuiet = !isLate && session.tick(now);
    if (isQuiet) recording.add({ time: seconds(now), who: "", what: "quiet", bytes: [] });
    clearTimeout(timer);
    const due = session.due;
    if (due !== null) {
      const at = isLate ? Math.max(due, now + QUIET_MS) : due;
      timer = setTimeout(() => {
        const then = performance.now();
        tick(then, then > at + QUIET_MS && !document.hidden && !isLate);
      }, Math.max(0, at - now));
    }
    queue.pump();
    count();
  }

  function show({ at, isSent, event, names, sender, answer }) {
    const time = seconds(at), isNoise = event.type !== "message", bytes = Uint8Array.from(event.bytes);
    const noise = sender === null ? "either noise" : "noise";
    const what = isNoise ? event.reason : names.join(" or ");
    recording.add({ time, who: isNoise ? noise : sender ?? "either", what, bytes });
    const says = () => wordsOfEntry(event, names, answer);
    log.add({ time, way: wayOf(sender), says, bytes, isSent, isNoise });
    if (!fresh.length) queueMicrotask(list);
    fresh.push({ time, sender, event });
  }

  // What came at once goes to the list above at once. It grows as long as it can be searched with
  // ease, and begins anew then.
  function list() {
    if (listed > LISTED_BOUND) {
      window.workbench.begin(name);
      listed = 0;
      comment(`the list above has begun anew after ${counted(LISTED_BOUND)} entries`);
    }
    listed += fresh.length;
    window.workbench.append(fresh.splice(0));
  }

  function wayOf(sender) {
    const way = protocol.directions.find((each) => each.sender === sender);
    return way ? way.text.replace(" to ", " → ") : "either";
  }

  function count() {
    if (isCounting) return;
    isCounting = true;
    requestAnimationFrame(() => {
      isCounting = false;
      const counts = (session ?? last)?.counts;
      if (session) last = session;
      if (!counts) return;
      for (const each of ["bytes", "frames", "noise", "errors", "sent"]) {
        byId(`line-${each}`).textContent = counted(counts[each]);
      }
      const dropped = recording?.dropped ?? 0;
      byId("line-bound").hidden = !dropped;
      byId("line-bound").textContent = `The recording holds ${RECORDING_BOUND / 1024 / 1024} MB: `
        + `the ${counted(dropped)} oldest entries were dropped.`;
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

  function unanswered(question, isEnded) {
    session.counts.errors += 1;
    const [what, why] = wordsOfSilence(question, session.counts, isEnded);
    reply(`${what} ${why}`, "no");
    comment(what);
  }

  // One question at a time: what is sent before its reply is here waits for it.
  const queue = makeSendQueue(({ message }) => session.waiting && data.exchanges[message].reply, hand);

  function send() {
    if (!session || !encoded.bytes) return;
    const waiting = queue.add(encoded);
    if (waiting !== 0) reply(wordsOfWaiting(encoded.message, waiting), waiting ? "" : "no");
  }

  async function hand({ message, bytes }) {
    let question = null;
    try {
      question = session.sent([...bytes], performance.now(), settings.limits());
    } catch (error) {
      if (!(error instanceof Unusable)) throw error;
      reply(`${message} is not sent. ${error.message}`, "no");
      return;
    }
    reply(question ? `${message} is sent; ${question.exchange.reply} is waited for.`
      : `${message} is sent. ${wordsOfExchange(message, kindOf(message), data)}`);
    tick(performance.now());
    try {
      await line.write(bytes);
    } catch (error) {
      if (session) {
        session.counts.errors += 1;
        session.forget(question);
      }
      reply(`${message} was not sent.${reasonOf(error)}`, "no");
      comment(`${message} was not sent`);
      tick(performance.now());
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

  function changed(state, error) {
    if (state === "open" && shownState !== "open") {
      name = nameOfPort(line.port);
      begin();
    }
    if (state !== "open" && shownState === "open") {
      end(state === "lost" ? "the line was lost" : "disconnected");
    }
    let [text, advice] = [WORDS_OF_STATE[state], ""];
    if (state === "open") text = `Connected to ${name}, at ${settings.ofPort().baudRate} baud.`;
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
    settings.disable(!isFree || line.state === "lost");
  }

  // The ports that were allowed before need no choice.
  async function offerGranted() {
    const ports = line.state === "closed" ? await line.granted().catch(() => []) : [];
    if (line.state !== "closed") ports.length = 0;
    byId("line-granted").replaceChildren(...ports.map((port) =>
      button(`Connect to ${nameOfPort(port)} again`, () => connect((wanted) => line.open(port, wanted)))));
  }

  function connect(start) {
    const problem = settings.problem();
    if (problem) byId("line-status").textContent = problem;
    else start(settings.ofPort());
  }

  // ---- The recording

  async function withRecording(use) {
    if (isSaving || !recording) return;
    isSaving = true;
    byId("line-saving").textContent = "Writing the recording …";
    try {
      const file = await fileOf(recording, { name, codec, protocol, rest: () => wait(0) });
      use(file);
      byId("line-saving").textContent = `${file.name}: ${counted(recording.count)} entries.`;
    } finally {
      isSaving = false;
    }
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
  byId("line-limits").addEventListener("change", () => reply(""));
  byId("line-download").addEventListener("click", () => withRecording(saveFile));
  byId("line-load").addEventListener("click", () => withRecording((file) => window.workbench.openFile(file)));
  byId("line-clear").addEventListener("click", clear);
  byId("line-hold").addEventListener("click", ({ target }) => {
    const isHeld = target.getAttribute("aria-pressed") !== "true";
    target.setAttribute("aria-pressed", String(isHeld));
    log.hold(isHeld);
  });
  addEventListener("pagehide", () => line.close());
  document.addEventListener("encoded", ({ detail }) => {
    encoded = detail;
    offerToSend();
  });

  changed("closed", null);
}

showLine(protocol, codec);

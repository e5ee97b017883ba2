// A frame of the message of this page, in fields and in bytes: each follows the other.
"use strict";

const live = JSON.parse(byId("live-data").textContent);

function makeLive(codec, [kind]) {
  const hex = byId("live-hex"), status = byId("live-status"), strip = byId("live-strip");
  const copy = byId("live-copy"), open = byId("live-open"), key = `frame ${live.name} ${kind.name}`;
  const way = codec.directions.find((each) => each.key === kind.direction);
  const form = makeFields(codec, kind, { values: kind.example, onInput: fromFields });

  function fromFields() {
    try {
      const frame = codec.encode(kind.name, form.values());
      hex.value = toHex(frame);
      take(frame);
    } catch (error) {
      if (!(error instanceof Unusable)) throw error;
      const isPlaced = form.mark(error);
      refuse([isPlaced ? `No frame: ${error.message}` : error.message], null);
    }
  }

  function fromHex() {
    form.mark(null);
    try {
      const bytes = parseHex(hex.value), found = codec.decodeFrame(bytes, kind.direction);
      if (!found.message) return refuse(...reasonsOf(bytes, found));
      form.show(found.fields);
      return take(bytes);
    } catch (error) {
      if (!(error instanceof Unusable)) throw error;
      return refuse([error.message], hex);
    }
  }

  // Why bytes are no frame of this message, and what would be one.
  function reasonsOf(bytes, { reason, offset }) {
    if (!bytes.length) return [["Type the bytes of a frame, or change a field."], hex];
    if (reason === live.reasons.unknown) {
      return [[`Not ${kind.name}: byte ${offset} is the id of another message, or of none.`], hex];
    }
    const { refusals: [{ expected }], hints } = codec.explain(bytes, kind.direction);
    const offers = hints.filter(({ frame }) => frame.length).map(({ text, frame }) => [`${text} `,
      button("Take this frame", () => { hex.value = toHex(frame); fromHex(); hex.focus(); })]);
    return [[`Not ${kind.name}: ${reason} at byte ${offset}, ${expected}.`, ...offers.flat()], hex];
  }

  function refuse(parts, field) {
    hex.setAttribute("aria-invalid", String(field === hex));
    status.className = "error";
    status.replaceChildren(...parts.map((part) => (typeof part === "string" ? `${part} ` : part)));
    strip.hidden = true;
    copy.disabled = true;
    lead(hex.value);
  }

  function take(frame) {
    const event = codec.decodeFrame(frame, kind.direction), text = toHex(frame);
    hex.setAttribute("aria-invalid", "false");
    status.className = "quiet small";
    status.textContent = `${kind.name}, ${way.text}: ${pluralized(frame.length, "byte")}.`;
    strip.hidden = false;
    strip.replaceChildren(...stripCells(event.rows));
    copy.disabled = false;
    copy.dataset.copy = text;
    lead(text);
    keep(text);
  }

  // The workbench opens what stands here, right or wrong.
  function lead(text) {
    const query = new URLSearchParams({ hex: text.replace(/\s+/g, ""), direction: kind.direction });
    open.href = `${open.dataset.page}?${query}`;
  }

  // The frame is kept for this visit and in the address, where the browser lets a page do so: of one
  // that was opened as a file, some do not.
  function keep(text) {
    const isFirst = text === first, plain = text.replace(/ /g, "");
    attempt(() => (isFirst ? sessionStorage.removeItem(key) : sessionStorage.setItem(key, plain)));
    attempt(() => {
      const address = new URL(location.href);
      if (isFirst) address.searchParams.delete("frame");
      else address.searchParams.set("frame", plain);
      if (address.href !== location.href) history.replaceState(history.state, "", address);
    });
  }

  function attempt(task) {
    try {
      return task();
    } catch {
      return null;
    }
  }

  function restart() {
    form.mark(null);
    form.show(kind.example);
    fromFields();
  }

  byId("live-fields").append(form.element);
  hex.addEventListener("input", fromHex);
  byId("live-restart").addEventListener("click", restart);
  const first = toHex(codec.encode(kind.name, kind.example));
  const shared = new URLSearchParams(location.search).get("frame");
  hex.value = shared ?? attempt(() => sessionStorage.getItem(key)) ?? first;
  fromHex();
}

const liveCodec = makeCodec(live);
makeLive(liveCodec, liveCodec.kinds);

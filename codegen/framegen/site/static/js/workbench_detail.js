// One event of the list, taken apart: what `framegen explain` says of its bytes.
"use strict";

// So many bytes are shown at first, at each end of noise; so many more at a time; and so many of
// noise are explained.
const DETAIL_ENDS = 32, DETAIL_MORE = 4096, DETAIL_EXPLAINED = 2048;

// Who sends, and who receives.
function badgeOf({ key, sender, receiver }) {
  const option = [...byId("direction").options].find(({ value }) => value === key);
  return make("span", { class: `way ${option ? option.dataset.variant : ""}` }, sender, " ",
    make("span", { "aria-hidden": "true" }, "→"), make("span", { class: "visually-hidden" }, "to"),
    " ", receiver);
}

// Text with the pieces in backticks as code.
const withCode = (text) => text.split("`").map((piece, i) => (i % 2 ? make("code", {}, piece) : piece));

// `take(event, frame)` puts a frame in the place of an event, and `edit(event)` shows it in the encoder.
function makeDetail(element, { codec, take, edit }) {
  function show(event) {
    const explained = codec.explain(event.bytes.slice(0, DETAIL_EXPLAINED), event.direction);
    const shown = event.kind ? readings(event, explained) : refused(event, explained);
    element.replaceChildren(heading(event), ...shown);
    element.hidden = false;
  }

  function heading(event) {
    const title = event.kind ? event.names.join(" or ") : whatOf(event);
    const last = event.at + event.size - 1;
    const place = event.size === 1 ? `byte ${event.at}` : `bytes ${event.at} to ${last}`;
    const facts = [`${counted(event.size, "byte")}, ${place}`];
    const time = timeInWords(event.time, event.isClock);
    if (time) facts.push(event.isClock ? `at ${time}` : `at ${time} s`);
    if (event.channel) facts.push(`wire ${event.channel}`);
    return make("div", { class: "head" },
      make("h3", { id: "event-title", class: event.kind ? "yes" : "no" }, title),
      make("p", { class: "quiet small" }, facts.join(" · ")));
  }

  const whatOf = ({ type, reason }) => `${type === "unknown" ? "Unknown frame" : "Noise"}: ${reason}`;

  function readings(event, explained) {
    const shown = explained.readings.map((reading) => {
      const link = make("a", { href: `${reading.kind.page}.html` }, reading.message);
      const name = make(explained.readings.length > 1 ? "h4" : "p", {}, link, " ", badgeOf(reading.way));
      return make("section", {}, name, make("p", {}, reading.summary), strip(reading.rows, event.at),
        facts(reading.facts));
    });
    const many = explained.readings.length > 1
      ? [make("p", {}, "These bytes are a frame in each direction. Who sent them decides.")] : [];
    return [...many, ...shown, make("div", { class: "actions" },
      button("Edit in the encoder", () => edit(event)),
      make("button", { type: "button", class: "copy", "data-copy": toHex(event.bytes) }, "Copy hex"))];
  }

  const strip = (rows, at) =>
    make("ol", { class: "strip", "aria-label": "The bytes" }, ...stripCells(rows, at));

  function facts(pairs) {
    return make("dl", { class: "facts small" }, ...pairs.flatMap(([label, text]) =>
      [make("dt", {}, label), make("dd", {}, text)]));
  }

  // Bytes that are no frame: where that shows, why in each direction, and what may have been meant.
  function refused(event, { refusals, hints, readings: whole }) {
    const at = refusals.length ? refusals[0].offset : null;
    const notes = [];
    if (event.size > DETAIL_EXPLAINED) {
      notes.push(`Its first ${counted(DETAIL_EXPLAINED, "byte")} are explained.`);
    }
    if (whole.length) {
      const names = whole.map(({ message }) => message).join(" or ");
      notes.push(`It was recorded as noise, though by itself it would be ${names}.`);
    }
    const agreed = refusals.length && refusals[0].rows.length ? [
      make("p", { class: "small quiet" }, "Right up to there:"), strip(refusals[0].rows, event.at),
    ] : [];
    return [
      bytesOf(event, at), ...notes.map((note) => make("p", { class: "quiet small" }, note)),
      ...hints.map((hint) => hinted(event, hint)), reasons(event, refusals), ...agreed,
    ];
  }

  function reasons(event, refusals) {
    const said = refusals.map(({ reason, expected }) => `${reason}: ${expected}`);
    const isSame = said.length > 1 && new Set(said).size === 1;
    const lines = isSame ? [["In every direction", said[0], refusals[0].offset]]
      : refusals.map(({ way, offset }, i) => [badgeOf(way), said[i], offset]);
    return make("dl", { class: "reasons" }, ...lines.flatMap(([way, text, offset]) => [
      make("dt", {}, way), make("dd", {}, `${text} (byte ${event.at + offset})`)]));
  }

  function hinted(event, { text, frame }) {
    const hex = frame && frame.length ? toHex(frame) : "";
    return make("div", { class: "note" }, make("p", {}, ...withCode(text[0].toUpperCase() + text.slice(1))),
      hex ? make("p", {}, make("code", { class: "bytes" }, hex)) : null,
      hex ? make("div", { class: "actions" },
        button("Take this frame", () => take(event, frame), { class: "take" }),
        make("button", { type: "button", class: "copy", "data-copy": hex }, "Copy hex")) : null);
  }

  // All bytes of noise, or its two ends; the byte at which it was refused is marked.
  function bytesOf(event, refusedAt) {
    const shown = make("p", { class: "dump bytes" });
    const piece = (from, to) => {
      const bytes = event.rest(from, to), place = refusedAt === null ? -1 : refusedAt - from;
      if (place < 0 || place >= bytes.length) return [toHex(bytes)];
      const before = toHex(bytes.subarray(0, place)), after = toHex(bytes.subarray(place + 1));
      const marked = make("mark", {}, toHex(bytes.subarray(place, place + 1)));
      return [before && `${before} `, marked, after && ` ${after}`];
    };
    const isWhole = event.size <= 2 * DETAIL_ENDS + 16;
    let until = isWhole ? event.size : DETAIL_ENDS;
    const left = () => event.size - DETAIL_ENDS - until;
    const more = button("", () => {
      const next = Math.min(until + DETAIL_MORE, event.size - DETAIL_ENDS);
      more.before(...piece(until, next), " ");
      until = next;
      name();
    }, { class: "more" });
    const name = () => {
      const part = left() > DETAIL_MORE ? `${counted(DETAIL_MORE, "byte")} of ` : "";
      if (left() > 0) more.textContent = `… show ${part}${counted(left(), "byte")} more …`;
      else more.remove();
    };
    shown.append(...piece(0, until));
    if (!isWhole) {
      name();
      shown.append(" ", more, " ", ...piece(event.size - DETAIL_ENDS, event.size));
    }
    return shown;
  }

  return { show, clear: () => { element.hidden = true; element.replaceChildren(); } };
}

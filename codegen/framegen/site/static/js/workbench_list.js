// The events of a capture as a list: what a row says, which rows there are, and how to find one.
"use strict";

const LIST_NOISE_ENDS = 6, LIST_SHORT = 20;

function makeEventList({ codec, protocol, detail }) {
  const box = byId("events"), tally = byId("tally");
  let capture = null, filter = null, found = null, scanned = 0;

  const list = makeVirtualList(box, { draw, select: (position) => detail.show(eventAt(position)) });
  const indexAt = (position) => (found ? found.at(position) : position);

  function eventAt(position) {
    const event = capture.event(indexAt(position));
    return { ...event, isClock: capture.seen.isClock };
  }

  function draw(row, position) {
    const event = capture.event(indexAt(position), 1024), { kind } = event;
    const who = whoOf(event);
    const fields = kind ? fieldsInWords(kind, codec.decodeFrame(event.bytes, kind.direction).fields) : "";
    const time = timeInWords(event.time, capture.seen.isClock);
    row.className = `row ${kind ? "message" : event.type}`;
    row.append(
      make("span", { class: "place" }, time || String(event.at)), " ",
      make("span", { class: `who ${variantOf(event)}` }, who), " ",
      make("span", { class: "what" }, make("b", {}, kind ? event.names.join(" or ") : event.reason),
        fields ? ` ${fields}` : "", kind ? "" : ` ${counted(event.size, "byte")}`), " ",
      make("span", { class: "bytes" }, briefly(event)));
  }

  function whoOf({ kind, direction, names, type }) {
    if (!kind) return type;
    if (direction === null || names.length > 1) return "either";
    const way = protocol.directions.find(({ key }) => key === direction);
    return variantOf({ kind, names, direction }) === "to" ? `${way.sender} →` : `← ${way.sender}`;
  }

  function variantOf({ kind, direction, names }) {
    if (!kind || direction === null || names.length > 1) return "";
    const option = [...byId("direction").options].find(({ value }) => value === direction);
    return option ? option.dataset.variant : "";
  }

  function briefly(event) {
    if (event.size <= LIST_SHORT || event.kind) return toHex(event.bytes);
    const ends = [event.rest(0, LIST_NOISE_ENDS), event.rest(event.size - LIST_NOISE_ENDS, event.size)];
    return ends.map((bytes) => toHex(bytes)).join(" … ");
  }

  // Whether an event with such a code is wanted.
  function isWanted(code) {
    if (filter.code !== undefined) return code === filter.code;
    const { kind, isEither, type } = capture.meaning(code);
    if (filter.direction) return Boolean(kind) && !isEither && kind.direction === filter.direction;
    return type === filter.type;
  }

  function scan() {
    for (; scanned < capture.size; scanned++) {
      if (isWanted(capture.codeAt(scanned))) found.push(scanned);
    }
  }

  // Show a capture from its beginning, or what has come since.
  function show(shown, { grew = false } = {}) {
    if (!grew) {
      capture = shown;
      detail.clear();
      [filter, found] = [null, null];
    }
    if (found) scan();
    const count = found ? found.size : capture.size;
    box.hidden = byId("finding").hidden = !capture.size;
    box.classList.toggle("timed", capture.seen.isTimed);
    list.update(count, { grew });
    showTally();
  }

  function setFilter(wanted) {
    filter = wanted;
    found = wanted ? makeColumn(Uint32Array) : null;
    scanned = 0;
    if (found) scan();
    const count = found ? found.size : capture.size;
    list.update(count);
    detail.clear();
    showTally();
    if (count) list.choose(0);
    announce(wanted ? `${counted(count, "event")} shown` : "All events are shown");
  }

  // How often each message came, and what was noise; a button shows those alone.
  function showTally() {
    const entries = [...capture.counts].sort(([a], [b]) => b - a).map(([code, { events, bytes }]) => {
      const { kind, type, reason, isEither } = capture.meaning(code);
      const name = kind ? kind.name + (isEither ? " (either way)" : "")
        : `${type === "noise" ? "Noise" : "Unknown"}: ${reason}`;
      const size = kind ? "" : `, ${counted(bytes, "byte")}`;
      return tallied({ code }, name, `${events.toLocaleString("en")}${size}`);
    });
    const senders = protocol.directions.map(({ key, sender }) => {
      const sum = [...capture.counts].filter(([code]) => {
        const { kind, isEither } = capture.meaning(code);
        return kind && !isEither && kind.direction === key;
      }).reduce((so, [, { events }]) => so + events, 0);
      return sum ? tallied({ direction: key }, `From ${sender}`, sum.toLocaleString("en")) : null;
    });
    const hadFocus = tally.contains(document.activeElement) ? document.activeElement.dataset.key : null;
    tally.hidden = capture.counts.size < 2;
    const all = tallied(null, "All", capture.size.toLocaleString("en"));
    tally.replaceChildren(...[all, ...senders, ...entries].filter(Boolean));
    if (hadFocus) tally.querySelector(`[data-key="${CSS.escape(hadFocus)}"]`)?.focus();
  }

  function tallied(wanted, name, number) {
    const key = JSON.stringify(wanted), isShown = key === JSON.stringify(filter);
    const attributes = { "aria-pressed": String(isShown), "data-key": key };
    const made = button(`${name} `, () => setFilter(wanted), attributes);
    made.append(make("span", { class: "number" }, number));
    return make("li", {}, made);
  }

  // Go to the next event of a type behind the chosen one, and from the beginning after the last.
  function next(type) {
    const count = list.count;
    for (let step = 1; step <= count; step++) {
      const position = (list.chosen + step) % count;
      if (capture.meaning(capture.codeAt(indexAt(position))).type === type) {
        if (position <= list.chosen) announce("From the beginning again");
        list.choose(position);
        box.focus();
        return;
      }
    }
    announce(`No ${type === "noise" ? "noise" : "unknown frame"} is in the list`);
  }

  // Go to the event that holds a byte.
  function goTo(offset) {
    if (!(offset >= 0 && offset < capture.seen.size)) {
      announce(`There is no byte ${offset}: the last is ${capture.seen.size - 1}`);
      return;
    }
    if (found) setFilter(null);
    list.choose(capture.indexAt(offset));
    box.focus();
  }

  return {
    show, next, goTo, choose: list.choose,
    get chosen() {
      return list.chosen;
    },
  };
}

// The list of what the line says: the newest at the end, and no more than so many rows.
"use strict";

const LOG_ROWS = 300;
// So many bytes of an entry are shown; the recording has all of them.
const LOG_BYTES = 48;

// After so long, rows are drawn together with those that come until then.
const LOG_WAITS_MS = 100;

const drawSoon = (redraw) => setTimeout(requestAnimationFrame, LOG_WAITS_MS, redraw);

// `element` scrolls, and holds a list. `draw` is called when the page has time to draw, once for many rows.
function makeLineLog(element, draw = drawSoon) {
  const list = element.querySelector("ol");
  // The rows to be drawn, and whether that is under way.
  let rows = [], fresh = 0, isDue = false, isHeld = false;

  const span = (name, text) => make("span", { class: name }, text);

  function item(row) {
    if (row.comment !== undefined) return make("li", { class: "comment" }, row.comment);
    const kind = [row.isSent ? "sent" : "", row.isNoise ? "noise" : ""].join(" ").trim();
    const rest = row.bytes.length - LOG_BYTES;
    const hex = toHex(row.bytes.slice(0, LOG_BYTES)) + (rest > 0 ? ` … and ${rest} more` : "");
    return make("li", { class: kind }, span("time", `${row.time.toFixed(3)} s`), span("way-of", row.way),
      span("says", row.says()), span("bytes", hex));
  }

  function redraw() {
    isDue = false;
    element.ariaBusy = null;
    if (isHeld || !fresh) return;
    const isAtEnd = element.scrollHeight - element.scrollTop - element.clientHeight < 40;
    list.append(...rows.slice(rows.length - Math.min(fresh, rows.length)).map(item));
    fresh = 0;
    while (list.childElementCount > LOG_ROWS) list.firstElementChild.remove();
    if (isAtEnd) element.scrollTop = element.scrollHeight;
  }

  function soon() {
    if (!isDue) draw(redraw);
    isDue = true;
    element.ariaBusy = "true";
  }

  return {
    // A row is {time, way, says, bytes, isSent, isNoise}, or a {comment}; what it `says` is worked out when
    // it is drawn.
    add(row) {
      rows.push(row);
      fresh += 1;
      if (rows.length >= 2 * LOG_ROWS) rows = rows.slice(-LOG_ROWS);
      soon();
    },
    clear() {
      [rows, fresh] = [[], 0];
      list.replaceChildren();
    },
    hold(held) {
      isHeld = held;
      soon();
    },
  };
}

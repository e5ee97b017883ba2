// A list box of any length: only the rows in sight are in the page. Arrow keys, Page Up and Down, Home
// and End move the selection, and a screen reader is told the place of a row among all.
"use strict";

// No browser draws an element of more pixels; beyond, the bar moves by more than it shows.
const LIST_TALLEST = 8_000_000;
// So many rows go on paper.
const LIST_PRINTED = 500;

// `draw(row, position)` fills the element of a row, and `select(position)` is told of each choice.
function makeVirtualList(box, { draw, select }) {
  const track = box.appendChild(document.createElement("div"));
  track.className = "track";
  track.setAttribute("role", "presentation");
  const rows = new Map();
  let count = 0, chosen = -1, height = 24, isPrinting = false;

  const inSight = () => Math.max(1, Math.floor(box.clientHeight / height));
  const tall = () => Math.min(LIST_TALLEST, count * height);
  const room = () => Math.max(1, tall() - box.clientHeight);

  // The position of the row at the top, and where it stands in pixels.
  function top() {
    if (count * height <= LIST_TALLEST) {
      const first = Math.floor(box.scrollTop / height);
      return [first, first * height];
    }
    return [Math.round((box.scrollTop / room()) * (count - inSight())), box.scrollTop];
  }

  function show() {
    const [first, at] = isPrinting ? [0, 0] : top();
    const last = Math.min(count, isPrinting ? LIST_PRINTED : first + inSight() + 2);
    for (const [position, row] of rows) {
      if (position < first || position >= last) {
        row.remove();
        rows.delete(position);
      }
    }
    let before = null;
    for (let position = first; position < last; position++) {
      const row = rows.get(position) || newRow(position);
      row.style.transform = isPrinting ? "" : `translateY(${at + (position - first) * height}px)`;
      row.setAttribute("aria-setsize", String(count));
      row.setAttribute("aria-selected", String(position === chosen));
      const next = before ? before.nextSibling : track.firstChild;
      if (next !== row) track.insertBefore(row, next);
      before = row;
    }
    if (rows.has(chosen)) box.setAttribute("aria-activedescendant", rows.get(chosen).id);
    else box.removeAttribute("aria-activedescendant");
  }

  function newRow(position) {
    const row = document.createElement("div");
    row.setAttribute("role", "option");
    row.id = `${box.id}-${position}`;
    row.setAttribute("aria-posinset", String(position + 1));
    row.dataset.position = String(position);
    draw(row, position);
    rows.set(position, row);
    return row;
  }

  // How tall a row is, as it is written now: it depends on the width of the page and the zoom.
  function measure() {
    const row = rows.values().next().value;
    const found = row ? row.getBoundingClientRect().height : 0;
    if (!found || Math.abs(found - height) < 0.5) return;
    const [first] = top();
    height = found;
    track.style.height = `${tall()}px`;
    box.scrollTop = count * height <= LIST_TALLEST ? first * height : box.scrollTop;
    show();
  }

  function reveal(position) {
    const [first] = top();
    if (position >= first && position < first + inSight() && count * height > LIST_TALLEST) return;
    if (count * height > LIST_TALLEST) {
      box.scrollTop = (position / Math.max(1, count - inSight())) * room();
    } else if (position * height < box.scrollTop) box.scrollTop = position * height;
    else if ((position + 1) * height > box.scrollTop + box.clientHeight) {
      box.scrollTop = (position + 1) * height - box.clientHeight;
    }
  }

  function choose(position) {
    if (!count) return;
    chosen = Math.max(0, Math.min(count - 1, position));
    reveal(chosen);
    show();
    select(chosen);
  }

  // The list has so many rows now; others than before, unless it `grew`.
  function update(size, { grew = false } = {}) {
    const isAtEnd = box.scrollTop + box.clientHeight >= tall() - height;
    count = size;
    if (!grew) {
      rows.forEach((row) => row.remove());
      rows.clear();
      chosen = -1;
      box.scrollTop = 0;
    }
    track.style.height = `${tall()}px`;
    if (grew === "follow" && isAtEnd) box.scrollTop = tall();
    show();
    measure();
  }

  const keys = {
    ArrowDown: () => chosen + 1, ArrowUp: () => chosen - 1, Home: () => 0, End: () => count - 1,
    PageDown: () => chosen + inSight(), PageUp: () => chosen - inSight(),
  };
  box.addEventListener("keydown", (event) => {
    if (!(event.key in keys) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    choose(keys[event.key]());
  });
  box.addEventListener("click", (event) => {
    const row = event.target.closest("[role=option]");
    if (row) choose(Number(row.dataset.position));
  });
  box.addEventListener("scroll", show, { passive: true });
  window.addEventListener("resize", () => {
    measure();
    show();
  });
  const print = (isNow) => () => {
    isPrinting = isNow;
    box.classList.toggle("printed", isNow);
    rows.forEach((row) => row.remove());
    rows.clear();
    show();
  };
  window.addEventListener("beforeprint", print(true));
  window.addEventListener("afterprint", print(false));

  return {
    update, choose,
    get chosen() {
      return chosen;
    },
    get count() {
      return count;
    },
  };
}

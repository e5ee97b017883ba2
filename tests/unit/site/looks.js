// What a reader would stumble over on a page as it stands, whatever was done with it before.
"use strict";

const named = (each) => each.outerHTML.slice(0, 90).replace(/\s+/g, " ");
const shown = (each) => each.checkVisibility({ visibilityProperty: true, opacityProperty: true });
const CONTROLS = "button, input, select, textarea, summary, [role=option], [role=tab]";

// Where something can be seen: its own place, cut by the boxes around it that scroll or hide.
const windows = new Map();
function windowOf(element) {
  if (!element || element === document.documentElement) {
    return { left: -Infinity, top: -Infinity, right: Infinity, bottom: Infinity };
  }
  if (!windows.has(element)) {
    const outer = windowOf(element.parentElement);
    const style = getComputedStyle(element);
    const clips = style.overflowX !== "visible" && style.display !== "inline";
    windows.set(element, clips ? cut(element.getBoundingClientRect(), outer) : outer);
  }
  return windows.get(element);
}

const cut = (a, b) => ({
  left: Math.max(a.left, b.left), top: Math.max(a.top, b.top),
  right: Math.min(a.right, b.right), bottom: Math.min(a.bottom, b.bottom),
});

// The lines of text that are seen in the content, and whose they are.
function lines(root) {
  const found = [];
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const owner = node.parentElement;
    if (!node.data.trim() || owner.closest("script, style, option, textarea") || !shown(owner)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const whole of range.getClientRects()) {
      const seen = cut(whole, windowOf(owner));
      if (seen.right - seen.left < 2 || seen.bottom - seen.top < 2) continue;
      found.push({ node, owner, whole, seen });
    }
  }
  return found;
}

function wideFaults() {
  const wide = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth <= wide) return [];
  const over = [...document.body.querySelectorAll("*")].filter((each) => {
    const { left, right } = each.getBoundingClientRect();
    return shown(each) && (right > wide + 1 || left < -1);
  });
  return [`${document.documentElement.scrollWidth} wide: ${over.slice(-1).map(named)}`];
}

function linkFaults() {
  const faults = [];
  const ids = [...document.querySelectorAll("[id]")].map(({ id }) => id);
  const seen = new Set();
  for (const id of ids) {
    if (seen.has(id)) faults.push(`the id ${id} stands twice`);
    seen.add(id);
  }
  for (const link of document.querySelectorAll('a[href^="#"]')) {
    const id = decodeURIComponent(link.getAttribute("href").slice(1));
    if (id && !seen.has(id)) faults.push(`no #${id}`);
  }
  for (const image of document.images) {
    if (shown(image) && !image.naturalWidth) faults.push(`does not show: ${named(image)}`);
  }
  return faults;
}

// A box that scrolls is reached with the keyboard; one that hides what is in it, hides no text.
function boxFaults() {
  const faults = [];
  for (const each of document.querySelectorAll("main *, body > header *")) {
    const over = each.scrollWidth > each.clientWidth + 1 && each.clientWidth > 1;
    if (!over || !shown(each) || each.matches("input, textarea, select, .visually-hidden")) continue;
    const style = getComputedStyle(each);
    const reached = each.tabIndex >= 0 || each.querySelector("a, button, input, [tabindex]");
    if (/auto|scroll/.test(style.overflowX) && !reached) faults.push(`no key scrolls ${named(each)}`);
    // What a row leaves out is written out below the list.
    const isShort = style.textOverflow === "ellipsis" && each.closest("[role=option]");
    if (/hidden|clip/.test(style.overflowX) && !isShort) faults.push(`cut off: ${named(each)}`);
  }
  return faults;
}

// Text stays in its cell or button, and no line is written over another.
function textFaults() {
  const faults = [], drawn = lines(document.body);
  for (const { owner, whole, seen } of drawn) {
    const cell = owner.closest("td, th, button, summary, .strip li, .chips label");
    if (!cell || seen.right < whole.right - 1) continue;
    const box = cell.getBoundingClientRect();
    if (whole.left < box.left - 1 || whole.right > box.right + 1) faults.push(`out of its cell: ${named(cell)}`);
  }
  const fixed = new Map();
  const layerOf = (owner) => {
    for (let each = owner; each; each = each.parentElement) {
      if (!fixed.has(each)) fixed.set(each, /fixed|sticky/.test(getComputedStyle(each).position));
      if (fixed.get(each)) return each;
    }
    return null;
  };
  drawn.sort((a, b) => a.seen.top - b.seen.top);
  drawn.forEach((a, i) => {
    for (let j = i + 1; j < drawn.length && drawn[j].seen.top < a.seen.bottom - 4; j += 1) {
      const b = drawn[j];
      const over = cut(a.seen, b.seen);
      if (over.right - over.left < 3 || over.bottom - over.top < 4 || a.node === b.node) continue;
      // What is fixed lies over what moves below it, on purpose.
      if (layerOf(a.owner) !== layerOf(b.owner)) continue;
      faults.push(`over each other: ${named(a.owner)} and ${named(b.owner)}`);
    }
  });
  return faults;
}

// A finger or a shaking hand meets what is 24 pixels wide and high.
function targetFaults() {
  return [...document.querySelectorAll(CONTROLS)].filter(shown).filter((each) => {
    const parts = each.matches("[type=checkbox], [type=radio]") ? [each, ...each.labels] : [each];
    const sizes = parts.map((part) => part.getBoundingClientRect());
    return sizes[0].width > 1 && !sizes.some(({ width, height }) => width >= 23.5 && height >= 23.5);
  }).map((each) => {
    const { width, height } = each.getBoundingClientRect();
    return `${Math.round(width)} by ${Math.round(height)} small: ${named(each)}`;
  });
}

// On paper there is the content alone, and all of it.
function paperFaults() {
  const wide = document.documentElement.clientWidth;
  const faults = wideFaults();
  for (const each of document.querySelectorAll("nav, button, select, textarea, .permalink, .skip")) {
    if (shown(each)) faults.push(`on paper: ${named(each)}`);
  }
  for (const { owner, whole } of lines(document.body)) {
    if (whole.right > wide + 1 || whole.left < -1) faults.push(`beside the paper: ${named(owner)}`);
  }
  for (const each of document.querySelectorAll("main pre, main .scroll, main table, main ol, main ul")) {
    const cuts = getComputedStyle(each).overflowX !== "visible" || getComputedStyle(each).overflowY !== "visible";
    const more = each.scrollWidth > each.clientWidth + 1 || each.scrollHeight > each.clientHeight + 1;
    if (shown(each) && each.clientWidth && cuts && more) faults.push(`cut off on paper: ${named(each)}`);
  }
  return faults;
}

// With the colours of the user, a control has an edge, or it is underlined.
function edgeFaults() {
  const edged = "button, input:not([type=checkbox]):not([type=radio]), select, textarea";
  return [...document.querySelectorAll(edged)].filter(shown).filter((each) => {
    const { borderBottomStyle, borderBottomWidth, outlineStyle, textDecorationLine } = getComputedStyle(each);
    if (each.getBoundingClientRect().width < 2) return false;
    const bordered = borderBottomStyle !== "none" && parseFloat(borderBottomWidth) > 0;
    return !bordered && outlineStyle === "none" && textDecorationLine === "none";
  }).map((each) => `without an edge: ${named(each)}`);
}

// Where motion is not wanted, nothing moves.
function motionFaults() {
  const long = (text) => text.split(",").some((each) => parseFloat(each) > 0.01);
  return [document.documentElement, ...document.querySelectorAll("body *")].filter((each) => {
    const { animationName, animationDuration, transitionDuration, scrollBehavior } = getComputedStyle(each);
    return (animationName !== "none" && long(animationDuration)) || long(transitionDuration)
      || scrollBehavior === "smooth";
  }).map((each) => `moves: ${named(each)}`);
}

// Without a script, there is nothing to press that would do nothing.
function deadFaults() {
  const dead = "button:not([popovertarget]), input, select, textarea, [role=listbox], progress";
  return [...document.querySelectorAll(dead)].filter(shown).map((each) => `dead: ${named(each)}`);
}

// Each control is reached by Tab, once in a round, and seen to be: by its outline, shadow or ground.
function startKeys() {
  document.activeElement.blur();
  getSelection().removeAllRanges();
  const reachable = [...document.querySelectorAll("a[href], button, input, select, textarea, summary, [tabindex]")]
    .filter((each) => shown(each) && each.tabIndex >= 0 && !each.disabled)
    .filter((each) => !each.matches("[type=radio]") || each.checked);
  const look = (each) => {
    const { outlineStyle, outlineWidth, boxShadow } = getComputedStyle(each);
    return `${outlineStyle} ${outlineWidth} ${boxShadow}`;
  };
  const before = new Map(reachable.map((each) => [each, look(each)]));
  const times = new Map(), faults = [];
  let begun = null, isRound = false;
  const reached = ({ target }) => {
    isRound ||= target === begun;
    if (isRound) return;
    if (before.has(target)) begun ??= target;
    times.set(target, (times.get(target) || 0) + 1);
    const beside = target.closest("label, form") || target;
    const differs = look(target) !== before.get(target) || target.closest(".chips");
    if (before.has(target) && !differs) faults.push(`not seen to have the focus: ${named(beside)}`);
  };
  document.addEventListener("focusin", reached);
  window.hasComeRound = () => isRound;
  window.endKeys = () => {
    document.removeEventListener("focusin", reached);
    for (const each of reachable) {
      const count = times.get(each) || 0;
      if (count !== 1) faults.push(`${count} times reached: ${named(each)}`);
    }
    return first(faults);
  };
  return reachable.length;
}

const screenFaults = () => [
  ...wideFaults(), ...linkFaults(), ...boxFaults(), ...textFaults(), ...targetFaults(),
];

const first = (faults) => {
  windows.clear();
  return [...new Set(faults)].slice(0, 8);
};

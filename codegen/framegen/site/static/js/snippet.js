// What is shown of a text that is found: its part with the words of the search, which are marked.
"use strict";

// Where words of a search stand in a text, in any form; those that are `open` may be beginnings.
function* placesOf(text, words, open = []) {
  for (const { 0: found, index } of text.matchAll(WORD)) {
    for (const word of words) {
      if (keysOf(found).some((key) => isForm(key, word, open.includes(word)))) yield { index, word, found };
    }
  }
}

// Text in pieces, of which some are matched by the words of a search.
function piecesOf(text, words, open) {
  const pieces = [];
  let end = 0;
  for (const { index, found } of placesOf(text, words, open)) {
    if (index < end) continue;
    pieces.push({ text: text.slice(end, index), hit: false }, { text: found, hit: true });
    end = index + found.length;
  }
  return [...pieces, { text: text.slice(end), hit: false }].filter((piece) => piece.text);
}

// The first of the places behind which the most different words stand within `reach`.
function densestOf(places, reach) {
  const many = new Map(), counts = new Map();
  let end = 0;
  places.forEach(({ index, word }, at) => {
    for (; end < places.length && places[end].index < index + reach; end++) {
      counts.set(places[end].word, (counts.get(places[end].word) ?? 0) + 1);
    }
    if (!many.has(index)) many.set(index, counts.size);
    if (counts.get(word) === 1) counts.delete(word);
    else counts.set(word, counts.get(word) - 1);
  });
  return places.reduce((so, place) => (many.get(place.index) > many.get(so.index) ? place : so), places[0]);
}

// The part of a text with the most of the words in it, at whole words.
function snippetOf(text, words, open, size = 200) {
  if (text.length <= size) return text;
  const places = [...placesOf(text, words, open)];
  const best = words.length > 1 ? densestOf(places, 0.7 * size) : places[0];
  let from = Math.max(0, (best?.index ?? 0) - 50);
  if (from) from = text.indexOf(" ", from) + 1;
  let to = Math.min(text.length, from + size);
  if (to < text.length) to = Math.max(text.lastIndexOf(" ", to), from + 1);
  return `${from ? "… " : ""}${text.slice(from, to)}${to < text.length ? " …" : ""}`;
}

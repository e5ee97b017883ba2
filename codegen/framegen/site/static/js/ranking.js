// Finds the entries of an index by words, the best first. It touches no page.
"use strict";

// Letters and digits, by ranges: browsers are ten times slower with the names of such classes.
const WORD = /[A-Za-z0-9\u00c0-\u1fff\u3040-\uffee]+(?:[-_.][A-Za-z0-9\u00c0-\u1fff\u3040-\uffee]+)*/g;
const BETWEEN = /[^a-z0-9\u00c0-\u1fff\u3040-\uffee]+/g;
// How much it is worth where a word stands.
const PLACES = { title: 8, names: 8, also: 7, where: 3, text: 2 };
const EXACT_TITLE = 100, EXACT_NAME = 90, EXACT_HEADING = 60, TITLE_BEGINS = 6;
const LEAST_TO_CORRECT = 4, LEAST_STEM = 3, MOST_SUGGESTIONS = 3, MOST_WORDS = 16;

// A name as it is compared: "LX-16A", "lx_16a" and "lx16a" are one.
const glued = (text) => text.toLowerCase().replace(BETWEEN, "");

// What a word is found by: itself, each of its parts, and what it has from there on. So
// "BatteryVoltageRead" is found by "voltage" and "voltageread", too.
const keysOfWords = new Map();
function keysOf(word) {
  if (!keysOfWords.has(word)) {
    const parts = word.replace(/([a-z0-9])([A-Z])/g, "$1 $2").toLowerCase().split(/[-_. ]/);
    const keys = [...parts, ...parts.map((_, from) => parts.slice(from).join(""))];
    keysOfWords.set(word, [...new Set(keys)]);
  }
  return keysOfWords.get(word);
}

// Words and “phrases” of a query. What is between quotes must stand there as it is.
function readQuery(query) {
  const phrases = [];
  const open = query.replace(/["“”]([^"“”]+)["“”]/g, (_, phrase) => {
    phrases.push(phrase.trim().toLowerCase().replace(/\s+/g, " "));
    return ` ${phrase} `;
  });
  return { words: (open.match(WORD) ?? []).slice(0, MOST_WORDS), phrases: phrases.filter(Boolean) };
}

// A word without the ends that English gives to it, or "" where too little is left.
function stemOf(word) {
  const stem = word.replace(/ies$/, "y").replace(/(?:ing|ed|es|s)$/, "");
  return stem !== word && stem.length >= LEAST_STEM ? stem : "";
}

// Whether one slip lies between two words: a letter too many, too few, another, or two changed round.
function isOneSlip(one, other) {
  if (one.length > other.length) return isOneSlip(other, one);
  let at = 0;
  while (at < one.length && one[at] === other[at]) at++;
  const rest = (text, from) => text.slice(from);
  if (one.length < other.length) return rest(one, at) === rest(other, at + 1);
  return rest(one, at + 1) === rest(other, at + 1)
    || (one[at] === other[at + 1] && one[at + 1] === other[at] && rest(one, at + 2) === rest(other, at + 2));
}

function makeSearch(index) {
  const { entries } = index, ranks = Object.keys(index.kinds);
  const whole = entries.map((entry) => [entry.title, ...(entry.names ?? []), ...(entry.also ?? []),
    entry.where, entry.text ?? ""].join("\n").toLowerCase());
  const titles = entries.map(({ title }) => glued(title));
  // What is called so, what has such words, and how names of several parts are written.
  const exact = new Map(), vocabulary = new Map(), written = new Map();

  entries.forEach((entry, number) => {
    const places = { ...entry, names: (entry.names ?? []).join("\n"), also: (entry.also ?? []).join("\n") };
    const seen = new Map();
    for (const [place, worth] of Object.entries(PLACES)) {
      for (const word of (places[place] ?? "").match(WORD) ?? []) {
        if (keysOf(word).length > 1 && !written.has(glued(word))) written.set(glued(word), word);
        for (const key of keysOf(word)) {
          const before = seen.get(key) ?? 0;
          // What prose says again and again counts a little more.
          if (!before) seen.set(key, worth);
          else if (before < PLACES.where) seen.set(key, before + 0.2);
        }
      }
    }
    for (const [key, worth] of seen) {
      if (!vocabulary.has(key)) vocabulary.set(key, []);
      vocabulary.get(key).push([number, worth]);
    }
    const names = [entry.title, ...(entry.names ?? []), ...(entry.also ?? [])];
    names.forEach((name, at) => {
      const key = glued(name);
      if (!exact.has(key)) exact.set(key, new Map());
      const title = entry.kind === "guide" ? EXACT_HEADING : EXACT_TITLE;
      if (!exact.get(key).has(number)) exact.get(key).set(number, at ? EXACT_NAME : title);
    });
  });
  const keys = [...vocabulary.keys()].sort();

  // The first of all keys that is not before `word`.
  function firstFrom(word) {
    let low = 0, high = keys.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (keys[middle] < word) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  // How well each entry has a word, or one that begins with it.
  function worths(word) {
    const found = new Float32Array(entries.length);
    const take = (start, factor) => {
      for (let at = firstFrom(start); at < keys.length && keys[at].startsWith(start); at++) {
        const like = keys[at] === word ? 1 : factor * (1 + start.length / keys[at].length) / 2;
        for (const [number, worth] of vocabulary.get(keys[at])) {
          if (worth * like > found[number]) found[number] = worth * like;
        }
      }
    };
    take(word, 0.8);
    if (stemOf(word)) take(stemOf(word), 0.6);
    return found;
  }

  // Words that exist, and that one slip makes of this one; the most used first.
  function near(word) {
    if (word.length < LEAST_TO_CORRECT) return [];
    const like = keys.filter((key) => Math.abs(key.length - word.length) < 2 && isOneSlip(key, word));
    const uses = (key) => vocabulary.get(key).reduce((sum, [, worth]) => sum + worth, 0);
    return like.sort((one, other) => uses(other) - uses(one)).slice(0, MOST_SUGGESTIONS);
  }

  // Words as they are found: one that stands nowhere as a whole is taken in its parts.
  function taken(words) {
    return words.flatMap((word) => {
      const found = worths(glued(word)), parts = word.split(/[-_.]/);
      if (found.some(Boolean) || parts.length === 1) return [{ word: glued(word), found }];
      return taken(parts);
    });
  }

  // The entries with all words and phrases. Where none has, `loose` tells that hits have some of
  // the words, and `suggestions` are queries that have a hit.
  function find(query, { kind = "", protocol = "" } = {}) {
    const { words, phrases } = readQuery(query), sought = taken(words), key = glued(query);
    const said = phrases.length ? entries.map((_, number) => phrases.every(
      (phrase) => whole[number].includes(phrase))) : null;
    const counts = {};
    const rank = (most) => {
      const hits = [];
      entries.forEach((entry, number) => {
        if ((said && !said[number]) || (protocol && entry.protocol !== protocol)) return;
        const had = sought.filter(({ found }) => found[number]);
        if (!had.length || had.length < most) return;
        counts[entry.kind] = (counts[entry.kind] ?? 0) + 1;
        if (kind && entry.kind !== kind) return;
        const named = exact.get(key)?.get(number) ?? 0;
        const begins = titles[number].startsWith(key) ? TITLE_BEGINS * key.length / titles[number].length : 0;
        const score = had.reduce((sum, { found }) => sum + found[number], named + begins)
          - ranks.indexOf(entry.kind) - number / entries.length;
        hits.push({ entry, score, number });
      });
      return hits.sort((one, other) => other.score - one.score || one.number - other.number);
    };
    const wrong = sought.filter(({ found }) => !found.some(Boolean));
    let hits = rank(sought.length);
    const better = wrong.length ? corrected(query, wrong.map(({ word }) => word)) : [];
    const suggestions = better.filter((text) => {
      const answer = find(text);
      return answer.hits.length && !answer.loose;
    });
    const loose = !hits.length && sought.length > 1 && !suggestions.length && wrong.length < sought.length;
    if (loose) {
      const had = (_, number) => sought.filter(({ found }) => found[number]).length;
      hits = rank(Math.max(...entries.map(had)));
    }
    return { hits, counts, loose, suggestions, words: sought.map(({ word }) => word) };
  }

  // The query with other words in the place of those that stand nowhere.
  function corrected(query, wrong) {
    const choices = wrong.map(near);
    if (!choices.every((each) => each.length)) return [];
    return choices[0].map((_, place) => [...query.matchAll(WORD)].map(([word]) => {
      const at = wrong.indexOf(glued(word));
      const right = choices[at]?.[place] ?? choices[at]?.[0];
      return at < 0 ? word : written.get(right) ?? right;
    }).join(" "));
  }

  return { find };
}

// Text in pieces, of which some are matched by the words of a search.
function piecesOf(text, words) {
  const stems = words.flatMap((word) => [word, stemOf(word)]).filter(Boolean), pieces = [];
  let end = 0;
  for (const { 0: word, index } of text.matchAll(WORD)) {
    if (!keysOf(word).some((key) => stems.some((stem) => key.startsWith(stem)))) continue;
    pieces.push({ text: text.slice(end, index), hit: false }, { text: word, hit: true });
    end = index + word.length;
  }
  return [...pieces, { text: text.slice(end), hit: false }].filter((piece) => piece.text);
}

// Where the words of a search stand in a text, whatever joins their parts there.
function placesOf(text, words) {
  return words.flatMap((word) => {
    const pattern = new RegExp([...(stemOf(word) || word)].join("[-_.]?"), "giu");
    return Array.from(text.matchAll(pattern), ({ index }) => ({ index, word }));
  });
}

// The part of a text with the most of the words in it, at whole words.
function snippetOf(text, words, size = 200) {
  if (text.length <= size) return text;
  const places = placesOf(text, words), reach = 0.7 * size;
  const within = ({ index: from }) => new Set(places.filter(({ index }) => index >= from
    && index < from + reach).map(({ word }) => word)).size;
  const best = words.length > 1
    ? places.reduce((so, place) => (within(place) > within(so) ? place : so), places[0]) : places[0];
  let from = Math.max(0, (best?.index ?? 0) - 50);
  if (from) from = text.indexOf(" ", from) + 1;
  let to = Math.min(text.length, from + size);
  if (to < text.length) to = Math.max(text.lastIndexOf(" ", to), from + 1);
  return `${from ? "… " : ""}${text.slice(from, to)}${to < text.length ? " …" : ""}`;
}

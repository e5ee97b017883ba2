// Words, as a search takes them from texts and queries, and when two of them are one. It touches no page.
"use strict";

// Letters and digits, by ranges: browsers are ten times slower with the names of such classes.
const WORD = /[A-Za-z0-9\u00c0-\u1fff\u3040-\uffee]+(?:[-_.][A-Za-z0-9\u00c0-\u1fff\u3040-\uffee]+)*/g;
const BETWEEN = /[^a-z0-9\u00c0-\u1fff\u3040-\uffee]+/g;
const MOST_WORDS = 16, LEAST_STEM = 3, LEAST_BEGINNING = 4;
// What a short word may end with besides, from its last letter on, and a short stem: "bits" and "LED2",
// but neither "note" for "not" nor "100" for "1".
const WORD_ENDS = /^.(?:e?s|e?d|ing)?$|^\D\d+$/, STEM_ENDS = /^.(?:e|e?s|e?d|y|ies|ing)?$/;
// "node" has no form "nod".
const ENDS_OF_E = /^.(?:e|e[sd]|ing)$/;

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
  const stem = word.replace(/ies$/, "y").replace(/(?:ing|ed|es|s|e)$/, "");
  return stem !== word && stem.length >= LEAST_STEM ? stem : "";
}

// Whether a key is a word in one of its forms, or begins with it. What is short begins too much:
// it counts as a beginning where it is `open`, still being typed.
function isForm(key, word, open = false) {
  const begins = (start, ends) => key.startsWith(start)
    && (start.length >= LEAST_BEGINNING || ends.test(key.slice(start.length - 1)));
  if (open ? key.startsWith(word) : begins(word, WORD_ENDS)) return true;
  return stemOf(word) !== "" && begins(stemOf(word), word.endsWith("e") ? ENDS_OF_E : STEM_ENDS);
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

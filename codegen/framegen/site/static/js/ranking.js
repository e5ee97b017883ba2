// Finds the entries of an index by words, the best first. It touches no page.
"use strict";

// How much it is worth where a word stands, and how much less it is worth in a long text of that kind.
const PLACES = { title: [8, 0.3], names: [8, 0], also: [7, 0], path: [4, 0], where: [3, 0.3],
  sort: [3, 0], text: [2, 0.6] };
// What people call an entry of a kind.
const SORTS = { message: "command packet layout format bytes", method: "function call Python" };
// How soon more of the same word adds nothing, and what a name within a question is worth.
const SATURATION = 3, NAMED = 0.7, NAME_WITHIN = 0.8, MOST_NAME_WORDS = 5;
// Hits have this much of what the best one has of the words, rare ones counting more; and so much of what
// a query tells must stand somewhere.
const LEAST_SHARE = 0.3, LEAST_KNOWN = 0.2;
// How much less a hit is worth that is not for users, as far as its headings do not tell.
const ASIDE = 0.25;
// What questions are made of. It says nothing about the place, and is too rare in reference text for
// its frequency there to tell so.
const QUESTION_WORDS = new Set(`a about am an and any are as at be can could did do does for from get
  gets had has have how i if in is it its me mean means my of on or our should so that the their them
  there these they this to too use used using want was we what when where which while who why will
  with would you your`.split(/\s+/));
const EXACT_TITLE = 100, EXACT_NAME = 90, EXACT_HEADING = 60, TITLE_BEGINS = 2, KIND = 0.4, LATER = 0.8;
const LEAST_TO_CORRECT = 4, MOST_SUGGESTIONS = 3;

function makeSearch(index) {
  const { entries } = index, ranks = Object.keys(index.kinds);
  const protocols = index.protocols.map(({ name }) => name);
  const whole = entries.map((entry) => [entry.title, ...(entry.names ?? []), ...(entry.also ?? []),
    entry.where, entry.text ?? ""].join("\n").toLowerCase());
  const titles = entries.map(({ title }) => glued(title));
  const headings = entries.map(({ title, where, also = [] }) => (
    [...new Set([title, where, ...also].join("\n").match(WORD)?.flatMap(keysOf))]));
  // What is called so, which entries have a word and how well, in turn,
  // and how names of several parts are written.
  const exact = new Map(), vocabulary = new Map(), written = new Map();
  // A page is called what its address says, its sections are not.
  const pathOf = ({ path }) => (path.includes("#") ? ""
    : path.replace(/(?:\/index)?\.html$/, "").replace(/^.*\//, ""));
  const placesIn = (entry) => ({ ...entry, path: pathOf(entry), sort: SORTS[entry.kind] });
  const said = entries.map(placesIn).map((entry) => Object.keys(PLACES).map((place) => (
    [entry[place] ?? ""].flat().join("\n").match(WORD) ?? [])));
  const usual = Object.keys(PLACES).map((_, place) => (
    said.reduce((sum, words) => sum + words[place].length, 1) / entries.length));

  entries.forEach((entry, number) => {
    const seen = new Map();
    Object.values(PLACES).forEach(([worth, shrinks], place) => {
      const words = said[number][place];
      const each = worth / (1 - shrinks + shrinks * words.length / usual[place]);
      for (const word of words) {
        if (keysOf(word).length > 1 && !written.has(glued(word))) written.set(glued(word), word);
        for (const key of keysOf(word)) seen.set(key, (seen.get(key) ?? 0) + each);
      }
    });
    for (const [key, worth] of seen) {
      if (!vocabulary.has(key)) vocabulary.set(key, []);
      vocabulary.get(key).push(number, worth / (worth + SATURATION));
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

  // As one types, only the last word is another one.
  const known = new Map();
  function worths(word, open) {
    const name = `${word} ${open}`;
    if (known.size > MOST_WORDS) known.delete(known.keys().next().value);
    if (!known.has(name)) known.set(name, worthsAnew(word, open));
    return known.get(name);
  }

  // How well each entry has a word, in one of its forms.
  function worthsAnew(word, open) {
    const found = new Float32Array(entries.length);
    const take = (start, factor) => {
      for (let at = firstFrom(start); at < keys.length && keys[at].startsWith(start); at++) {
        if (!isForm(keys[at], word, open)) continue;
        const like = keys[at] === word ? 1 : factor * (1 + start.length / keys[at].length) / 2;
        const having = vocabulary.get(keys[at]);
        for (let next = 0; next < having.length; next += 2) {
          const number = having[next], worth = having[next + 1] * like;
          if (worth > found[number]) found[number] = worth;
        }
      }
    };
    take(word, 0.8);
    if (stemOf(word)) take(stemOf(word), 0.6);
    // "baudrate" is "baud rate".
    for (const number of exact.get(word)?.keys() ?? []) found[number] ||= NAMED;
    return found;
  }

  // Words that exist, and that one slip makes of this one; the most used first.
  function near(word) {
    if (word.length < LEAST_TO_CORRECT) return [];
    const like = keys.filter((key) => Math.abs(key.length - word.length) < 2 && isOneSlip(key, word));
    const uses = (key) => vocabulary.get(key).reduce((sum, each, at) => sum + (at % 2 ? each : 0), 0);
    return like.sort((one, other) => uses(other) - uses(one)).slice(0, MOST_SUGGESTIONS);
  }

  // Words as they are found: one that stands nowhere as a whole is a beginning, or taken in its parts.
  // The last one is still being typed.
  function taken(words, typed = true) {
    return words.flatMap((text, at) => {
      const word = glued(text), parts = text.split(/[-_.]/);
      for (const open of typed && at === words.length - 1 ? [true] : [false, true]) {
        const found = worths(word, open);
        if (found.some(Boolean)) return [{ text, word, open, found }];
      }
      if (parts.length > 1) return taken(parts, false);
      return [{ text, word, open: false, found: new Float32Array(entries.length) }];
    });
  }

  // How much a word tells: the fewer entries have it, the more.
  function weightOf({ word, found }) {
    if (QUESTION_WORDS.has(word)) return 0;
    let many = 0;
    for (const each of found) if (each) many++;
    return Math.log(1 + (entries.length - many + 0.5) / (many + 0.5));
  }

  const tellsOf = (sought) => sought.reduce((sum, { weight }) => sum + weight, 0);

  // What each entry gains by names that stand within a question.
  function namedWithin(sought) {
    const gained = new Map();
    sought.forEach((_, from) => {
      let key = "", weight = 0;
      for (const { word, weight: own } of sought.slice(from, from + MOST_NAME_WORDS)) {
        key += word;
        weight += own;
        for (const number of weight ? exact.get(key)?.keys() ?? [] : []) {
          gained.set(number, Math.max(gained.get(number) ?? 0, NAME_WITHIN * weight));
        }
      }
    });
    return gained;
  }

  // How much of what is sought the headings of an entry have.
  function inHeadings(number, sought) {
    const has = ({ word, open }) => headings[number].some((key) => isForm(key, word, open));
    return sought.reduce((sum, each) => sum + (has(each) ? each.weight : 0), 0) / tellsOf(sought);
  }

  // The entries with all phrases and with most of what the words tell. If none has all words, `loose`
  // says so, and `absent` are the words that stand nowhere, unless hits are those of words like them:
  // then `suggestions` are queries that have all words with these.
  function find(query, { kind = "", protocol = "" } = {}) {
    const { words, phrases } = readQuery(query), key = glued(query);
    const sought = taken(words).map((each) => ({ ...each, weight: weightOf(each) }));
    const wrong = sought.filter(({ found, weight }) => weight && !found.some(Boolean));
    const better = exact.has(key) ? [] : corrected(query, wrong.map(({ word }) => word));
    const answers = better.map((text) => find(text, { kind, protocol }));
    if (answers.some(({ hits }) => hits.length)) {
      const suggestions = better.filter((_, at) => answers[at].hits.length && !answers[at].loose);
      return { ...answers.find(({ hits }) => hits.length), suggestions };
    }
    // Where nothing but a question is asked, its words are all there is.
    if (!sought.some(({ weight }) => weight)) sought.forEach((each) => { each.weight = 1; });
    const within = namedWithin(sought), hits = [], counts = {}, tells = tellsOf(sought);
    const isKnown = exact.has(key) || tells - tellsOf(wrong) >= LEAST_KNOWN * tells;
    entries.forEach((entry, number) => {
      if (!isKnown) return;
      if (!phrases.every((phrase) => whole[number].includes(phrase))) return;
      if (protocol && entry.protocol !== protocol) return;
      let share = 0, score = within.get(number) ?? 0, missing = 0;
      for (const { found, weight } of sought) {
        if (found[number]) share += weight;
        else if (weight) missing++;
        score += weight * found[number];
      }
      const named = exact.get(key)?.get(number) ?? 0;
      if (!share && !named) return;
      if (named) missing = 0;
      if (entry.aside && !named) score *= 1 - ASIDE * (1 - inHeadings(number, sought));
      const begins = titles[number].startsWith(key) ? TITLE_BEGINS * key.length / titles[number].length : 0;
      const behind = LATER * Math.max(0, protocols.indexOf(entry.protocol))
        + KIND * (ranks.indexOf(entry.kind) + number / entries.length);
      hits.push({ entry, score, number, share, missing, sure: named + begins - behind });
    });
    const best = hits.reduce((most, { share }) => Math.max(most, share), 0);
    const enough = hits.filter(({ share }) => share >= LEAST_SHARE * best || !share);
    // Of two that have the same of some words, the one that has the others as well leads.
    for (const hit of enough) hit.score = hit.score * (hit.share / (best || 1)) + hit.sure;
    for (const { entry } of enough) counts[entry.kind] = (counts[entry.kind] ?? 0) + 1;
    return {
      hits: enough.filter(({ entry }) => !kind || entry.kind === kind)
        .sort((one, other) => other.score - one.score || one.number - other.number),
      counts,
      loose: enough.length > 0 && enough.every(({ missing }) => missing),
      suggestions: [],
      absent: exact.has(key) ? [] : wrong.map(({ text }) => text),
      words: sought.filter(({ weight }) => weight).map(({ word }) => word),
      open: sought.filter(({ open }) => open).map(({ word }) => word),
    };
  }

  // The query with other words in the place of those that stand nowhere.
  function corrected(query, wrong) {
    const choices = wrong.map(near);
    if (!choices.length || !choices.every((each) => each.length)) return [];
    return choices[0].map((_, place) => [...query.matchAll(WORD)].map(([word]) => {
      const at = wrong.indexOf(glued(word));
      const right = choices[at]?.[place] ?? choices[at]?.[0];
      return at < 0 ? word : written.get(right) ?? right;
    }).join(" "));
  }

  return { find };
}

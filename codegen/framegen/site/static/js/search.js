// The page of the search: results as one types, kept in the address, reached by keys.
"use strict";

{
  const index = JSON.parse(byId("search-index").textContent);
  const search = makeSearch(index), bytesSearch = makeBytesSearch(index);
  const words = byId("search-words"), results = byId("search-results"), title = document.title;
  const titles = new Map(index.protocols.map((protocol) => [protocol.name, protocol.title]));
  const A_PAGE = 30, UNTIL_KEPT = 300;
  let shown = A_PAGE, keeping = 0;

  const marked = (text, { words, open }) => piecesOf(text, words, open).map(
    (piece) => (piece.hit ? make("mark", {}, piece.text) : piece.text));

  // ---- What is asked

  const chosen = (name) => byId(`search-${name}`).querySelector("input:checked")?.value ?? "";
  const asked = () => ({ query: words.value.trim(), kind: chosen("kinds"), protocol: chosen("protocols") });

  // A row of choices, the first of which takes all.
  function offer(name, choices) {
    for (const [value, label] of [["", "All"], ...choices]) {
      const input = make("input", { type: "radio", name: `search-${name}`, value });
      const count = make("span", { class: "count" });
      byId(`search-${name}`).append(make("label", {}, input, make("span", {}, label, " ", count)));
    }
  }

  // How many there are of each choice; a choice that leads to nothing is not offered.
  function count(name, counts) {
    for (const input of byId(`search-${name}`).querySelectorAll("input")) {
      const all = Object.values(counts).reduce((sum, each) => sum + each, 0);
      const many = input.value ? counts[input.value] ?? 0 : all;
      input.parentElement.hidden = !many && !input.checked;
      input.parentElement.querySelector(".count").textContent = many;
    }
  }

  function choose(name, value) {
    const inputs = [...byId(`search-${name}`).querySelectorAll("input")];
    (inputs.find((input) => input.value === value) ?? inputs[0]).checked = true;
  }

  // ---- What is found

  // The hits of a query: what its bytes are in front, then what its words find.
  function found({ query, kind, protocol }) {
    const read = bytesIn(query), said = search.find(read?.certain ? "" : query, { kind, protocol });
    const mayTake = (entry) => (!kind || entry.kind === kind) && (!protocol || entry.protocol === protocol);
    if (read?.problem) return { ...said, hits: [], counts: {}, suggestions: [], problem: read.problem };
    if (!read) return { ...said, bytes: null };
    const { judged, known, whole } = bytesSearch.find(read.bytes);
    // What may be a number or a word is taken for bytes if it is a frame, or nothing else.
    const isWords = Object.keys(said.counts).length > 0 && !said.loose;
    const isBytes = read.certain || whole || (!isWords && judged.length + known.length > 0);
    if (!isBytes) return { ...said, bytes: null };
    const framed = [...judged, ...known].filter((entry) => !protocol || entry.protocol === protocol);
    const hits = framed.filter(mayTake).map((entry) => ({ entry }));
    const counts = { frame: framed.length };
    return { hits, counts, loose: false, suggestions: [], absent: [], words: [], whole, ...read };
  }

  function bytesShown({ hex, at, size }) {
    if (at === undefined) return [hex];
    const end = 3 * (at + size) - 1;
    return [hex.slice(0, 3 * at), make("mark", {}, hex.slice(3 * at, end)), hex.slice(end)];
  }

  function itemOf({ entry }, sought) {
    const where = [entry.where, entry.decoder ? "" : titles.get(entry.protocol)].filter(Boolean).join(" · ");
    const isHit = (each) => piecesOf(each, sought.words, sought.open).some(({ hit }) => hit);
    const also = (entry.also ?? []).filter(isHit);
    const item = make("li", { class: entry.decoder ? "found bytes-found" : "found" },
      make("p", { class: "found-title" },
        make("a", { href: entry.path }, ...marked(entry.title, sought)), " ",
        make("span", { class: "small quiet" }, ...marked(where, sought))));
    const add = (kind, ...children) => item.append(make("p", { class: kind }, ...children));
    if (entry.hex) add("small", make("code", { class: "bytes" }, ...bytesShown(entry)));
    if (also.length) add("small", "Found for: ", ...marked(also.join(", "), sought));
    if (entry.text) add("snippet", ...marked(snippetOf(entry.text, sought.words, sought.open), sought));
    if (entry.decoder) add("small", make("a", { href: entry.decoder }, "Decode it in the workbench"));
    return item;
  }

  // ---- What is said

  const counted = (many, what) => `${many} ${many === 1 ? what : `${what}s`}`;

  // The words that stand on no page, where others do.
  function missed({ absent, words }) {
    if (!absent.length || absent.length === words.length) return "";
    const quoted = absent.map((word) => `“${word}”`), last = quoted.pop();
    return `No page has ${quoted.length ? `${quoted.join(", ")} or ${last}` : last}.`;
  }

  function summary({ query, kind }, answer, instead) {
    const { hits, bytes, left, problem, suggestions, whole, absent } = answer;
    if (!query) return `${index.entries.length} places to find.`;
    const half = left ? ` The last digit, ${left}, is half a byte.` : "";
    const what = bytes ? counted(bytes.length, "byte") : `“${query}”`;
    const of = kind ? ` in ${index.kinds[kind].toLowerCase()}` : "";
    if (problem) return `${problem}.`;
    if (suggestions.length) return `Nothing has “${query}”. ${instead.hits.length} found instead for`;
    if (hits.length && absent.length) {
      return `${missed(answer)} ${hits.length} found without ${absent.length > 1 ? "them" : "it"}${of}.`;
    }
    // What holds them is documented; what else is shown says why they are no frame.
    const isKnown = whole || hits.some(({ entry }) => !entry.decoder);
    if (bytes && hits.length && !isKnown) return `${what}, and no whole frame.${half}`;
    return `${hits.length || "Nothing"} found for ${what}${of}.${half} ${missed(answer)}`.trim();
  }

  function suggested(suggestions) {
    return suggestions.flatMap((text, at) => {
      const button = make("button", { type: "button", class: "suggestion" }, text);
      button.addEventListener("click", () => {
        words.value = text;
        renew();
        words.focus();
      });
      // What is shown is of the first.
      return at === 1 ? ["; or search for ", button] : [" ", button];
    });
  }

  // ---- The page

  function show() {
    const request = asked(), answer = found(request);
    const { hits, counts, suggestions } = answer;
    const instead = suggestions.length ? found({ ...request, query: suggestions[0] }) : answer;
    const visible = request.query ? instead.hits.slice(0, shown) : [];
    results.replaceChildren(...visible.map((hit) => itemOf(hit, instead)));
    results.hidden = !visible.length;
    byId("search-count").replaceChildren(summary(request, answer, instead), ...suggested(suggestions));
    byId("search-more").hidden = !request.query || instead.hits.length <= shown;
    byId("search-advice").hidden = !request.query || (hits.length > 0 && !suggestions.length);
    for (const link of byId("search-advice").querySelectorAll("[data-workbench]")) {
      link.search = answer.bytes ? `?hex=${toHex(answer.bytes).replace(/ /g, "").toLowerCase()}` : "";
    }
    byId("search-widely").hidden = !request.kind && !request.protocol;
    byId("search-letters").hidden = Boolean(request.query);
    byId("search-kinds").hidden = !request.query || !hits.length && !request.kind;
    byId("search-protocols").hidden = byId("search-kinds").hidden || index.protocols.length < 2;
    count("kinds", counts);
    document.title = request.query ? `${request.query} – ${title}` : title;
  }

  // The address of what is asked, so that going back leads to it.
  function keep() {
    clearTimeout(keeping);
    keeping = 0;
    const { query, kind, protocol } = asked();
    const said = Object.entries({ q: query, kind, in: protocol }).filter(([, value]) => value);
    const address = `${location.pathname}${said.length ? "?" : ""}${new URLSearchParams(said)}`;
    history.replaceState(history.state, "", address);
  }

  function renew() {
    shown = A_PAGE;
    show();
    // Browsers allow only so many changes of the address at a time.
    if (!keeping) keeping = setTimeout(keep, UNTIL_KEPT);
  }

  const links = () => [...results.querySelectorAll("a")];

  // Which link is followed is remembered, for whoever comes back.
  results.addEventListener("click", (event) => {
    const at = links().indexOf(event.target.closest("a"));
    if (at < 0) return;
    keep();
    history.replaceState({ at, shown }, "");
  });

  words.addEventListener("input", renew);
  byId("search-form").addEventListener("change", (event) => { if (event.target !== words) renew(); });
  byId("search-form").addEventListener("submit", (event) => {
    event.preventDefault();
    keep();
    if (words.value.trim()) links()[0]?.click();
  });
  byId("search-more").addEventListener("click", () => {
    const first = shown;
    shown += A_PAGE;
    show();
    results.children[first]?.querySelector("a").focus();
  });
  byId("search-advice").addEventListener("click", (event) => {
    if (!event.target.matches("button")) return;
    choose("kinds", "");
    choose("protocols", "");
    renew();
    words.focus();
  });

  document.addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const all = links(), at = all.indexOf(document.activeElement);
    if (!step || (at < 0 && (event.target !== words || step < 0))) return;
    event.preventDefault();
    (all[at + step] ?? (at + step < 0 ? words : all[at]))?.focus();
  });

  const address = new URLSearchParams(location.search);
  offer("kinds", Object.entries(index.kinds));
  offer("protocols", index.protocols.map((protocol) => [protocol.name, protocol.title]));
  words.value = address.get("q") ?? "";
  choose("kinds", address.get("kind") ?? "");
  choose("protocols", address.get("in") ?? "");
  shown = history.state?.shown ?? A_PAGE;
  show();
  if (history.state?.at === undefined) words.focus();
  else links()[history.state.at]?.focus();
}

// The fields of a message as inputs: choices for named values, a list that grows and shrinks, and what
// is wrong beside the field where it is.
"use strict";

let fieldCount = 0;

// The inputs of the message `kind`, with `values` in them; `onInput` is called at every change. The
// values are read as the command reads them, and checked by `encode`.
function makeFields(codec, kind, { values: first, onInput = () => {} }) {
  const groups = kind.given.map((slot) => (
    slot.role === "list" && !slot.text ? listOf(slot) : single(slot, slot.name, () => slot.name)));
  const element = make("div", { class: "values" }, ...groups.map((group) => group.element));

  function changed() {
    mark(null);
    onInput();
  }

  // One labelled input; `path` says where it is, which changes when items of its list go.
  function single(slot, name, path) {
    const id = `field-${++fieldCount}`, bounds = boundsOf(slot, kind);
    const hint = make("span", { class: "hint", id: `${id}-hint` }, bounds);
    const words = make("span", { class: "in-words", id: `${id}-words` });
    const problem = make("span", { class: "error", id: `${id}-error` });
    const input = make("input", { id, name, autocomplete: "off", spellcheck: "false",
      "aria-describedby": `${id}-error ${id}-hint ${id}-words` });
    const choice = namesOf(slot).length ? choiceOf(slot, name, input) : null;
    input.addEventListener("input", () => {
      say();
      changed();
    });

    // The value in words, where these say more than the input.
    function say() {
      const value = readOr(null);
      if (choice) choice.value = nameOf(slot, value) ?? "";
      const isNumeric = ["number", "bigint"].includes(typeof value);
      const says = isNumeric && (slot.scale || slot.bits || nameOf(slot, value) !== undefined);
      words.textContent = says ? inWords(slot, value) : "";
    }

    function read() {
      const text = slot.role === "text" || slot.text ? input.value : input.value.trim();
      return readOne(slot, path(), text);
    }

    function readOr(otherwise) {
      try {
        return read();
      } catch (error) {
        if (!(error instanceof Unusable)) throw error;
        return otherwise;
      }
    }

    return {
      element: make("div", { class: "value-field" }, make("label", { for: id }, name), hint,
        make("div", { class: "with-choice" }, input, choice), words, problem),
      read,
      show(value) {
        input.value = writeOne(slot, value);
        say();
      },
      mark(error) {
        const isHere = error !== null && (error.path === path() || error.path.startsWith(`${path()}[`));
        input.setAttribute("aria-invalid", String(isHere));
        problem.textContent = isHere ? reasonIn(error) : "";
        return isHere;
      },
      focus: () => input.focus(),
      // What tells it from the same field of other items, for who does not see where it stands.
      call: (label) => input.setAttribute("aria-label", label),
    };
  }

  // The names of values to choose from, beside the input that takes any.
  function choiceOf(slot, name, input) {
    const options = namesOf(slot).map((each) => make("option", { value: each }, each));
    const choice = make("select", { "aria-label": `${name} by name` },
      make("option", { value: "" }, "a number"), ...options);
    choice.addEventListener("change", () => {
      if (!choice.value) return;
      input.value = String(slot.names[choice.value]);
      input.dispatchEvent(new Event("input", { bubbles: true }));
    });
    return choice;
  }

  // A list: its items in order, each with a way to take it out, and a way to add one.
  function listOf(list) {
    const { low, high } = list.count === undefined ? kind.counts : { low: list.count, high: list.count };
    const rows = make("ol", { class: "items" });
    const problem = make("p", { class: "error", id: `field-${++fieldCount}-error` });
    const add = button("Add an item", () => {
      insert(items.length ? items[items.length - 1].read(true) : blank());
      items[items.length - 1].focus();
      changed();
    });
    const legend = make("legend", {}, list.name, " ",
      make("span", { class: "hint" }, low === high ? pluralized(low, "item") : `${low}..${high} items`));
    const fieldset = make("fieldset", { "aria-describedby": problem.id }, legend, rows,
      low === high ? null : make("div", { class: "actions" }, add), problem);
    let items = [];

    const blank = () => Object.fromEntries(list.fields.map((field) => [field.name, field.low ?? 0]));
    const asObject = (item) => (list.element === null ? { [list.fields[0].name]: item } : item);
    const asItem = (values) => (list.element === null ? values[list.fields[0].name] : values);

    function insert(values) {
      const item = {}, place = () => items.indexOf(item);
      const inputs = list.fields.map((field) => single(field, list.element === null ? list.name : field.name,
        () => pathOf(list, place(), field)));
      const remove = button("Remove", () => removeAt(place()));
      Object.assign(item, {
        inputs, remove,
        row: make("li", {}, ...inputs.map((each) => each.element), low === high ? null : remove),
        focus: () => inputs[0].focus(),
        // The values, as they are where they are to be repeated.
        read: (isLoose) => Object.fromEntries(inputs.map((each, i) => [list.fields[i].name,
          isLoose ? loosely(each, list.fields[i]) : each.read()])),
      });
      items.push(item);
      rows.append(item.row);
      inputs.forEach((each, i) => each.show(values[list.fields[i].name]));
      bound();
    }

    function loosely(each, field) {
      try {
        return each.read();
      } catch (error) {
        if (!(error instanceof Unusable)) throw error;
        return field.low ?? 0;
      }
    }

    function removeAt(index) {
      items[index].row.remove();
      items.splice(index, 1);
      bound();
      const next = items[Math.min(index, items.length - 1)];
      if (!next) add.focus();
      else if (next.remove.disabled) next.focus();
      else next.remove.focus();
      changed();
    }

    // No more can be added, or taken out, than there may be.
    function bound() {
      add.disabled = items.length >= high;
      items.forEach((item, index) => {
        item.remove.disabled = items.length <= low;
        const name = `item ${index + 1} of ${list.name}`;
        item.remove.setAttribute("aria-label", `Remove ${name}`);
        item.inputs.forEach((each, i) => each.call(`${list.fields[i].name}, ${name}`));
      });
    }

    return {
      element: fieldset,
      read: () => items.map((item) => asItem(item.read())),
      show(values) {
        const shown = values || [];
        while (items.length > shown.length) items.pop().row.remove();
        shown.forEach((value, i) => {
          if (i === items.length) return insert(asObject(value));
          return items[i].inputs.forEach((each, at) => each.show(asObject(value)[list.fields[at].name]));
        });
        bound();
      },
      mark(error) {
        const found = items.map((item) => item.inputs.map((each) => each.mark(error))).flat().includes(true);
        const isHere = !found && error !== null && error.path.split("[")[0] === list.name;
        problem.textContent = isHere ? reasonIn(error) : "";
        return found || isHere;
      },
      focus: () => (items.length ? items[0].focus() : add.focus()),
    };
  }

  // Say what is wrong, at the field where it is; null for nothing. Return whether there is one.
  function mark(error) {
    return groups.map((group) => group.mark(error)).includes(true);
  }

  function show(values) {
    kind.given.forEach((slot, i) => groups[i].show(values[slot.name] ?? null));
  }

  show(first);
  return {
    element, show, mark,
    // The values by name, as `encode` takes them. Throws what `mark` takes.
    values: () => Object.fromEntries(kind.given.map((slot, i) => [slot.name, groups[i].read()])),
    focus(path) {
      const at = kind.given.findIndex(({ name }) => path.split(/[.[]/)[0] === name);
      if (groups[Math.max(at, 0)]) groups[Math.max(at, 0)].focus();
    },
  };
}

const namesOf = ({ names = {} }) => Object.keys(names);

// Why a field is wrong, without its place, beside which it stands.
function reasonIn({ message, path }) {
  return message.startsWith(`${path}: `) ? message.slice(path.length + 2) : message;
}

// The value of one input. Text is typed as it is, and what may be absent is where nothing is typed.
function readOne(slot, path, text) {
  if (slot.role === "text" || slot.text) return text;
  if (slot.optional && !text) return null;
  if (slot.role === "counter" && !text) return 0;
  if (slot.role !== "packed") return readNumberIn(slot, path, text, 0);
  return text.split(/[\s,]+/).filter(Boolean).map((each, i) => readNumberIn(slot, `${path}[${i}]`, each, 0));
}

function writeOne(slot, value) {
  if (value === null || value === undefined) return "";
  if (Array.isArray(value)) return value.join(", ");
  if (typeof value === "string") return value;
  return writeField(slot, value);
}

// Which values a field takes.
function boundsOf(slot, kind) {
  if (slot.text) return `${slot.count ?? `${kind.counts.low}..${kind.counts.high}`} characters`;
  if (slot.role === "text") return `up to ${slot.size} characters`;
  const bounds = slot.float ? "a number" : `${slot.low}..${slot.high}`;
  if (slot.role === "packed") return `${slot.count} numbers, ${bounds}`;
  return `${bounds} ${slot.unit || ""}`.trimEnd() + (slot.optional ? ", or nothing" : "");
}

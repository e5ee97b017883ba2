// What the Python client does not send, and how it says so: values outside the limits that were chosen,
// and questions for which no reply has room.
"use strict";

// `data` is what line_data.py says. Bounds are two whole numbers of any size, or null for none.
function makeLimits({ limits, exchanges }) {
  const { usual = null, others = [], fields = {} } = limits ?? {};
  const known = (usual ? [["what is usual", usual], ...others] : [])
    .map(([name, bounds]) => ({ name, bounds: bounds.map(BigInt) }));
  const isIn = ([low, high], value) => low <= value && value <= high;
  const written = (bounds) => (bounds ? `(${bounds.join(", ")})` : "None");
  const refuse = (path, why) => { throw new Unusable(`${path}: ${why}`, { path }); };

  function wayOut(value) {
    const takers = known.filter(({ bounds }) => isIn(bounds, value))
      .map(({ name, bounds }) => `limits=${written(bounds)} is for ${name}`);
    return takers.length ? `${takers.join(", ")}, limits=None for any` : "limits=None sends anything";
  }

  function checkRoom({ message, kind, fields: values }) {
    const most = exchanges[message]?.most, size = most && values[kind.list.name].length;
    const why = `${size} items are requested at once, and a reply has room for ${most}`;
    if (size > most) refuse(kind.list.name, why);
  }

  // Throw Unusable for a message that is not sent within these bounds.
  function check(event, bounds) {
    checkRoom(event);
    for (const path of (bounds && fields[event.message]) || []) {
      const values = valuesAt(event.fields, path), place = values.findIndex((value) => !isIn(bounds, value));
      if (place < 0) continue;
      const why = `${values[place]} is outside the limits ${bounds.join("..")}; ${wayOut(values[place])}`;
      refuse(placeOf(event.kind, path, place), why);
    }
  }

  return {
    check,
    usual: known.length ? known[0].bounds : null,
    // What there is to choose from, first what is usual; nothing where nothing has limits.
    choices: (usual ? [...known, { name: "anything", bounds: null }] : []).map(({ name, bounds }) => (
      { bounds, text: `${written(bounds)}: ${name}` })),
  };
}

// The path of a value of a field: `targets[0].position`, or `time_ms`.
function placeOf({ given }, path, place) {
  const [name, inner] = path.split("."), slot = given.find((each) => each.name === name);
  return slot.role === "list" ? pathOf(slot, place, { name: inner }) : path;
}

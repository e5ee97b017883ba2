// The frame that carries some values, all of which are checked.
"use strict";

function makeEncode({ kindOf, frameWith, slotsIn, layOut, due }, { checksumOf }) {
  const refuse = (path, why) => { throw new Unusable(`${path}: ${why}`, { path }); };

  // The frame that carries `fields`, as decodeFrame gives them; a number may be given by its name.
  // Throws Unusable.
  return function encode(name, named) {
    const kind = kindOf.get(name), fields = bare(named);
    if (!kind) refuse(name, "no message has this name");
    const known = kind.given.map((slot) => slot.name);
    const strange = Object.keys(fields).find((key) => !known.includes(key));
    if (strange !== undefined) {
      refuse(strange, `no field of ${name}, which has ${known.join(", ") || "none"}`);
    }
    const values = valuesOf(kind, fields), frame = frameWith(kind, countOf(kind, fields));
    if (!frame) {
      const { low, high } = kind.counts, { name: list } = kind.list;
      refuse(list, `${fields[list].length} items is outside ${low}..${high}`);
    }
    const placed = layOut(frame), bytes = new Uint8Array(frame.size);
    for (const { path, slot, at } of placed) {
      const follows = due(slot, frame);
      const each = slot.role === "size" ? kind.list.size : 1;
      if (countsList(slot)) checked(slot.name, frame.count * each, slot);
      if (follows.length) bytes.set(follows, at);
      else if (slot.role !== "checksum") bytes.set(written(path, slot, values.get(path)), at);
    }
    for (const slot of kind.envelope.checksums) {
      const value = checksumOf(kind.envelope, slot, kind.ids, frame.size, lookAt(bytes), 0);
      bytes.set(writeNumber(slot, value), slot.at < 0 ? frame.size + slot.at : slot.at);
    }
    return bytes;
  };

  // The count that values have: of their list, or of those that may be absent.
  function countOf(kind, fields) {
    if (kind.list) return fields[kind.list.name].length;
    if (!kind.optional.length) return 0;
    const isGiven = ({ name }) => fields[name] !== null && fields[name] !== undefined;
    const given = kind.optional.filter(isGiven);
    const fitting = kind.sizes.findIndex((_, count) => {
      const there = slotsIn(frameWith(kind, count)).filter(({ slot }) => slot.optional);
      return there.length === given.length && there.every(({ slot }, i) => slot === given[i]);
    });
    if (fitting >= 0) return fitting;
    const names = given.map(({ name }) => name).join(", ") || "none of them";
    return refuse(kind.optional[0].name, `no frame has ${names} of the fields that may be absent`);
  }

  // What is given, by path.
  function valuesOf(kind, fields) {
    return new Map(kind.given.flatMap((slot) => {
      const items = slot.role === "counter" ? fields[slot.name] ?? 0 : fields[slot.name];
      if (slot.role !== "list") return [[slot.name, items]];
      if (slot.text) return [[slot.name, checkedText(slot.name, items)]];
      if (!Array.isArray(items)) refuse(slot.name, "a list is due");
      const { count = items.length } = slot;
      if (items.length !== count) refuse(slot.name, `${items.length} items, and it has ${count}`);
      return items.flatMap((item, index) => slot.fields.map((field) =>
        [pathOf(slot, index, field), slot.element === null ? item : itemIn(slot, index, item)[field.name]]));
    }));
  }

  function itemIn(list, index, item) {
    const path = `${list.name}[${index}]`, known = list.fields.map(({ name }) => name);
    if (item === null || typeof item !== "object") refuse(path, `an object of ${known.join(", ")} is due`);
    const strange = Object.keys(item).find((key) => !known.includes(key));
    if (strange !== undefined) refuse(`${path}.${strange}`, `no field of it, which has ${known.join(", ")}`);
    return item;
  }

  function written(path, slot, value) {
    if (slot.role === "text") {
      const bytes = bytesOf(checkedText(path, value));
      if (bytes.length <= slot.size) return bytes;
      refuse(path, `${bytes.length} characters, and it has room for ${slot.size}`);
    }
    if (slot.role !== "packed") return writeNumber(slot, checked(path, value, slot));
    if (!Array.isArray(value)) refuse(path, "a list is due");
    if (value.length !== slot.count) refuse(path, `${value.length} numbers, and it has ${slot.count}`);
    return writePacked(slot, value.map((each, i) => checked(`${path}[${i}]`, each, slot)));
  }

  function checkedText(path, value) {
    if (typeof value !== "string") refuse(path, "a text is due");
    const strange = [...value].find((character) => character.codePointAt(0) > 0x7f);
    if (strange) refuse(path, `“${strange}” is not ASCII`);
    return value;
  }

  function checked(path, given, slot) {
    const isName = typeof given === "string" && Object.hasOwn(slot.names, given);
    const value = isName ? slot.names[given] : given;
    if (slot.float) {
      if (typeof value !== "number") refuse(path, "a number is due");
      if (slot.size > 4 || !Number.isFinite(value) || Number.isFinite(Math.fround(value))) return value;
      refuse(path, `${value} does not fit`);
    }
    if (typeof value !== "bigint" && !Number.isInteger(value)) refuse(path, "a whole number is due");
    if (inside(slot, value)) return value;
    return refuse(path, `${value} is outside ${slot.low}..${slot.high}`);
  }
}

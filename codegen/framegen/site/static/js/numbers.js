// Numbers and text in the bytes of a slot, and back. What has more digits than a number of a browser
// is a BigInt.
"use strict";

const OF_FLOAT = new DataView(new ArrayBuffer(8));

// The number of a slot whose bytes begin at `at`.
function readNumber(slot, bytes, at) {
  const { size, float, wide, signed } = slot, isLittle = slot.order === "little";
  if (float) return readFloat(size, isLittle, bytes, at);
  if (wide) return readWide(slot, bytes, at);
  if (size === 1) return signed && bytes[at] > 127 ? bytes[at] - 256 : bytes[at];
  let value = 0;
  for (let i = 0; i < size; i++) value = value * 256 + bytes[isLittle ? at + size - 1 - i : at + i];
  return signed && value >= 2 ** (8 * size - 1) ? value - 2 ** (8 * size) : value;
}

function readFloat(size, isLittle, bytes, at) {
  for (let i = 0; i < size; i++) OF_FLOAT.setUint8(i, bytes[at + i]);
  return size === 4 ? OF_FLOAT.getFloat32(0, isLittle) : OF_FLOAT.getFloat64(0, isLittle);
}

function readWide({ size, order, signed }, bytes, at) {
  let value = 0n;
  for (let i = 0; i < size; i++) {
    value = value * 256n + BigInt(bytes[order === "little" ? at + size - 1 - i : at + i]);
  }
  return signed ? BigInt.asIntN(8 * size, value) : value;
}

// The bytes that stand for `value` in a slot.
function writeNumber({ size, order, float }, value) {
  const view = new DataView(new ArrayBuffer(8));
  if (float && size === 4) view.setFloat32(4, value);
  else if (float) view.setFloat64(0, value);
  else view.setBigInt64(0, BigInt.asIntN(64, BigInt(value)));
  const bytes = [...new Uint8Array(view.buffer)].slice(8 - size);
  return order === "little" ? bytes.reverse() : bytes;
}

// Numbers of `width` bits that stand behind each other, and back.
function readPacked({ size, order, width, count, wide }, bytes, at) {
  const whole = readWide({ size, order, signed: false }, bytes, at);
  const values = Array.from({ length: count }, (_, i) => BigInt.asUintN(width, whole >> BigInt(i * width)));
  if (order === "big") values.reverse();
  return wide ? values : values.map(Number);
}

function writePacked({ size, order, width }, values) {
  const lowestFirst = order === "big" ? [...values].reverse() : values;
  const whole = lowestFirst.reduceRight((so, value) => (so << BigInt(width)) | BigInt(value), 0n);
  const bytes = Array.from({ length: size }, (_, i) => Number((whole >> BigInt(8 * i)) & 255n));
  return order === "big" ? bytes.reverse() : bytes;
}

// Text, one byte a character, and back.
const textOf = (bytes) => Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
const bytesOf = (text) => Array.from(text, (character) => character.codePointAt(0));

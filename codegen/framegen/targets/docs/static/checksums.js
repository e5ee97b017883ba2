// Works checksums out, of any pieces of some bytes. Each byte is summed once, however many pieces it
// is in: a run of headers that all claim to be long takes no longer than the bytes that it has.
"use strict";

// What works out a checksum of `bytes`, by its method: a function of pieces, which are arrays
// `[start, end]`, or bytes that are not among these.
function makeChecksum(method, bytes) {
  switch (method.kind) {
    case "crc": return makeCrc(method, bytes);
    case "fletcher": return makeFletcher(method, bytes);
    case "xor": return makeXor(method, bytes);
    default: return makeSum(method, bytes);
  }
}

// The registers in front of each byte and behind the last, worked out as far as they are asked for.
function makeRegisters(first, bytes, next) {
  const registers = [first];
  return (at) => {
    while (registers.length <= at) {
      registers.push(next(registers.at(-1), bytes[registers.length - 1]));
    }
    return registers[at];
  };
}

const isStretch = (piece) => Array.isArray(piece);

function makeSum({ width, factor, offset }, bytes) {
  const sum = makeRegisters(0, bytes, (total, byte) => total + byte);
  return (pieces) => {
    const total = pieces.reduce((so, piece) => so + (isStretch(piece)
      ? sum(piece[1]) - sum(piece[0])
      : piece.unsent.reduce((all, byte) => all + byte, 0)), 0);
    const modulus = 2 ** width, value = (factor * total + offset) % modulus;
    return value < 0 ? value + modulus : value;
  };
}

function makeXor({ xor_out: last }, bytes) {
  const xor = makeRegisters(0, bytes, (value, byte) => value ^ byte);
  return (pieces) => pieces.reduce((value, piece) => value ^ (isStretch(piece)
    ? xor(piece[1]) ^ xor(piece[0])
    : piece.unsent.reduce((all, byte) => all ^ byte, 0)), last);
}

// Two sums: of the bytes, and of what the first one was after each.
function makeFletcher({ width, modulus, start }, bytes) {
  const next = ([first, second], byte) => [first + byte, second + first + byte];
  const sums = makeRegisters([0, 0], bytes, next);
  return (pieces) => {
    let register = [start, 0];
    for (const piece of pieces) {
      if (!isStretch(piece)) {
        register = piece.unsent.reduce(next, register);
        continue;
      }
      const [[first, second], [firstEnd, secondEnd]] = [sums(piece[0]), sums(piece[1])];
      const size = piece[1] - piece[0];
      register = [register[0] + firstEnd - first,
        register[1] + size * (register[0] - first) + secondEnd - second];
    }
    return (register[1] % modulus) * 2 ** (width / 2) + (register[0] % modulus);
  };
}

// The remainder of a division, with the lowest bit of each byte first; where the method has the
// highest first, bytes and remainder are turned round. One of 64 bits is a BigInt.
function makeCrc({ width, poly, init, xor_out: last, reflected }, bytes) {
  const isWide = width > 32, number = isWide ? BigInt : Number;
  const right = isWide ? (value, bits) => value >> BigInt(bits) : (value, bits) => value >>> bits;
  const whole = isWide ? (value) => value : (value) => value >>> 0;
  const lowest = (value) => Number(BigInt.asUintN(8, BigInt(value)));
  const turned = (value, size) => number(
    `0b${[...BigInt(value).toString(2).padStart(size, "0")].reverse().join("")}`);
  const ordered = Array.from({ length: 256 }, (_, byte) => (
    reflected ? byte : parseInt(byte.toString(2).padStart(8, "0").split("").reverse().join(""), 2)));

  // What each byte makes of a register that is zero.
  const divisor = turned(poly, width);
  const table = Array.from({ length: 256 }, (_, byte) => {
    let value = number(byte);
    for (let bit = 0; bit < 8; bit++) {
      value = lowest(value) & 1 ? whole(right(value, 1) ^ divisor) : right(value, 1);
    }
    return value;
  });
  const low = isWide ? lowest : (value) => value & 255;
  const next = (value, byte) => whole(table[low(value) ^ ordered[byte]] ^ right(value, 8));
  const registers = makeRegisters(number(0), bytes, next);

  // What 1, 2, 4, … zero bytes make of a register: a table for each byte of it.
  const powers = [];
  const mapped = (tables, value) => tables.reduce(
    (found, each, i) => whole(found ^ each[low(right(value, 8 * i))]), number(0));
  function nextPower() {
    const step = powers.length ? (value) => mapped(powers.at(-1), mapped(powers.at(-1), value))
      : (value) => next(value, 0);
    return Array.from({ length: width / 8 }, (_, i) => {
      let images = [number(0)];
      for (let bit = 0; bit < 8; bit++) {
        const image = step(number(BigInt(1) << BigInt(8 * i + bit)));
        images = [...images, ...images.map((value) => whole(value ^ image))];
      }
      return images;
    });
  }
  function afterZeros(value, count) {
    let result = value;
    for (let rest = count, i = 0; rest > 0; rest = Math.floor(rest / 2), i++) {
      if (i === powers.length) powers.push(nextPower());
      if (rest % 2) result = mapped(powers[i], result);
    }
    return result;
  }

  return (pieces) => {
    let value = turned(init, width);
    for (const piece of pieces) {
      if (isStretch(piece)) {
        // Remainders add up: what was there before the stretch is taken out again.
        const [start, end] = piece;
        value = whole(afterZeros(whole(value ^ registers(start)), end - start) ^ registers(end));
      } else {
        value = piece.unsent.reduce(next, value);
      }
    }
    return whole((reflected ? value : turned(value, width)) ^ number(last));
  };
}

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

// Sums are of numbers of `word` bytes, the low byte first, which begin where the first piece does.
// A register is what the last byte, the one before, and so on to the size of a number make, each with
// those that are a multiple of this size in front of it.
function makeWords(word, bytes, joined) {
  const first = new Array(word).fill(0);
  const next = (sums, byte) => [joined(sums.at(-1), byte), ...sums.slice(0, -1)];
  const sums = makeRegisters(first, bytes, next);
  // What the bytes of all pieces make at each place of a number.
  return (pieces, without) => {
    const places = [...first];
    let length = 0;
    const put = (found, back) => {
      const place = (((length - 1 - back) % word) + word) % word;
      places[place] = joined(places[place], found);
    };
    for (const piece of pieces) {
      if (!isStretch(piece)) {
        for (const byte of piece.unsent) {
          length++;
          put(byte, 0);
        }
        continue;
      }
      const [start, end] = piece, before = sums(start), behind = sums(end);
      length += end - start;
      behind.forEach((found, back) => {
        const there = ((back - (end - start)) % word + word) % word;
        put(without(found, before[there]), back);
      });
    }
    return places;
  };
}

function makeSum({ width, factor, offset, left_out: leftOut = 0, word = 1, carried }, bytes) {
  const modulus = 2 ** (width - leftOut), sums = makeWords(word, bytes, (one, other) => one + other);
  return (pieces) => {
    const places = sums(pieces, (behind, before) => behind - before);
    let total = places.reduce((so, sum, place) => so + sum * 256 ** place, 0);
    if (carried && total > 0) total = ((total - 1) % (modulus - 1)) + 1;
    const value = (factor * total + offset) % modulus;
    return value < 0 ? value + modulus : value;
  };
}

function makeXor({ xor_out: last, mask = 255, word = 1 }, bytes) {
  const either = (one, other) => one ^ other, places = makeWords(word, bytes, either);
  return (pieces) => (last ^ places(pieces, either).reduce(
    (value, each, place) => value ^ (each << (8 * place)), 0)) & mask;
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
function makeCrc({ width, poly, init, xor_out: last, reflected, mixed }, bytes) {
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
    return whole((reflected && !mixed ? value : turned(value, width)) ^ number(last));
  };
}

// Works checksums out, of any pieces of some bytes. Each byte is summed once, however many pieces it
// is in: a run of headers that all claim to be long takes no longer than the bytes that it has.
"use strict";

// What works out a checksum of `bytes` from `base` on, by its method: a function of pieces, which are
// arrays `[start, end]`, or bytes that are not among these.
function makeChecksum(method, bytes, base = 0) {
  switch (method.kind) {
    case "crc": return makeCrc(method, bytes, base);
    case "fletcher": return makeFletcher(method, bytes, base);
    case "xor": return makeXor(method, bytes, base);
    default: return makeSum(method, bytes, base);
  }
}

// The register in front of each byte from `base` on, worked out as far as it is asked for. What `next`
// makes of a byte depends on the register `word` bytes before.
function makeRegisters(Numbers, first, bytes, base, next, word = 1) {
  let registers = new Numbers(256).fill(first, 0, word), known = word;
  return (at) => {
    const wanted = at - base + word;
    if (wanted > registers.length) {
      const wider = new Numbers(2 * wanted);
      wider.set(registers);
      registers = wider;
    }
    for (; known < wanted; known++) {
      registers[known] = next(registers[known - word], bytes[base + known - word]);
    }
    return registers[wanted - 1];
  };
}

const isStretch = (piece) => Array.isArray(piece);

// Sums are of numbers of `word` bytes, the low byte first, which begin where the first piece does.
// A register is what the last byte, the one `word` bytes before, and so on make.
function makeWords(word, bytes, base, joined) {
  const sums = makeRegisters(Float64Array, 0, bytes, base, joined, word);
  if (word === 1) return ofBytes(sums, joined);
  // What the bytes of all pieces make at each place of a number.
  return (pieces, without) => {
    const places = new Array(word).fill(0);
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
      const [start, end] = piece;
      length += end - start;
      for (let back = 0; back < word; back++) {
        // Of those in front of the stretch, the last that counts for the same place of a number.
        const before = start - ((((start - end + back) % word) + word) % word);
        put(without(sums(end - back), sums(before)), back);
      }
    }
    return places;
  };
}

// The same where a number is a byte.
function ofBytes(sums, joined) {
  return (pieces, without) => {
    let total = 0;
    for (const piece of pieces) {
      total = joined(total, isStretch(piece) ? without(sums(piece[1]), sums(piece[0]))
        : piece.unsent.reduce(joined, 0));
    }
    return [total];
  };
}

const added = (one, other) => one + other, taken = (whole, part) => whole - part;
const either = (one, other) => one ^ other;

function makeSum({ width, factor, offset, left_out: leftOut = 0, word = 1, carried }, bytes, base) {
  const modulus = 2 ** (width - leftOut), sums = makeWords(word, bytes, base, added);
  return (pieces) => {
    let total = sums(pieces, taken).reduce((so, sum, place) => so + sum * 256 ** place, 0);
    if (carried && total > 0) total = ((total - 1) % (modulus - 1)) + 1;
    const value = (factor * total + offset) % modulus;
    return value < 0 ? value + modulus : value;
  };
}

function makeXor({ xor_out: last, mask = 255, word = 1 }, bytes, base) {
  const places = makeWords(word, bytes, base, either);
  return (pieces) => (last ^ places(pieces, either).reduce(
    (value, each, place) => value ^ (each << (8 * place)), 0)) & mask;
}

// Two sums: of the bytes, and of what the first one was after each.
function makeFletcher({ width, modulus, start }, bytes, base) {
  let sum = 0;
  const seconds = makeRegisters(Float64Array, 0, bytes, base, (so, byte) => so + (sum += byte));
  const firsts = (at) => (at > base ? seconds(at) - seconds(at - 1) : 0);
  return (pieces) => {
    let first = start, second = 0;
    for (const piece of pieces) {
      if (isStretch(piece)) {
        const [from, to] = piece, size = to - from;
        second += size * (first - firsts(from)) + seconds(to) - seconds(from);
        first += firsts(to) - firsts(from);
        continue;
      }
      for (const byte of piece.unsent) {
        first += byte;
        second += first;
      }
    }
    return (second % modulus) * 2 ** (width / 2) + (first % modulus);
  };
}

// What a CRC is worked out with, made once for each method.
const DIVISIONS = new WeakMap();

function divisionOf(method) {
  if (!DIVISIONS.has(method)) DIVISIONS.set(method, makeDivision(method));
  return DIVISIONS.get(method);
}

// The remainder of a division, with the lowest bit of each byte first; where the method has the
// highest first, bytes and remainder are turned round. One of 64 bits is a BigInt.
function makeDivision({ width, poly, reflected }) {
  const isWide = width > 32, number = isWide ? BigInt : Number;
  const right = isWide ? (value, bits) => value >> BigInt(bits) : (value, bits) => value >>> bits;
  const whole = isWide ? (value) => value : (value) => value >>> 0;
  const low = isWide ? (value) => Number(BigInt.asUintN(8, value)) : (value) => value & 255;
  const bytesTurned = Uint8Array.from({ length: 256 }, (_, byte) => (
    parseInt(byte.toString(2).padStart(8, "0").split("").reverse().join(""), 2)));
  const turned = (value) => {
    let result = number(0), rest = number(value);
    for (let bits = 0; bits < width; bits += 8) {
      result = isWide ? (result << 8n) | BigInt(bytesTurned[low(rest)])
        : ((result << 8) | bytesTurned[rest & 255]) >>> 0;
      rest = right(rest, 8);
    }
    return result;
  };

  // What each byte makes of a register that is zero.
  const divisor = turned(poly);
  const table = Array.from({ length: 256 }, (_, byte) => {
    let value = number(byte);
    for (let bit = 0; bit < 8; bit++) {
      value = low(value) & 1 ? whole(right(value, 1) ^ divisor) : right(value, 1);
    }
    return value;
  });
  const ordered = reflected ? bytesTurned.map((_, byte) => byte) : bytesTurned;
  const next = isWide ? (value, byte) => table[low(value) ^ ordered[byte]] ^ (value >> 8n)
    : (value, byte) => (table[(value & 255) ^ ordered[byte]] ^ (value >>> 8)) >>> 0;

  // What 1, 2, 4, … zero bytes make of a register: a table for each byte of it.
  const powers = [];
  function mapped(tables, value) {
    let found = number(0);
    for (let i = 0; i < tables.length; i++) found = whole(found ^ tables[i][low(right(value, 8 * i))]);
    return found;
  }
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

  return { isWide, number, whole, turned, next, afterZeros };
}

function makeCrc(method, bytes, base) {
  const { isWide, number, whole, turned, next, afterZeros } = divisionOf(method);
  const Registers = isWide ? BigUint64Array : Uint32Array;
  const registers = makeRegisters(Registers, number(0), bytes, base, next);
  const begun = turned(method.init), last = number(method.xor_out);
  const isTurned = method.reflected && !method.mixed;
  return (pieces) => {
    let value = begun;
    for (const piece of pieces) {
      if (isStretch(piece)) {
        // Remainders add up: what was there before the stretch is taken out again.
        const [start, end] = piece;
        value = whole(afterZeros(whole(value ^ registers(start)), end - start) ^ registers(end));
      } else {
        value = piece.unsent.reduce(next, value);
      }
    }
    return whole((isTurned ? value : turned(value)) ^ last);
  };
}

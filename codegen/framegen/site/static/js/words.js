// Values as people say them, in the words of `framegen explain`: `7500 mV = 7.500 V`, `0 (unlimited)`.
"use strict";

// A number that is not whole, as Python writes it: `1.0`, `1e-05`, `-0.0`.
function floatInWords(value) {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value < 0 ? "-inf" : "inf";
  const sign = value < 0 || Object.is(value, -0) ? "-" : "";
  const [, first, rest = "", power] = /^(\d)(?:\.(\d+))?e([-+]\d+)$/.exec(Math.abs(value).toExponential());
  const digits = first + rest, point = Number(power) + 1;
  if (point < -3 || point > 16) {
    const size = String(Math.abs(power)).padStart(2, "0");
    return `${sign}${first}${rest && `.${rest}`}e${power < 0 ? "-" : "+"}${size}`;
  }
  if (point <= 0) return `${sign}0.${"0".repeat(-point)}${digits}`;
  return `${sign}${digits.slice(0, point).padEnd(point, "0")}.${digits.slice(point) || "0"}`;
}

// A number with a point as a whole number of steps: `7.500` is 7500 of ten to the power of -3.
function decimal(text) {
  const [, sign, before, after = "", power = "0"] = /^(-?)(\d+)(?:\.(\d+))?(?:e([-+]\d+))?$/.exec(text);
  return { negative: sign === "-", digits: BigInt(before + after), power: Number(power) - after.length };
}

// So many digits are exact in the sum of a scale; none of a whole number is rounded.
const DIGITS = 64;

function decimalInWords({ negative, digits, power }) {
  let whole = String(digits), zeros = power;
  if (whole.length > DIGITS) {
    const over = whole.length - DIGITS, unit = 10n ** BigInt(over), rest = digits % unit;
    const isUp = rest * 2n > unit || (rest * 2n === unit && (digits / unit) % 2n === 1n);
    whole = String(digits / unit + (isUp ? 1n : 0n));
    zeros += over;
  }
  if (zeros >= 0) return `${negative ? "-" : ""}${digits ? whole + "0".repeat(zeros) : "0"}`;
  const shown = whole.padStart(1 - zeros, "0"), point = shown.length + zeros;
  return `${negative ? "-" : ""}${shown.slice(0, point)}.${shown.slice(point)}`;
}

// A value in its larger unit, exactly: 7500 steps of 0.001 V are 7.500 V.
function scaled(value, { step, unit, offset }, isFloat = false) {
  if (typeof value === "number" && !Number.isFinite(value)) {
    const sign = (value < 0) === step.startsWith("-") ? "" : "-";
    return `${Number.isNaN(value) ? "NaN" : `${sign}Infinity`} ${unit}`.trimEnd();
  }
  const one = decimal(numberInWords(value, isFloat)), other = decimal(step);
  const product = { negative: one.negative !== other.negative, digits: one.digits * other.digits,
    power: one.power + other.power };
  return `${decimalInWords(offset ? sum(product, decimal(offset)) : product)} ${unit}`.trimEnd();
}

function sum(one, other) {
  const power = Math.min(one.power, other.power);
  const steps = ({ negative, digits, power: own }) => (
    (negative ? -digits : digits) * 10n ** BigInt(own - power));
  const total = steps(one) + steps(other);
  const negative = total < 0n || (!total && one.negative && other.negative);
  return { negative, digits: total < 0n ? -total : total, power };
}

// A number by itself; one of a slot of floating point is `isFloat`, whatever it is.
function numberInWords(value, isFloat = typeof value === "number" && !Number.isInteger(value)) {
  return isFloat || Object.is(value, -0) ? floatInWords(value) : String(value);
}

// The named bits of a number that are set, those of several bits with their value.
function setBits(value, bits) {
  return Object.entries(bits).flatMap(([name, [low, high]]) => {
    const found = BigInt.asUintN(high - low + 1, BigInt(value) >> BigInt(low));
    return found ? [low === high ? name : `${name} ${found}`] : [];
  });
}

// The name of a value; undefined where it has none.
function nameOf({ names = {} }, value) {
  return Object.keys(names).find((name) => (typeof value === "bigint"
    ? BigInt(names[name]) === value : Number(names[name]) === value));
}

// Text in quotes, as Python writes it.
function quoted(text) {
  const quote = text.includes("'") && !text.includes('"') ? '"' : "'";
  const known = { "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t", [quote]: `\\${quote}` };
  const shown = text.replace(/[\\\n\r\t'"]|[^ -~]/g, (character) => (character === "'" || character === '"'
    ? known[character] || character
    : known[character] || `\\x${character.charCodeAt(0).toString(16).padStart(2, "0")}`));
  return quote + shown + quote;
}

// A value with its unit, in its larger unit and by its name. An empty text where there is none.
function inWords(slot, value) {
  if (value === null) return "";
  if (typeof value === "string") return quoted(value);
  if (Array.isArray(value)) return value.join(" ");
  const text = `${numberInWords(value, slot.float)} ${slot.unit || ""}`.trimEnd();
  const larger = slot.scale ? ` = ${scaled(value, slot.scale, slot.float)}` : "";
  const set = slot.bits ? setBits(value, slot.bits).join(", ") : "", name = nameOf(slot, value);
  return text + larger + (set && ` (${set})`) + (name === undefined ? "" : ` (${name})`);
}

// What a value means: what is said of its name, or else of its slot.
function meaningOf(slot, value) {
  const name = value === null ? undefined : nameOf(slot, value);
  return (name !== undefined && slot.meanings?.[name]) || slot.about || "";
}

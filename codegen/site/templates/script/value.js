// Values of a row: conversion between texts, raw values and physical values. A raw value is a BigInt with the bits of the type.

// Returns the type of a row: its number of bits, and whether it is signed or a real number. Returns nothing for other types.
function typeOf(row) {
  const name = row.rows[0].cells[2].textContent;
  if (name === "BOOLEAN") return { bits: 1 };
  const [, kind, bits] = name.match(/^(UNSIGNED|INTEGER|REAL)(\d+)$/) ?? [];
  return kind && { bits: Number(bits), isSigned: kind === "INTEGER", isReal: kind === "REAL" };
}

const realBytes = new DataView(new ArrayBuffer(8));
const realFrom = ({ bits }, raw) => {
  realBytes.setBigUint64(0, raw << BigInt(64 - bits));
  return bits === 32 ? realBytes.getFloat32(0) : realBytes.getFloat64(0);
};
const rawOfReal = ({ bits }, number) => {
  if (bits === 32) realBytes.setFloat32(0, number); else realBytes.setFloat64(0, number);
  return realBytes.getBigUint64(0) >> BigInt(64 - bits);
};

// Parses `-5`, `0x1237`, `1237h`, `0b1010`, and numbers with a decimal point if the type is real. Returns nothing if the text is no
// number or does not fit into the type.
function rawFrom(text, type) {
  const plainText = text.trim().replace(/[_\s]/g, "").replace("−", "-");
  const [, sign, hex, suffixed, binary, decimal] = /^(-?)(?:0x([0-9a-f]+)|([0-9a-f]+)h|0b([01]+)|([0-9]+))$/i.exec(plainText) ?? [];
  if (type.isReal && (decimal || sign === undefined)) {
    const number = Number(plainText);
    return plainText === "" || Number.isNaN(number) ? undefined : rawOfReal(type, number);
  }
  if (sign === undefined) return undefined;
  const magnitude = BigInt(hex ?? suffixed ? "0x" + (hex ?? suffixed) : binary ? "0b" + binary : decimal);
  const number = sign ? -magnitude : magnitude, count = 1n << BigInt(type.bits);
  return number < count && number >= -count / 2n ? BigInt.asUintN(type.bits, number) : undefined;
}

// Returns the number of a raw value, with its sign.
const numberOf = (type, raw) => type.isReal ? realFrom(type, raw) : type.isSigned ? BigInt.asIntN(type.bits, raw) : raw;

const hex = (number, digits) => number.toString(16).toUpperCase().padStart(digits, "0");
const hexOf = (type, raw) => "0x" + hex(raw, Math.ceil(type.bits / 4));

// Returns the scale of a row: functions from numbers to physical values and back. Returns nothing if there is none.
function scaleOf(row) {
  const text = row.dataset.scale;
  if (!text) return undefined;
  if (text.startsWith("/")) {
    const numerator = Number(text.slice(1));
    return { physical: (number) => numerator / number, number: (physical) => numerator / physical };
  }
  const [factor, offset] = text.split(" ").map(Number);
  return { physical: (number) => number * factor + offset, number: (physical) => (physical - offset) / factor };
}

// Returns the raw value of a physical value, rounded to the resolution. Returns nothing if it does not fit into the type.
function rawOfPhysical(scale, type, text) {
  const number = scale.number(Number(text.trim().replace("−", "-").replace(",", ".")));
  if (text.trim() === "" || !Number.isFinite(number)) return undefined;
  return type.isReal ? rawOfReal(type, number) : rawFrom(String(BigInt(Math.round(number))), type);
}

// Returns whether a number can be written to the item of a row, according to its range.
function isInRange(row, number) {
  const ranges = (row.dataset.range ?? "").split(" ").filter(Boolean).map((range) => range.split(".."));
  return !ranges.length || ranges.some(([low, high]) => (low === "" || Number(low) <= Number(number)) && (high === "" || Number(number) <= Number(high)));
}

// Removes the rounding errors of a floating-point number.
const shortNumber = (number) => String(Number(number.toPrecision(12)));

// The named values of a list. A term is a number or a range: `3`, `4 to 7`, `256 (0x100)`.
function labelsOf(list) {
  return [...list?.querySelectorAll(":scope > dt") ?? []].map((term) => {
    const [first, last] = term.textContent.replace(/ \(0x[0-9A-F]+\)/g, "").split(" to ").map(BigInt);
    return { first, last: last ?? first, term, text: term.nextElementSibling.querySelector("b")?.textContent ?? "" };
  });
}

// Numbers as they are written in a scene, and their changes.

// The parts of a line of a scene: comments, headers of tables, strings, numbers, and anything else.
const PART = /(?<comment>#.*)|(?<table>^\s*\[\[?[^\]]*\]\]?)|(?<string>"(?:[^"\\]|\\.)*"?|'[^']*'?)|(?<number>(?<![\w.+-])[+-]?\d[\d_]*(?:\.\d+)?(?:[eE][+-]?\d+)?(?![\w.]))|(?<other>[\w.-]+|\s+|.)/gu;

// The parts of a line, each with its kind, its text and its place in the line.
export function parts(line) {
  return [...line.matchAll(PART)].map((found) => {
    const [kind] = Object.entries(found.groups).find(([, text]) => text !== undefined);
    return { kind, text: found[0], at: found.index };
  });
}

// The step by which a number changes: one in its second digit, so that a drag of a hand's width changes the number by
// its own size.
export function stepOf(value, whole, written = "") {
  if (whole) return 1;
  if (value !== 0) return 10 ** (Math.floor(Math.log10(Math.abs(value)) + 1e-9) - 1);
  return 10 ** -Math.max(decimals(written), 1);
}

// The range in which values of a number are tried: from zero to twice the number, or a hundred steps to both sides of
// zero.
export function rangeOf({ value, whole, least, written }) {
  const size = value === 0 ? 100 * stepOf(value, whole, written) : Math.abs(value);
  return [Math.max(value - size, least ?? -Infinity), value + size];
}

// A value in the format of a written number: with its decimals, or more if the step needs them, and its exponent.
export function writtenAs(value, written, step, whole) {
  if (whole) return String(Math.round(value));
  const shown = Math.max(decimals(written), Math.round(-Math.log10(step)), 0);
  if (/e/i.test(written)) return String(Number(value.toPrecision(3)).toExponential()).replace("e+", "e");
  const text = value.toFixed(Math.min(shown, 12));
  return Number(text) === 0 ? text.replace("-", "") : text;
}

function decimals(written) {
  return (written.split(/e/i)[0].split(".")[1] ?? "").length;
}

// A text with other numbers at some places: each `{ from, to, text }`.
export function replaced(text, changes) {
  const sorted = [...changes].sort((a, b) => b.from - a.from);
  return sorted.reduce((all, { from, to, text: piece }) => all.slice(0, from) + piece + all.slice(to), text);
}

// Numbers for people, and the marks of axes.

const MINUS = "\u2212";

/** Return a number with so many significant digits, and a true minus sign. */
function number(value, digits = 4) {
  if (Number.isNaN(value)) return "\u2013";
  if (!Number.isFinite(value)) return value < 0 ? `${MINUS}\u221e` : "\u221e";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const short = Number(value.toPrecision(digits));
  const text = size < 1e-4 || size >= 1e6 ? short.toExponential() : String(short);
  return text.replace("e+", "e").replace(/-/g, MINUS);
}

/** Return a number with its unit; a pure number shows none. */
function withUnit(value, unit, digits = 4) {
  const bare = unit === "" || unit === "1" || Number.isNaN(value);
  return number(value, digits) + (bare ? "" : `\u00a0${unit}`);
}

/** Return what stands before a value of a line: \u2248 where samples around it are left out. */
function nearly(line, time) {
  return line && line.isNear(time) ? "\u2248" : "";
}

/** Return a time with as many decimals as tell one scan from the next. */
function seconds(time, scan) {
  const decimals = Math.min(Math.max(Math.ceil(-Math.log10(scan) - 1e-9), 0), 6);
  const more = Math.abs(scan * 10 ** decimals - Math.round(scan * 10 ** decimals)) > 1e-6 ? 1 : 0;
  return time.toFixed(decimals + more).replace("-", MINUS);
}

const ROUNDING = 1e-12; // what numbers differ by less than this part of them is rounding

const HUGE = Number.MAX_VALUE / 8; // the end of any axis, so that its length is a number

/** Return whether two numbers are one, but for a part of the larger. */
const isOne = (low, high, part = ROUNDING) => !(high - low > part * Math.max(Math.abs(low), Math.abs(high)));

/** Return at most so many round places from `low` to `high`, each with its label; none where they are one. */
function marks(low, high, most) {
  const span = high - low;
  if (isOne(low, high) || !Number.isFinite(span)) return [];
  const rough = span / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => span / each <= most) || 10 * power;
  if (!(step > 0)) return []; // a span that numbers can hardly tell from nothing
  const [first, last] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
  const found = [];
  // Counted from 0: of whole numbers beyond 2 ** 53, the next is the same.
  for (let k = 0; k <= last - first; k++) found.push((first + k) * step);
  const size = Math.max(Math.abs(low), Math.abs(high));
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const digits = Math.max(4, Math.ceil(Math.log10(size / step)) + 1); // as tell one from the next
  const label = (at) => (size >= 1e6 || decimals > 5 ? number(at, digits) : at.toFixed(decimals).replace("-", MINUS));
  return found.map((at) => ({ at, label: Math.abs(at) < step * 1e-9 ? "0" : label(at) }));
}

/** Return a number within bounds. */
const clamped = (value, low, high) => Math.min(Math.max(value, low), high);

// Packs of numbers, as pack.py writes them.

/** Return the document of a pack, and what gives its numbers. */
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const document_ = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const body = bytes.subarray(4 + length);
  const known = new Map();
  return {
    document: document_,
    series(number) {
      if (!known.has(number)) known.set(number, decoded(body, document_.series[number]));
      return known.get(number);
    },
    /** Return the times in seconds of a run's samples: one array for all runs that have the same steps. */
    times(told) {
      const key = `${told.begin} ${told.folded}`;
      if (!known.has(key)) known.set(key, unevenTimes(body, told));
      return known.get(key);
    },
    plain: ([begin, count]) => body.subarray(begin, begin + count),
  };
}

const STEPS = 0xfffe;
const NONE = 0xffff;

/** Return the values of a series, NaN where one is not finite, and which samples they are (null: every one). */
function decoded(body, made) {
  if (made.constant !== undefined) return { constant: made.constant };
  const { begin, count, low, high } = made;
  const kept = made.thinned ? unfolded(body, begin, count, false) : null;
  const steps = unfolded(body, begin + (made.thinned ? 2 * count : 0), count, true);
  const value = (part) => (1 - part) * low + part * high;
  const values = Float64Array.from(steps, (step) => (step === NONE ? NaN : value(step / STEPS)));
  return { kept, values, grain: high / STEPS - low / STEPS };
}

/** Return sums of differences that were folded to be positive; of 16 bits, or as many as they need. */
function unfolded(body, begin, count, wraps) {
  const sums = new Uint32Array(count);
  let sum = 0;
  for (let i = 0; i < count; i++) {
    const positive = body[begin + i] | (body[begin + count + i] << 8);
    sum += positive & 1 ? -((positive + 1) >> 1) : positive >> 1;
    sums[i] = wraps ? sum & 0xffff : sum;
  }
  return sums;
}

/** Return times that go on by steps of which each may be longer or shorter, as Pack.times() writes them. */
function unevenTimes(body, { begin, step, count, grain, folded: [first, length] }) {
  const times = new Float64Array(count);
  const steps = count - 1;
  let time = begin;
  for (let i = 0; i < count; i++) {
    times[i] = time / 1e9;
    let positive = 0;
    for (let at = first + length - steps + i; i < steps && at >= first; at -= steps) positive = 256 * positive + body[at];
    time += step + grain * (positive % 2 ? -(positive + 1) / 2 : positive / 2);
  }
  return times;
}

/** Return the times in seconds of a run's samples. */
function clockOf(time, pack) {
  if (time.folded === undefined) return { count: time.count, at: (index) => (time.begin + index * time.step) / 1e9 };
  const times = pack.times(time);
  return { count: time.count, at: (index) => times[index] };
}

/** A line through samples: what was kept of a signal. Times rise; `isThinned` where samples are left out. */
class Line {
  constructor(clock, series) {
    const constant = series.constant !== undefined;
    const ends = clock.count > 1 ? [0, clock.count - 1] : [0].slice(0, clock.count);
    const kept = constant ? ends : series.kept || Array.from({ length: clock.count }, (_, index) => index);
    this.times = Float64Array.from(kept, (index) => clock.at(index));
    this.values = constant ? new Float64Array(kept.length).fill(series.constant) : series.values;
    this.isThinned = !constant && series.kept !== null;
    this.grain = constant ? 0 : series.grain;
  }

  /** Return the index of the last sample that is not later than a time, −1 before the first. */
  indexAt(time) {
    let low = 0;
    let high = this.times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= time + 1e-9) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** Return the value at a time, on the line between samples; NaN outside of the run. Less than a step is 0. */
  at(time) {
    const value = this.valueAt(time);
    return Math.abs(value) <= this.grain ? 0 : value;
  }

  valueAt(time) {
    const index = this.indexAt(time);
    const last = this.times.length - 1;
    if (index < 0 || (index === last && time > this.times[last] + 1e-6)) return NaN;
    if (index === last || time - this.times[index] < 1e-9) return this.values[index];
    const part = (time - this.times[index]) / (this.times[index + 1] - this.times[index]);
    const [here, next] = [this.values[index], this.values[index + 1]];
    const between = here + part * (next - here);
    return Number.isFinite(between) ? between : (1 - part) * here + part * next; // the way is longer than a number
  }

  /** Return whether a time lies between samples of which some are left out. */
  isNear(time) {
    const index = this.indexAt(time);
    const isWithin = index >= 0 && index < this.times.length - 1;
    return this.isThinned && isWithin && Math.abs(this.times[index] - time) > 1e-9;
  }

  /** Return the least and the largest value from a time to another; Infinity and −Infinity where there is none. */
  extent(from, to) {
    let low = Infinity;
    let high = -Infinity;
    const take = (value) => {
      if (value < low) low = value;
      if (value > high) high = value;
    };
    for (let i = Math.max(this.indexAt(from), 0); i < this.times.length && this.times[i] <= to; i++) {
      if (this.times[i] >= from) take(this.values[i]);
    }
    take(this.at(from));
    take(this.at(to));
    return [low, high];
  }
}

// The plant as a drawing, moved, filled and coloured by its signals.

/** What a signal was when so much less of a flow had gone by. */
class Delay {
  constructor(flow, line) {
    this.line = line;
    this.times = flow.times;
    this.gone = new Float64Array(flow.times.length);
    for (let i = 1; i < this.gone.length; i++) {
      this.gone[i] = this.gone[i - 1] + 0.5 * (flow.times[i] - flow.times[i - 1]) * (flow.values[i] + flow.values[i - 1]);
    }
  }

  at(time, amount) {
    const wanted = between(this.times, this.gone, time) - amount;
    return this.line.at(Math.max(between(this.gone, this.times, wanted), this.line.times[0]));
  }
}

/** Return the value at a place of a line through points whose places rise, that of its ends beyond them. */
function between(places, values, place) {
  let low = 0;
  let high = places.length - 1;
  if (!(place > places[low])) return values[low];
  if (place >= places[high]) return values[high];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (places[middle] <= place) low = middle;
    else high = middle;
  }
  const part = (place - places[low]) / (places[high] - places[low] || 1);
  return values[low] + part * (values[high] - values[low]);
}

/** Return the colour of a part, 0 to 1, of the way from the first to the last of colours (#rrggbb). */
function mixed(colours, part) {
  const place = clamped(part, 0, 1) * (colours.length - 1);
  const [from, to] = [Math.floor(place), Math.ceil(place)].map((each) => colours[each].match(/\w\w/g).map((pair) => parseInt(pair, 16)));
  return `rgb(${from.map((each, at) => Math.round(each + (place % 1) * (to[at] - each))).join(" ")})`;
}

/** A drawing whose groups are moved, turned and grown, and whose pieces are coloured, by signals of a run. */
class Sketch {
  constructor(told, run) {
    this.run = run;
    this.told = told;
    this.moved = [];
    this.coloured = [];
    this.delays = new Map();
    const [left, foot] = told.low;
    const [right, top] = told.high;
    const parts = svg("g", { transform: "scale(1 -1)" }, told.parts.map((part) => this.part(part)));
    const size = Math.max((right - left) / 32, (top - foot) / 20);
    this.readings = told.readings.map((reading) => {
      const [x, y] = reading.at;
      const text = svg("text", { x, y: 0.35 * size - y, "font-size": size, class: reading.on ? "on" : "" });
      return { text, told: reading };
    });
    const low = foot - (told.hasScale ? 2.4 * size : 0); // the ruler stands below all else
    const ruler = told.hasScale ? this.ruler(left, right, low, top) : [];
    const box = `${left} ${-top} ${right - left} ${top - low}`;
    this.picture = svg("svg", { viewBox: box, role: "img" }, parts, ...ruler, this.readings.map(({ text }) => text));
    this.element = html("figure", { class: "sketch" }, this.picture, html("figcaption", { class: "note" }, told.about));
  }

  part(told) {
    if (told.points) {
      const path = `M${told.points.map((point) => point.join(" ")).join("L")}${told.closed ? "Z" : ""}`;
      const piece = svg("path", { d: path, class: `piece ${told.role}` });
      if (told.tint || told.paint) this.coloured.push({ piece, told });
      return piece;
    }
    const group = svg("g", {}, told.parts.map((part) => this.part(part)));
    this.moved.push({ group, told });
    return group;
  }

  /** Return a length of a round number of metres, drawn at the foot. */
  ruler(left, right, foot, top) {
    const length = marks(0, (right - left) / 3, 2).at(-1);
    if (!length || !(length.at > 0)) return [];
    const size = Math.max((right - left) / 40, (top - foot) / 25);
    const at = [right - length.at - size, -foot - size];
    const line = svg("path", { class: "ruler", d: `M${at[0]} ${at[1] - size / 2}v${size / 2}h${length.at}v${-size / 2}` });
    const text = svg("text", { x: at[0] + length.at / 2, y: at[1] - 0.75 * size, "font-size": 1.15 * size }, `${length.label} m`);
    return [line, text];
  }

  /** Return what an amount is at a time; of a run that has ended, what it was then. */
  value(told, time) {
    const line = this.run.line(told.signal);
    if (!line) return NaN;
    const at = Math.min(time, line.times[line.times.length - 1]);
    if (told.flow === undefined) return line.at(at) * (told.factor === undefined ? 1 : told.factor);
    if (!this.delays.has(told.signal)) this.delays.set(told.signal, new Delay(this.run.line(told.flow), line));
    return this.delays.get(told.signal).at(at, told.amount);
  }

  /** Return a signal's value with its unit. */
  reading(signal, time) {
    return nearly(this.run.line(signal), time) + withUnit(this.value({ signal }, time), this.run.unit(signal));
  }

  point(state) {
    const value = (told) => this.value(told, state.at);
    for (const { group, told } of this.moved) {
      const moves = [];
      const across = (told.across ? value(told.across) || 0 : 0) + told.at[0];
      if (told.across || told.at.some(Boolean)) moves.push(`translate(${across} ${told.at[1]})`);
      if (told.turn) moves.push(`rotate(${value(told.turn) || 0})`);
      if (told.grow) moves.push(`scale(${Math.max(value(told.grow) || 0, 0)})`);
      if (told.rise) moves.push(`scale(1 ${value(told.rise) || 0})`);
      group.setAttribute("transform", moves.join(" "));
    }
    for (const { piece, told } of this.coloured) piece.style.fill = this.colour(told, value);
    for (const { text, told } of this.readings) {
      say(text, `${told.word} ${this.reading(told.signal, state.at)}`.trim());
    }
    describe(this.picture, `${this.told.about} At ${seconds(state.at, this.run.told.scan)} s: ${this.words(state.at)}.`);
  }

  colour(told, value) {
    if (told.paint) {
      const parts = told.paint.map(value);
      return parts.every(Number.isFinite) ? `rgb(${parts.map((each) => Math.round(clamped(each, 0, 255))).join(" ")})` : "";
    }
    const part = (value(told.tint.value) - told.tint.low) / (told.tint.high - told.tint.low || 1);
    return Number.isNaN(part) ? "" : mixed(this.told.warmth, part);
  }

  /** Return the signals that move the drawing or are read on it, with their values. */
  words(time) {
    const motions = this.moved.flatMap(({ told }) => [told.across, told.turn, told.grow, told.rise]).filter(Boolean);
    const signals = [...new Set([...motions, ...this.told.readings].map(({ signal }) => signal))];
    return signals.map((signal) => `${signal} ${this.reading(signal, time)}`).join(", ");
  }
}

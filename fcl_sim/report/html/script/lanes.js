// One axis over time: a signal of all runs against what is asked of it.

const WIDE = 1000;
const FAR = 1.5;
const ROOM = 0.08;
const STILL = 1e-6; // what moves by less than this part of its value is at rest, as on paper
const MOST_NAMED = 8;
const BAR = 3; // from one bar of violations to the next, in pixels
const MOST_BARS = 0.3; // what they take of a lane, at most
const INSTANT = 0.03; // the part of the window that a band takes at least
const LETTERS = 0.95; // height of a label, in the unit of the heights in page.css

/** Put the two labels that lie closest together into one. */
function joinNearest(labels) {
  const gaps = labels.slice(1).map((each, i) => each.part - labels[i].part);
  const at = gaps.indexOf(Math.min(...gaps));
  labels[at].text += `, ${labels[at + 1].text}`;
  labels.splice(at + 1, 1);
}

/** Return marks, more than were wanted where there would be one alone. */
function atLeastTwo(low, high, most) {
  const found = marks(low, high, most);
  return found.length > 1 ? found : marks(low, high, 2 * most);
}

/** A lane is drawn on a plane of its own, WIDE each way, once it is seen; what of it is seen is its view box. */
class Lane {
  constructor(scenario, told) {
    this.scenario = scenario;
    this.told = told;
    this.readings = html("span", { class: "readings" });
    this.up = html("div", { class: "lane-up", "aria-hidden": "true" });
    this.labels = html("div", { class: "lane-labels", "aria-hidden": "true" });
    this.plot = html("div", { class: "lane-plot" });
    const body = html("div", { class: "lane-body" }, this.up, this.plot, this.labels);
    this.element = html("div", { class: told.judged ? "lane judged" : "lane" }, this.head(), body);
  }

  head() {
    const { names, unit, focus } = this.told;
    const [first, ...others] = names;
    const more = focus ? "close to its bounds" : others.map((name) => `= ${name}`).join(" ");
    return html(
      "div",
      { class: "lane-head" },
      html("span", { class: "lane-name" }, first, html("span", { class: "unit" }, ` [${unit || "1"}]`)),
      more ? html("span", { class: "faint" }, more) : null,
      this.readings,
    );
  }

  /** Draw what stays as it is: the lines of all runs, and what is asked of them. */
  ink() {
    const { scenario, told } = this;
    this.lines = scenario.runs.map((run) => run.line(told.signal));
    this.older = scenario.older.map((run) => run.line(told.signal));
    this.whole = told.focus || this.extent([...this.lines, ...this.older].filter(Boolean));
    this.grid = svg("path", { class: "grid" });
    this.groups = this.lines.map((line, index) => this.run(line, `run ${look(index)}`));
    this.olderGroups = this.older.map((line, i) => this.run(line, this.olderLook(i)));
    this.allowed = told.allowed.map((band) => this.area(band));
    this.bands = told.bands.map((band) => this.bounds(band));
    this.shades = svg("g", { class: "shades" });
    this.picture = svg(
      "svg",
      { preserveAspectRatio: "none", role: "img" },
      this.grid,
      this.allowed.map(({ area }) => area),
      told.corridors.map((corridor) => this.corridor(corridor)),
      this.shades,
      this.bands.map(({ edges }) => edges),
      this.olderGroups,
      [...this.groups].reverse(),
    );
    this.under = html("div", { class: "under" });
    this.over = html("div", { class: "over" });
    this.idle = svg("svg", { class: "idle", preserveAspectRatio: "none", "aria-hidden": "true" }, svg("path"));
    this.cursor = html("div", { class: "cursor" });
    this.dots = this.lines.map((_, index) => html("i", { class: `dot ${look(index)}` }));
    this.plot.replaceChildren(this.under, this.picture, this.over, this.idle, this.cursor, ...this.dots);
  }

  /** Return how a run of the older version looks: in the colour of that which takes its place. */
  olderLook(index) {
    const { mark } = this.scenario.older[index];
    return mark < 0 ? "older" : `older run-${mark % 7}`;
  }

  extent(lines) {
    const extents = lines.map((line) => line.extent(0, this.scenario.end));
    const low = Math.min(...extents.map((each) => each[0]));
    const high = Math.max(...extents.map((each) => each[1]));
    if (!(high >= low)) return [0, 1];
    const around = isOne(low, high, STILL) ? Math.max(1, Math.abs(low)) : 0;
    return [clamped(low - around, -HUGE, HUGE), clamped(high + around, -HUGE, HUGE)];
  }

  across(time) {
    return (WIDE * time) / this.scenario.end;
  }

  down(value) {
    const [low, high] = this.whole;
    return clamped(WIDE * ((high - value) / (high - low)), -1e6, 1e6);
  }

  run(line, kind) {
    const path = line ? this.path(line) : "";
    return svg("g", { class: kind }, svg("path", { d: path, class: "line" }));
  }

  path(line) {
    let path = "";
    let pen = "M";
    for (let i = 0; i < line.times.length; i++) {
      if (Number.isNaN(line.values[i])) {
        pen = "M";
        continue;
      }
      path += `${pen}${this.across(line.times[i]).toFixed(3)} ${this.down(line.values[i]).toFixed(3)}`;
      pen = "L";
    }
    return path;
  }

  /** Return what is allowed in a stretch of time. */
  area(band) {
    const top = band.high === null ? -1e6 : this.down(band.high);
    const foot = band.low === null ? 1e6 : this.down(band.low);
    return { told: band, area: svg("rect", { class: "area", y: top, height: Math.max(foot - top, 0) }) };
  }

  bounds(band) {
    const at = [band.low, band.high].filter((each) => each !== null).map((each) => this.down(each));
    return { told: band, at, edges: svg("path", { class: "bound" }) };
  }

  /** Return from when to when a band is drawn: one of an instant is made as wide as is seen, and ends there. */
  seen({ from, to }, [begin, end]) {
    const least = INSTANT * (end - begin);
    if (to - from >= least || to < begin || from > end) return [from, to];
    const start = Math.min(Math.max(to - least, begin), end - least);
    return [start, start + least];
  }

  /** Draw every band as wide as it is seen in a window of time. */
  widen(window) {
    for (const { told, area } of this.allowed) {
      const [left, right] = this.seen(told, window).map((time) => this.across(time));
      area.setAttribute("x", left);
      area.setAttribute("width", Math.max(right - left, 0));
    }
    for (const { told, at, edges } of this.bands) {
      const [left, right] = this.seen(told, window).map((time) => this.across(time));
      edges.setAttribute("d", at.map((edge) => `M${left} ${edge}H${right}`).join(""));
    }
  }

  /** Return the paths of a corridor: what it allows, and its edges. One is there between two rows that both have it. */
  walls({ time, low, high }) {
    const [allowed, edges] = [[], { low: "", high: "" }];
    const isThere = (values, i) => i >= 0 && values[i] !== null && values[i + 1] !== null;
    const side = (values, i, none) =>
      [i, i + 1].map((row) => `${this.across(time[row])} ${isThere(values, i) ? this.down(values[row]) : none}`);
    for (let i = 0; i + 1 < time.length; i++) {
      const [foot, top] = [side(low, i, 1e6), side(high, i, -1e6)];
      if (isThere(low, i) || isThere(high, i)) allowed.push(`M${[...foot, top[1], top[0]].join("L")}Z`);
      for (const [name, values, [from, to]] of [["low", low, foot], ["high", high, top]]) {
        if (isThere(values, i)) edges[name] += isThere(values, i - 1) ? `L${to}` : `M${from}L${to}`;
      }
    }
    return { allowed: allowed.join(""), edges: edges.low + edges.high };
  }

  corridor(told) {
    const { allowed, edges } = this.walls(told);
    return svg("g", { class: "band" }, svg("path", { class: "area", d: allowed }), svg("path", { d: edges }));
  }

  /** Draw what depends on the window of time and on the runs that are shown. */
  draw(state) {
    if (!this.picture) this.ink();
    const [from, to] = state.window;
    const isShown = (index) => state.shown.has(index) && this.lines[index];
    this.groups.forEach((group, index) => group.classList.toggle("off", !isShown(index)));
    this.groups.forEach((group, index) => group.classList.toggle("chosen", index === state.chosen));
    this.olderGroups.forEach((group, i) => group.classList.toggle("off", !state.shown.has(this.scenario.older[i].mark)));
    [this.low, this.high] = this.limits(state, isShown);
    this.missed = this.told.focus ? [] : this.scenario.runs.map((_, index) => index).filter((index) => isShown(index) && this.broken(index).length);
    const strip = Math.min((BAR * (this.missed.length + 0.5)) / (this.told.judged ? 104 : 64), MOST_BARS);
    if (this.missed.length) this.high += ((this.high - this.low) * strip) / (1 - strip);
    this.strip = strip;
    const [top, foot] = [this.down(this.high), this.down(this.low)];
    const [left, right] = [this.across(from), this.across(to)];
    this.picture.setAttribute("viewBox", `${left} ${top} ${right - left} ${foot - top}`);
    const upright = marks(from, to, state.columns).map((each) => `M${this.across(each.at)} ${top}V${foot}`);
    const level = atLeastTwo(this.low, this.high, this.told.judged ? 4 : 3);
    const lying = level.map((each) => `M${left} ${this.down(each.at)}H${right}`);
    this.grid.setAttribute("d", [...upright, ...lying].join(""));
    this.up.replaceChildren(...level.map((each) => this.placed("span", this.part(each.at), {}, each.label)));
    this.widen(state.window);
    this.nameBands(from, to);
    this.drawUnder(state, isShown);
    this.drawIdle(state, left, right);
    this.describe(state, isShown);
  }

  /** Return when a run violates what is asked of the signal. */
  broken(index) {
    const run = this.scenario.runs[index];
    return run.told.violations.filter((each) => each.signals.some((name) => this.told.names.includes(name)));
  }

  limits(state, isShown) {
    if (this.told.focus) return this.told.focus;
    const [from, to] = state.window;
    let low = Infinity;
    let high = -Infinity;
    const take = (line) => {
      const [least, most] = line.extent(from, to);
      low = Math.min(low, least);
      high = Math.max(high, most);
    };
    this.lines.forEach((line, index) => isShown(index) && take(line));
    this.older.forEach((line, i) => line && state.shown.has(this.scenario.older[i].mark) && take(line));
    if (!(high >= low)) [low, high] = this.whole;
    [low, high] = [clamped(low, -HUGE, HUGE), clamped(high, -HUGE, HUGE)];
    const whole = this.whole[1] - this.whole[0];
    const span = isOne(low, high, STILL) ? Math.min(Math.abs(high), whole) : high - low;
    const bounds = this.told.bands.filter((band) => band.from <= to && band.to >= from);
    const asked = bounds.flatMap(({ low: foot, high: top, far }) => [[foot, far], [top, far]]);
    const corridors = this.told.corridors.flatMap((each) => [...each.low, ...each.high]).map((edge) => [edge, FAR]);
    for (const [bound, far] of [...asked, ...corridors]) {
      if (bound === null || bound < low - far * span || bound > high + far * span) continue;
      low = Math.min(low, bound);
      high = Math.max(high, bound);
    }
    const room = isOne(low, high, STILL) ? Math.min(0.1 * Math.abs(high) || 1, whole) : ROOM * (high - low);
    return [low - room, high + room];
  }

  /** Return how far below the upper edge a value lies, from 0 to 1. */
  part(value) {
    return (this.high - value) / (this.high - this.low);
  }

  placed(name, part, attributes, text) {
    const made = html(name, attributes, text);
    made.style.top = `${100 * part}%`;
    return made;
  }

  nameBands(from, to) {
    const named = this.told.bands.filter((band) => band.from <= to && band.to >= from);
    const places = new Map();
    for (const band of named) {
      const limits = [band.low, band.high].filter((each) => each !== null);
      const middle = limits.reduce((sum, each) => sum + each, 0) / (limits.length || 1);
      places.set(middle, [...(places.get(middle) || []), ...band.ids]);
    }
    const wanted = [...places].flatMap(([middle, ids]) => {
      const beyond = middle < this.low ? ` \u2193${number(middle, 3)}` : middle > this.high ? ` \u2191${number(middle, 3)}` : "";
      return [...new Set(ids)].map((id) => ({ part: clamped(this.part(middle), 0.04, 0.96), text: id + beyond }));
    });
    wanted.sort((one, other) => one.part - other.part);
    while (wanted.length > MOST_NAMED) joinNearest(wanted);
    const least = Math.min(LETTERS / (this.told.judged ? 6.5 : 4), 0.92 / Math.max(wanted.length - 1, 1));
    wanted.forEach((each, i) => {
      if (i > 0) each.part = Math.max(each.part, wanted[i - 1].part + least);
    });
    wanted.reduceRight((ceiling, each) => {
      each.part = Math.min(each.part, ceiling);
      return each.part - least;
    }, 0.96);
    this.labels.replaceChildren(
      ...wanted.map((each) => this.placed("span", each.part, { title: each.text }, each.text)),
    );
  }

  drawUnder(state, isShown) {
    const [from, to] = state.window;
    const place = (start, end, kind, top = null) => {
      const [left, right] = [clamped(start, from, to), clamped(end, from, to)];
      if (right < left || end < from || start > to) return null;
      const made = html("div", { class: kind });
      made.style.left = `min(${(100 * (left - from)) / (to - from)}%, 100% - 3px)`; // one at the end is seen, too
      made.style.width = `${(100 * (right - left)) / (to - from)}%`;
      if (top !== null) made.style.top = `${100 * top}%`;
      return made;
    };
    const under = [];
    const over = [];
    const shades = [];
    this.scenario.runs.forEach((run, index) => {
      if (!isShown(index)) return;
      const row = this.missed.indexOf(index);
      for (const each of this.broken(index)) {
        if (index === state.chosen) shades.push([this.across(each.from), this.across(each.to)]);
        const top = (this.strip * (row + 0.4)) / (this.missed.length + 0.5);
        if (row >= 0) over.push(place(each.from, each.to, `violation ${look(index)}`, top));
      }
      if (index !== state.chosen || run.told.fault === null) return;
      const time = run.told.fault;
      under.push(place(time, this.scenario.end, "rest"));
      const mark = place(time, time, "fault");
      if (mark) mark.append(html("span", { class: time > (from + to) / 2 ? "late" : "" }, `FAULT at ${number(time)}\u00a0s`));
      over.push(mark);
    });
    this.shades.replaceChildren(...shades.map(([x, end]) => svg("rect", { x, y: -1e6, width: end - x, height: 2e6 })));
    this.under.replaceChildren(...under.filter(Boolean));
    this.over.replaceChildren(...over.filter(Boolean));
  }

  /** Mark at the foot of an output when no rule is active in the run that was chosen. */
  drawIdle(state, left, right) {
    const stretches = this.scenario.runs[state.chosen].idle(this.told.names);
    this.idle.setAttribute("viewBox", `${left} 0 ${right - left} 1`);
    const bars = stretches.map(([begin, end]) => `M${this.across(begin)} 0H${this.across(end)}V1H${this.across(begin)}Z`);
    this.idle.firstChild.setAttribute("d", bars.join(""));
    this.idle.classList.toggle("off", !bars.length);
  }

  describe(state, isShown) {
    const [from, to] = state.window;
    const parts = this.lines.flatMap((line, index) => {
      if (!isShown(index)) return [];
      const [low, high] = line.extent(from, to);
      const unit = this.told.unit;
      const last = line.times[line.times.length - 1];
      const ends = `from ${withUnit(line.at(from), unit)} to ${withUnit(line.at(Math.min(to, last)), unit)}`;
      return [`${this.scenario.runs[index].name} ${ends}, between ${withUnit(low, unit)} and ${withUnit(high, unit)}`];
    });
    describe(this.picture, `${this.told.names[0]} over time: ${parts.join("; ") || "no run is shown"}.`);
  }

  /** Move the cursor, and tell what every run has there. */
  point(state) {
    const [from, to] = state.window;
    const place = (state.at - from) / (to - from);
    const isSeen = place >= 0 && place <= 1;
    this.cursor.classList.toggle("off", !isSeen);
    this.cursor.style.left = `${100 * place}%`;
    const told = [];
    this.lines.forEach((line, index) => {
      const value = line && state.shown.has(index) ? line.at(state.at) : NaN;
      const dot = this.dots[index];
      const part = this.part(value);
      dot.classList.toggle("off", !(isSeen && part >= 0 && part <= 1));
      dot.style.left = `${100 * place}%`;
      dot.style.top = `${100 * part}%`;
      if (!line || !state.shown.has(index)) return;
      const name = html("span", { class: "hidden" }, `${this.scenario.runs[index].name}: `);
      const text = nearly(line, state.at) + withUnit(value, this.told.unit);
      told.push(html("span", { class: "reading" }, swatch(index), name, text));
    });
    this.readings.replaceChildren(...told);
  }
}

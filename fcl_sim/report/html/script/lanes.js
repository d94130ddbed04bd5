// One axis over time: a signal of all runs against what is asked of it.

const WIDE = 1000;
const FAR = 1.5;
const ROOM = 0.08;

/** A lane is drawn on a plane of its own, WIDE each way; what of it is seen is its view box. */
class Lane {
  constructor(scenario, told) {
    this.scenario = scenario;
    this.told = told;
    this.lines = scenario.runs.map((run) => run.line(told.signal));
    this.older = scenario.older.map((run) => run.line(told.signal));
    const extents = [...this.lines, ...this.older].filter(Boolean).map((line) => line.extent(0, scenario.end));
    const low = Math.min(...extents.map((each) => each[0]));
    const high = Math.max(...extents.map((each) => each[1]));
    this.whole = Number.isFinite(high - low) && high > low ? [low, high] : [low - 1 || 0, low + 1 || 1];
    if (told.focus) this.whole = told.focus;
    this.element = this.build();
  }

  build() {
    const { told } = this;
    this.readings = html("span", { class: "readings" });
    this.up = html("div", { class: "lane-up", "aria-hidden": "true" });
    this.labels = html("div", { class: "lane-labels", "aria-hidden": "true" });
    this.picture = svg("svg", { preserveAspectRatio: "none", role: "img" }, svg("title"));
    this.grid = svg("path", { class: "grid" });
    this.picture.append(this.grid, ...told.bands.map((band) => this.band(band)));
    this.picture.append(...told.corridors.map((corridor) => this.corridor(corridor)));
    this.groups = this.lines.map((line, index) => this.run(line, `run ${look(index)}`));
    this.olderGroups = this.older.map((line) => this.run(line, "older"));
    this.picture.append(...this.olderGroups, ...[...this.groups].reverse());
    this.under = html("div", { class: "under" });
    this.idle = svg("svg", { class: "idle", preserveAspectRatio: "none", "aria-hidden": "true" }, svg("path"));
    this.cursor = html("div", { class: "cursor" });
    this.dots = this.lines.map((_, index) => html("i", { class: `dot ${look(index)}` }));
    this.plot = html("div", { class: "lane-plot" }, this.under, this.picture, this.idle, this.cursor, this.dots);
    const [first, ...others] = told.names;
    const head = html(
      "div",
      { class: "lane-head" },
      html("span", { class: "lane-name" }, first, html("span", { class: "unit" }, ` [${told.unit || "1"}]`)),
      told.focus ? html("span", { class: "faint" }, "close to its bounds") : null,
      others.length && !told.focus ? html("span", { class: "faint" }, others.map((name) => `= ${name}`).join(" ")) : null,
      this.readings,
    );
    const body = html("div", { class: "lane-body" }, this.up, this.plot, this.labels);
    return html("div", { class: told.judged ? "lane judged" : "lane" }, head, body);
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

  band(band) {
    const [left, right] = [this.across(band.from), this.across(band.to)];
    const top = band.high === null ? -1e6 : this.down(band.high);
    const foot = band.low === null ? 1e6 : this.down(band.low);
    const edges = [band.low, band.high].filter((each) => each !== null).map((each) => this.down(each));
    return svg(
      "g",
      { class: "band" },
      svg("rect", { x: left, y: top, width: Math.max(right - left, 0), height: Math.max(foot - top, 0) }),
      svg("path", { d: edges.map((edge) => `M${left} ${edge}H${right}`).join("") }),
    );
  }

  corridor(corridor) {
    const point = (time, value) => `${this.across(time)} ${this.down(value)}`;
    const side = (values, none) =>
      corridor.time.map((time, i) => (values[i] === null ? `${this.across(time)} ${none}` : point(time, values[i])));
    const [low, high] = [side(corridor.low, 1e6), side(corridor.high, -1e6)];
    const edge = (values) => {
      let pen = "M";
      return corridor.time
        .map((time, i) => {
          const drawn = values[i] === null ? "" : `${pen}${point(time, values[i])}`;
          pen = values[i] === null ? "M" : "L";
          return drawn;
        })
        .join("");
    };
    return svg(
      "g",
      { class: "band" },
      svg("path", { class: "area", d: `M${low.join("L")}L${high.reverse().join("L")}Z` }),
      svg("path", { d: edge(corridor.low) + edge(corridor.high) }),
    );
  }

  /** Draw what depends on the window of time and on the runs that are shown. */
  draw(state) {
    const [from, to] = state.window;
    const isShown = (index) => state.shown.has(index) && this.lines[index];
    this.groups.forEach((group, index) => group.classList.toggle("off", !isShown(index)));
    this.groups.forEach((group, index) => group.classList.toggle("chosen", index === state.chosen));
    this.olderGroups.forEach((group, i) => group.classList.toggle("off", !state.shown.has(this.scenario.older[i].mark)));
    [this.low, this.high] = this.limits(state, isShown);
    const [top, foot] = [this.down(this.high), this.down(this.low)];
    const [left, right] = [this.across(from), this.across(to)];
    this.picture.setAttribute("viewBox", `${left} ${top} ${right - left} ${foot - top}`);
    const upright = marks(from, to, state.columns).map((each) => `M${this.across(each.at)} ${top}V${foot}`);
    const level = marks(this.low, this.high, this.told.judged ? 4 : 3);
    const lying = level.map((each) => `M${left} ${this.down(each.at)}H${right}`);
    this.grid.setAttribute("d", [...upright, ...lying].join(""));
    this.up.replaceChildren(...level.map((each) => this.placed("span", this.part(each.at), {}, each.label)));
    this.nameBands(from, to);
    this.drawUnder(state, isShown);
    this.drawIdle(state, left, right);
    this.describe(state, isShown);
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
    const span = high - low || Math.abs(high);
    const bounds = this.told.bands.filter((band) => band.from <= to && band.to >= from);
    const corridors = this.told.corridors.flatMap((each) => [...each.low, ...each.high]);
    for (const bound of [...bounds.flatMap((band) => [band.low, band.high]), ...corridors]) {
      if (bound === null || bound < low - FAR * span || bound > high + FAR * span) continue;
      low = Math.min(low, bound);
      high = Math.max(high, bound);
    }
    const room = ROOM * (high - low) || 0.1 * Math.abs(high) || 1;
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
    const wanted = named.map((band) => {
      const limits = [band.low, band.high].filter((each) => each !== null);
      const middle = limits.reduce((sum, each) => sum + each, 0) / (limits.length || 1);
      const beyond = middle < this.low ? ` \u2193${number(middle, 3)}` : middle > this.high ? ` \u2191${number(middle, 3)}` : "";
      return { part: clamped(this.part(middle), 0.04, 0.96), text: band.ids.join(", ") + beyond };
    });
    const least = 15 / (this.plot.clientHeight || 90);
    wanted.sort((one, other) => one.part - other.part);
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
    const place = (start, end, kind, top) => {
      const [left, right] = [clamped(start, from, to), clamped(end, from, to)];
      if (right < left || end < from || start > to) return null;
      const made = html("div", { class: kind });
      made.style.left = `${(100 * (left - from)) / (to - from)}%`;
      made.style.width = `${(100 * (right - left)) / (to - from)}%`;
      if (top !== undefined) made.style.top = `${top}px`;
      return made;
    };
    const found = [];
    let bars = 0;
    this.scenario.runs.forEach((run, index) => {
      if (!isShown(index)) return;
      const broken = run.told.violations.filter((each) => each.signals.some((name) => run.isSame(name, this.told.signal)));
      for (const each of broken) {
        if (index === state.chosen) found.push(place(each.from, each.to, "violated"));
        found.push(place(each.from, each.to, `violation ${look(index)}`, 1 + 4 * bars));
      }
      bars += broken.length ? 1 : 0;
      if (index === state.chosen && run.told.fault) {
        found.push(place(run.told.fault.time, this.scenario.end, "rest"));
        const mark = place(run.told.fault.time, run.told.fault.time, "fault");
        if (mark) {
          const late = run.told.fault.time > (from + to) / 2;
          mark.append(html("span", { class: late ? "late" : "" }, `FAULT at ${number(run.told.fault.time)}\u00a0s`));
        }
        found.push(mark);
      }
    });
    this.under.replaceChildren(...found.filter(Boolean));
  }

  /** Mark at the foot of an output when no rule is active in the run that was chosen. */
  drawIdle(state, left, right) {
    const stretches = this.scenario.runs[state.chosen].idle(this.told.signal);
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
    say(this.picture.firstChild, `${this.told.names[0]} over time: ${parts.join("; ") || "no run is shown"}.`);
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
      const near = line.isNear(state.at) ? "\u2248" : "";
      const name = html("span", { class: "hidden" }, `${this.scenario.runs[index].name}: `);
      const text = `${near}${withUnit(value, this.told.unit)}`;
      told.push(html("span", { class: "reading" }, swatch(index), name, text));
    });
    this.readings.replaceChildren(...told);
  }
}

// A scenario to look into: one time and one window of it for plots, rules, map and plant.

/** A run as a pack tells it; `mark` is the place of its colour. */
class Run {
  constructor(told, mark, pack) {
    this.told = told;
    this.mark = mark;
    this.name = told.name;
    this.pack = pack;
    this.clock = clockOf(told.time, pack);
    this.known = new Map();
  }

  lineOf(series) {
    if (!this.known.has(series)) this.known.set(series, new Line(this.clock, this.pack.series(series)));
    return this.known.get(series);
  }

  line(signal) {
    const series = this.told.signals[signal];
    return series === undefined ? null : this.lineOf(series);
  }

  /** Return from when to when no rule is active for what goes by any of these names, an output of a block. */
  idle(names) {
    const isNamed = (block, output) => names.includes(`${block.name}.${output}`) || names.includes(block.name);
    return this.told.blocks.flatMap((block) =>
      Object.keys(block.idle).flatMap((output) => (isNamed(block, output) ? block.idle[output] : [])),
    );
  }

  unit(signal) {
    return this.told.units[signal] || "";
  }
}

/** Everything about a scenario, from its pack. */
function scenarioOf(pack) {
  const told = pack.document;
  const runs = told.runs.map((run, index) => new Run(run, index, pack));
  const older = told.older.map((run) => {
    const mark = runs.findIndex((each) => each.name === run.name);
    return new Run({ ...run, blocks: [], violations: [] }, mark, pack);
  });
  const end = Math.max(...runs.map((run) => run.told.duration), 1e-9);
  return { told, runs, older, end, scan: Math.min(...runs.map((run) => run.told.scan)), pack };
}

/** Plots, map, rules and plant of a scenario, in `place`; `before` is the state of one that it replaces. */
class Explorer {
  constructor(place, pack, before) {
    this.place = place;
    this.scenario = scenarioOf(pack);
    const { runs, end } = this.scenario;
    const everything = new Set(runs.map((_, index) => index));
    this.state = { time: 0, hovered: null, window: [0, end], shown: everything, chosen: 0, columns: 8 };
    this.controls = new Controls(this.scenario, this);
    this.plots = new Plots(this.scenario, this);
    this.side = html("div", { class: "side", tabindex: 0, role: "group", "aria-label": "Plant and characteristic" });
    this.under = html("div");
    place.replaceChildren(this.controls.element, html("div", { class: "panes" }, html("div", {}, this.plots.element, this.under), this.side));
    if (before) this.restore(before);
    this.choose(this.state.chosen);
    new ResizeObserver(() => this.fit()).observe(place);
  }

  /** Return what the next one of this scenario takes over. */
  memory() {
    const { runs } = this.scenario;
    const { state } = this;
    const hidden = runs.filter((_, index) => !state.shown.has(index)).map((run) => run.name);
    const isWhole = state.window[0] === 0 && state.window[1] === this.scenario.end;
    const isOpen = Boolean(this.plots.fold && this.plots.fold.open);
    return { time: state.time, window: isWhole ? null : state.window, hidden, chosen: runs[state.chosen].name, isOpen };
  }

  restore(before) {
    const { runs, end } = this.scenario;
    const { state } = this;
    state.time = clamped(before.time, 0, end);
    if (before.window && before.window[1] <= end) state.window = before.window;
    state.shown = new Set([...runs.keys()].filter((index) => !before.hidden.includes(runs[index].name)));
    state.chosen = Math.max(runs.findIndex((run) => run.name === before.chosen), 0);
    if (this.plots.fold) this.plots.fold.open = before.isOpen;
  }

  /** Show rules, map and plant of a run. */
  choose(index) {
    const { scenario, state } = this;
    state.chosen = index;
    state.shown.add(index);
    const run = scenario.runs[index];
    this.rules = run.told.blocks.map((block) => new Rules(scenario.told.bases[block.base], block, run, scenario.end));
    this.maps = run.told.blocks.flatMap((block) =>
      scenario.told.bases[block.base].maps.map((told) => ({ block, map: new Characteristic(told, scenario.pack) })),
    );
    this.maps.forEach(({ map }) => map.paint());
    this.sketch = run.told.sketch ? new Sketch(run.told.sketch, run) : null;
    this.side.replaceChildren(...(this.sketch ? [this.sketch.element] : []), ...this.maps.map(({ map }) => map.element));
    this.under.replaceChildren(...this.rules.map((rules) => rules.element));
    this.place.classList.toggle("alone", !this.side.children.length);
    this.draw();
  }

  /** Draw all that depends on the window of time and on the runs that are shown. */
  draw() {
    this.controls.draw(this.state);
    this.plots.draw(this.state);
    for (const rules of this.rules) rules.draw(this.state);
    this.point();
  }

  /** Show the time at the cursor everywhere. */
  point() {
    const { state } = this;
    state.at = state.hovered === null ? state.time : state.hovered;
    this.controls.point(state);
    this.plots.point(state);
    for (const rules of this.rules) rules.point(state);
    for (const { block, map } of this.maps) map.follow(block, this.scenario.runs[state.chosen], state.at);
    if (this.sketch) this.sketch.point(state);
  }

  snapped(time) {
    const { end, scan } = this.scenario;
    return Math.min(Math.round(clamped(time, 0, end) / scan) * scan, end);
  }

  setTime(time) {
    this.state.time = this.snapped(time);
    this.state.hovered = null;
    this.point();
  }

  /** Show a run at a time, as where it first violates a requirement. */
  visit(name, time) {
    const index = this.scenario.runs.findIndex((run) => run.name === name);
    if (index < 0) return;
    if (this.playing) this.toggle();
    const [from, to] = this.state.window;
    if (time < from || time > to) this.zoomTo(0, Infinity);
    this.choose(index);
    this.setTime(time);
    this.place.scrollIntoView({ block: "start" });
    this.controls.slider.focus({ preventScroll: true });
  }

  hover(time) {
    if (this.playing) return;
    this.state.hovered = time === null ? null : this.snapped(time);
    this.soon();
  }

  /** Point once before the next picture, however often the pointer moves until then. */
  soon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.point();
    });
  }

  show(index, isShown) {
    if (isShown) this.state.shown.add(index);
    else this.state.shown.delete(index);
    this.draw();
  }

  zoomTo(from, to) {
    const { end, scan } = this.scenario;
    const [begin, last] = [clamped(Math.min(from, to), 0, end), clamped(Math.max(from, to), 0, end)];
    const least = Math.min(5 * scan, end);
    const middle = clamped((begin + last) / 2, least / 2, end - least / 2);
    this.state.window = last - begin < least ? [middle - least / 2, middle + least / 2] : [begin, last];
    this.draw();
  }

  zoomBy(factor, around) {
    const [from, to] = this.state.window;
    const { time } = this.state;
    const middle = around === undefined ? (time >= from && time <= to ? time : (from + to) / 2) : around;
    this.zoomTo(middle - (middle - from) * factor, middle + (to - middle) * factor);
  }

  shiftBy(part) {
    const [from, to] = this.state.window;
    const width = to - from;
    const begin = clamped(from + part * width, 0, this.scenario.end - width);
    this.zoomTo(begin, begin + width);
  }

  /** Mark what a drag would zoom to; nothing takes the mark away. */
  select(from, to) {
    const [left, right] = this.state.window;
    for (const lane of this.plots.seen) {
      const mark = lane.selection || (lane.selection = html("div", { class: "selection" }));
      if (!mark.parentNode) lane.plot.append(mark);
      mark.classList.toggle("off", from === null);
      if (from === null) continue;
      mark.style.left = `${(100 * (Math.min(from, to) - left)) / (right - left)}%`;
      mark.style.width = `${(100 * Math.abs(to - from)) / (right - left)}%`;
    }
  }

  /** Run, or stop, the time. */
  toggle() {
    this.playing = !this.playing;
    say(this.controls.play, this.playing ? "Pause" : "Play");
    if (!this.playing) return;
    if (this.state.time >= this.scenario.end) this.state.time = 0;
    let [last, time] = [performance.now(), this.state.time];
    const step = (now) => {
      if (!this.playing || !this.place.isConnected) return;
      if (Math.abs(this.snapped(time) - this.state.time) > this.scenario.scan) time = this.state.time;
      time += ((now - last) / 1000) * Number(this.controls.speed.value);
      last = now;
      this.setTime(time);
      if (time >= this.scenario.end) this.toggle();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  fit() {
    const columns = this.place.clientWidth < 640 ? 4 : 8;
    if (columns === this.state.columns) return;
    this.state.columns = columns;
    this.draw();
  }
}

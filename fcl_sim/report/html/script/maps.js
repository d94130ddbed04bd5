// The characteristic of a rule base, the way of a run over it, and the point where it is.

const HEAT = ["#3d6590", "#5a94a8", "#8fbfae", "#cfdfae", "#fbf3c9"];
const SHADES = 255;
const MAP = [560, 400];

const PALETTE = Array.from({ length: SHADES }, (_, shade) => {
  const place = (shade / (SHADES - 1)) * (HEAT.length - 1);
  const first = Math.min(Math.floor(place), HEAT.length - 2);
  const channel = (colour, at) => parseInt(colour.slice(at, at + 2), 16);
  const [red, green, blue] = [1, 3, 5].map((at) => {
    const [low, high] = [channel(HEAT[first], at), channel(HEAT[first + 1], at)];
    return Math.round(low + (place - first) * (high - low));
  });
  return pixel(red, green, blue, 255);
});
const STRIPE = pixel(110, 120, 130, 190);
const BETWEEN = pixel(110, 120, 130, 28);

/** Return a colour as it lies in the memory of an image, on the machines that there are. */
function pixel(red, green, blue, alpha) {
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0;
}

/** What an output is over one input or two; of a run that uses it, where it was and where it is. */
class Characteristic {
  constructor(told, pack) {
    this.told = told;
    this.pack = pack;
    this.isMap = told.views !== undefined;
    this.view = 0;
    this.element = this.build();
  }

  build() {
    const { told } = this;
    const over = this.isMap ? `${told.across.name} and ${told.up.name}` : told.across.name;
    this.canvas = this.isMap ? html("canvas", { width: MAP[0], height: MAP[1], "aria-hidden": "true" }) : null;
    this.back = svg("g");
    this.path = svg("path", { class: "way" });
    this.halo = svg("path", { class: "halo" });
    this.lost = svg("path", { class: "lost" });
    this.ahead = svg("path", { class: "ahead" });
    const lines = [this.halo, this.ahead, this.path, this.lost];
    this.picture = svg("svg", { viewBox: `0 0 ${WIDE} ${WIDE}`, preserveAspectRatio: "none", role: "img" }, this.back, lines);
    this.spot = html("i", { class: "spot" });
    this.exits = html("div", { class: "exits", "aria-hidden": "true" });
    this.plot = html("div", { class: "map-plot" }, this.canvas, this.picture, this.exits, this.spot);
    this.up = html("div", { class: "lane-up", "aria-hidden": "true" });
    this.across = html("div", { class: "lane-axis", "aria-hidden": "true" });
    this.reading = html("span", { class: "map-reading" });
    const body = html("div", { class: "map-body" }, this.up, this.plot, this.scale(), html("i"), this.across);
    const label = (name, unit) => `${name} [${unit || "1"}]`;
    const upward = this.isMap ? label(told.up.name, told.up.unit) : label(told.output, told.unit);
    const hatched = this.isMap ? told.views.some((view) => view.undefined) : told.undefined.length;
    const notes = [told.note, hatched ? "Hatched: no rule is active." : ""].filter(Boolean).join(" ");
    return html(
      "figure",
      { class: "map" },
      html("figcaption", {}, html("b", {}, `${told.output} over ${over}`), " ", this.reading),
      this.choice(),
      html("p", { class: "axis-up" }, upward),
      body,
      html("p", { class: "axis-across" }, label(told.across.name, told.across.unit)),
      notes ? html("p", { class: "note" }, notes) : null,
    );
  }

  /** Return what chooses between all terms and where the runs went. */
  choice() {
    if (!this.isMap || this.told.views.length < 2) return null;
    const look = (event) => {
      this.view = event.target.checked ? 1 : 0;
      this.paint();
      this.follow(this.block, this.run, this.at);
    };
    const box = html("input", { type: "checkbox", onchange: look });
    return html("label", { class: "choice" }, box, "close to where the runs went");
  }

  scale() {
    if (!this.isMap) return html("i");
    const { low, high, output, unit } = this.told;
    const bar = html("div", { class: "scale-bar" });
    bar.style.background = `linear-gradient(to top, ${HEAT.join(", ")})`;
    const labels = marks(low, high, 6).map((each) => {
      const label = html("span", {}, each.label);
      label.style.bottom = `${(100 * (each.at - low)) / (high - low)}%`;
      return label;
    });
    const name = html("b", {}, `${output} [${unit || "1"}]`);
    return html("div", { class: "scale", "aria-hidden": "true" }, bar, html("div", { class: "scale-labels" }, labels), name);
  }

  /** Paint the map, or draw the curve, with its axes. */
  paint() {
    if (this.isMap) this.paintMap();
    else this.drawCurve();
    const [left, right, low, high] = this.limits;
    const place = (each, from, to) => (100 * (each - from)) / (to - from);
    const level = marks(low, high, 6).map((each) => {
      const label = html("span", {}, each.label);
      label.style.top = `${100 - place(each.at, low, high)}%`;
      return label;
    });
    const upright = marks(left, right, 6).map((each) => {
      const label = html("span", {}, each.label);
      label.style.left = `${place(each.at, left, right)}%`;
      return label;
    });
    this.up.replaceChildren(...level);
    this.across.replaceChildren(...upright);
  }

  paintMap() {
    const view = this.told.views[this.view];
    const [x, y] = [this.pack.series(view.x).values, this.pack.series(view.y).values];
    const cells = this.pack.plain(view.cells);
    const [width, height] = MAP;
    this.limits = [x[0], x[x.length - 1], y[0], y[y.length - 1]];
    const columns = cellsOf(x, width);
    const rows = cellsOf(y, height).reverse();
    const image = new ImageData(width, height);
    const pixels = new Uint32Array(image.data.buffer);
    for (let row = 0; row < height; row++) {
      for (let column = 0; column < width; column++) {
        const shade = cells[rows[row] * (x.length - 1) + columns[column]];
        const blank = (row + column) % 10 < 2 ? STRIPE : BETWEEN;
        pixels[row * width + column] = shade < SHADES ? PALETTE[shade] : blank;
      }
    }
    this.canvas.getContext("2d").putImageData(image, 0, 0);
  }

  drawCurve() {
    const x = this.pack.series(this.told.x).values;
    const series = this.pack.series(this.told.values);
    const values = series.constant === undefined ? series.values : new Float64Array(x.length).fill(series.constant);
    const told = values.filter((each) => !Number.isNaN(each));
    const ends = told.length ? [told.reduce((a, b) => Math.min(a, b)), told.reduce((a, b) => Math.max(a, b))] : [0, 1];
    const [low, high] = ends.map((each) => clamped(each, -HUGE, HUGE));
    const room = isOne(low, high) ? 0.1 * Math.abs(high) || 1 : 0.06 * (high - low);
    this.limits = [x[0], x[x.length - 1], low - room, high + room];
    let [path, pen] = ["", "M"];
    values.forEach((value, i) => {
      if (!Number.isNaN(value)) path += pen + this.point(x[i], value);
      pen = Number.isNaN(value) ? "M" : "L";
    });
    const areas = this.told.undefined.map(([begin, end]) => {
      const [left, right] = [begin, end].map((each) => WIDE * ((each - this.limits[0]) / (this.limits[1] - this.limits[0])));
      return svg("rect", { class: "undefined", x: left, y: 0, width: right - left, height: WIDE });
    });
    this.back.replaceChildren(...areas, svg("path", { d: path, class: "curve" }));
  }

  point(x, y) {
    const [left, right, low, high] = this.limits;
    return `${(WIDE * (x - left)) / (right - left)} ${WIDE * (1 - (y - low) / (high - low))}`;
  }

  /** Show where a run is at a time, with its way up to there and from there on. */
  follow(block, run, at) {
    [this.block, this.run, this.at] = [block, run, at];
    const { told } = this;
    const output = run.lineOf(block.outputs[told.output]);
    const across = run.lineOf(block.inputs[inputOf(block, told.across.input)]);
    const up = this.isMap ? run.lineOf(block.inputs[inputOf(block, told.up.input)]) : output;
    this.drawWay(across, up, at, block.idle[told.output] || []);
    this.drawExits(across, up);
    const here = [across.at(at), up.at(at)];
    const [left, right, low, high] = this.limits;
    const part = [(here[0] - left) / (right - left), 1 - (here[1] - low) / (high - low)];
    const isIn = part.every((each) => each >= 0 && each <= 1);
    this.spot.classList.toggle("off", Number.isNaN(part[0] + part[1]));
    this.spot.classList.toggle("beyond", !isIn);
    this.spot.style.left = `${100 * clamped(part[0], 0, 1)}%`;
    this.spot.style.top = `${100 * clamped(part[1], 0, 1)}%`;
    const read = (line, unit) => nearly(line, at) + withUnit(line.at(at), unit);
    const inputs = [read(across, told.across.unit), ...(this.isMap ? [read(up, told.up.unit)] : [])];
    const isIdle = (block.idle[told.output] || []).some(([begin, end]) => at >= begin - 1e-9 && at < end - 1e-9);
    const beyond = isIn || Number.isNaN(part[0]) ? "" : ", beyond the edge";
    const value = `${inputs.join(", ")} \u2192 ${read(output, told.unit)}${isIdle ? ", no rule is active" : ""}${beyond}`;
    say(this.reading, value);
    describe(this.picture, `Characteristic: ${told.output} at ${seconds(at, run.told.scan)} s: ${value}`);
  }

  /** Draw an arrow head wherever the way goes out of the picture; anew only for another run or view. */
  drawExits(across, up) {
    const shown = `${this.limits} ${this.run.told.name}`;
    if (this.shown === shown) return;
    this.shown = shown;
    const points = merged(across.times, up.times);
    const found = exitsOf(Array.from(points, (time) => [across.at(time), up.at(time)]), this.limits);
    this.exits.replaceChildren(...found.map(({ place: [x, y], side }) => {
      const head = html("i", { class: side });
      [head.style.left, head.style.top] = [`${100 * x}%`, `${100 * y}%`];
      return head;
    }));
  }

  drawWay(across, up, at, idle) {
    const times = merged(across.times, up.times);
    const isIdle = (time) => idle.some(([begin, end]) => time >= begin && time <= end);
    const parts = { before: "", after: "", lost: "" };
    let pens = { before: "M", after: "M", lost: "M" };
    let split = false;
    const add = (part, x, y) => {
      parts[part] += pens[part] + this.point(x, y);
      pens[part] = "L";
    };
    for (const time of times) {
      const [x, y] = [across.at(time), up.at(time)];
      if (Number.isNaN(x + y)) {
        pens = { before: "M", after: "M", lost: "M" };
        continue;
      }
      if (time <= at) add("before", x, y);
      else {
        const here = [across.at(at), up.at(at)];
        if (!split && !Number.isNaN(here[0] + here[1])) add("after", ...here);
        split = true;
        add("after", x, y);
      }
      if (time <= at && isIdle(time)) add("lost", x, y);
      else pens.lost = "M";
    }
    this.path.setAttribute("d", parts.before);
    this.lost.setAttribute("d", parts.lost);
    this.ahead.setAttribute("d", parts.after);
    this.halo.setAttribute("d", parts.before + parts.after);
  }
}

const APART = 0.06;

/** Return where a way goes out of a picture, as parts of its width and height, and to which side; none beside another. */
function exitsOf(points, [left, right, low, high]) {
  const found = [];
  const isIn = (point) => point.every((each) => each >= 0 && each <= 1);
  let last = null;
  for (const [x, y] of points) {
    const now = [(x - left) / (right - left), (high - y) / (high - low)];
    const isTold = !Number.isNaN(now[0] + now[1]);
    if (last && isTold && isIn(last) && !isIn(now)) {
      const way = [now[0] - last[0], now[1] - last[1]];
      const ends = way.map((each, axis) => (each ? ((each > 0 ? 1 : 0) - last[axis]) / each : Infinity));
      const axis = ends[0] <= ends[1] ? 0 : 1;
      const place = last.map((each, at) => clamped(each + ends[axis] * way[at], 0, 1));
      const side = [["left", "right"], ["up", "down"]][axis][way[axis] > 0 ? 1 : 0];
      if (found.every((other) => Math.hypot(other.place[0] - place[0], other.place[1] - place[1]) >= APART)) found.push({ place, side });
    }
    last = isTold ? now : null;
  }
  return found;
}

/** Return the name of an input as a block has it: letter case does not count. */
function inputOf(block, name) {
  return Object.keys(block.inputs).find((each) => each.toLowerCase() === name.toLowerCase());
}

/** Return in which cell between edges the middle of each of so many pixels lies. */
function cellsOf(edges, count) {
  const [first, last] = [edges[0], edges[edges.length - 1]];
  let cell = 0;
  return Array.from({ length: count }, (_, pixel) => {
    const at = first + ((pixel + 0.5) / count) * (last - first);
    while (cell < edges.length - 2 && edges[cell + 1] <= at) cell += 1;
    return cell;
  });
}

/** Return the times of two lines, each once. */
function merged(one, other) {
  if (one === other || (one.length === other.length && one[1] === other[1] && one.at(-2) === other.at(-2))) return one;
  return Float64Array.from(new Set([...one, ...other])).sort();
}

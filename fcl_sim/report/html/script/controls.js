// What moves the time, chooses runs and zooms: buttons, a slider, boxes; all of them by keys, too.

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000];
const WATCHED = 20;

/** The controls of a scenario. */
class Controls {
  constructor(scenario, explorer) {
    this.scenario = scenario;
    this.explorer = explorer;
    this.scans = Math.max(Math.round(scenario.end / scenario.scan), 1);
    this.element = html("div", { class: "controls" }, this.runs(), this.time());
  }

  time() {
    const { explorer, scenario } = this;
    this.play = html("button", { type: "button", onclick: () => explorer.toggle() }, "Play");
    const set = () => explorer.setTime(Number(this.slider.value) * scenario.scan);
    const label = `Time in ${scenario.told.name}`;
    this.slider = html("input", { type: "range", min: 0, max: this.scans, step: 1, "aria-label": label, oninput: set });
    this.told = html("output", {});
    const fitting = SPEEDS.find((speed) => scenario.end / speed <= WATCHED) || SPEEDS.at(-1);
    const options = SPEEDS.map((speed) => html("option", { value: speed, selected: speed === fitting }, `${speed} \u00d7`));
    this.speed = html("select", { "aria-label": "Speed" }, options);
    const button = (label, text, act) => html("button", { type: "button", "aria-label": label, title: label, onclick: act }, text);
    const shift = (part) => explorer.shiftBy(part);
    const zoom = html(
      "div",
      { class: "zoom", role: "group", "aria-label": "Zoom" },
      button("Zoom in", "+", () => explorer.zoomBy(0.5)),
      button("Zoom out", MINUS, () => explorer.zoomBy(2)),
      button("Earlier", "\u2039", () => shift(-0.25)),
      button("Later", "\u203a", () => shift(0.25)),
      html("button", { type: "button", onclick: () => explorer.zoomTo(0, Infinity) }, "Whole run"),
    );
    return html("div", { class: "time" }, this.play, this.slider, this.told, this.speed, zoom);
  }

  runs() {
    const { explorer, scenario } = this;
    this.boxes = scenario.runs.map((run, index) => {
      const show = (event) => explorer.show(index, event.target.checked);
      return html("input", { type: "checkbox", checked: true, onchange: show });
    });
    const labels = scenario.runs.map((run, index) => {
      const title = run.told.title ? { title: run.told.title } : {};
      return html("label", title, this.boxes[index], swatch(index), run.name, " ", badge(run.told.verdict));
    });
    const older = scenario.older.length
      ? html("span", { class: "faint" }, swatchOfOlder(), ` ${scenario.told.olderLabel}`)
      : null;
    const options = scenario.runs.map((run, index) => html("option", { value: index }, run.name));
    this.chosen = html("select", { onchange: () => explorer.choose(Number(this.chosen.value)) }, options);
    const details = html("label", { class: "details-of" }, "Rules, map and plant of ", this.chosen);
    const set = html("fieldset", {}, html("legend", {}, "Runs"), labels, older);
    return html("div", { class: "choose" }, set, scenario.runs.length > 1 ? details : null);
  }

  draw(state) {
    this.boxes.forEach((box, index) => {
      box.checked = state.shown.has(index);
    });
    this.chosen.value = state.chosen;
  }

  point(state) {
    const text = `${seconds(state.at, this.scenario.scan)} s`;
    say(this.told, text);
    this.slider.setAttribute("aria-valuetext", text);
    if (state.hovered === null) this.slider.value = Math.round(state.at / this.scenario.scan);
  }
}

/** Return a short stroke as an older version is drawn. */
function swatchOfOlder() {
  const line = svg("line", { x1: 0, x2: 30, y1: 5, y2: 5, class: "line" });
  return svg("svg", { class: "swatch older", viewBox: "0 0 30 10", "aria-hidden": "true" }, line);
}

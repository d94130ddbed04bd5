// Lanes above one another, and the axis of time below them.

/** All lanes of a scenario; those that are not judged stand behind a fold. */
class Plots {
  constructor(scenario, explorer) {
    this.explorer = explorer;
    this.lanes = scenario.told.lanes.map((told) => new Lane(scenario, told));
    const judged = this.lanes.filter((lane) => lane.told.judged);
    const others = this.lanes.filter((lane) => !lane.told.judged);
    const [first, behind] = judged.length ? [judged, others] : [others, []];
    this.axes = [];
    this.folded = new Set(behind);
    this.fold = this.foldOf(behind);
    this.element = html("div", { class: "plots" }, first.map((lane) => lane.element), this.axis(), this.fold);
    for (const lane of this.lanes) this.listen(lane.plot);
  }

  foldOf(behind) {
    if (!behind.length) return null;
    const text = `${behind.length} further ${behind.length === 1 ? "signal" : "signals"}`;
    const body = html("div", {}, behind.map((lane) => lane.element), this.axis());
    const fold = html("details", {}, html("summary", {}, text), body);
    fold.addEventListener("toggle", () => this.explorer.draw());
    return fold;
  }

  axis() {
    const made = html("div", { class: "lane-axis", "aria-hidden": "true" });
    this.axes.push(made);
    return html("div", { class: "lane-body" }, html("div", { class: "lane-up" }), made, html("div", { class: "lane-labels" }));
  }

  get seen() {
    return this.lanes.filter((lane) => !this.folded.has(lane) || this.fold.open);
  }

  draw(state) {
    const [from, to] = state.window;
    for (const lane of this.seen) lane.draw(state);
    for (const axis of this.axes) {
      const labels = marks(from, to, state.columns).map((each) => {
        const label = html("span", {}, each.label);
        label.style.left = `${(100 * (each.at - from)) / (to - from)}%`;
        return label;
      });
      axis.replaceChildren(...labels, html("b", {}, "time [s]"));
    }
  }

  point(state) {
    for (const lane of this.seen) lane.point(state);
  }

  /** Follow the pointer: moved, it shows another time; clicked, it sets it; dragged, it zooms. */
  listen(plot) {
    let begin = null;
    const timeAt = (event) => {
      const { left, width } = plot.getBoundingClientRect();
      const [from, to] = this.explorer.state.window;
      return from + clamped((event.clientX - left) / width, 0, 1) * (to - from);
    };
    plot.addEventListener("pointermove", (event) => {
      if (begin) this.explorer.select(begin.time, timeAt(event));
      else if (event.pointerType === "mouse") this.explorer.hover(timeAt(event));
    });
    plot.addEventListener("pointerleave", () => begin || this.explorer.hover(null));
    plot.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      begin = { x: event.clientX, time: timeAt(event) };
      if (event.pointerType === "mouse") plot.setPointerCapture(event.pointerId);
    });
    plot.addEventListener("pointercancel", () => {
      begin = null;
      this.explorer.select(null);
    });
    plot.addEventListener("pointerup", (event) => {
      if (!begin) return;
      const moved = Math.abs(event.clientX - begin.x);
      const from = begin.time;
      begin = null;
      this.explorer.select(null);
      if (moved > 6) this.explorer.zoomTo(from, timeAt(event));
      else this.explorer.setTime(timeAt(event));
    });
    plot.addEventListener("dblclick", () => this.explorer.zoomTo(0, Infinity));
    plot.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey) return;
        event.preventDefault();
        this.explorer.zoomBy(event.deltaY > 0 ? 1.25 : 0.8, timeAt(event));
      },
      { passive: false },
    );
  }
}

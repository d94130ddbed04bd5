// The rules of a block: how far each fires at the cursor, and over the time that is shown.

/** A table of the rules of a rule base, for the run that was chosen. */
class Rules {
  constructor(told, block, run, end) {
    this.run = run;
    this.lines = block.degrees.map((series) => run.lineOf(series));
    this.end = end;
    this.rows = told.rules.map(([label, text], index) => this.row(label, text, this.lines[index]));
    this.caption = html("caption");
    this.name = block.name;
    const heads = ["Rule", "Degree", "Text", "Over time"].map((text) => html("th", { scope: "col" }, text));
    const body = html("tbody", {}, this.rows.map((row) => row.element));
    this.element = html(
      "div",
      { class: "wide rules", tabindex: 0, role: "group", "aria-label": `Rules of ${block.name}` },
      html("table", {}, this.caption, html("thead", {}, html("tr", {}, heads)), body),
    );
  }

  row(label, text, line) {
    const bar = html("i", { class: "bar" });
    const value = html("span", { class: "degree" });
    const strip = svg("svg", { preserveAspectRatio: "none", "aria-hidden": "true" }, svg("path", { d: this.path(line) }));
    const cursor = html("i", { class: "cursor" });
    const mark = html("span", { class: "fires" });
    const element = html(
      "tr",
      {},
      html("th", { scope: "row" }, label),
      html("td", { class: "degrees" }, html("i", { class: "rail" }, bar), value, mark),
      html("td", { class: "text" }, text),
      html("td", { class: "strip" }, html("div", {}, strip, cursor)),
    );
    return { element, bar, value, strip, cursor, mark, line };
  }

  path(line) {
    let path = "M0 1";
    line.times.forEach((time, i) => {
      const degree = Number.isNaN(line.values[i]) ? 0 : line.values[i];
      path += `L${((WIDE * time) / this.end).toFixed(2)} ${(1 - degree).toFixed(4)}`;
    });
    return line.times.length ? `${path}V1Z` : "";
  }

  draw(state) {
    const [left, right] = state.window.map((time) => (WIDE * time) / this.end);
    for (const row of this.rows) row.strip.setAttribute("viewBox", `${left} 0 ${right - left} 1`);
  }

  point(state) {
    const [from, to] = state.window;
    const place = (state.at - from) / (to - from);
    let firing = 0;
    let near = "";
    for (const row of this.rows) {
      const degree = row.line.at(state.at);
      const fires = degree > 0;
      firing += fires ? 1 : 0;
      row.element.classList.toggle("firing", fires);
      row.bar.style.width = `${100 * clamped(degree || 0, 0, 1)}%`;
      const sign = nearly(row.line, state.at);
      near = near || sign;
      say(row.value, Number.isNaN(degree) ? "\u2013" : sign + degree.toFixed(3));
      say(row.mark, fires ? (sign ? "maybe" : "fires") : "");
      row.cursor.classList.toggle("off", !(place >= 0 && place <= 1));
      row.cursor.style.left = `${100 * place}%`;
    }
    const when = `at ${seconds(state.at, this.run.told.scan)}\u00a0s`;
    say(this.caption, `${this.name}, run ${this.run.name}: ${near}${firing} of ${this.rows.length} rules fire ${when}`);
  }
}

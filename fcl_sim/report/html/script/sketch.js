// The plant to scale, moved by its signals.

/** A drawing whose groups are moved, turned and grown by signals of a run. */
class Sketch {
  constructor(told, run) {
    this.run = run;
    this.told = told;
    this.moved = [];
    const [left, foot] = told.low;
    const [right, top] = told.high;
    const parts = svg("g", { transform: "scale(1 -1)" }, told.parts.map((part) => this.part(part)));
    const box = `${left} ${-top} ${right - left} ${top - foot}`;
    this.picture = svg("svg", { viewBox: box, role: "img" }, parts, ...this.ruler(left, right, foot, top));
    this.element = html("figure", { class: "sketch" }, this.picture, html("figcaption", { class: "note" }, told.about));
  }

  part(told) {
    if (told.points) {
      const path = `M${told.points.map((point) => point.join(" ")).join("L")}${told.closed ? "Z" : ""}`;
      return svg("path", { d: path, class: `piece ${told.role}` });
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
    const text = svg("text", { x: at[0] + length.at / 2, y: at[1] - size / 2, "font-size": 1.15 * size }, `${length.label} m`);
    return [line, text];
  }

  point(state) {
    const value = (motion) => {
      const line = motion && this.run.line(motion.signal);
      const last = line ? line.times[line.times.length - 1] : 0;
      return line ? line.at(Math.min(state.at, last)) * motion.factor : NaN;
    };
    for (const { group, told } of this.moved) {
      const moves = [];
      if (told.across) moves.push(`translate(${value(told.across) || 0} 0)`);
      if (told.turn) moves.push(`rotate(${value(told.turn) || 0})`);
      if (told.grow) moves.push(`scale(${Math.max(value(told.grow) || 0, 0)})`);
      group.setAttribute("transform", moves.join(" "));
    }
    const motions = this.moved.flatMap(({ told }) => [told.across, told.turn, told.grow]).filter(Boolean);
    const values = motions.map((motion) => `${motion.signal} ${withUnit(value(motion), this.run.unit(motion.signal))}`);
    describe(this.picture, `${this.told.about} At ${seconds(state.at, this.run.told.scan)} s: ${values.join(", ")}.`);
  }
}

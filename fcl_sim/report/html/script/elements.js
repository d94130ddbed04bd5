// Elements of the page: texts are set as texts, never as markup.

const SVG = "http://www.w3.org/2000/svg";

/** Return an element with attributes and children; a text becomes a text. */
function html(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

/** Return an element of a drawing in the same way. */
function svg(name, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, name), attributes, children);
}

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** Set a text where it has changed. */
function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Say in words what a drawing shows. */
function describe(picture, text) {
  if (picture.getAttribute("aria-label") !== text) picture.setAttribute("aria-label", text);
}

/** Return a short stroke as the run number `index` is drawn. */
function swatch(index) {
  const line = svg("line", { x1: 0, x2: 30, y1: 5, y2: 5, class: "line" });
  return svg("svg", { class: `swatch ${look(index)}`, viewBox: "0 0 30 10", "aria-hidden": "true" }, line);
}

/** Return the classes that give the run number `index` its colour and its dashes. */
const look = (index) => `run-${index % 7} dash-${index % 6}`;

/** Return a verdict, as a word on a colour. */
function badge(verdict) {
  const kind = { PASS: "good", FAIL: "bad", FAULT: "bad" }[verdict] || "doubtful";
  return html("span", { class: `badge ${kind}` }, verdict);
}

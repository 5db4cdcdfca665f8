// The parts of each panel: a switch, sliders, on demand the equation with its advice; and parts that could be added.
import { send } from "./api.js";
import { byId, make, refill } from "./dom.js";
import { equation, greek } from "./greek.js";
import { section } from "./scene.js";
import { slider } from "./slider.js";
import { live, on } from "./store.js";
import { known, word } from "./words.js";

let shape = null;
let shows = []; // [panel, part, number, show]
const been = new Map(); // parts that were on in a scene, in order: switched off, they stay in their place

/** Make the section and keep it up to date. */
export function startParts() {
  section("effects", "effects");
  on("setup", show);
  on("language", () => {
    shape = null;
    show();
  });
}

/** What, if it changes, asks for other controls: names, switches and ranges, but no values. */
function shapeOf(setup) {
  const part = (p) => [p.name, p.on, p.fixed, p.numbers.map((n) => [n.name, n.low, n.high, n.start])];
  return JSON.stringify(setup.panels.map((panel) => [panel.label, panel.parts.map(part)]));
}

/** Build anew, or only show the values. */
function show() {
  if (!live.setup) return;
  const now = shapeOf(live.setup);
  if (now !== shape) {
    shows = [];
    refill(byId("effects"), live.setup.panels.flatMap(ofPanel));
    shape = now;
  }
  for (const [panel, part, number, display] of shows) {
    const found = live.setup.panels[panel].parts.find((p) => p.name === part);
    const value = found?.numbers.find((n) => n.name === number)?.value;
    if (value !== undefined) display(value);
  }
}

/** Heading (if there are two), the parts, and what could be added. */
function ofPanel(panel, k, panels) {
  const heading = make("h3", { text: word("effects.of", { label: panel.label }) });
  const placed = places(panel);
  const there = placed.map((name) => ofPart(panel.parts.find((part) => part.name === name), k));
  const others = panel.parts.filter((part) => !placed.includes(part.name));
  const more = make("details", { id: `more-${k}`, class: "more" }, make("summary", { text: word("effects.more") }));
  more.append(...others.map((part) => ofPart(part, k)));
  return [...(panels.length > 1 ? [heading] : []), ...there, ...(others.length ? [more] : [])];
}

/** Names of the parts that are on, or were, in the order in which they came; bounded by the parts there are. */
function places(panel) {
  const key = `${live.setup.scene} ${panel.label}`;
  const before = been.get(key) ?? [];
  const fresh = panel.parts.filter((part) => part.on && !before.includes(part.name)).map((part) => part.name);
  been.set(key, [...before, ...fresh]);
  return been.get(key).filter((name) => panel.parts.some((part) => part.name === name));
}

/** The name of a part in the reader's language. */
export function partName({ name, kind }) {
  if (known(`part.${name}`)) return word(`part.${name}`);
  return kind === "term" ? name : `${word("kind.stepper")}: ${name}`;
}

/** One part. */
function ofPart(part, panel) {
  const box = make("div", { class: "part", "data-part": part.name });
  box.append(header(part, panel));
  const numbers = part.on ? part.numbers : [];
  for (const number of numbers) {
    const { element, show: display } = slider(panel, part.name, partName(part), number);
    shows.push([panel, part.name, number.name, display]);
    box.append(element);
  }
  box.append(explained(part, panel));
  return box;
}

/** The switch with its name; a fixed one says why. */
function header(part, panel) {
  const id = `switch-${panel}-${part.name}`;
  const name = make("span", { text: partName(part) });
  if (part.kind !== "term") return make("p", { class: "check" }, name);
  const box = make("input", { id, type: "checkbox", role: "switch", checked: part.on, disabled: part.fixed });
  box.addEventListener("change", () => {
    const on = box.checked;
    box.checked = !on; // until the run says that it is so
    send({ do: "switch", panel, part: part.name, on });
  });
  const label = make("label", { class: "check", title: part.name }, box, name);
  if (part.fixed) {
    box.setAttribute("aria-describedby", `${id}-why`);
    label.title = `${part.name}: ${whyFixed(part)}`;
  }
  return label;
}

/** Why a part cannot be switched. */
function whyFixed(part) {
  if (part.kind !== "term") return word("fixed.stepper");
  return part.why ? `${word("fixed")}: ${greek(part.why)}` : word("fixed");
}

/** Equation and advice, on demand. */
function explained(part, panel) {
  const box = make("details", { id: `explain-${panel}-${part.name}`, class: "explain" });
  box.append(make("summary", { text: word("explain"), title: word("explain.of", { name: partName(part) }) }));
  box.append(make("p", { class: "equation" }, equation(part.equation)));
  if (part.advice) box.append(make("p", { class: "prose", text: greek(part.advice) }));
  const id = `switch-${panel}-${part.name}-why`;
  if (part.fixed) box.append(make("p", { id, class: "why", text: whyFixed(part) }));
  return box;
}

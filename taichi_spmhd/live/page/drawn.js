// What is drawn: quantity, component, how, field lines, colours and their limits.
import { newest, send } from "./api.js";
import { byId, make, options, refill } from "./dom.js";
import { symbol } from "./greek.js";
import { labelled, section } from "./scene.js";
import { live, on } from "./store.js";
import { known, word } from "./words.js";

const AXES = ["x", "y", "z"];
const WAYS = ["particles", "nearest", "sph"];

/** Make the section and keep it up to date. */
export function startDrawn() {
  section("drawn", "drawn");
  on("language", () => refill(byId("drawn"), content()));
  on("language", show);
  on("setup", show);
}

/** A quantity with its name: "ρ density". */
export function quantity(name, axis, components) {
  const sign = symbol(name, axis, components);
  return known(`name.${name}`) ? `${sign} ${word(`name.${name}`)}` : sign;
}

/** What the pictures show, in words. */
export function shown() {
  const { draw, members } = live.setup;
  return quantity(draw.member, draw.axis, members.find((m) => m.name === draw.member)?.components ?? 1);
}

/** Send some keys of the action. */
const wish = (change) => send({ do: "draw", ...change });

/** The controls. */
function content() {
  const pick = (id, act) => make("select", { id, on: { change: (e) => act(e.target.value) } });
  const tick = (id, key, act) => {
    const box = make("input", { id, type: "checkbox", on: { change: (e) => act(e.target.checked) } });
    return make("label", { class: "check" }, box, make("span", { text: word(key) }));
  };
  const limits = newest((pair) => wish({ limits: pair }));
  const limit = (id) => {
    const field = make("input", { id, type: "number", step: "any", "aria-label": word(`limits.${id.slice(6)}`) });
    field.addEventListener("change", () => {
      const pair = [byId("limit-low"), byId("limit-high")].map((f) => (f.value === "" ? NaN : Number(f.value)));
      if (pair.every(Number.isFinite) && pair[0] < pair[1]) limits(pair);
    });
    return labelled(word(`limits.${id.slice(6)}`), field);
  };
  const auto = { click: () => wish({ limits: null }) };
  return [
    labelled(word("member"), pick("member", (member) => wish({ member, axis: null }))),
    labelled(word("component"), pick("axis", (axis) => wish({ axis: axis === "" ? null : Number(axis) }))),
    labelled(word("draw"), pick("draw", (way) => wish({ draw: way }))),
    tick("lines", "lines", (lines) => wish({ lines })),
    tick("log", "log", (log) => wish({ log })),
    make("div", { class: "pair" }, limit("limit-low"), limit("limit-high")),
    make("button", { id: "limits-auto", type: "button", text: word("limits.auto"), on: auto }),
  ];
}

/** Bring the controls in line with the setup. */
function show() {
  const setup = live.setup;
  if (!setup || !byId("member")) return;
  const { draw, members, box } = setup;
  const components = members.find((m) => m.name === draw.member)?.components ?? 1;
  options(byId("member"), members.map((m) => [m.name, quantity(m.name, null, 1)]), draw.member);
  const axes = AXES.slice(0, components).map((axis, k) => [String(k), axis]);
  options(byId("axis"), [["", word("magnitude")], ...(components > 1 ? axes : [])], draw.axis ?? "");
  byId("axis").parentElement.hidden = components === 1;
  options(byId("draw"), WAYS.map((way) => [way, word(`draw.${way}`)]), draw.draw);
  byId("draw").parentElement.hidden = box.profile;
  byId("lines").parentElement.hidden = box.profile || !members.some((m) => m.name === "B");
  byId("lines").checked = draw.lines;
  byId("log").checked = draw.log;
  ["limit-low", "limit-high"].forEach((id, k) => {
    if (document.activeElement !== byId(id)) byId(id).value = draw.limits ? Number(draw.limits[k].toPrecision(5)) : "";
  });
}

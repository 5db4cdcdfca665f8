// Which scene, with which parameters, variant and kernel.
import { send } from "./api.js";
import { byId, make, options, refill } from "./dom.js";
import { greek } from "./greek.js";
import { live, on } from "./store.js";
import { word } from "./words.js";

let shape = null;

/** A section of the settings; built once, filled by its module. */
export function section(id, key, open = true) {
  const unfolded = open && !matchMedia("(max-width: 699px)").matches; // a phone shows the effects first
  const box = make("details", { id: `section-${id}`, open: unfolded || id === "effects" });
  box.append(make("summary", { "data-word": key }), make("div", { id }));
  byId("settings").append(box);
}

/** A labelled control. */
export function labelled(text, control, tip = null) {
  return make("label", { class: "row", title: tip }, make("span", { text }), control);
}

/** Make the section and keep it up to date. */
export function startScene() {
  section("scene-box", "scene.section");
  on("setup", show);
  on("language", () => {
    shape = null;
    show();
  });
}

/** Build anew where other things can be chosen, else only bring values up to date. */
function show() {
  const setup = live.setup;
  if (!setup) return;
  const now = JSON.stringify([setup.scene, setup.parameters, setup.panels.map((p) => [p.label, p.variants])]);
  if (shape !== now) refill(byId("scene-box"), content(setup));
  shape = now;
  options(byId("scene"), setup.scenes.map(({ name }) => [name, name]), setup.scene);
  byId("scene").title = setup.title;
  setup.panels.forEach((panel, k) => {
    options(byId(`variant-${k}`), panel.variants.map((name) => [name, greek(name)]), panel.variant);
    options(byId(`kernel-${k}`), setup.kernels.map((name) => [name, name]), panel.kernel);
  });
}

/** All controls of the section. */
function content(setup) {
  const scene = make("select", { id: "scene", on: { change: (e) => send({ do: "choose", scene: e.target.value }) } });
  const about = make("details", { id: "about" }, make("summary", { text: word("about") }));
  about.append(make("p", { class: "prose", text: greek(setup.about) }));
  return [labelled(word("scene"), scene), about, ...setup.panels.flatMap(ofPanel), form(setup)];
}

/** Variant and kernel of one panel. */
function ofPanel(panel, k, panels) {
  const name = (key) => (panels.length > 1 ? `${word(key)} ${panel.label}` : word(key));
  const choose = (key) => ({ change: (e) => send({ do: "choose", panel: k, [key]: e.target.value }) });
  return [
    labelled(name("variant"), make("select", { id: `variant-${k}`, on: choose("variant") })),
    labelled(name("kernel"), make("select", { id: `kernel-${k}`, on: choose("kernel") })),
  ];
}

/** The parameters, sent together. */
function form(setup) {
  const inputs = setup.parameters.map(input);
  const rows = setup.parameters.map((parameter, k) => labelled(greek(parameter.name), inputs[k]));
  const apply = make("button", { id: "apply", type: "submit", text: word("apply") });
  const box = make("form", { id: "parameters", "aria-label": word("parameters") }, ...rows, apply);
  const folded = make("details", { id: "parameters-box" }, make("summary", { text: word("parameters") }), box);
  box.addEventListener("submit", (event) => {
    event.preventDefault();
    const set = {};
    setup.parameters.forEach((parameter, k) => {
      const value = read(parameter, inputs[k]);
      if (value !== parameter.value) set[parameter.name] = value;
    });
    send({ do: "choose", set });
  });
  return folded;
}

/** A field for one parameter, by its kind. */
function input({ name, kind, value, choices }) {
  const id = `parameter-${name}`;
  if (choices?.length) {
    const select = make("select", { id });
    options(select, choices.map((choice) => [choice, choice]), value);
    return select;
  }
  if (kind === "bool") return make("input", { id, type: "checkbox", checked: value });
  if (kind === "str") return make("input", { id, type: "text", maxlength: 100, value: value ?? "" });
  const step = kind === "int" ? 1 : "any";
  return make("input", { id, type: "number", step, value: value ?? "", required: value !== null });
}

/** Its value, of the right type. */
function read({ kind, value, choices }, field) {
  if (kind === "bool") return field.checked;
  if (kind === "str" || choices?.length) return value === null && field.value === "" ? null : field.value;
  return field.value === "" ? null : Number(field.value);
}

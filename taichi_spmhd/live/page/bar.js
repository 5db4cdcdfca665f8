// The bar: play, pause, step, reset, speed, second panel, pointer tools; and the keys that do the same.
import { newest, send } from "./api.js";
import { byId, make, write } from "./dom.js";
import { live, on } from "./store.js";
import { short } from "./ticks.js";
import { speak, spoken, translate, word } from "./words.js";

export const tool = { name: "look", radius: 0.12, strength: 1 };
const TOOLS = ["look", "push", "pressure", "field"];

/** Wire the bar. */
export function startBar() {
  byId("play").addEventListener("click", playOrPause);
  byId("step").addEventListener("click", () => send({ do: "step" }));
  byId("reset").addEventListener("click", () => send({ do: "reset" }));
  byId("language").addEventListener("click", () => speak(spoken() === "en" ? "ja" : "en"));
  byId("second").addEventListener("change", (event) => send({ do: "panels", count: event.target.checked ? 2 : 1 }));
  const speed = newest((value) => send({ do: "speed", value }));
  byId("speed").addEventListener("input", (event) => event.target.validity.valid && speed(Number(event.target.value)));
  document.addEventListener("keydown", key);
  makeTools();
  on("state", show);
  on("language", show);
  on("setup", offered);
}

/** The other of play and pause. */
function playOrPause() {
  return send({ do: live.state?.playing ? "pause" : "play" });
}

/** Radio buttons of the tools, and the sliders of the brush. */
function makeTools() {
  for (const name of TOOLS) {
    const radio = make("input", { type: "radio", name: "tool", id: `tool-${name}`, value: name });
    radio.addEventListener("change", () => choose(name));
    const text = make("span", { "data-word": `tool.${name}` });
    byId("tools").append(make("label", { class: "check", "data-tip": `tool.${name}.tip` }, radio, text));
  }
  for (const name of ["radius", "strength"]) {
    byId(name).addEventListener("input", (event) => {
      tool[name] = Number(event.target.value);
      choose(tool.name);
    });
  }
  translate(byId("tools"));
  choose("look");
}

/** Take a tool; the style sheet shows the brush that belongs to it. */
function choose(name) {
  tool.name = name;
  byId(`tool-${name}`).checked = true;
  document.body.dataset.tool = name;
  write(byId("strength-now"), short(tool.strength));
}

/** Only the tools that this scene allows. */
function offered() {
  const allowed = ["look", ...live.setup.pokes];
  for (const name of TOOLS) byId(`tool-${name}`).parentElement.hidden = !allowed.includes(name);
  if (!allowed.includes(tool.name)) choose("look");
  byId("second").checked = live.setup.panels.length === 2;
  write(byId("sight"), live.setup.title);
}

/** Bring buttons in line with the state. */
function show() {
  const state = live.state;
  if (!state) return;
  write(byId("play"), word(state.playing ? "pause" : "play"));
  byId("play").dataset.playing = state.playing;
  if (document.activeElement !== byId("speed")) byId("speed").value = state.speed;
}

/** Keys, unless somebody types. */
function key(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return;
  if (event.target.closest("input:not([type=range]), select, textarea")) return;
  if (event.key === " " && event.target.closest("button, summary, a")) return;
  const keys = { " ": playOrPause, s: () => send({ do: "step" }), r: () => send({ do: "reset" }) };
  const done = keys[event.key.toLowerCase()];
  if (!done) return;
  event.preventDefault();
  if (!event.repeat || event.key.toLowerCase() === "s") done();
}

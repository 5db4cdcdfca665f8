// The numbers below a picture.
import { make, write } from "./dom.js";
import { on } from "./store.js";
import { count, short } from "./ticks.js";
import { word } from "./words.js";

const NUMBERS = {
  t: (s) => short(s.t, 4),
  steps: (s) => String(s.steps),
  particles: (s) => String(s.particles),
  ms: (s) => short(s.ms || null), // 0: nothing measured yet
  updates: (s) => count(s.updates || null),
  gap: (s) => short(s.mean_gap),
  close: (s) => (s.close_pairs === null ? "–" : `${short(100 * s.close_pairs)} %`),
  growth: (s) => `${short(s.growth)} | ${short(s.growth_predicted)}`,
};

/** {element, show(state of the panel)}: a list of names and values, made once. */
export function readout(k) {
  const names = {};
  const values = {};
  const element = make("dl", { class: "readout", id: `readout-${k}` });
  for (const key of Object.keys(NUMBERS)) {
    names[key] = make("dt", { text: word(`read.${key}`) });
    values[key] = make("dd", { id: `read-${k}-${key}` });
    element.append(make("div", {}, names[key], values[key]));
  }
  const rename = () => Object.keys(NUMBERS).forEach((key) => write(names[key], word(`read.${key}`)));
  on("language", rename);
  const show = (state) => {
    for (const [key, text] of Object.entries(NUMBERS)) write(values[key], text(state));
    values.growth.parentElement.hidden = (state.growth ?? null) === null && (state.growth_predicted ?? null) === null;
    values.gap.parentElement.hidden = values.close.parentElement.hidden = (state.mean_gap ?? null) === null;
  };
  return { element, show };
}

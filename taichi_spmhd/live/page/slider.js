// One number that slides: a slider and a field, both sending at once; what is older and unsent is dropped.
import { newest, send } from "./api.js";
import { make } from "./dom.js";
import { equation, greek } from "./greek.js";
import { short } from "./ticks.js";
import { word } from "./words.js";

const QUIET = 600; // milliseconds after the last touch in which the server's (older) value is not shown

/** {element, show(value)} for a number of a part. */
export function slider(panel, part, partName, number) {
  const id = `number-${panel}-${part}-${number.name}`;
  const name = word("value.of", { name: greek(number.name), part: partName });
  const tip = word("range", { low: short(number.low), high: short(number.high) });
  const bounds = { min: number.low, max: number.high, title: tip };
  const range = make("input", { ...bounds, id, type: "range", step: stepOf(number), "aria-label": name });
  const field = make("input", { ...bounds, id: `${id}-field`, type: "number", step: "any", "aria-label": name });
  const back = make("button", { type: "button", class: "back", text: "↺", id: `${id}-back` });
  back.title = word("back.to", { value: short(number.start) });
  back.setAttribute("aria-label", `${name}: ${back.title}`);
  const touched = { at: -QUIET };
  const post = newest((value) => send({ do: "number", panel, part, name: number.name, value }));
  const set = (value) => {
    touched.at = performance.now();
    post(value);
  };
  range.addEventListener("input", () => {
    field.value = range.value;
    set(Number(range.value));
  });
  field.addEventListener("input", () => {
    if (field.value === "" || !field.validity.valid) return;
    range.value = field.value;
    set(Number(field.value));
  });
  back.addEventListener("click", () => {
    range.value = field.value = number.start;
    set(number.start);
  });
  const show = (value) => {
    if (performance.now() - touched.at < QUIET || document.activeElement === field) return;
    range.value = value;
    field.value = Number(value.toPrecision(6));
  };
  show(number.value);
  const label = make("label", { for: id, title: number.name }, equation(number.name));
  return { element: make("div", { class: "slider" }, label, range, field, back), show };
}

/** A round step, a hundredth of the range or finer, so that 0, 1/2 and 1 can be met. */
function stepOf({ low, high }) {
  return 10 ** Math.floor(Math.log10((high - low) / 50)) || "any";
}

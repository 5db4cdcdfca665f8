// The pictures of one or two panels: laid out in the room there is, with the colour bar and the numbers below.
import { colourBar } from "./axes.js";
import { byId, write } from "./dom.js";
import { feed, frames } from "./frames.js";
import { Panel } from "./panel.js";
import { live, on } from "./store.js";
import { short } from "./ticks.js";
import { spoken, word } from "./words.js";

const made = []; // panels ever made; they are reused
const TELL = 250; // milliseconds between two texts below the pictures
let shownPanels = [];
let told = 0;
let due = 0;
let below = 0; // the most height that the numbers below a picture have taken
let laid = null; // what the layout was made for

/** Follow the setup, the state and the window. */
export function startPictures() {
  on("setup", lay);
  on("language", lay);
  on("state", tellSoon);
  let waiting = 0;
  const later = () => {
    clearTimeout(waiting);
    waiting = setTimeout(lay, 100);
  };
  new ResizeObserver(later).observe(byId("pictures"));
  addEventListener("resize", later);
  frames();
}

/** All that the layout depends on. */
function occasion() {
  const { box, draw, palette, panels } = live.setup;
  const section = byId("pictures");
  const size = [section.clientWidth, section.clientHeight, innerHeight, devicePixelRatio];
  return JSON.stringify([box, draw, palette, panels.map((p) => [p.label, p.variant]), size, spoken()]);
}

/** One or two panels, as large as fits. */
function lay() {
  if (!live.setup) return;
  const now = occasion();
  if (now === laid) return;
  laid = now;
  below = 0;
  fill();
}

/** Panels, colour bar and axes anew. */
function fill() {
  const number = live.setup.panels.length;
  while (made.length < number) made.push(new Panel(made.length));
  const before = JSON.stringify(shownPanels.map((panel) => panel.size));
  if (shownPanels.length !== number) {
    shownPanels = made.slice(0, number);
    byId("panels").replaceChildren(...shownPanels.map((panel) => panel.element));
  }
  document.body.dataset.panels = number;
  const wide = byId("pictures").clientWidth - 8;
  const bar = colourBar(Math.min(wide, 620));
  byId("colours").replaceChildren(...(bar ? [bar] : []));
  const [w, h] = room(wide, number);
  for (const panel of shownPanels) panel.lay(w, h);
  if (before !== JSON.stringify(shownPanels.map((panel) => panel.size))) feed(shownPanels);
}

/** Room for the stage of each panel: beside each other where the page is wide, else below. */
function room(wide, number) {
  const section = byId("pictures");
  if (matchMedia("(max-width: 699px)").matches) {
    return number === 2 ? [wide / 2 - 4, innerHeight * 0.5] : [wide, innerHeight * 0.6];
  }
  below = Math.max(below, ...shownPanels.map((panel) => panel.readout.element.offsetHeight));
  const used = byId("colours").offsetHeight + byId("clock").offsetHeight + below + 24;
  const fixed = matchMedia("(min-width: 1100px)").matches;
  const high = fixed ? section.clientHeight - used : innerHeight * 0.65;
  return [(wide - 12 * (number - 1)) / number, Math.max(220, high)];
}

/** Texts below the pictures, a few times a second; the last state is always told. */
function tellSoon() {
  due ||= setTimeout(tellNumbers, Math.max(0, TELL - (performance.now() - told)));
}

/** Texts below the pictures, now. */
function tellNumbers() {
  clearTimeout(due);
  due = 0;
  told = performance.now();
  if (!live.state || !live.setup) return;
  shownPanels.forEach((panel, k) => live.state.panels[k] && panel.tell(live.state.panels[k]));
  const { frames_per_s: frames, share } = live.state.clock;
  const height = Math.max(...shownPanels.map((panel) => panel.readout.element.offsetHeight));
  write(byId("clock"), word("read.frames", { frames: short(frames), share: short(100 * share) }));
  if (height > below && below > 0) fill(); // a number that was not there before takes room
}

// One panel: the picture (a canvas), its axes and brush (an SVG over it), and what is written below.
import { axes, MARGIN, ranges } from "./axes.js";
import { shown } from "./drawn.js";
import { draw, make, write } from "./dom.js";
import { greek } from "./greek.js";
import { pointer } from "./pointer.js";
import { readout } from "./readout.js";
import { live } from "./store.js";
import { short } from "./ticks.js";
import { word } from "./words.js";

const SHARPEST = 1.5; // pixels of the picture a pixel of the page: more costs time and shows little
const LARGEST = { particles: 1200, nearest: 800, sph: 800 }; // of the longer side: smooth pictures cost by the pixel

/** The panel number k; elements are made once and reused. */
export class Panel {
  constructor(k) {
    this.k = k;
    this.canvas = make("canvas", { id: `picture-${k}`, class: "picture", role: "img", tabindex: 0 });
    this.marks = draw("svg", { class: "marks", "aria-hidden": "true" });
    this.over = draw("svg", { class: "over", "aria-hidden": "true" });
    this.sign = make("p", { class: "sign", hidden: true });
    this.stage = make("div", { class: "stage" }, this.marks, this.canvas, this.over, this.sign);
    this.readout = readout(k);
    this.element = make("figure", { class: "panel" }, this.stage, this.readout.element);
    this.size = null;
    pointer(this);
  }

  /** Width and height of the frames to ask for. */
  get pixels() {
    const largest = live.setup.box.profile ? LARGEST.particles : LARGEST[live.setup.draw.draw];
    const sharp = Math.min(devicePixelRatio || 1, SHARPEST, largest / Math.max(...this.size));
    return this.size.map((side) => Math.max(64, 2 * Math.round((side * sharp) / 2)));
  }

  /** Fit the field into the room there is, in the shape of the box, and draw the axes. */
  lay(width, height) {
    const [across, up] = ranges();
    const shape = live.setup.box.profile ? Math.max(4 / 3, width / height) : (across[1] - across[0]) / (up[1] - up[0]);
    const room = [width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom];
    const w = Math.max(64, Math.floor(Math.min(room[0], room[1] * shape)));
    const h = Math.max(48, Math.floor(w / shape));
    this.size = [w, h];
    const whole = [w + MARGIN.left + MARGIN.right, h + MARGIN.top + MARGIN.bottom];
    this.stage.style.width = `${whole[0]}px`;
    this.stage.style.height = `${whole[1]}px`;
    for (const side of [this.canvas, this.over]) {
      side.style.left = `${MARGIN.left}px`;
      side.style.top = `${MARGIN.top}px`;
      side.style.width = `${w}px`;
      side.style.height = `${h}px`;
    }
    const { label, variant } = live.setup.panels[this.k];
    const title = greek(live.setup.panels.length > 1 ? `${label}: ${variant}` : variant);
    this.marks.replaceChildren(...axes(w, h, title));
  }

  /** Show a decoded frame. */
  show(bitmap) {
    if (this.canvas.width !== bitmap.width) this.canvas.width = bitmap.width;
    if (this.canvas.height !== bitmap.height) this.canvas.height = bitmap.height;
    this.canvas.getContext("2d", { alpha: false }).drawImage(bitmap, 0, 0);
  }

  /** The numbers below, and what the picture shows in words. */
  tell(state) {
    this.readout.show(state);
    write(this.sign, state.failed ? word("failed.here") : "");
    this.sign.hidden = !state.failed;
    const [low, high] = live.setup.draw.limits ?? [null, null];
    const words = word("picture.of", {
      label: state.label,
      what: shown(),
      particles: state.particles,
      t: short(state.t),
      low: short(low),
      high: short(high),
      gap: short(state.mean_gap),
      close: short(100 * (state.close_pairs ?? 0)),
    });
    this.canvas.setAttribute("aria-label", `${words} ${word("picture.keys")}`);
  }
}

// The live plots: which columns they show, their legends with the last value in words. Panel A solid, panel B dashed.
import { chart, inks } from "./chart.js";
import { byId, make, write } from "./dom.js";
import { points } from "./rows.js";
import { live, on } from "./store.js";
import { count, short } from "./ticks.js";
import { word } from "./words.js";

const PLOTS = [
  { key: "energy", columns: { measured: "E_drift", predicted: "E_drift_predicted" }, zero: true },
  { key: "momentum", columns: { measured: "p_drift", predicted: "p_drift_predicted" }, zero: true },
  { key: "clumping", columns: { mean_gap: "mean_gap", close_pairs: "close_pairs" }, zero: true },
  { key: "divergence", columns: { value: "div_B" }, log: true },
  { key: "error", columns: { value: "error" }, zero: true },
  { key: "noise", columns: { value: "noise" }, log: true },
  { key: "ms", columns: { value: "ms" }, zero: true, speed: true },
  { key: "updates", columns: { value: "updates" }, zero: true, speed: true, text: count },
];
const COLOURS = ["measured", "predicted"];
const APART = 200; // milliseconds between two drawings

let due = false;
let colours = null;
const made = [];

/** Make the plots once; draw them when there are rows, another theme, another size. */
export function startPlots() {
  for (const plot of PLOTS) made.push(new Plot(plot));
  byId("plots").append(...made.map((plot) => plot.element));
  on("theme", () => {
    colours = null;
    soon();
  });
  for (const name of ["rows", "setup", "language"]) on(name, soon);
  new ResizeObserver(soon).observe(byId("plots"));
}

/** Draw all, a few times a second at most. */
function soon() {
  if (due) return;
  due = true;
  setTimeout(() => {
    due = false;
    if (!live.setup || document.hidden) return;
    colours ??= inks();
    for (const plot of made) plot.draw();
  }, APART);
}

/** One plot with its caption; its elements are made once. */
class Plot {
  constructor(plot) {
    this.plot = plot;
    this.canvas = make("canvas", { class: "chart", id: `plot-${plot.key}`, role: "img" });
    this.title = make("span", { class: "name" });
    this.legend = make("span", { class: "legend", id: `last-${plot.key}` });
    this.element = make("figure", { class: "plot" }, make("figcaption", {}, this.title, this.legend), this.canvas);
  }

  /** Lines of all panels: {points, colour, dashed, panel, name}. */
  lines() {
    return live.setup.panels.flatMap((panel, k) =>
      Object.entries(this.plot.columns).map(([name, column], c) => {
        const found = points(k, column, !this.plot.speed);
        return { points: found, colour: COLOURS[c], dashed: k > 0, panel: panel.label, name };
      }),
    );
  }

  /** Bring picture and words up to date; a plot without any value is hidden. */
  draw() {
    const lines = this.lines();
    this.element.hidden = !lines.some((line) => line.points.length);
    if (this.element.hidden) return;
    const title = word(`plot.${this.plot.key}`);
    write(this.title, title);
    const words = this.entries(lines);
    this.canvas.setAttribute("aria-label", word("plot.of", { title, values: words.join(", ") }));
    chart(this.canvas, lines, { log: this.plot.log, zero: this.plot.zero, colours });
  }

  /** The legend: a piece for each line, with its last value. Returns them as texts. */
  entries(lines) {
    const several = live.setup.panels.length > 1;
    const text = this.plot.text ?? short;
    const words = lines.map((line) => {
      const name = line.name === "value" ? (several ? line.panel : "") : word(`line.${line.name}`);
      const from = several && line.name !== "value" ? `${line.panel} ` : "";
      return `${from}${name} ${text(line.points.at(-1)?.[1])}`.trim();
    });
    while (this.legend.childElementCount < lines.length) this.legend.append(make("span"));
    while (this.legend.childElementCount > lines.length) this.legend.lastChild.remove();
    lines.forEach((line, k) => {
      const piece = this.legend.children[k];
      piece.className = `${line.colour}${line.dashed ? " dashed" : ""}`;
      piece.hidden = !line.points.length;
      write(piece, words[k]);
    });
    return words.filter((_, k) => lines[k].points.length);
  }
}

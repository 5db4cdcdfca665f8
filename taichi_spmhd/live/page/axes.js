// Axes of a panel, and the colour bar: SVG drawn by the page, so that numbers stay sharp and can be read aloud.
import { shown } from "./drawn.js";
import { draw } from "./dom.js";
import { live } from "./store.js";
import { powers, short, ticks } from "./ticks.js";
import { word } from "./words.js";

export const MARGIN = { left: 46, right: 10, top: 22, bottom: 34 };
const BAR = { height: 12, side: 26 };

/** Low and high of the horizontal and the vertical axis of a picture. */
export function ranges() {
  const { box, draw: drawn } = live.setup;
  const across = [box.lo[0], box.hi[0]];
  if (box.profile) return [across, drawn.limits ?? [0, 1]];
  return [across, [box.lo[1], box.hi[1]]];
}

/** Place of a value on an axis, 0..1; log where asked. */
const place = (value, [lo, hi], log) =>
  log ? Math.log(value / lo) / Math.log(hi / lo) : (value - lo) / (hi - lo);

/** Whether values are drawn on a logarithmic scale. */
const isLog = () => live.setup.draw.log && live.setup.draw.limits?.[0] > 0;

/** Frame, ticks and names of the axes around a field of w x h pixels. */
export function axes(w, h, title) {
  const [across, up] = ranges();
  const profile = live.setup.box.profile;
  const log = profile && isLog();
  const { left, top } = MARGIN;
  const marks = [draw("rect", { class: "frame", x: left - 0.5, y: top - 0.5, width: w + 1, height: h + 1 })];
  for (const value of ticks(...across, Math.max(2, Math.min(6, w / 70)))) {
    const x = left + place(value, across) * w;
    marks.push(draw("path", { class: "tick", d: `M${x} ${top + h}v5` }));
    marks.push(draw("text", { x, y: top + h + 17, "text-anchor": "middle", text: short(value) }));
  }
  const number = Math.max(2, Math.min(6, h / 60));
  for (const value of log ? powers(...up, number) : ticks(...up, number)) {
    const y = top + (1 - place(value, up, log)) * h;
    marks.push(draw("path", { class: "tick", d: `M${left - 5} ${y}h5` }));
    marks.push(draw("text", { x: left - 8, y: y + 4, "text-anchor": "end", text: short(value) }));
  }
  const below = { x: left + w / 2, y: top + h + 31, "text-anchor": "middle", class: "axis", text: "x" };
  const side = profile ? shown() : "y";
  const beside = { class: "axis", "text-anchor": profile ? "start" : "end", x: profile ? left : left - 30, text: side };
  marks.push(draw("text", below), draw("text", { ...beside, y: profile ? top - 7 : top + h / 2 + 4 }));
  if (title) marks.push(draw("text", { class: "title", x: left + w, y: top - 7, "text-anchor": "end", text: title }));
  return marks;
}

/** The colour bar, `width` pixels wide, as an SVG; none where the vertical axis tells the value. */
export function colourBar(width) {
  const { draw: drawn, palette, box } = live.setup;
  if (box.profile || !drawn.limits || width < 120) return null;
  const [low, high] = drawn.limits;
  const label = word("colours.of", { what: shown(), low: short(low), high: short(high) });
  const svg = draw("svg", { width, height: 48, role: "img", "aria-label": label });
  const stops = palette.map((colour, k) => draw("stop", { offset: k / (palette.length - 1), "stop-color": colour }));
  svg.append(draw("defs", {}, draw("linearGradient", { id: "shades" }, ...stops)));
  const long = width - 2 * BAR.side;
  svg.append(draw("text", { class: "title", x: BAR.side, y: 12, text: shown() }));
  const strip = { x: BAR.side, y: 18, width: long, height: BAR.height, fill: "url(#shades)", class: "shades" };
  svg.append(draw("rect", strip));
  const log = isLog();
  for (const value of log ? powers(low, high, 6) : ticks(low, high, Math.min(7, width / 70))) {
    const x = BAR.side + place(value, [low, high], log) * long;
    svg.append(draw("path", { class: "tick", d: `M${x} ${18 + BAR.height}v4` }));
    svg.append(draw("text", { x, y: 45, "text-anchor": "middle", text: short(value) }));
  }
  return svg;
}

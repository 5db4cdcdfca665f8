// A small chart on a canvas: lines, axes, grid; sharp on fine displays. No dependency.
import { powers, short, ticks } from "./ticks.js";

const EDGE = { left: 44, right: 8, top: 6, bottom: 18 };
const FLOOR = 1e-16; // of logarithmic charts

/** Colours of the page's style sheet, read once per theme. */
export function inks() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(name).trim();
  return { ink: read("--soft"), grid: read("--line"), measured: read("--measured"), predicted: read("--predicted") };
}

/** Draw lines [{points: [[t, value], ...], colour, dashed}] into a canvas. */
export function chart(canvas, lines, { log, colours, zero }) {
  const [w, h] = fit(canvas);
  const c = canvas.getContext("2d");
  c.clearRect(0, 0, w, h);
  const kept = log ? lines.map(positive) : lines;
  const all = kept.flatMap((line) => line.points);
  if (!all.length) return;
  const x = scale(all.map((p) => p[0]), EDGE.left, w - EDGE.right, {});
  const y = scale(all.map((p) => p[1]), h - EDGE.bottom, EDGE.top, { log, zero });
  grid(c, x, y, w, h, colours, log);
  c.save();
  c.beginPath();
  c.rect(EDGE.left, 0, w - EDGE.left - EDGE.right + 1, h - EDGE.bottom + 1);
  c.clip();
  for (const line of kept) stroke(c, line, x, y, colours);
  c.restore();
}

/** Match the canvas to its size on the page; width and height in pixels of the page. */
function fit(canvas) {
  const sharp = devicePixelRatio || 1;
  const [w, h] = [canvas.clientWidth, canvas.clientHeight];
  const [wide, high] = [Math.round(w * sharp), Math.round(h * sharp)];
  if (canvas.width !== wide) canvas.width = wide;
  if (canvas.height !== high) canvas.height = high;
  canvas.getContext("2d").setTransform(sharp, 0, 0, sharp, 0, 0);
  return [w, h];
}

/** What a logarithmic axis can show. */
function positive(line) {
  return { ...line, points: line.points.filter((p) => p[1] > FLOOR) };
}

/** A map from values to pixels with a little room: function with lo and hi. */
function scale(values, from, to, { log, zero }) {
  let lo = values.reduce((a, b) => Math.min(a, b), Infinity);
  let hi = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (zero) [lo, hi] = [Math.min(lo, 0), Math.max(hi, 0)];
  const half = (Math.abs(hi) || 1) / 2;
  if (!(hi - lo > 1e-12 * Math.abs(hi))) [lo, hi] = log ? [lo / 2, hi * 2] : [lo - half, hi + half]; // a level line
  const way = log ? Math.log : (value) => value;
  const map = (value) => from + ((way(value) - way(lo)) / (way(hi) - way(lo))) * (to - from);
  return Object.assign(map, { lo, hi });
}

/** Grid lines with numbers. */
function grid(c, x, y, w, h, colours, log) {
  c.font = "10px system-ui, sans-serif";
  c.fillStyle = colours.ink;
  c.strokeStyle = colours.grid;
  c.lineWidth = 1;
  c.beginPath();
  c.textAlign = "right";
  c.textBaseline = "middle";
  for (const value of log ? powers(y.lo, y.hi, 4) : ticks(y.lo, y.hi, 3)) {
    const at = Math.round(y(value)) + 0.5;
    c.moveTo(EDGE.left, at);
    c.lineTo(w - EDGE.right, at);
    c.fillText(short(value), EDGE.left - 4, at);
  }
  c.fillText("t", EDGE.left - 4, h - 8);
  c.textAlign = "center";
  c.textBaseline = "alphabetic";
  for (const value of ticks(x.lo, x.hi, 4)) {
    const at = Math.min(x(value), w - 12);
    c.moveTo(Math.round(x(value)) + 0.5, h - EDGE.bottom);
    c.lineTo(Math.round(x(value)) + 0.5, h - EDGE.bottom + 4);
    c.fillText(short(value), at, h - 4);
  }
  c.stroke();
}

/** One line; a single point is a dot. */
function stroke(c, { points, colour, dashed }, x, y, colours) {
  if (!points.length) return;
  c.strokeStyle = c.fillStyle = colours[colour];
  c.lineWidth = 1.6;
  c.setLineDash(dashed ? [5, 3] : []);
  c.beginPath();
  for (const [t, value] of points) c.lineTo(x(t), y(value));
  c.stroke();
  c.setLineDash([]);
  if (points.length === 1) c.fillRect(x(points[0][0]) - 1.5, y(points[0][1]) - 1.5, 3, 3);
}

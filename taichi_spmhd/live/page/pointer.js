// What the pointer and the arrow keys do on a picture: read a particle, push, add a pulse.
import { getJSON, newest, send } from "./api.js";
import { ranges } from "./axes.js";
import { tool } from "./bar.js";
import { draw, make } from "./dom.js";
import { greek } from "./greek.js";
import { live } from "./store.js";
import { short } from "./ticks.js";
import { word } from "./words.js";

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const STRIDE = 0.03; // of the box, an arrow key
const FORCE = 4; // a stroke over a brush's width gives about a quarter of the fastest signal speed at strength 1

/** Wire a panel. */
export function pointer(panel) {
  const { canvas, over } = panel;
  const table = make("table", { class: "reading", id: `reading-${panel.k}`, hidden: true, "aria-live": "off" });
  panel.stage.append(table);
  const cross = { at: null };
  const read = newest((at) => reading(panel, at, table));
  const shove = pushing(panel);
  let held = null;

  const look = (at) => {
    brush(panel, at);
    if (tool.name === "look") read(at);
    else table.hidden = true;
  };
  canvas.addEventListener("pointermove", (event) => {
    const at = placeOf(panel, event);
    look(at);
    if (held && tool.name === "push") shove(at, [at[0] - held[0], at[1] - held[1]]);
    if (held) held = at;
  });
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held = placeOf(panel, event);
    cross.at = held;
    look(held);
    pulse(panel, held);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => (held = null));
  canvas.addEventListener("pointerleave", () => {
    over.replaceChildren();
    table.hidden = true;
  });
  canvas.addEventListener("blur", () => {
    over.replaceChildren();
    table.hidden = true;
  });
  canvas.addEventListener("keydown", (event) => {
    const [across, up] = ranges();
    cross.at ??= [(across[0] + across[1]) / 2, (up[0] + up[1]) / 2];
    if (event.key === "Enter") return pulse(panel, cross.at);
    const arrow = ARROWS[event.key];
    if (!arrow) return undefined;
    event.preventDefault();
    const by = [arrow[0] * STRIDE * (across[1] - across[0]), arrow[1] * STRIDE * (up[1] - up[0])];
    if (event.shiftKey && tool.name === "push") return shove(cross.at, by);
    cross.at = [clamp(cross.at[0] + by[0], across), clamp(cross.at[1] + by[1], up)];
    return look(cross.at);
  });
}

const clamp = (value, [lo, hi]) => Math.min(hi, Math.max(lo, value));

/** Where in the box an event happened. */
function placeOf(panel, event) {
  const [across, up] = ranges();
  const rect = panel.canvas.getBoundingClientRect();
  const x = across[0] + ((event.clientX - rect.left) / rect.width) * (across[1] - across[0]);
  const y = up[1] - ((event.clientY - rect.top) / rect.height) * (up[1] - up[0]);
  return [clamp(x, across), clamp(y, up)];
}

/** x and y for the server: in a profile the vertical axis is no place, there the middle of the box. */
function asked([x, y]) {
  const { box } = live.setup;
  return { x, y: box.profile ? (box.dim > 1 ? (box.lo[1] + box.hi[1]) / 2 : box.lo[0]) : y };
}

/** Radius of the brush in lengths of the box: parts of its shorter side, of its length where it is a profile. */
function radius() {
  const { box } = live.setup;
  const sides = box.lo.map((lo, a) => box.hi[a] - lo);
  return tool.radius * (box.profile ? sides[0] / 4 : Math.min(...sides.slice(0, 2)));
}

/** A function that pushes: what was moved while a request is on its way is added up. */
function pushing(panel) {
  let sum = [0, 0];
  const post = newest((at) => {
    const [dx, dy] = sum;
    sum = [0, 0];
    const by = { dx: FORCE * tool.strength * dx, dy: live.setup.box.profile ? 0 : FORCE * tool.strength * dy };
    return send({ do: "poke", panel: panel.k, kind: "push", ...asked(at), ...by, radius: radius() });
  });
  return (at, [dx, dy]) => {
    sum = [sum[0] + dx, sum[1] + dy];
    post(at);
  };
}

/** Add a pulse of pressure or field, if such a tool is taken. */
function pulse(panel, at) {
  if (tool.name !== "pressure" && tool.name !== "field") return;
  send({ do: "poke", panel: panel.k, kind: tool.name, ...asked(at), strength: tool.strength, radius: radius() });
}

/** Draw the brush, or a cross where one only looks. */
function brush(panel, at) {
  const [across, up] = ranges();
  const [w, h] = panel.size;
  const x = ((at[0] - across[0]) / (across[1] - across[0])) * w;
  const y = (1 - (at[1] - up[0]) / (up[1] - up[0])) * h;
  const r = (radius() / (across[1] - across[0])) * w;
  const cross = () => draw("path", { d: `M${x - 7} ${y}h14M${x} ${y - 7}v14` });
  panel.over.replaceChildren(tool.name === "look" ? cross() : draw("circle", { cx: x, cy: y, r }));
}

/** Ask for the particle at a place and show its members in a small table beside it. */
async function reading(panel, at, table) {
  const { x, y } = asked(at);
  const place = `x=${x.toPrecision(7)}&y=${y.toPrecision(7)}`;
  const found = await getJSON(`particle?panel=${panel.k}&${place}`).catch(() => null);
  if (!found?.members || tool.name !== "look" || !panel.over.childElementCount) return;
  const cell = (value) => (Array.isArray(value) ? value.map((one) => short(one)).join(", ") : short(value));
  const rows = Object.entries(found.members).map(([name, value]) =>
    make("tr", {}, make("th", { scope: "row", text: greek(name) }), make("td", { text: cell(value) })));
  table.replaceChildren(make("caption", { text: word("particle", { id: found.id }) }), ...rows);
  const [across] = ranges();
  table.dataset.side = at[0] > (across[0] + across[1]) / 2 ? "left" : "right";
  table.hidden = false;
}

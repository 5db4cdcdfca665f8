// The frames of the panels by long polls: both of the same number, decoded, drawn, and let go.
import { get, pause } from "./api.js";
import { live } from "./store.js";

let shownPanels = [];
let gone = new AbortController(); // of the frames asked for in a size that is no longer wanted

/** The panels that are on the page now; what was asked for others, or in another size, is let go. */
export function feed(panels) {
  shownPanels = panels;
  gone.abort();
  gone = new AbortController();
}

/** Ask for a frame newer than `after`: {number, blob}, or null where the answer is none. */
async function frame(k, after) {
  const [width, height] = shownPanels[k].pixels;
  const answer = await get(`frame?panel=${k}&after=${after}&width=${width}&height=${height}`, { signal: gone.signal });
  const number = Number(answer.headers.get("X-Frame"));
  const blob = await answer.blob();
  return answer.status === 200 && blob.size && number > after ? { number, blob } : null;
}

/** Frames of all panels with the same number; whichever lags behind is asked for again. */
async function together(after) {
  const found = await Promise.all(shownPanels.map((_, k) => frame(k, after)));
  for (let tries = 0; tries < 5 && found.every(Boolean); tries++) {
    const newest = Math.max(...found.map((one) => one.number));
    const behind = found.findIndex((one) => one.number < newest);
    if (behind < 0) return found;
    found[behind] = await frame(behind, newest - 1);
  }
  return null;
}

/** Decode and draw; nothing is kept. */
async function show(found, panels) {
  const bitmaps = await Promise.all(found.map((one) => createImageBitmap(one.blob)));
  if (panels === shownPanels) bitmaps.forEach((bitmap, k) => panels[k].show(bitmap));
  bitmaps.forEach((bitmap) => bitmap.close());
  live.frames.shown += 1;
  live.frames.number = found[0].number;
}

/** Until the tab can be seen. */
function visible() {
  if (!document.hidden) return null;
  return new Promise((done) => document.addEventListener("visibilitychange", done, { once: true }));
}

/** Ask, show, ask again, for ever; with patience where nobody answers. */
export async function frames() {
  let after = -1;
  let lost = 0;
  let size = null;
  for (;;) {
    await visible();
    if (!shownPanels.length || !live.connected) {
      await pause(100);
      continue;
    }
    const now = JSON.stringify(shownPanels.map((panel) => panel.pixels));
    if (now !== size) after = -1; // another size: the frame of now is wanted again
    size = now;
    try {
      const panels = shownPanels;
      const found = await together(after);
      if (found) {
        after = found[0].number;
        await show(found, panels);
      } else await pause(30);
      lost = 0;
    } catch {
      lost += 1;
      if (lost > 2) after = -1;
      await pause(Math.min(4000, 50 * 2 ** lost));
    }
  }
}

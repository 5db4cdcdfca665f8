// Talking to the server: GETs that may wait, POSTs that do something. All addresses are relative to the token's folder.
import { live } from "./store.js";

const KEPT = 200; // timings
const PATIENCE = 20; // seconds for an answer; long polls take up to 10

/** Wait some milliseconds. */
export const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** A GET that gives up after PATIENCE; raises what fetch raises, and an Error for 4xx and 5xx. */
export async function get(path, { signal } = {}) {
  const limit = AbortSignal.timeout(PATIENCE * 1000);
  const answer = await fetch(path, { cache: "no-store", signal: signal ? AbortSignal.any([signal, limit]) : limit });
  if (!answer.ok) throw new Error(`${path.split("?")[0]}: ${answer.status}`);
  return answer;
}

/** A GET of JSON. */
export async function getJSON(path, options) {
  return (await get(path, options)).json();
}

let complain = () => {};

/** Where refused actions are said. */
export function onRefused(listener) {
  complain = listener;
}

/** POST an action; its id, or null if it was refused (which is then said on the page). */
export async function send(action) {
  const timing = { do: action.do, sent: performance.now(), answered: null, applied: null, id: null };
  try {
    const answer = await fetch("do", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(action),
      signal: AbortSignal.timeout(PATIENCE * 1000),
    });
    const result = await answer.json().catch(() => ({}));
    timing.answered = performance.now();
    if (!answer.ok) {
      complain(result.error ?? String(answer.status));
      return null;
    }
    timing.id = result.id;
    live.timings.push(timing);
    if (live.timings.length > KEPT) live.timings.shift();
    complain(null);
    applied(live.state?.applied ?? 0);
    return result.id;
  } catch {
    return null; // no connection: the state loop says so
  }
}

/** Note when the actions up to `id` were seen to act. */
export function applied(id) {
  live.lastApplied = id;
  const now = performance.now();
  for (const timing of live.timings) if (timing.applied === null && timing.id <= id) timing.applied = now;
}

/** A function that sends its newest argument: one request at a time, what is older and unsent is dropped. */
export function newest(post) {
  let busy = false;
  let next = null;
  return async (value) => {
    next = { value };
    if (busy) return;
    busy = true;
    try {
      while (next) {
        const { value: now } = next;
        next = null;
        await post(now);
      }
    } finally {
      busy = false;
    }
  };
}

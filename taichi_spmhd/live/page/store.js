// What the page knows, and who wants to hear of it. `live` is also window.live, for tests and the curious.

/** setup and state as the server gave them last; rows of the plots; how fast actions were answered. */
export const live = {
  setup: null,
  state: null,
  rows: [],
  lastApplied: 0,
  timings: [],
  frames: { shown: 0, number: 0 },
  connected: true,
};
window.live = live;

const listeners = new Map();

/** Call `listener` whenever `name` ("setup", "state", "rows", "language", "theme", "connection") is told. */
export function on(name, listener) {
  listeners.set(name, [...(listeners.get(name) ?? []), listener]);
}

/** Tell all listeners of `name`. */
export function tell(name, ...what) {
  for (const listener of listeners.get(name) ?? []) listener(...what);
}

/** A remembered choice, or null; browsers may forbid the storage. */
export function remembered(key) {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

/** Remember a choice of this reader. */
export function remember(key, value) {
  try {
    localStorage.setItem(key, value);
  } catch {
    // a private window: forget it
  }
}

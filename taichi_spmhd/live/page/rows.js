// Rows of the plots: kept per panel, thinned where they become many, begun anew when the run begins anew.
import { live, tell } from "./store.js";

const MOST = 3000; // rows a panel; then every second one of the older half goes

/** Empty rows for this many panels. */
export function restart(panels) {
  live.rows = Array.from({ length: panels }, () => []);
  tell("rows");
}

/** Add what came with a state: {first, next, panels: [[row, ...], ...]}. */
export function take(rows) {
  if (!rows) return;
  if (rows.panels.length !== live.rows.length && rows.panels.length) restart(rows.panels.length);
  if (rows.first === 0 || begunAnew(rows)) live.rows.forEach((kept) => kept.splice(0));
  const fresh = rows.panels.some((panel) => panel.length);
  rows.panels.forEach((panel, k) => grow(live.rows[k], panel));
  if (fresh || rows.first === 0) tell("rows");
}

/** Whether time went back. */
function begunAnew(rows) {
  const kept = live.rows[0] ?? [];
  const fresh = rows.panels[0] ?? [];
  return kept.length > 0 && fresh.length > 0 && fresh[0][0] !== null && fresh[0][0] < kept.at(-1)[0];
}

/** Append, and thin the older half where there are too many. */
function grow(kept, fresh) {
  kept.push(...fresh);
  if (kept.length <= MOST) return;
  const half = kept.length >> 1;
  const older = kept.slice(0, half).filter((_, k) => k % 2 === 0);
  kept.splice(0, half, ...older);
}

/** A column of a panel's rows as (t, value) points, without nulls; without zeros where they mean "not measured yet". */
export function points(panel, column, zeros = true) {
  const k = live.setup.columns.indexOf(column);
  if (k < 0) return [];
  const there = (row) => row[0] !== null && row[k] !== null && (zeros || row[k] !== 0);
  return (live.rows[panel] ?? []).filter(there).map((row) => [row[0], row[k]]);
}

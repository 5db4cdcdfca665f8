// spmhd live: start of the page, and the loop that follows the state of the run.
import { applied, getJSON, pause } from "./api.js";
import { startBar } from "./bar.js";
import { startDrawn } from "./drawn.js";
import { startMessages } from "./messages.js";
import { startParts } from "./parts.js";
import { startPictures } from "./pictures.js";
import { startPlots } from "./plots.js";
import { startRecord } from "./record.js";
import { restart, take } from "./rows.js";
import { startScene } from "./scene.js";
import { live, tell } from "./store.js";
import { startTheme } from "./theme.js";
import { translate } from "./words.js";

const BACK_OFF = [200, 500, 1000, 2000, 4000]; // milliseconds between tries when the connection is lost

/** Fetch the setup when the state speaks of a newer one. */
async function follow(version, anew) {
  if (live.setup && live.setup.version >= version && !anew) return;
  const before = live.setup;
  live.setup = await getJSON("setup");
  if (!before || before.panels.length !== live.setup.panels.length) restart(live.setup.panels.length);
  tell("setup");
}

/** One answer of the server: state, rows, what was applied. */
async function listen(after, row) {
  const state = await getJSON(`state?after=${after}&row=${row}`);
  if (!state.panels) return state; // the run has not begun yet
  await follow(state.setup, state.seq < after); // a smaller seq: another server stands at this address
  live.state = state;
  applied(state.applied);
  take(state.rows);
  tell("state");
  return state;
}

/** Ask for the state for ever; the server answers when there is news. */
async function loop() {
  let lost = 0;
  let after = -1;
  let row = 0;
  for (;;) {
    try {
      const state = await listen(after, row);
      after = state.seq;
      row = state.rows.next;
      if (lost) connection(true);
      lost = 0;
      if (document.hidden) await pause(1000);
    } catch (error) {
      live.lastError = String(error);
      lost += 1;
      if (lost > 1) connection(false);
      if (lost > 1) after = -1;
      await pause(BACK_OFF[Math.min(lost, BACK_OFF.length) - 1]);
    }
  }
}

/** Say that the connection is there, or not. */
function connection(there) {
  if (live.connected === there) return;
  live.connected = there;
  tell("connection");
}

startTheme();
startMessages();
startBar();
startScene();
startParts();
startDrawn();
startRecord();
startPictures();
startPlots();
translate();
tell("language");
loop();

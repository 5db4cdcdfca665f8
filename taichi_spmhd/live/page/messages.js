// The one place where the page speaks up: refused actions, failures, compiling, a lost connection.
import { onRefused, send } from "./api.js";
import { byId, write } from "./dom.js";
import { live, on } from "./store.js";
import { word } from "./words.js";

const SAID = [
  [/^t_end = (\S+) is reached/, "said.end"],
  [/^written: (.*)$/, "said.written"],
];
let refused = null;

/** Listen to all that can go wrong. */
export function startMessages() {
  onRefused((text) => {
    refused = text;
    show();
  });
  byId("message-reset").addEventListener("click", () => send({ do: "reset" }));
  for (const name of ["state", "language", "connection"]) on(name, show);
}

/** The most important thing to say: [kind, text]. */
function said() {
  const state = live.state;
  if (!live.connected) return ["error", word("lost")];
  if (!state) return ["info", ""];
  if (state.busy) return ["busy", known(state.busy)];
  if (refused) return ["error", refused];
  const failed = state.panels.find((panel) => panel.failed);
  if (failed) return ["error", word("failed", { label: failed.label, text: failed.failed })];
  if (state.message) return [state.message.kind, translated(state.message.text)];
  return state.recording ? ["info", word("recording")] : ["info", ""];
}

/** The two things that the run says every day, in the reader's language; all else as it comes. */
function translated(text) {
  for (const [pattern, key] of SAID) {
    const found = text.match(pattern);
    if (found) return word(key, { what: found[1] });
  }
  return text;
}

/** What the run is busy with, in words. */
function known(busy) {
  const words = word(`busy.${busy}`);
  return words.startsWith("busy.") ? busy : words;
}

/** Put it into the live region. */
function show() {
  const [kind, text] = said();
  write(byId("message"), text);
  byId("messages").dataset.kind = text ? kind : "none";
  byId("message-reset").hidden = !live.state?.panels.some((panel) => panel.failed);
}

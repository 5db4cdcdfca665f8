// Record: picture, film, state, scene file; and what was written.
import { send } from "./api.js";
import { byId, make, refill, write } from "./dom.js";
import { section } from "./scene.js";
import { live, on } from "./store.js";
import { word } from "./words.js";

/** Make the section and keep it up to date. */
export function startRecord() {
  section("record", "record");
  on("language", () => {
    refill(byId("record"), content());
    show();
  });
  on("state", show);
}

/** The buttons and the list. */
function content() {
  const button = (what) => {
    const act = () => send({ do: "record", what: what === "film" && live.state?.recording ? "stop" : what });
    return make("button", { id: `record-${what}`, type: "button", text: word(`record.${what}`), on: { click: act } });
  };
  const buttons = make("div", { class: "buttons" }, ...["png", "film", "state", "scene"].map(button));
  const title = make("p", { id: "files-title", text: word("files") });
  return [buttons, title, make("ul", { id: "files", "aria-labelledby": "files-title" })];
}

/** The film's button and the newest files first. */
function show() {
  const state = live.state;
  if (!state || !byId("files")) return;
  write(byId("record-film"), word(state.recording ? "record.stop" : "record.film"));
  byId("record-film").setAttribute("aria-pressed", String(state.recording));
  const files = byId("files");
  const key = JSON.stringify([state.files, word("files.none")]);
  if (files.dataset.list === key) return;
  files.dataset.list = key;
  const names = state.files.length ? [...state.files].reverse() : [word("files.none")];
  files.replaceChildren(...names.map((text) => make("li", { text })));
}

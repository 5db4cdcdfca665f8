// Light or dark: what the system wants, until the reader chooses.
import { byId } from "./dom.js";
import { on, remember, remembered, tell } from "./store.js";
import { word } from "./words.js";

const system = matchMedia("(prefers-color-scheme: dark)");

/** "light" or "dark", in force now. */
export const theme = () => document.documentElement.dataset.theme;

/** Follow the system, and let the button choose. */
export function startTheme() {
  set(remembered("theme") ?? (system.matches ? "dark" : "light"));
  system.addEventListener("change", () => remembered("theme") ?? set(system.matches ? "dark" : "light"));
  byId("theme").addEventListener("click", () => {
    set(theme() === "dark" ? "light" : "dark");
    remember("theme", theme());
  });
  on("language", () => set(theme()));
}

/** Put it on. */
function set(name) {
  document.documentElement.dataset.theme = name;
  byId("theme").textContent = word(name === "dark" ? "theme.light" : "theme.dark");
  tell("theme");
}

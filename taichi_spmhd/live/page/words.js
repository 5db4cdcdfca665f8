// The language of the page: which one, and its words. Static text carries data-word (text), data-label (aria-label) or
// data-tip (title) with a key; what is built by the modules asks word() and is built anew on "language".
import { english } from "./english.js";
import { japanese } from "./japanese.js";
import { remember, remembered, tell } from "./store.js";

export const languages = { en: english, ja: japanese };
let language = first();

/** ?lang=ja, else what was chosen before, else what the browser prefers. */
function first() {
  const asked = new URLSearchParams(location.search).get("lang") ?? remembered("language") ?? navigator.language;
  return asked?.toLowerCase().startsWith("ja") ? "ja" : "en";
}

/** The words for a key, with {names} filled in; the key itself where there is none. */
export function word(key, filled = {}) {
  const text = languages[language][key] ?? key;
  return text.replace(/\{(\w+)\}/g, (whole, name) => filled[name] ?? whole);
}

/** Whether there are words for this key. */
export const known = (key) => key in languages[language];

/** Which language is spoken. */
export const spoken = () => language;

/** Speak another language, here and next time. */
export function speak(other) {
  language = other;
  remember("language", other);
  translate();
  tell("language");
}

/** Put the words of the language into the static text below `root`. */
export function translate(root = document) {
  document.documentElement.lang = language;
  document.title = word("title");
  for (const element of root.querySelectorAll("[data-word]")) element.textContent = word(element.dataset.word);
  for (const element of root.querySelectorAll("[data-label]")) {
    element.setAttribute("aria-label", word(element.dataset.label));
  }
  for (const element of root.querySelectorAll("[data-tip]")) element.title = word(element.dataset.tip);
}

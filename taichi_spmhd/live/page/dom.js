// Elements, made and kept. Text from the server only ever becomes a text node.
const SVG = "http://www.w3.org/2000/svg";

/** An element: properties (class, text, on: {event: listener}, data-*, aria-*, plain attributes), then children. */
export function make(tag, properties = {}, ...children) {
  return dressed(document.createElement(tag), properties, children);
}

/** The same for SVG. */
export function draw(tag, properties = {}, ...children) {
  return dressed(document.createElementNS(SVG, tag), properties, children);
}

/** Set the properties of an element and append its children. */
function dressed(element, properties, children) {
  for (const [name, value] of Object.entries(properties)) {
    if (name === "text") element.textContent = value;
    else if (name === "on") for (const [event, heard] of Object.entries(value)) element.addEventListener(event, heard);
    else if (typeof value === "boolean") element.toggleAttribute(name, value);
    else if (value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/** Set a text only where it differs: no needless layout, nothing read twice by a screen reader. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** The element with this id. */
export const byId = (id) => document.getElementById(id);

/** Fill `root` anew, keeping the focus and which details are open, by id. */
export function refill(root, children) {
  const focus = root.contains(document.activeElement) ? document.activeElement.id : null;
  const open = new Map([...root.querySelectorAll("details[id]")].map((box) => [box.id, box.open]));
  root.replaceChildren(...children);
  for (const box of root.querySelectorAll("details[id]")) if (open.has(box.id)) box.open = open.get(box.id);
  if (focus) byId(focus)?.focus({ preventScroll: true });
}

/** <option>s into a <select>; options: [[value, text], ...]. Left alone where nothing changed. */
export function options(select, list, chosen) {
  const key = JSON.stringify(list);
  if (select.dataset.list !== key) {
    select.replaceChildren(...list.map(([value, text]) => make("option", { value, text })));
    select.dataset.list = key;
  }
  if (document.activeElement !== select || select.value === "") select.value = String(chosen);
}

// What the report shows: one JSON text in the page, numbers of large arrays as base64.

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** Little-endian floats or whole numbers of 4 bytes, as the program wrote them. */
export const floats = (text) => new Float32Array(bytes(text).buffer);
export const integers = (text) => new Uint32Array(bytes(text).buffer);

export const data = JSON.parse(document.getElementById("data").textContent);

/** A number as people read it. */
export function shown(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e6) return String(value);
  return String(Number(value.toPrecision(digits)));
}

/** An element with text and children; texts are never markup. */
export function element(tag, options = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(options)) {
    if (name === "class") made.className = value;
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children.filter((child) => child !== undefined && child !== null));
  return made;
}

const colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444"];
export const colourOf = (i) => colours[i % colours.length];

/** Who wants to know which place of the path is looked at: {branch, length, step}. */
const watchers = [];
export let place = null;
export const watchPlace = (watcher) => watchers.push(watcher);
export function goTo(next) {
  place = next;
  for (const watcher of watchers) watcher(next);
}

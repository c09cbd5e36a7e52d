// Elements without innerHTML: whatever a file is called, it stays text.
const svgNamespace = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "style" && typeof value === "object") Object.assign(element.style, value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child === undefined || child === null || child === false) continue;
    element.append(child);
  }
  return element;
}

/** An HTML element: h("p", {class: "note"}, "text", child…). */
export const h = (tag, attributes, ...children) => fill(document.createElement(tag), attributes, children);
/** An SVG element. */
export const s = (tag, attributes, ...children) =>
  fill(document.createElementNS(svgNamespace, tag), attributes, children);

let ids = 0;
export const newId = (stem) => `${stem}-${++ids}`;

const observer = new IntersectionObserver((entries) => {
  for (const entry of entries) entry.target.seen(entry.isIntersecting);
}, { rootMargin: "200px" });

/**
 * Calls `draw` when `element` comes near the window, and `reserve` before, as soon as its width is known. Returns a function that has
 * it drawn again, at once or when it is next seen.
 */
export function whenSeen(element, draw, reserve = () => {}) {
  let near = false, fresh = false, placed = false;
  element.drawNow = () => {
    if (fresh) return;
    fresh = true;
    draw();
  };
  element.seen = (now) => {
    near = now;
    if (near) element.drawNow();
    else if (!placed) reserve();
    placed = true;
  };
  observer.observe(element);
  return () => { fresh = false; element.seen(near); };
}

/** Gives the user a file. */
export function download(name, content, type) {
  const url = typeof content === "string" && content.startsWith("data:")
    ? content
    : URL.createObjectURL(new Blob([content], { type }));
  const link = h("a", { href: url, download: name });
  link.click();
  // A busy browser takes seconds to begin.
  if (url.startsWith("blob:")) setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

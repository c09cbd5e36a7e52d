// Where a number comes from.
import { h } from "./dom.js";

export const meaning = {
  measured: "measured on the thesis' board",
  published: "stated by the thesis, a product guide or a data sheet",
  derived: "computed from published or measured values",
  assumed: "an estimate: no source states it",
  decision: "a choice of this project where the thesis is silent",
  simulated: "counted in this simulation",
};

/** The first word of a source text names the origin: "published: thesis 4.6.1". */
export function originOf(source) {
  const word = String(source ?? "").match(/[a-z]+/i)?.[0]?.toLowerCase();
  return word in meaning ? word : null;
}

export function origin(source, detail) {
  const name = originOf(source) ?? "derived";
  const text = detail ?? (String(source).length > name.length ? source : meaning[name]);
  return h("span", { class: `origin ${name}`, title: text }, name, h("span", { class: "hidden" }, `: ${text}`));
}

export function legend(names = ["simulated", "measured", "published", "derived", "assumed"]) {
  return h("p", { class: "note origins" }, names.map((name) => h("span", {}, h("span", { class: `origin ${name}` }, name), ` ${meaning[name]}`)));
}

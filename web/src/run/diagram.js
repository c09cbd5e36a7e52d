// The block design as a picture: a part that is chosen shows its registers, its traffic, and where its waves are.
import { h } from "../kit/dom.js";
import { fixed } from "../kit/format.js";
import { dataTable } from "../kit/table.js";

function registers(part) {
  if (part.registers.length === 0) return null;
  const rows = part.registers.map(([address, name, access, what]) => ({ address, name, access, what }));
  return [h("h4", {}, "Registers"), dataTable({ caption: `Registers of ${part.name}`, name: "registers", rows, columns: [
    { title: "Address", head: true, value: (r) => r.address, node: (r) => h("code", {}, r.address) },
    { title: "Register", value: (r) => r.name, node: (r) => h("code", {}, r.name) },
    { title: "Access", value: (r) => r.access },
    { title: "What it is", value: (r) => r.what }] })];
}

function traffic(part) {
  const rows = part.traffic.map(([name, count, what]) => ({ name, count, what }));
  return [h("h4", {}, "Traffic"), rows.length === 0
    ? h("p", { class: "note" }, "Nothing was counted in it.")
    : dataTable({ caption: `Traffic of ${part.name}`, name: "traffic", rows, columns: [
      { title: "Where", head: true, value: (r) => r.name, node: (r) => h("code", {}, r.name) },
      { title: "Count", number: true, value: (r) => r.count, show: (v) => fixed(v, 0) },
      { title: "What it counts", value: (r) => r.what }] })];
}

function waves(part, run) {
  const seen = run.extras.waves?.signals?.some((signal) => signal.name.startsWith(part.module));
  const show = () => {
    run.moment.pointAt({ signals: part.module });
    document.getElementById("waves").scrollIntoView();
  };
  return [h("h4", {}, "Waves"), seen ? h("button", { type: "button", onclick: show }, `Show the waves of ${part.name}`)
    : h("p", { class: "note" }, "None in this page: a run with ", h("code", {}, "--trace"), " has them.")];
}

/** Graphviz's picture, whose groups of class "node" have the name of their part as title, that of the PS twice. */
function picture(text, choose, names) {
  const svg = document.importNode(new DOMParser().parseFromString(text, "image/svg+xml").documentElement, true);
  svg.setAttribute("role", "group");
  svg.setAttribute("aria-label", "Block design");
  for (const node of svg.querySelectorAll("g.node")) {
    const name = node.querySelector("title").textContent.replace(/ inputs$/, "");
    if (!names.has(name)) continue;
    const act = () => choose(name);
    node.setAttribute("role", "button");
    node.setAttribute("tabindex", "0");
    node.setAttribute("aria-label", name);
    node.addEventListener("click", act);
    node.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      act();
    });
  }
  return svg;
}

/** The section of a design that is a file; null for others. */
export function diagram(run) {
  const data = run.extras.diagram;
  const section = (...children) => h("section", { id: "diagram", "aria-labelledby": "diagram-title" }, h("h2", { id: "diagram-title" }, "Block design"), children);
  if (data?.problem) return section(h("p", { class: "note" }, `No picture: ${data.problem}`));
  if (!data?.svg) return null;
  const parts = new Map(data.parts.map((part) => [part.name, part]));
  const about = h("div", { "aria-live": "polite" });
  const choose = (name) => {
    const part = parts.get(name);
    about.replaceChildren(h("h3", {}, `${name}, ${part.ip}`), ...[registers(part), traffic(part), waves(part, run)].flat().filter(Boolean));
  };
  return section(h("p", { class: "note" }, "Streams are blue, interrupts red, other wires grey; the colour of a part is its clock. What the PS takes is at the right. Choose a part for its registers, traffic and waves."),
    h("div", { class: "table-scroll diagram", tabindex: "0", role: "group", "aria-label": "Picture of the block design" }, picture(data.svg, choose, parts)), about);
}

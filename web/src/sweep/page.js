// The page of a sweep.
import { h, whenSeen } from "../kit/dom.js";
import { counted, fixed, significant, shellWord } from "../kit/format.js";
import { dataTable } from "../kit/table.js";
import { columnsOf, heatMap, parallel, tornado } from "./charts.js";
import { makeSweep } from "./facts.js";
import { progress, whyNot } from "./outcome.js";
import { makeSelection } from "./selection.js";
import { tradeOff } from "./trade_off.js";
import { comparison, whatIf } from "./what_if.js";

/** By how much the front is better than a point behind it. */
function behind(sweep, point, open) {
  if (point.better === undefined) return null;
  const better = sweep.byPlace[point.better];
  const gains = sweep.objectives.map((o) => ({ o, gain: Math.abs(o.of(better) - o.of(point)) })).filter(({ gain }) => gain > 0)
    .map(({ o, gain }) => `${significant(gain, 3)} ${o.unit}${gain / Math.abs(o.of(point)) >= 0.001 ? ` (${significant(100 * gain / Math.abs(o.of(point)), 2)} %)` : ""} ${o.better > 0 ? "more" : "less"} ${o.name.toLowerCase()}`);
  return h("p", { class: "note" }, "Behind the front: ", h("button", { type: "button", class: "plain", onclick: () => open(better) }, better.key.slice(0, 8)), ` has ${gains.join(" and ")}.`);
}

function pointPanel(sweep, selection, compare) {
  const panel = h("section", { id: "point", class: "panel", "aria-label": "Point", tabindex: "-1", hidden: true });
  panel.show = (point) => {
    panel.hidden = false;
    const folder = sweep.folder.replace(/\/$/, "");
    const run = `reports/${point.key.slice(0, 12)}`;
    const reasons = selection.why(point);
    const fact = (name, text) => h("div", {}, h("dt", {}, name), h("dd", {}, text));
    panel.replaceChildren(
      h("div", { class: "section-head" }, h("h2", {}, "Point ", h("code", {}, point.key.slice(0, 12))),
        h("div", { class: "tools" }, h("button", { type: "button", onclick: () => compare.keep(point) }, "Keep to compare"), h("button", { type: "button", onclick: () => { panel.hidden = true; } }, "Close"))),
      reasons.length > 0 && h("ul", { class: "chips" }, reasons.map((reason) => h("li", { class: "bad" }, reason))),
      behind(sweep, point, panel.show),
      h("div", { class: "columns" },
        h("dl", { class: "facts wide" }, sweep.parameters.map((p) => fact(p.name, p.text(point)))),
        h("dl", { class: "facts wide" }, sweep.metrics.filter((m) => Number.isFinite(m.of(point))).map((m) => fact(m.name, `${significant(m.of(point), 5)} ${m.unit}`)))),
      h("p", { class: "note", style: { margin: "18px 0 6px" } }, "To run it again, with pictures and ", h("a", { href: `${run}/report.html` }, "its own report"), ", which is there then:"),
      h("pre", { tabindex: "0", "aria-label": "Command line" }, h("code", {}, `markervp run --point ${shellWord(`${folder}:${point.key}`)} --output ${shellWord(`${folder}/${run}`)}`)));
    panel.focus({ preventScroll: true });
    panel.scrollIntoView({ block: "nearest" });
  };
  return panel;
}

function verdict(sweep) {
  const best = (axis) => {
    const list = sweep.feasible.filter((p) => Number.isFinite(axis.of(p)));
    return list.length ? list.reduce((a, b) => ((axis.of(b) - axis.of(a)) * axis.better > 0 ? b : a)) : null;
  };
  const tile = (axis) => {
    const point = best(axis);
    return point && h("div", { class: "tile" }, h("dt", {}, `${axis.better > 0 ? "Most" : "Least"}: ${axis.name}`),
      h("dd", { class: "figure" }, h("span", { class: "value" }, significant(axis.of(point), 4)), h("span", { class: "unit" }, " " + axis.unit)),
      h("dd", { class: "band" }, sweep.parameters.map((p) => `${p.name.split(".").slice(-2).join(".")} ${p.text(point)}`).join(", ")));
  };
  const { points: all, feasible, failed } = sweep.counts;
  const bad = all - feasible - failed;
  return h("section", { id: "verdict", "aria-label": "Verdict" },
    h("ul", { class: "chips" }, h("li", { class: "good" }, `${counted(feasible, "feasible point")}`), bad > 0 && h("li", { class: "bad" }, `${fixed(bad, 0)} not feasible or not proven`),
      failed > 0 && h("li", { class: "bad" }, `${fixed(failed, 0)} failed`),
      sweep.missing > 0 && h("li", { class: "bad" }, `${fixed(sweep.missing, 0)} not computed yet`)),
    all > sweep.points.length && h("p", { class: "note", style: { margin: "0 0 14px" } }, `This page has ${fixed(sweep.points.length, 0)} of ${counted(all, "point")}: the Pareto front, and of the others every so many. sweep.csv and sweep.sqlite have all.`),
    sweep.idle && h("p", { class: "note", style: { margin: "0 0 14px" } }, sweep.idle.trim()),
    sweep.constraints.length > 0 && h("p", { class: "note", style: { margin: "0 0 14px" } }, `A point must have ${sweep.constraints.join(" and ")}.`),
    h("dl", { class: "tiles" }, sweep.objectives.map(tile)));
}

/** What one step of each parameter changes at a point. */
function stepTable({ key, figures, rows }) {
  const change = ({ title, unit, factor }, index) => ({
    title, unit, number: true,
    value: (row) => (row.changes[index] === null ? null : row.changes[index] * factor),
    show: (value) => (value > 0 ? "+" : "") + significant(value, 4),
  });
  const columns = [{ title: "Parameter", value: (row) => row.path }, { title: "From", value: (row) => row.from }, { title: "To", value: (row) => row.to },
    ...figures.map(change), { title: "Not feasible", value: (row) => row.trouble }];
  const base = figures.filter((figure) => figure.base !== null).map((figure) => `${figure.title} ${significant(figure.base * figure.factor, 5)} ${figure.unit}`.trim());
  return h("div", {}, h("p", { class: "note" }, `Point ${key.slice(0, 12)}: ${base.join(", ")}. One step down or up of each parameter changes this by:`),
    dataTable({ columns, rows, caption: "Steps, the strongest first", name: "steps", exportable: true, limit: 40 }));
}

/** A table of the points that are `wanted` now. */
function points(sweep, selection, wanted, caption, name, open) {
  const key = { title: "Point", value: (p) => p.key, node: (p) => h("button", { type: "button", class: "plain", onclick: () => open(p) }, p.key.slice(0, 8)) };
  const holder = h("div");
  const fill = () => {
    const rows = sweep.points.filter(wanted);
    holder.replaceChildren(...(rows.length ? [h("h3", {}, caption), dataTable({ columns: [key, ...columnsOf(sweep, selection, rows)], rows, caption, name, exportable: true, limit: 20 })] : []));
  };
  selection.onChange(whenSeen(holder, fill));
  holder.drawNow();  // what is filled again when first seen takes the button from under the mouse
  return holder;
}

export function sweepPage(data) {
  const sweep = makeSweep(data);
  const selection = makeSelection(sweep);
  const compare = comparison(sweep, selection);
  const panel = pointPanel(sweep, selection, compare);
  const section = (id, title, ...content) => (content.some(Boolean) ? h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), h("div", { class: "stack" }, content)) : null);
  const open = panel.show;
  const list = (wanted, caption, name) => points(sweep, selection, wanted, caption, name, open);
  return {
    title: sweep.title || (sweep.name ? `Sweep ${sweep.name}` : "Sweep"),
    subtitle: [counted(sweep.counts.points, "point"), sweep.parameters.map((p) => p.name).join(", ")].filter(Boolean).join("  ·  "),
    sections: [verdict(sweep), sweep.text && h("section", { "aria-label": "About" }, h("p", { class: "note" }, sweep.text)),
      section("trade-off", "Trade-off", tradeOff(sweep, selection, open)), panel,
      section("search", "Search", progress(sweep)), section("why-not", "Why not?", whyNot(sweep, selection)),
      section("what-if", "What if?", whatIf(sweep, selection, open, compare)), compare,
      section("space", "Design space", parallel(sweep, selection)), section("maps", "Map", heatMap(sweep, selection, open)), section("influence", "Influence", tornado(sweep)),
      section("steps", "What a step is worth", sweep.steps && stepTable(sweep.steps)),
      section("points", "Points", list(selection.good, "Feasible points within the limits, the best first", "points"),
        list((p) => !p.failed && !selection.good(p), "Not feasible, not proven or outside the limits", "not-feasible"), list((p) => p.failed, "Failed", "failed"))],
  };
}

// Where the energy goes.
import { application } from "../application.js";
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { fixed, significant, words } from "../kit/format.js";
import { origin } from "../kit/origin.js";
import { dataTable } from "../kit/table.js";
import { palette, seriesColour } from "../kit/theme.js";
import { powerByModule } from "./facts.js";

function moduleChart(run) {
  const rows = run.result.power.modules.filter((m) => m.w > 0);
  const modules = powerByModule(run.result.power);
  const kinds = [...new Set(rows.map((m) => m.kind))];
  const names = modules.map((m) => m.name).reverse();
  return chart({
    name: "power-by-module", title: "Power by module, W", height: Math.max(180, 26 * names.length + 60),
    summary: `Most is drawn by ${modules.slice(0, 3).map((m) => `${words(m.name)} with ${significant(m.w, 3)} W`).join(", ")}.`,
    option: () => ({
      legend: kinds.length > 1 ? { top: 0, left: 0, icon: "roundRect", itemWidth: 10, itemHeight: 10, textStyle: { color: palette().soft } } : undefined,
      grid: { left: 8, right: 24, top: kinds.length > 1 ? 32 : 8, bottom: 8, containLabel: true },
      xAxis: axis({ type: "value" }), yAxis: axis({ type: "category", data: names.map(words), splitLine: { show: false } }),
      tooltip: { show: true, trigger: "item", valueFormatter: (v) => significant(v, 3) + " W" },
      series: kinds.map((kind, i) => ({ name: kind ?? "power", type: "bar", stack: "all", barMaxWidth: 14, itemStyle: { color: seriesColour(i) },
        data: names.map((name) => rows.filter((m) => m.name === name && m.kind === kind).reduce((sum, m) => sum + m.w, 0)) })),
    }),
    table: () => ({ caption: "Power by module", rows: modules, columns: columns().filter((column) => ["Module", "Power"].includes(column.title)) }),
  });
}

const columns = () => [
  { title: "Module", head: true, value: (m) => m.name, show: words }, { title: "Rail", value: (m) => m.rail }, { title: "Kind", value: (m) => m.kind },
  { title: "Power", unit: "W", csv: "Power W", number: true, value: (m) => m.w, show: (v) => significant(v, 3) },
  { title: "Energy", unit: "mJ", csv: "Energy mJ", number: true, value: (m) => m.mj, show: (v) => significant(v, 3) },
  { title: "Origin", value: (m) => m.source, node: (m) => (m.source ? origin(m.source) : "") },
];

function rails(power) {
  const rows = Object.entries(power.rails ?? {});
  if (rows.length === 0) return null;
  return h("details", {}, h("summary", {}, "Power by rail"), dataTable({ caption: "Power by rail", name: "rails", rows, exportable: true, columns: [
    { title: "Rail", head: true, value: (r) => r[0] }, { title: "Power", unit: "W", csv: "Power W", number: true, value: (r) => r[1], show: (v) => significant(v, 3) }] }));
}

function activities(power) {
  const rows = power.activity ?? [];
  if (rows.length === 0) return null;
  return h("details", {}, h("summary", {}, "Activity inside RTL"), dataTable({ caption: "Activity inside RTL, of which 0.125 is usual", name: "activity", rows, exportable: true, columns: [
    { title: "Module", head: true, value: (r) => r.name, show: words },
    { title: "Changes a bit and clock", csv: "Changes a bit and clock", number: true, value: (r) => r.toggle_rate, show: (v) => significant(v, 3) },
    { title: "Bits of signals", csv: "Bits of signals", number: true, value: (r) => r.signal_bits }] }));
}

export function power(run) {
  const facts = run.result.power;
  if (!facts?.modules?.length) return null;
  const about = [facts.mode && `mode ${facts.mode}`, facts.table && `coefficients ${facts.table}`, Number.isFinite(facts.ambient_c) && `ambient ${fixed(facts.ambient_c, 0)} °C`].filter(Boolean).join(", ");
  return h("section", { id: "power", "aria-labelledby": "power-title" }, h("h2", { id: "power-title" }, "Power and energy"),
    about && h("p", { class: "note", style: { marginBottom: "20px" } }, about[0].toUpperCase() + about.slice(1) + "."),
    h("div", { class: "stack" }, application.energy(run), moduleChart(run),
      h("div", {}, h("details", {}, h("summary", {}, "Modules with the origin of their numbers"), dataTable({ caption: "Power by module", name: "power", exportable: true, rows: facts.modules, columns: columns() })), activities(facts), rails(facts))));
}

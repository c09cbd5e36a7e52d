// Resources against the device, and clocks against what each module can do.
import { h } from "../kit/dom.js";
import { fixed, significant, words } from "../kit/format.js";
import { origin } from "../kit/origin.js";
import { dataTable } from "../kit/table.js";
import { timingOf } from "./facts.js";

const show = (v) => (Number.isInteger(v) ? fixed(v, 0) : significant(v, 4));

function meters({ total = {}, available = {} }, title) {
  return h("div", { class: "bars" }, Object.entries(available).filter(([kind]) => total[kind] !== undefined).map(([kind, room]) => {
    const share = total[kind] / room;
    return h("div", { class: "meter" + (share > 1 ? " over" : ""), role: "img", "aria-label": `${title(kind)}: ${show(total[kind])} of ${show(room)}` },
      h("span", {}, title(kind)), h("span", { class: "track" }, h("i", { style: { width: `${Math.min(100, share * 100)}%` } })),
      h("span", { class: "number" }, `${show(total[kind])} of ${show(room)}`, h("span", { class: "faint" }, `  ${fixed(share * 100, 1)} %`)));
  }));
}

function modules(resources, title) {
  const names = Object.keys(resources.available ?? {}).filter((kind) => resources.modules.some((m) => m[kind] !== undefined));
  return dataTable({
    caption: "Resources of each module", name: "resources", exportable: true, rows: resources.modules,
    columns: [{ title: "Module", head: true, value: (m) => m.name, show: words },
      ...names.map((kind) => ({ title: title(kind), number: true, value: (m) => m[kind], show })),
      { title: "Band", number: true, value: (m) => m.uncertainty_percent, show: (v) => `±${fixed(v, 0)} %` },
      { title: "Origin", value: (m) => m.source, node: (m) => (m.source ? origin(m.source) : "") }],
  });
}

function clocks(timing) {
  return dataTable({
    caption: "Clock and Fmax of each module", name: "timing", exportable: true, rows: timing.modules,
    columns: [{ title: "Module", head: true, value: (m) => m.name, show: words }, { title: "Clock", value: (m) => m.clock },
      { title: "Frequency", unit: "MHz", csv: "Frequency MHz", number: true, value: (m) => m.frequency_mhz, show: (v) => significant(v, 4) },
      { title: "Fmax", unit: "MHz", csv: "Fmax MHz", number: true, value: (m) => m.fmax_mhz, show: (v, m) => significant(v, 4) + (m.fmax_high_mhz > v ? ` to ${significant(m.fmax_high_mhz, 4)}` : "") },
      { title: "Margin", number: true, value: (m) => m.margin_percent, show: (v) => `${fixed(v, 1)} %` },
      { title: "Timing", value: timingOf, node: (m) => h("span", { class: "tag " + (m.met ? "good" : "bad") }, timingOf(m)) },
      { title: "Origin", value: (m) => m.source, node: (m) => (m.source ? origin(m.source) : "") }],
  });
}

export function resources(run) {
  const { resources: needs, timing } = run.result;
  if (!needs && !timing) return null;
  const title = (kind) => run.figure(`resources.total.${kind}`).title;
  return h("section", { id: "resources", "aria-labelledby": "resources-title" },
    h("h2", { id: "resources-title" }, "Resources and timing"),
    h("div", { class: "stack" },
      needs?.total && h("div", {}, needs.device && h("p", { class: "note", style: { marginBottom: "14px" } }, `Of the programmable logic of ${needs.device}.`), meters(needs, title)),
      timing?.modules && clocks(timing), needs?.modules && h("details", {}, h("summary", {}, "Resources of each module"), modules(needs, title))));
}

// A campaign of faults: how many do harm, where, and how to have one again.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, percent, time } from "../kit/format.js";
import { dataTable } from "../kit/table.js";
import { palette } from "../kit/theme.js";

const meaning = {
  masked: "All units are right, and nothing was noticed", recovered: "Something was noticed, and the last unit is right",
  reported: "Units are wrong, and the program or a checker said so", unnoticed: "Units are wrong, and there is no sign of it",
  hang: "Not all units come, or the program was stopped", broken: "The simulator failed: a bug of it",
};
const colourOf = (outcome) => palette()[{ masked: "grey", recovered: "green", reported: "sky", unnoticed: "vermilion", hang: "purple", broken: "yellow" }[outcome]];
const feared = (group) => group.unnoticed + group.hang;
const range = ([low, high]) => `${percent(low, 2)} to ${percent(high, 2)}`;

function tile(data, outcome) {
  const count = data.all[outcome];
  return h("div", { class: count > 0 && ["unnoticed", "hang", "broken"].includes(outcome) ? "tile bad" : "tile" }, h("dt", {}, outcome.replace(/^./, (c) => c.toUpperCase())),
    h("dd", { class: "figure" }, h("span", { class: "value" }, fixed((100 * count) / data.all.faults, 2)), h("span", { class: "unit" }, " %")),
    h("dd", { class: "band" }, range(data.all.interval[outcome])), h("dd", { class: "foot" }, `${counted(count, "fault")}. ${meaning[outcome]}.`));
}

/** What came of the units against what was said of them. */
function confusion({ all }) {
  const rows = [["right, at the end at least", all.masked, all.recovered], ["wrong", all.unnoticed, all.reported], ["missing", all.silent_hangs, all.hang - all.silent_hangs]].map(([units, silent, noticed]) => ({ units, silent, noticed }));
  const number = (title, key) => ({ title, number: true, value: (r) => r[key], show: (v) => fixed(v, 0) });
  return dataTable({ caption: "Units of work against what was noticed", name: "confusion", sortable: false, rows, columns: [{ title: "Units are", head: true, value: (r) => r.units }, number("Not noticed", "silent"), number("Noticed", "noticed")] });
}

/** Bars of shares that add up to 1, a row each. `groups`: {name: counts}. */
function shares(data, groups, name, title, vertical = false) {
  const rows = groups.map(([of, counts]) => ({ of, ...counts }));
  if (rows.length === 0) return null;
  const shown = data.outcomes.filter((outcome) => rows.some((row) => row[outcome] > 0));
  const drawn = vertical ? rows : rows.slice().reverse();
  const categories = axis({ type: "category", data: drawn.map((row) => row.of), splitLine: { show: false }, axisLabel: vertical ? {} : { width: 260, overflow: "truncate" } });
  const values = axis({ type: "value", min: 0, max: 100, axisLabel: { formatter: "{value} %" } });
  return chart({
    name, title, height: vertical ? 260 : 26 * rows.length + 60, summary: rows.map((row) => `${row.of}: ${percent(feared(row) / row.faults)} of ${counted(row.faults, "fault")} unnoticed or a hang`).join("; "),
    option: () => ({
      legend: { top: 0, left: 0, icon: "roundRect", itemWidth: 10, itemHeight: 10, itemGap: 14, textStyle: { color: palette().soft } },
      grid: { left: 8, right: 24, top: 34, bottom: 4, containLabel: true }, xAxis: vertical ? categories : values, yAxis: vertical ? values : categories,
      tooltip: { show: true, trigger: "item", formatter: (p) => `${p.name}: ${p.seriesName}\n${fixed(drawn[p.dataIndex][p.seriesName], 0)} of ${counted(drawn[p.dataIndex].faults, "fault")}, ${fixed(p.value, 2)} %` },
      series: shown.map((outcome) => ({ name: outcome, type: "bar", stack: "all", barMaxWidth: 20, itemStyle: { color: colourOf(outcome) }, data: drawn.map((row) => (100 * row[outcome]) / row.faults) })),
    }),
    table: () => ({ caption: title, rows, columns: [{ title: "Of", head: true, value: (r) => r.of }, { title: "Faults", number: true, value: (r) => r.faults, show: (v) => fixed(v, 0) },
      ...data.outcomes.map((outcome) => ({ title: outcome, number: true, value: (r) => r[outcome], show: (v) => fixed(v, 0) })),
      { title: "Unnoticed or hang", unit: "%", csv: "unnoticed or hang percent", number: true, value: (r) => (100 * feared(r)) / r.faults, show: (v) => fixed(v, 2) }] }),
  });
}

function shotPanel() {
  const panel = h("section", { id: "shot", class: "panel", "aria-label": "Fault", tabindex: "-1", hidden: true });
  panel.show = (shot) => {
    panel.hidden = false;
    const command = (label, text) => [h("p", { class: "note", style: { margin: "18px 0 6px" } }, label), h("pre", { tabindex: "0", "aria-label": label }, h("code", {}, text))];
    panel.replaceChildren(h("div", { class: "section-head" }, h("h2", {}, `Fault ${fixed(shot.number, 0)}: ${shot.outcome}`), h("div", { class: "tools" }, h("button", { type: "button", onclick: () => { panel.hidden = true; } }, "Close"))),
      h("p", {}, h("code", {}, shot.fault)), h("p", {}, shot.sign),
      ...command("Run it again:", shot.again), ...command("Run it again with its waveforms:", `${shot.again} --trace fault-${shot.number}.fst`));
    panel.focus({ preventScroll: true });
    panel.scrollIntoView({ block: "nearest" });
  };
  return panel;
}

function shotTable(data, panel) {
  const open = (shot) => h("button", { type: "button", class: "plain", onclick: () => panel.show(shot) }, fixed(shot.number, 0));
  return dataTable({ caption: "Faults that did something", name: "faults", exportable: true, rows: data.shots, columns: [
    { title: "Fault", number: true, value: (s) => s.number, node: open }, { title: "Outcome", value: (s) => s.outcome }, { title: "Class", value: (s) => s.class }, { title: "Module", value: (s) => s.module },
    { title: "At", csv: "at us", number: true, value: (s) => s.at_us, show: time }, { title: "What", value: (s) => s.fault, node: (s) => h("code", {}, s.fault) }, { title: "Sign of it", value: (s) => s.sign }] });
}

export function faultsPage(data) {
  const section = (id, title, ...content) => h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), h("div", { class: "stack" }, content.filter(Boolean)));
  const { faults, broken } = data.all;
  const worstFirst = Object.entries(data.modules).sort(([, a], [, b]) => feared(b) / b.faults - feared(a) / a.faults);
  const modules = worstFirst.slice(0, 40);
  const acted = faults - data.all.masked;
  const panel = shotPanel();
  return {
    title: data.design ? `Faults of ${data.design}` : "Faults", subtitle: `${counted(faults, "fault")}, one a run  ·  ${counted(data.units, "unit")} of work in ${time(data.end_us)}${data.inputs.length ? `  ·  ${data.inputs.join(", ")}` : ""}  ·  seed ${data.seed}`,
    sections: [
      h("section", { id: "verdict", "aria-label": "Verdict" }, h("ul", { class: "chips" }, broken > 0 ? h("li", { class: "bad" }, `${counted(broken, "fault")} broke the simulator`) : h("li", { class: "good" }, "No fault broke the simulator"), data.all.unnoticed > 0 ? h("li", { class: "bad" }, `${counted(data.all.unnoticed, "fault")} unnoticed`) : h("li", { class: "good" }, "No wrong unit went unnoticed")),
        h("dl", { class: "tiles" }, data.outcomes.filter((outcome) => outcome !== "broken" || broken > 0).map((outcome) => tile(data, outcome))),
        h("p", { class: "note", style: { marginTop: "14px" } }, "Ranges: 95 % intervals of the shares (Wilson).")),
      section("noticed", "Right and noticed", confusion(data)),
      section("classes", "By class", shares(data, Object.entries(data.classes), "classes", "What came of the faults of a class")),
      section("modules", "By module", worstFirst.length > modules.length && h("p", { class: "note" }, `The ${modules.length} worst of ${worstFirst.length}; faults.json has all.`), shares(data, modules, "modules", "What came of the faults in a module")),
      Object.keys(data.bits).length > 1 && section("bits", "By bit", shares(data, Object.entries(data.bits).sort(([a], [b]) => a - b), "bits", "What came of a wrong bit, by its number", true)),
      panel,
      acted > 0 && section("shots", "Faults that did something", acted > data.shots.length && h("p", { class: "note" }, `${fixed(data.shots.length, 0)} of ${fixed(acted, 0)}, the worst first; faults.csv has all.`), shotTable(data, panel)),
    ],
  };
}

// Where the program's time goes, function by function, and how long interrupts wait: of runs with --software-profile.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant, time } from "../kit/format.js";
import { dataTable } from "../kit/table.js";
import { isDark, palette, seriesColour } from "../kit/theme.js";

const row = 21; // px
const microjoules = (v) => `${significant(v, 3)} µJ`;
const cycles = (v) => `${fixed(v, 0)} cycles`;
const measures = [
  { name: "Time", of: (f) => f.work + f.stalls + f.waiting + f.asleep, show: time },
  { name: "Time awake", of: (f) => f.work + f.stalls + f.waiting, show: time },
  { name: "Memory stalls", of: (f) => f.stalls, show: time },
  { name: "Waiting", of: (f) => f.waiting, show: time },
  { name: "Cycles", of: (f) => f.cycles, show: cycles },
  { name: "Energy", of: (f) => f.energy, show: microjoules },
];

/** The functions with what they and those below them took; callers stand before those that they call. `calls`: of each, by name. */
function tree(rows, calls) {
  const all = rows.map(([name, caller, halCalls, work, stalls, waiting, asleep, cycles_, energy]) => ({ name, caller, halCalls, work, stalls, waiting, asleep, cycles: cycles_, energy, calls: calls?.[name], below: [], total: [] }));
  all.forEach((f, i) => {
    f.index = i;
    f.depth = i === 0 ? 0 : all[f.caller].depth + 1;
    f.total = measures.map((measure) => measure.of(f));
    if (i > 0) all[f.caller].below.push(f);
  });
  for (const f of all.slice(1).reverse()) f.total.forEach((value, m) => { all[f.caller].total[m] += value; });
  return all;
}

/** Boxes [function, from, to], shares of the width: `top` and its callers have all of it. */
function boxes(all, top, m) {
  const out = [];
  for (let f = top; ; f = all[f.caller]) {
    if (f !== top) out.push([f.index, 0, 1]);
    if (f.index === 0) break;
  }
  const lay = (f, from, width) => {
    if (width < 2e-4) return;
    out.push([f.index, from, from + width]);
    let at = from;
    for (const child of f.below.slice().sort((a, b) => b.total[m] - a.total[m])) {
      const share = f.total[m] > 0 ? width * child.total[m] / f.total[m] : 0;
      lay(child, at, share);
      at += share;
    }
  };
  lay(top, 0, 1);
  return out;
}

/** As much of a name as a box has room for, without arguments. */
function shortened(name, width) {
  const plain = name.replace(/\(anonymous namespace\)::/g, "").replace(/\(.*$/, "") || name;
  const letters = Math.floor((width - 8) / 6.4);
  return letters < 3 ? "" : plain.length <= letters ? plain : `${plain.slice(0, letters - 1)}…`;
}

function colourOf(f, colour) {
  if (f.index === 0) return colour.grey;
  const shades = ["orange", "vermilion", "yellow", "green", "sky", "purple"];
  return colour[shades[[...f.name].reduce((sum, c) => (sum * 31 + c.charCodeAt(0)) % 9973, 7) % shades.length]];
}

function flameGraph(all) {
  let m = 0;
  let top = all[0];
  let instance = null;
  const height = row * (Math.max(...all.map((f) => f.depth)) + 1) + 4;
  const item = (params, api) => {
    const f = all[api.value(0)];
    const area = params.coordSys;
    const x = area.x + api.value(1) * area.width;
    const width = (api.value(2) - api.value(1)) * area.width;
    const colour = palette();
    return {
      type: "rect", shape: { x, y: area.y + f.depth * row, width: Math.max(width - 1, 0.5), height: row - 1, r: 2 },
      style: { fill: colourOf(f, colour), opacity: f.depth < top.depth ? 0.45 : 0.9 },
      textContent: { style: { text: shortened(f.name, width), fill: isDark() || f.index === 0 ? "#14171b" : "#16191d", fontSize: 11 } },
      textConfig: { position: "insideLeft" },
    };
  };
  const tip = (f) => [f.name, `${measures[m].name.toLowerCase()} ${measures[m].show(f.total[m])}, ${fixed(all[0].total[m] > 0 ? 100 * f.total[m] / all[0].total[m] : 0, 1)} %`,
    `itself: work ${time(f.work)}, stalls ${time(f.stalls)}, waiting ${time(f.waiting)}, asleep ${time(f.asleep)}`,
    f.calls === undefined ? "" : `called ${counted(f.calls, "time")}, wherever from`, `${counted(f.halCalls, "call")} of the HAL`].filter(Boolean).join("\n");
  const option = () => ({
    grid: { left: 0, right: 0, top: 0, height }, xAxis: axis({ type: "value", min: 0, max: 1, show: false }), yAxis: axis({ type: "value", min: 0, max: 1, show: false }),
    tooltip: { show: true, trigger: "item", formatter: (p) => tip(all[p.value[0]]) },
    series: [{ type: "custom", data: boxes(all, top, m), renderItem: item, encode: { x: [1, 2] }, clip: true }],
  });
  const again = () => instance?.setOption({ ...option(), animation: false });
  const select = h("select", { "aria-label": "What the flame graph shows", onchange: () => { m = Number(select.value); again(); } },
    measures.map((measure, i) => h("option", { value: String(i) }, measure.name)));
  const whole = h("button", { type: "button", onclick: () => { top = all[0]; again(); } }, "Whole program");
  const figure = chart({
    name: "flame-graph", title: "Flame graph of the PS program", height: height + 8, canvas: true, option,
    note: "Below each function those that it called; as wide as what they took. Click one to enlarge it.",
    summary: `Most was taken by ${byFunction(all).slice(1, 4).map((f) => `${f.name} with ${time(f.own)} of its own`).join(", ")}.`,
    table: () => ({ caption: "Functions of the PS program", rows: byFunction(all), columns: functionColumns }),
    ready: (chartInstance) => {
      instance = chartInstance;
      chartInstance.on("click", (event) => { top = all[event.value[0]]; again(); });
    },
  });
  return h("div", {}, h("div", { class: "tools right" }, select, whole), figure);
}

const inTime = (title, value, places = 1) => ({ title, unit: "µs", csv: `${title} us`, number: true, value, show: (v) => fixed(v, places) });
const functionColumns = [
  { title: "Function", head: true, value: (f) => f.name },
  inTime("With those called", (f) => f.all), inTime("Itself", (f) => f.own), inTime("Work", (f) => f.work),
  inTime("Stalls", (f) => f.stalls), inTime("Waiting", (f) => f.waiting), inTime("Asleep", (f) => f.asleep),
  { title: "Cycles", number: true, value: (f) => f.cycles, show: (v) => fixed(v, 0) },
  { title: "Energy", unit: "µJ", csv: "Energy uJ", number: true, value: (f) => f.energy, show: (v) => significant(v, 3) },
  { title: "Calls", number: true, value: (f) => f.calls },
  { title: "HAL calls", number: true, value: (f) => f.halCalls },
];

/** Each function once, wherever it was called; of recursive calls the outermost counts. */
function byFunction(all) {
  const found = new Map();
  const within = (f) => { for (let g = f; g.index > 0;) { g = all[g.caller]; if (g.name === f.name) return true; } return false; };
  for (const f of all) {
    const sum = found.get(f.name) ?? { name: f.name, all: 0, own: 0, work: 0, stalls: 0, waiting: 0, asleep: 0, cycles: 0, energy: 0, calls: f.calls, halCalls: 0 };
    if (!within(f)) sum.all += f.total[0];
    sum.own += measures[0].of(f);
    for (const part of ["work", "stalls", "waiting", "asleep", "cycles", "energy", "halCalls"]) sum[part] += f[part];
    found.set(f.name, sum);
  }
  const [program, ...others] = [...found.values()];
  return [program, ...others.sort((a, b) => b.own - a.own)];
}

function latencies(profile) {
  if (profile.interrupts.length === 0) return null;
  const most = Math.max(...profile.interrupts.map((i) => i.counts.length));
  const first = Math.min(...profile.interrupts.map((i) => i.counts.findIndex((count) => count > 0)));
  const limits = Array.from({ length: most - first }, (_, n) => time(2 ** (first + n) / 1e3));
  const histogram = chart({
    name: "interrupt-latency", title: "Interrupts by latency", height: 190,
    note: "From the rise of the line to the handler's first statement; each column reaches to twice its time.",
    summary: profile.interrupts.map((i) => `${i.name}: ${counted(i.count, "interrupt")}, ${time(i.mean)} in the mean, ${time(i.worst)} at worst`).join("; ") + ".",
    option: () => ({
      legend: profile.interrupts.length > 1 ? { top: 0, left: 0, textStyle: { color: palette().soft } } : undefined,
      grid: { left: 8, right: 24, top: 32, bottom: 4, containLabel: true }, xAxis: axis({ type: "category", data: limits }), yAxis: axis({ type: "value" }),
      tooltip: { show: true, trigger: "item" },
      series: profile.interrupts.map((i, at) => ({ name: i.name, type: "bar", stack: "all", barMaxWidth: 60, itemStyle: { color: seriesColour(at) }, data: limits.map((_, n) => i.counts[first + n] ?? 0) })),
    }),
    table: () => ({ caption: "Interrupts by latency", rows: profile.interrupts.flatMap((i) => i.counts.map((count, n) => ({ name: i.name, from: n === 0 ? 0 : 2 ** n / 1e3, count }))),
      columns: [{ title: "Interrupt", value: (r) => r.name }, inTime("From", (r) => r.from, 3), { title: "Count", number: true, value: (r) => r.count }] }),
  });
  const table = dataTable({ caption: "Latency of interrupts", name: "latency", exportable: true, rows: profile.interrupts, columns: [
    { title: "Interrupt", head: true, value: (i) => i.name }, { title: "Count", number: true, value: (i) => i.count },
    inTime("Mean", (i) => i.mean, 3), inTime("Worst", (i) => i.worst, 3), inTime("Worst at", (i) => i.worst_at)] });
  return [histogram, table];
}

export function profile(run) {
  const facts = run.extras.profile;
  if (!facts) return null;
  const all = tree(facts.functions, facts.calls);
  const named = facts.named.length > 0 && h("details", {}, h("summary", {}, "Functions that the program names, with their calls"),
    dataTable({ caption: "Functions that the program names", name: "named-functions", exportable: true, rows: facts.named, columns: [
      { title: "Function", head: true, value: (f) => f[0] }, { title: "Calls", number: true, value: (f) => f[1] }, inTime("Itself", (f) => f[2]), inTime("Entry to return", (f) => f[3])] }));
  return h("section", { id: "profile", "aria-labelledby": "profile-title" }, h("h2", { id: "profile-title" }, "PS program"),
    h("p", { class: "note", style: { marginBottom: "20px" } }, `${time(facts.handlers)} in interrupt handlers.`),
    h("div", { class: "stack" }, flameGraph(all), latencies(facts), named));
}

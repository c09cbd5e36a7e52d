// Two runs beside each other.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { significant, signed, tidy, time } from "../kit/format.js";
import { dataTable } from "../kit/table.js";
import { palette, seriesColour } from "../kit/theme.js";
import { makeRun } from "../run/facts.js";
import { gantt } from "../run/gantt.js";
import { stageBars, stagesOf } from "../run/stages.js";

function deltaTable(rows, names) {
  const share = (r) => (Number.isFinite(r.a) && Number.isFinite(r.b) && r.a !== 0 ? 100 * (r.b / r.a - 1) : undefined);
  const mood = (r) => { const d = share(r) * r.better; return !Number.isFinite(d) || Math.abs(d) < 0.005 ? "" : d > 0 ? "good" : "bad"; };
  const number = (v) => tidy(v, 5);
  return dataTable({ caption: "Figures of both runs", name: "comparison", exportable: true, rows, columns: [
    { title: "Figure", head: true, value: (r) => r.title }, { title: "Unit", value: (r) => r.unit }, { title: names[0], number: true, value: (r) => r.a, show: number }, { title: names[1], number: true, value: (r) => r.b, show: number },
    { title: "Change", unit: "%", csv: "Change percent", number: true, value: share, node: (r) => (share(r) === undefined ? "" : h("span", { class: "tag " + mood(r) }, `${signed(share(r), 2)} %`)) }] });
}

function stageChart(runs, names) {
  const rows = runs.map((run, i) => ({ name: names[i], stages: stagesOf(run) }));
  return rows.some((row) => row.stages.length > 0) ? stageBars(rows, runs[0].unit) : null;
}

function latencies(runs, names) {
  if (Math.max(...runs.map((run) => run.delivered.length)) < 2 || !runs.every((run) => run.latency)) return null;
  return chart({
    name: "latency", title: `Latency of each ${runs[0].unit}, ms`, height: 240, canvas: true, summary: runs.map((run, i) => `${names[i]}: mean ${time(run.latency.mean)}`).join(", "),
    option: () => ({
      legend: { top: 0, left: 0, icon: "circle", itemWidth: 8, itemHeight: 8, textStyle: { color: palette().soft } }, grid: { left: 8, right: 24, top: 34, bottom: 4, containLabel: true }, xAxis: axis({ type: "value", min: 1 }), yAxis: axis({ type: "value", scale: true }),
      tooltip: { show: true, trigger: "axis", valueFormatter: (v) => significant(v, 4) },
      series: runs.map((run, i) => ({ name: names[i], type: "line", symbolSize: 5, showSymbol: run.delivered.length < 60, lineStyle: { width: 1.5, color: seriesColour(i) }, itemStyle: { color: seriesColour(i) }, data: run.delivered.map((f) => [f.index + 1, f.time_us[run.unit] / 1e3]) })),
    }),
  });
}

/** Both timelines on one axis that begins with the first frame: every track twice. */
function overlaid(runs, names) {
  const timelines = runs.map((run) => run.extras.timeline);
  if (!timelines.every((timeline) => timeline?.frames?.length)) return null;
  const all = { names: [], tracks: [], counters: [], frames: [] };
  timelines.forEach((timeline, which) => {
    const zero = timeline.frames[0].start;
    const offset = all.names.length;
    all.names.push(...timeline.names);
    timeline.tracks.forEach((track, i) => {
      const spans = track.spans.filter((span) => span[0] + span[1] > zero).map(([start, length, name, hot]) => [Math.max(0, start - zero), Math.min(length, start + length - zero), name + offset, hot]);
      all.tracks.push({ ...track, order: i * 2 + which, name: `${track.name} ${which ? "B" : "A"}`, spans });
    });
    if (all.frames.length === 0 || timeline.frames[0].end - zero > all.frames[0].end) all.frames = [{ index: timeline.frames[0].index, start: 0, end: timeline.frames[0].end - zero }];
  });
  all.tracks.sort((p, q) => p.order - q.order);
  return gantt({ unit: runs[0].unit, extras: { timeline: all } });
}

export function comparePage(first, firstExtras, second, secondExtras, { folders, figures }) {
  const runs = [makeRun(first, firstExtras), makeRun(second, secondExtras)];
  const short = folders.map((folder) => folder.replace(/\/$/, "").split("/").at(-1) || folder);
  const names = short[0] === short[1] ? folders : short;
  const labels = names.map((name, i) => `${"AB"[i]}  ${name}`);
  const changed = [...new Set([...Object.keys(first.configuration ?? {}), ...Object.keys(second.configuration ?? {})])].filter((path) => first.configuration?.[path] !== second.configuration?.[path])
    .map((path) => ({ path, a: first.configuration?.[path], b: second.configuration?.[path] }));
  for (const key of ["system", "fidelity", "profile", "design"]) if (first[key] !== second[key] && !changed.some((c) => c.path === key)) changed.push({ path: key, a: first[key], b: second[key] });
  const section = (id, title, ...content) => h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), h("div", { class: "stack" }, content));
  return {
    title: `${names[0]} and ${names[1]}`, subtitle: `Two runs compared  ·  A is ${folders[0]}, B is ${folders[1]}`,
    sections: [
      section("configuration", "What differs", changed.length ? dataTable({ caption: "Parameters that differ", name: "changed", rows: changed, columns: [{ title: "Parameter", head: true, value: (r) => r.path }, { title: labels[0], value: (r) => r.a }, { title: labels[1], value: (r) => r.b }] }) : h("p", { class: "note" }, "The configurations are equal.")),
      section("figures", "Figures", deltaTable(figures.map((row) => ({ ...row, a: row.a ?? NaN, b: row.b ?? NaN })), labels)),
      section("time", "Time", stageChart(runs, labels), latencies(runs, labels), overlaid(runs, labels)),
    ],
  };
}

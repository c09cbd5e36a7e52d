// Where the time of a frame goes: stages beside the thesis', and everything that happened on one time axis.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant, time, words } from "../kit/format.js";
import { palette, stageColour } from "../kit/theme.js";
import { partsOf } from "./facts.js";
import { gantt } from "./gantt.js";
import { systems, thesisOf } from "./thesis.js";

function stageChart(run) {
  if (run.delivered.length === 0) return null;
  const rows = [{ name: "This run", stages: partsOf(run).map((name) => ({ name, us: run.stageMean(name) })).filter((stage) => stage.us > 0) },
    ...(thesisOf(run) ? systems : []).map(({ title, stages }) => ({ name: title, stages }))];
  const names = [...new Set(rows.flatMap((row) => row.stages.map((stage) => stage.name)))];
  const total = (row) => row.stages.reduce((sum, stage) => sum + stage.us, 0);
  const shown = rows.slice().reverse();
  return chart({
    name: "stages", title: "Stages of a frame, ms", height: rows.length === 1 ? 110 : 190,
    note: rows.length === 1 ? undefined : "Thesis: mean of the 15 images with one to fifteen squares (5.4.1), derived from its published differences; it gives no time for evaluation and reading features.",
    summary: rows.map((row) => `${row.name}: ${time(total(row))}, ${row.stages.map((stage) => `${words(stage.name)} ${time(stage.us)}`).join(", ")}`).join(". "),
    option: () => ({
      legend: { top: 0, left: 0, icon: "roundRect", itemWidth: 10, itemHeight: 10, itemGap: 14, textStyle: { color: palette().soft }, type: "plain" },
      grid: { left: 8, right: 24, top: 52, bottom: 4, containLabel: true },
      xAxis: axis({ type: "value" }),
      yAxis: axis({ type: "category", data: shown.map((row) => row.name), splitLine: { show: false } }),
      tooltip: { show: true, trigger: "item", formatter: (p) => `${p.seriesName}\n${time(p.value * 1e3)}` },
      series: names.map((name) => ({ name: words(name), type: "bar", stack: "all", barMaxWidth: 20, itemStyle: { color: stageColour(name) },
        data: shown.map((row) => (row.stages.find((stage) => stage.name === name)?.us ?? 0) / 1e3) })),
    }),
    table: () => ({ caption: "Stages of a frame", rows: rows.flatMap((row) => row.stages.map((stage) => ({ of: row.name, ...stage }))), columns: [
      { title: "System", value: (r) => r.of }, { title: "Stage", value: (r) => r.name, show: words },
      { title: "Time", unit: "µs", csv: "Time us", number: true, value: (r) => r.us, show: (v) => fixed(v, 1) }] }),
  });
}

export function timing(run) {
  if (run.frames.length === 0) return null;
  return h("section", { id: "time", "aria-labelledby": "time-title" }, h("h2", { id: "time-title" }, "Time"),
    h("div", { class: "stack" }, gantt(run), stageChart(run)));
}

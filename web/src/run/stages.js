// Where the time of a unit goes, one bar a run: stages that follow one another, none with its own parts beside it.
import { axis, chart } from "../kit/chart.js";
import { fixed, time, words } from "../kit/format.js";
import { palette, stageColour } from "../kit/theme.js";
import { partsOf } from "./facts.js";

/** Mean times of a run's stages that add up to its unit: [{name, us}]. */
export const stagesOf = (run) => partsOf(run).map((name) => ({ name, us: run.stageMean(name) })).filter((stage) => stage.us > 0);

/** `rows`: [{name, stages: [{name, us}]}]. */
export function stageBars(rows, unit, note) {
  const names = [...new Set(rows.flatMap((row) => row.stages.map((stage) => stage.name)))];
  const total = (row) => row.stages.reduce((sum, stage) => sum + stage.us, 0);
  const shown = rows.slice().reverse();
  return chart({
    name: "stages", title: `Stages of a ${unit}, ms`, height: rows.length === 1 ? 110 : 190, note,
    summary: rows.map((row) => `${row.name}: ${time(total(row))}, ${row.stages.map((stage) => `${words(stage.name)} ${time(stage.us)}`).join(", ")}`).join(". "),
    option: () => ({
      legend: { top: 0, left: 0, icon: "roundRect", itemWidth: 10, itemHeight: 10, itemGap: 14, textStyle: { color: palette().soft }, type: "plain" },
      grid: { left: 8, right: 24, top: 34, bottom: 4, containLabel: true },
      xAxis: axis({ type: "value" }),
      yAxis: axis({ type: "category", data: shown.map((row) => row.name), splitLine: { show: false }, axisLabel: { width: 180, overflow: "truncate" } }),
      tooltip: { show: true, trigger: "item", formatter: (p) => `${p.seriesName}\n${time(p.value * 1e3)}` },
      series: names.map((name) => ({ name: words(name), type: "bar", stack: "all", barMaxWidth: 20, itemStyle: { color: stageColour(name) },
        data: shown.map((row) => (row.stages.find((stage) => stage.name === name)?.us ?? 0) / 1e3) })),
    }),
    table: () => ({ caption: `Stages of a ${unit}`, rows: rows.flatMap((row) => row.stages.map((stage) => ({ of: row.name, ...stage }))), columns: [
      { title: "System", value: (r) => r.of }, { title: "Stage", value: (r) => r.name, show: words },
      { title: "Time", unit: "µs", csv: "Time us", number: true, value: (r) => r.us, show: (v) => fixed(v, 1) }] }),
  });
}

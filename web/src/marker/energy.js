// The energy of a frame beside what the thesis' software alone would need.
import { axis, chart } from "../kit/chart.js";
import { fixed, significant } from "../kit/format.js";
import { palette, seriesColour } from "../kit/theme.js";
import { systems, thesisOf } from "./thesis.js";

/** This run beside the same work on the PS alone: the thesis' times at the power of this run's PS. */
export function energyChart(run) {
  const power = run.summary.power_w;
  const software = systems.find((system) => !system.logic);
  if (!power || !Number.isFinite(run.summary.energy_per_frame_mj) || !thesisOf(run)?.logic) return null;
  const seconds = run.summary.energy_per_frame_mj / power.total / 1e3;
  const other = software.stages.reduce((sum, stage) => sum + stage.us, 0) / 1e6;
  const parts = [["PS", power.ps, power.ps], ["PL", power.pl, 0], ["Static", power.static, power.static]].filter(([, w]) => Number.isFinite(w));
  const bars = ["PS only (derived)", "This run"];
  const sums = [parts.reduce((sum, p) => sum + p[2] * other * 1e3, 0), parts.reduce((sum, p) => sum + p[1] * seconds * 1e3, 0)];
  return chart({
    name: "energy-per-frame", title: "Energy per frame, mJ", height: 150,
    note: `PS only: the thesis' times of the same work on the PS (${fixed(other * 1e3, 0)} ms a frame) at the power that the PS draws here, without the logic's own power.`,
    summary: `This run needs ${significant(sums[1], 3)} mJ a frame; the PS alone would need ${significant(sums[0], 3)} mJ.`,
    option: () => ({
      legend: { top: 0, left: 0, icon: "roundRect", itemWidth: 10, itemHeight: 10, textStyle: { color: palette().soft } },
      grid: { left: 8, right: 24, top: 30, bottom: 4, containLabel: true },
      xAxis: axis({ type: "value" }), yAxis: axis({ type: "category", data: bars, splitLine: { show: false } }),
      tooltip: { show: true, trigger: "item", valueFormatter: (v) => significant(v, 3) + " mJ" },
      series: parts.map(([name, here, there], i) => ({ name, type: "bar", stack: "all", barMaxWidth: 20, itemStyle: { color: seriesColour(i) }, data: [there * other * 1e3, here * seconds * 1e3] })),
    }),
    table: () => ({ caption: "Energy per frame", rows: parts, columns: [{ title: "Part", value: (p) => p[0], head: true },
      { title: "This run mJ", number: true, value: (p) => p[1] * seconds * 1e3, show: (v) => significant(v, 3) },
      { title: "PS only mJ", number: true, value: (p) => p[2] * other * 1e3, show: (v) => significant(v, 3) }] }),
  });
}

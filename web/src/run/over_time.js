// How the run went, unit by unit.
import uPlot from "uplot";
import { axis, chart } from "../kit/chart.js";
import { fixed, heading } from "../kit/format.js";
import { palette } from "../kit/theme.js";

const font = "12px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";

/** A long series with µPlot: tens of thousands of values stay quick. */
function plot(data, label) {
  return (target, height) => {
    let instance = null;
    const make = () => {
      const colour = palette();
      const quiet = { stroke: colour.soft, font, grid: { stroke: colour.line, width: 1 }, ticks: { show: false } };
      instance?.destroy();
      instance = new uPlot({
        width: target.clientWidth, height: height - 32,
        scales: { x: { time: false } },
        series: [{ label: "Number" }, { label, stroke: colour.blue, width: 1.5, value: (_, v) => (v == null ? "–" : fixed(v, 3)), points: { show: data[0].length < 80, size: 5, fill: colour.page } }],
        axes: [{ ...quiet, incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000] }, { ...quiet, size: 56 }],
      }, data, target);
    };
    make();
    return { redraw: make, resize: () => instance.setSize({ width: target.clientWidth, height: height - 32 }) };
  };
}

export function overTime(run) {
  const frames = run.delivered;
  if (frames.length < 4) return null;
  const x = frames.map((frame) => frame.index + 1);
  const y = frames.map((frame) => frame.time_us[run.unit] / 1e3);
  return chart({
    name: "latency", title: `Latency of each ${run.unit}, ms`, height: 240,
    summary: `From ${fixed(run.latency.low / 1e3, 3)} to ${fixed(run.latency.high / 1e3, 3)} ms, mean ${fixed(run.latency.mean / 1e3, 3)} ms.`,
    screen: plot([x, y], "Latency, ms"),
    option: () => ({
      xAxis: axis({ type: "value", min: 1, max: x.at(-1) }), yAxis: axis({ type: "value", scale: true }),
      series: [{ type: "line", data: x.map((value, i) => [value, y[i]]), symbol: "none", lineStyle: { color: palette().blue, width: 1.5 } }],
    }),
    table: () => ({ caption: `Latency of each ${run.unit}`, rows: frames, columns: [
      { title: heading(run.unit), value: (f) => f.index + 1, number: true }, { title: "Input", value: (f) => f.input },
      { title: "Latency", unit: "ms", csv: "Latency ms", value: (f) => f.time_us[run.unit] / 1e3, show: (v) => fixed(v, 3), number: true }] }),
  });
}

// How a search went, and what rules points out.
import { axis, chart } from "../kit/chart.js";
import { counted, fixed, significant } from "../kit/format.js";
import { palette } from "../kit/theme.js";

/** The hypervolume of the front over the points that the search looked at. */
export function progress({ progress: found, counts }) {
  if (!found) return null;
  const steps = found.points.map((points, i) => ({ points, hypervolume: found.hypervolume[i] }));
  const last = steps.at(-1);
  // From when on it was within a hundredth of what it came to.
  const settled = steps.find(({ hypervolume }) => hypervolume >= 0.99 * last.hypervolume);
  return chart({
    name: "progress", title: "How the search went", height: 240,
    note: "The part that the front dominates of the box between the best and the worst feasible figures (hypervolume), after so many points. Where it is flat, more points bring little.",
    summary: () => `Of ${counted(counts.points, "point")} the first ${fixed(settled.points, 0)} brought 99 % of the final hypervolume, ${significant(last.hypervolume, 3)}.`,
    option: () => {
      const c = palette();
      return {
        grid: { left: 20, right: 24, top: 28, bottom: 34, containLabel: true },
        xAxis: axis({ type: "value", min: 0, max: last.points, name: "points looked at" }),
        yAxis: axis({ type: "value", min: 0, max: 1, name: "hypervolume", nameGap: 40 }),
        tooltip: { show: true, trigger: "axis", formatter: ([p]) => `${counted(p.value[0], "point")}\nhypervolume ${significant(p.value[1], 4)}` },
        series: [{ type: "line", symbol: "none", step: "end", data: steps.map(({ points, hypervolume }) => [points, hypervolume]), lineStyle: { color: c.green, width: 2 }, areaStyle: { color: c.green, opacity: 0.12 },
          markLine: { silent: true, symbol: "none", lineStyle: { color: c.faint, type: "dashed" }, label: { formatter: "99 %", position: "end", rotate: 0, color: c.soft }, data: [{ xAxis: settled.points }] } }],
      };
    },
    table: () => ({ caption: "Hypervolume after so many points", rows: steps, columns: [
      { title: "Points", number: true, value: (s) => s.points }, { title: "Hypervolume", number: true, value: (s) => s.hypervolume, show: (v) => significant(v, 5) }] }),
  });
}

/** "timing missed by pl.a" and "timing missed by pl.b" are one kind, so are "1 of 3 frames with losses" and "2 of 3 …". */
const kindOf = (reason) => (/^(breaks|outside) /.test(reason) ? reason
  : reason.replace(/^failed: .*/, "failed").replace(/^\d+ of \d+ /, "").replace(/ (by|in|of|for) .*/, ""));

/** For each kind of reason how many points it rules out, and of these how many alone; within the reader's limits. */
function countedReasons(sweep, selection) {
  const kinds = new Map();
  let out = 0;
  for (const point of sweep.points) {
    const here = new Set(selection.why(point).map(kindOf));
    if (here.size > 0) out += 1;
    for (const kind of here) {
      const row = kinds.get(kind) ?? { kind, alone: 0, all: 0 };
      row.all += 1;
      if (here.size === 1) row.alone += 1;
      kinds.set(kind, row);
    }
  }
  return { out, rows: [...kinds.values()].sort((a, b) => b.all - a.all || (a.kind < b.kind ? -1 : 1)).slice(0, 12) };
}

/** What rules points out, as bars. */
export function whyNot(sweep, selection) {
  const possible = sweep.points.some((p) => p.reasons.length > 0) || sweep.limits.length > 0;
  if (!possible) return null;
  let found = countedReasons(sweep, selection);
  const figure = chart({
    name: "why-not", title: "What rules points out", height: 48 * Math.max(2, found.rows.length) + 90,
    note: `Filled: points that nothing else rules out; they come back if this is mended, or the limit let go.${sweep.counts.points > sweep.points.length ? " Counted are the points that this page has." : ""}`,
    summary: () => `${counted(found.out, "point")} of ${fixed(sweep.points.length, 0)} ruled out. ${found.rows.map((r) => `${r.kind}: ${fixed(r.all, 0)}, ${fixed(r.alone, 0)} of them by this alone`).join(". ")}`,
    option: () => {
      const c = palette();
      found = countedReasons(sweep, selection);
      const rows = found.rows.slice().reverse();
      const bar = (name, style, of) => ({ type: "bar", name, stack: "points", barWidth: 18, itemStyle: style, data: rows.map(of) });
      return {
        legend: { top: 0, left: 0, itemWidth: 12, itemHeight: 9, data: ["by this alone", "by this and others"], textStyle: { color: c.soft } },
        grid: { left: 8, right: 30, top: 36, bottom: 34, containLabel: true },
        xAxis: axis({ type: "value", min: 0, minInterval: 1, name: "points" }),
        yAxis: axis({ type: "category", data: rows.map((r) => r.kind), splitLine: { show: false }, axisLabel: { width: 260, overflow: "truncate" } }),
        tooltip: { show: true, formatter: (p) => { const r = rows[p.dataIndex]; return `${r.kind}\n${counted(r.all, "point")}, ${fixed(r.alone, 0)} by this alone`; } },
        series: [bar("by this alone", { color: c.vermilion }, (r) => r.alone), bar("by this and others", { color: c.vermilion, opacity: 0.3 }, (r) => r.all - r.alone)],
      };
    },
    table: () => ({ caption: "What rules points out", rows: found.rows, columns: [
      { title: "Reason", value: (r) => r.kind }, { title: "Points", number: true, value: (r) => r.all }, { title: "By this alone", number: true, value: (r) => r.alone }] }),
  });
  selection.onChange(() => figure.update());
  return figure;
}

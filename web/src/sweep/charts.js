// What a sweep shows: trade-off, all axes at once, a map of two parameters, what matters most.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant, tidy } from "../kit/format.js";
import { isDark, palette } from "../kit/theme.js";
import { shortName } from "./facts.js";

const ramp = () => { const c = palette(); return isDark() ? ["#22303c", c.blue, c.sky] : ["#e6eef4", c.sky, c.blue]; };
/** Of a text on the ramp, at `share` of it. */
const onRamp = (share) => { const c = palette(); return share > (isDark() ? 0.4 : 0.7) ? c.page : c.ink; };
export const value = (ax, point) => (Number.isFinite(ax.of(point)) ? tidy(ax.of(point)) + (ax.unit ? " " + ax.unit : "") : "–");

/** What the error bands of its figures leave of a point's place. */
const certainty = { no: "No other point can beat it, by the bands", unknown: "Another point beats it perhaps, by the bands", yes: "Another point beats it for sure" };

export function describe(sweep, point, selection) {
  return [...sweep.parameters.map((p) => `${p.name} ${p.text(point)}`),
    ...sweep.metrics.slice(0, 6).map((m) => `${m.name} ${value(m, point)}`), ...selection.why(point), ...(point.dominated ? [certainty[point.dominated]] : [])].join("\n");
}

export function opener(open, pick) {
  return (instance, again) => again || instance.on("click", (event) => { const point = pick(event); if (point) open(point); });
}

/** For a cell; the whole text is in the point's panel and in the CSV. */
function clipped(reason) {
  const text = reason.replace(/^failed: program .*? ended with exit code \d+: /, "failed: ");
  return text.length > 56 ? text.slice(0, 55) + "…" : text;
}

export const columnsOf = (sweep, selection, rows = sweep.points) => [
  ...sweep.parameters.map((p) => ({ title: p.name, value: (point) => (p.numeric ? p.of(point) : p.text(point)), show: (_, point) => p.text(point), number: p.numeric, csv: sweep.label(p) })),
  ...(rows.some((p) => p.same_as) ? [{ title: "Same point", value: (point) => point.same_as ?? "" }] : []),
  ...(rows.some((p) => !selection.good(p)) ? [{ title: "Why not", value: (point) => selection.why(point).join("; "), show: clipped }] : []),
  ...sweep.metrics.map((m) => ({ title: m.name, unit: m.unit, csv: sweep.label(m), number: true, value: (point) => m.of(point), show: (v) => (Number.isFinite(v) ? tidy(v) : "") })),
];

/** Lines that are drawn: more would only be a blot. */
const mostLines = 1500;
const spread = (points, most) => (points.length <= most ? points : Array.from({ length: most }, (_, i) => points[Math.floor(i * points.length / most)]));

/** Marks what is kept of an axis. ECharts paints the marks that a drag makes as it is asked to, others always grey. */
function mark(instance, model, intervals, { width, color, opacity }) {
  model.setActiveIntervals(intervals);
  instance.getViewOfComponentModel(model)._brushController.updateCovers(intervals.map((range) => ({
    brushType: "lineX", panelId: "pl", range: range.map((number) => model.axis.dataToCoord(number, true)),
    brushStyle: { fill: color, stroke: color, lineWidth: 1, opacity }, brushMode: "multiple", width })));
}

export function parallel(sweep, selection) {
  const axes = [...sweep.parameters, ...sweep.metrics.filter((m) => new Set(sweep.whole.map((p) => m.of(p)).filter(Number.isFinite)).size > 1).slice(0, 6)];
  if (axes.length < 2) return null;
  const colourBy = sweep.metrics.find((m) => m.id === "summary.energy_per_frame_mj") ?? sweep.metrics[0] ?? axes[0];
  const points = sweep.whole.filter((p) => axes.every((a) => Number.isFinite(a.of(p))));
  if (points.length === 0) return null;
  const extent = (a) => points.reduce(([least, most], p) => [Math.min(least, a.of(p)), Math.max(most, a.of(p))], [Infinity, -Infinity]);
  const extents = axes.map(extent);
  const [least, most] = extent(colourBy);
  const open = (dim, [low, high]) => [low <= extents[dim][0] ? -Infinity : low, high >= extents[dim][1] ? Infinity : high];
  const closed = (dim, [low, high]) => [Math.max(low, extents[dim][0]), Math.min(high, extents[dim][1])];
  // Lines are drawn anew only when the mouse is let go: its own marks must stay under it.
  let dragging = false;
  const status = h("p", { class: "note", role: "status" });
  const kept = () => points.filter(selection.keeps);
  const style = () => { const c = palette(); return { width: 18, color: c.orange, opacity: 0.35, borderColor: c.orange, borderWidth: 1 }; };
  const say = () => {
    const count = kept().length;
    status.textContent = [count < points.length && `${counted(count, "point")} kept.`, count > mostLines && `${fixed(mostLines, 0)} of them are drawn.`].filter(Boolean).join(" ");
  };
  const figure = chart({
    name: "parallel", title: "All parameters and figures", height: 400, least: axes.length * 92, canvas: true,
    note: `One line a point, coloured by ${colourBy.name.toLowerCase()}. Drag along an axis to keep what passes there, in all charts; click beside it to let go.`,
    summary: `${counted(points.length, "point")} on ${counted(axes.length, "axis").replace("axiss", "axes")}: ${axes.map((a) => a.name).join(", ")}.`,
    option: () => {
      const c = palette();
      const shown = spread(kept(), mostLines);
      const line = (p) => [...axes.map((a) => a.of(p)), colourBy.of(p)];
      const lines = { type: "parallel", progressive: 0 };
      return {
        parallel: { left: 56, right: 72, top: 56, bottom: 24, parallelAxisDefault: {
          nameTextStyle: { color: c.soft, fontSize: 11, lineHeight: 14 }, nameGap: 12, axisLine: { lineStyle: { color: c.faint } }, axisTick: { show: false },
          axisLabel: { color: c.ink, fontSize: 11, textBorderColor: c.page, textBorderWidth: 4 }, z: 4 } },
        parallelAxis: axes.map((a, dim) => ({ dim, areaSelectStyle: style(), name: a.parameter ? shortName(a, "\n") : `${a.name}\n${a.unit}`, scale: true, minInterval: points.every((p) => Number.isInteger(a.of(p))) ? 1 : undefined, type: a.numeric ? "value" : "category", data: a.numeric ? undefined : a.words })),
        visualMap: { show: false, seriesIndex: 1, min: least, max: most, dimension: axes.length, inRange: { color: [c.green, c.yellow, c.vermilion] } },
        series: [
          { ...lines, silent: true, lineStyle: { color: c.grey, width: 0.6, opacity: 0.12 }, activeOpacity: 0.12, inactiveOpacity: 0.12, data: spread(points, mostLines / 3).map(line) },
          { ...lines, lineStyle: { width: shown.length > 1000 ? 0.6 : 1.1 }, activeOpacity: shown.length > 1000 ? 0.35 : 0.6, inactiveOpacity: 0, data: shown.map(line) },
        ].map((series) => ({ ...series, lineStyle: { ...series.lineStyle, opacity: series.activeOpacity } })),
      };
    },
    ready: (instance, again) => {
      say();
      const model = (dim) => instance.getModel().getComponent("parallelAxis", dim);
      const wanted = (dim) => selection.ranges(axes[dim]).map((range) => closed(dim, range));
      for (const dim of axes.keys()) mark(instance, model(dim), wanted(dim), style());
      if (again) return;
      instance.getDom().addEventListener("pointerdown", () => { dragging = true; });
      window.addEventListener("pointerup", () => { if (dragging) { dragging = false; figure.update(); } });
      instance.on("axisareaselected", () => {
        for (const [dim, a] of axes.entries()) {
          const { activeIntervals } = model(dim);
          if (JSON.stringify(activeIntervals) !== JSON.stringify(wanted(dim))) selection.set(a, activeIntervals.map((range) => open(dim, range)));
        }
      });
    },
    table: () => ({ caption: "Points that are kept", rows: kept(), columns: columnsOf(sweep, selection, kept()) }),
  });
  selection.onChange(() => (dragging ? say() : figure.update()));
  say();
  figure.append(status);
  return figure;
}

export function heatMap(sweep, selection, open) {
  const axes = sweep.parameters;
  if (axes.length < 2 || sweep.metrics.length === 0) return null;
  const chosen = { x: axes[0], y: axes[1], z: sweep.objectives.find((o) => !o.parameter) ?? sweep.metrics[0] };
  let figure = null;
  const holder = h("div");
  const build = () => {
    const { x, y, z } = chosen;
    const sorted = (a) => [...new Map(sweep.points.map((p) => [a.of(p), a.text(p)])).entries()].sort((p, q) => p[0] - q[0]);
    const xs = sorted(x), ys = sorted(y);
    const rank = (list) => new Map(list.map((entry, i) => [entry[0], i]));
    const xRank = rank(xs), yRank = rank(ys);
    const cells = new Map();
    for (const p of sweep.points) {
      const key = [xRank.get(x.of(p)), yRank.get(y.of(p))];
      const number = key[1] * xs.length + key[0];
      if (!cells.has(number)) cells.set(number, { key, points: [] });
      cells.get(number).points.push(p);
    }
    const valueOf = (points) => {
      let sum = 0, count = 0;
      for (const p of points) if (!p.failed && Number.isFinite(z.of(p))) { sum += z.of(p); count += 1; }
      return sum / count;
    };
    // A cell of which nothing is kept pales, with the mean of all.
    const summed = () => [...cells.values()].map(({ key, points }) => {
      const kept = points.filter(selection.keeps);
      return { key, points: kept.length ? kept : points, kept: kept.length > 0, mean: valueOf(kept.length ? kept : points), bad: !points.some((p) => p.faults.length === 0) };
    });
    let all = summed(), data = null, means = null, least = 0, most = 0;
    const take = () => {
      all = summed();
      data = all.filter((cell) => Number.isFinite(cell.mean));
      means = data.map((cell) => cell.mean);
      [least, most] = [means.reduce((a, b) => Math.min(a, b), Infinity), means.reduce((a, b) => Math.max(a, b), -Infinity)];
    };
    take();
    const failed = all.filter((cell) => !Number.isFinite(cell.mean) && cell.points.every((p) => p.failed));
    const place = (cell) => `${x.name} ${xs[cell.key[0]][1]}\n${y.name} ${ys[cell.key[1]][1]}\n`;
    const why = (cell) => (cell.points.length === 1 ? selection.why(cell.points[0]).map((reason) => "\n" + reason).join("") : "");
    const wide = Math.max(...ys.map((e) => e[1].length)) * 6.6 + 16;
    // Of cells a few pixels high, whole outlines would hide the colours.
    const outline = ys.length > 40 || xs.length > 100 ? 0.3 : 1;
    figure?.leave();
    figure = chart({
      name: "heat-map", title: `${sweep.label(z)} over two parameters`, height: Math.min(560, Math.max(260, ys.length * 26 + 126)), least: Math.min(900, xs.length * 54 + wide + 60), canvas: data.length > 900,
      note: ["Mean where several points share a cell; pale where none is within the limits.", data.some((cell) => cell.bad) && "Outlined cells are not feasible or not proven.", failed.length > 0 && "Crossed cells failed."].filter(Boolean).join(" "),
      summary: () => means.length ? `From ${significant(least, 4)} to ${significant(most, 4)}.` : "No values.",
      option: () => {
        const c = palette();
        take();
        return {
          grid: { left: wide + 34, right: 24, top: 8, bottom: 100, outerBoundsMode: "none" },
          xAxis: axis({ type: "category", data: xs.map((e) => e[1]), name: x.name, splitLine: { show: false }, nameGap: 30 }),
          yAxis: axis({ type: "category", data: ys.map((e) => e[1]), splitLine: { show: false }, name: y.name, nameGap: wide }),
          visualMap: { type: "continuous", seriesIndex: 0, min: least, max: most, orient: "horizontal", left: "center", bottom: 0, itemWidth: 10, itemHeight: 180,
            text: [`${significant(most, 4)} ${z.unit}`, significant(least, 4)], textStyle: { color: c.soft }, inRange: { color: ramp() } },
          tooltip: { show: true, formatter: (p) => `${place(p.data.cell)}${p.seriesType === "custom" ? "no value" : `${z.name} ${significant(p.value[2], 4)} ${z.unit}`}${why(p.data.cell)}` },
          series: [{ type: "heatmap", label: { show: xs.length <= 12 && ys.length <= 24, formatter: (p) => significant(p.value[2], 4), fontSize: 11 },
            data: data.map((cell) => ({ value: [...cell.key, cell.mean], cell, label: { color: cell.kept ? onRamp((cell.mean - least) / (most - least)) : c.soft }, itemStyle: { borderColor: cell.bad ? c.vermilion : c.page, borderWidth: outline, opacity: cell.kept ? 1 : 0.2 } })) },
          { type: "custom", data: failed.map((cell) => ({ value: cell.key, cell })), renderItem: (_, api) => {
            const [px, py] = api.coord([api.value(0), api.value(1)]);
            const [width, height] = api.size([1, 1]).map((size) => size - 2);
            const [left, top] = [px - width / 2, py - height / 2];
            const arm = Math.min(5, height / 3, width / 3);
            const stroke = { stroke: c.vermilion, lineWidth: 1.2 };
            const cross = (sign) => ({ type: "line", shape: { x1: px - arm, y1: py - sign * arm, x2: px + arm, y2: py + sign * arm }, style: stroke });
            return { type: "group", children: [{ type: "rect", shape: { x: left, y: top, width, height }, style: { fill: c.raised } }, cross(1), cross(-1)] };
          } }],
        };
      },
      ready: opener(open, (event) => event.data?.cell?.points[0]),
      table: () => ({ caption: `${z.name} over ${x.name} and ${y.name}`, rows: all, columns: [
        { title: x.name, value: (cell) => xs[cell.key[0]][1] }, { title: y.name, value: (cell) => ys[cell.key[1]][1] },
        { title: z.name, unit: z.unit, number: true, value: (cell) => cell.mean, show: (v) => (Number.isFinite(v) ? significant(v, 5) : "–") }] }),
    });
    holder.replaceChildren(figure);
  };
  const choice = (label, key, list) => {
    const select = h("select", { onchange: () => { chosen[key] = list[select.value]; build(); } },
      list.map((a, i) => h("option", { value: String(i), selected: a === chosen[key] }, a.name)));
    return h("label", {}, label, select);
  };
  build();
  selection.onChange(() => figure.update());
  return h("div", {}, h("div", { class: "controls" }, choice("Figure", "z", sweep.metrics), choice("Across", "x", axes), choice("Up", "y", axes)), holder);
}

/** What moves the first objective: the program computed it, by one rule for console and page. */
export function tornado(sweep) {
  const { influence } = sweep;
  if (!influence) return null;
  const note = influence.note && h("p", { class: "note" }, `${influence.note[0].toUpperCase()}${influence.note.slice(1)}.`);
  if (influence.rows.length === 0) return note || null;
  const metric = sweep.objectives.find(({ id }) => id === influence.metric) ?? { name: influence.metric, unit: "", scale: 1 };
  const scaled = (number) => number * (metric.scale ?? 1);
  const rows = influence.rows.slice().reverse();
  const most = (r) => (r.low_at === undefined || r.size === 0 ? "" : `${significant(scaled(r.low), 4)} at ${r.low_at}, ${significant(scaled(r.high), 4)} at ${r.high_at}`);
  const figure = chart({
    name: "tornado", title: `What moves ${sweep.label(metric)}`, height: 44 * rows.length + 70,
    note: `${influence.basis[0].toUpperCase()}${influence.basis.slice(1)}. All feasible points count, whatever the limits.`,
    summary: () => influence.rows.map((r) => `${r.path}: ${significant(scaled(r.size), 4)}${most(r) && ` (${most(r)})`}`).join(". "),
    option: () => {
      const c = palette();
      return {
        grid: { left: 8, right: 30, top: 8, bottom: 8, containLabel: true },
        xAxis: axis({ type: "value", min: 0 }),
        yAxis: axis({ type: "category", data: rows.map((r) => r.path), splitLine: { show: false }, axisLabel: { width: 220, overflow: "truncate" } }),
        tooltip: { show: true, formatter: (p) => { const r = rows[p.dataIndex]; return [r.path, `${significant(scaled(r.size), 4)} ${metric.unit}`, most(r)].filter(Boolean).join("\n"); } },
        series: [{ type: "bar", barWidth: 16, itemStyle: { color: c.blue, borderRadius: 2 }, data: rows.map((r) => scaled(r.size)) }],
      };
    },
    table: () => ({ caption: `What moves ${metric.name}`, rows: influence.rows, columns: [
      { title: "Parameter", value: (r) => r.path }, { title: "Change", unit: metric.unit, number: true, value: (r) => scaled(r.size), show: (v) => significant(v, 4) },
      { title: "From", number: true, value: (r) => r.count }, { title: "Largest", value: most }] }),
  });
  return h("div", {}, figure, note);
}

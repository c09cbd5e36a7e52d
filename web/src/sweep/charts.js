// What a sweep shows: trade-off, all axes at once, a map of two parameters, what matters most.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant, tidy } from "../kit/format.js";
import { isDark, palette } from "../kit/theme.js";
import { shortName } from "./facts.js";

const ramp = () => { const c = palette(); return isDark() ? ["#22303c", c.blue, c.sky] : ["#e6eef4", c.sky, c.blue]; };
/** Of a text on the ramp, at `share` of it. */
const onRamp = (share) => { const c = palette(); return share > (isDark() ? 0.4 : 0.7) ? c.page : c.ink; };
/** A round step that parts `range` into about `parts`. */
function roundStep(range, parts) {
  const decade = 10 ** Math.floor(Math.log10(range / parts));
  return decade * [1, 2, 5, 10].find((n) => n * decade >= (range / parts) * 0.999);
}

const value = (ax, point) => (Number.isFinite(ax.of(point)) ? tidy(ax.of(point)) + (ax.unit ? " " + ax.unit : "") : "–");

export function describe(sweep, point) {
  return [...sweep.parameters.map((p) => `${p.name} ${p.text(point)}`),
    ...sweep.metrics.slice(0, 6).map((m) => `${m.name} ${value(m, point)}`), ...point.reasons].join("\n");
}

function opener(open, pick) {
  return (instance, again) => again || instance.on("click", (event) => { const point = pick(event); if (point) open(point); });
}

/** Lines of equal energy a frame, from edge to edge of the plot; none where it does not show rate and power. */
function isoLines(sweep, points, floor, ceiling) {
  const { x: fps, y: power } = sweep;
  if (fps?.id !== "summary.fps.mean" || power?.id !== "power.total_w.nominal") return [];
  const energies = points.map((p) => 1e3 * power.of(p) / fps.of(p));
  const [least, most] = [Math.min(...energies), Math.max(...energies)];
  if (!(most > least)) return [];
  const step = roundStep(most - least, window.innerWidth < 620 ? 3 : 7);
  const rates = points.map((p) => fps.of(p));
  const [low, high] = [Math.min(...rates), Math.max(...rates)];
  const lines = [];
  for (let mj = Math.ceil(least / step) * step; mj <= most; mj += step) {
    const from = Math.max(low, floor * 1e3 / mj);
    const to = Math.min(high, ceiling * 1e3 / mj);
    if (to > from) lines.push({ mj, line: [[from, mj * from / 1e3], [to, mj * to / 1e3]] });
  }
  return lines;
}

export function tradeOff(sweep, open) {
  const { x, y, front } = sweep;
  if (!x || !y) return null;
  const known = sweep.whole.filter((p) => Number.isFinite(x.of(p)) && Number.isFinite(y.of(p)));
  if (known.length === 0) return null;
  const onFront = new Set(front);
  const place = (p) => ({ value: [x.of(p), y.of(p)], point: p });
  const powers = known.map((p) => y.of(p));
  const range = Math.max(...powers) - Math.min(...powers) || 0.1;
  const tick = roundStep(range * 1.16, 6);
  const floor = Math.floor((Math.min(...powers) - range * 0.08) / tick) * tick, ceiling = Math.ceil((Math.max(...powers) + range * 0.08) / tick) * tick;
  const lines = isoLines(sweep, known, floor, ceiling);
  const groups = () => {
    const c = palette();
    return [
      { name: "Feasible", points: known.filter((p) => p.reasons.length === 0 && !onFront.has(p)), symbol: "circle", size: 6, style: { color: c.blue, opacity: 0.55 } },
      { name: "Not feasible or not proven", points: known.filter((p) => p.reasons.length > 0), symbol: "path://M1 0L5 4L9 0L10 1L6 5L10 9L9 10L5 6L1 10L0 9L4 5L0 1Z", size: 7, style: { color: c.vermillion, opacity: 0.6 } },
      { name: "Pareto front", points: front, symbol: "diamond", size: 10, style: { color: c.green } },
    ].filter((group) => group.points.length > 0);
  };
  const reasons = [...new Set(known.flatMap((p) => p.reasons))].sort((a, b) => a.length - b.length);
  const failed = sweep.points.length - sweep.whole.length;
  return chart({
    name: "trade-off", title: `${x.name} and ${y.name.toLowerCase()}`, height: 440, canvas: true,
    note: `No feasible point beats one of the front in all that the study asks for.${lines.length ? " Grey lines: equal energy a frame." : ""}${reasons.length ? " Crossed: not feasible, or not proven (" + reasons.slice(0, 2).join("; ") + (reasons.length > 2 ? "; …" : "") + ")." : ""}${failed ? ` ${counted(failed, "point")} that failed ${failed === 1 ? "is" : "are"} left out here; the table and the map say why.` : ""} A click opens a point.`,
    summary: `${counted(known.length, "point")}, ${fixed(known.filter((p) => p.reasons.length).length, 0)} of them not feasible or not proven. The front has ${counted(front.length, "point")}` +
      (front.length ? `, from ${value(x, front[0])} at ${value(y, front[0])} to ${value(x, front.at(-1))} at ${value(y, front.at(-1))}.` : "."),
    option: () => {
      const c = palette();
      return {
        legend: { top: 0, left: 0, itemWidth: 9, itemHeight: 9, data: groups().map((g) => g.name), textStyle: { color: c.soft } },
        grid: { left: 20, right: 64, top: 36, bottom: 34, containLabel: true },
        xAxis: axis({ type: "value", scale: true, name: sweep.label(x) }),
        yAxis: axis({ type: "value", min: floor, max: ceiling, interval: tick, name: sweep.label(y), nameGap: 44, axisLabel: { formatter: (v) => significant(Number(v.toPrecision(9)), tick < 0.01 ? 4 : 3) } }),
        tooltip: { show: true, trigger: "item", formatter: (p) => (p.data.point ? describe(sweep, p.data.point) : p.seriesName) },
        series: [
          ...lines.map(({ mj, line }) => ({ type: "line", name: `${mj} mJ`, silent: true, symbol: "none", clip: true, data: line, z: 0,
            lineStyle: { color: c.faint, width: 1, type: "dotted", opacity: 0.8 }, endLabel: { show: true, distance: 2, formatter: `${tidy(Number(mj.toPrecision(6)))} mJ`, color: c.faint, fontSize: 11 } })),
          sweep.objectives.length <= 2 && { type: "line", name: "front", silent: true, symbol: "none", data: front.map((p) => [x.of(p), y.of(p)]), step: x.better > 0 && y.better < 0 ? "start" : undefined, lineStyle: { color: c.green, width: 1.5 }, z: 1 },
          ...groups().map((g) => ({ type: "scatter", name: g.name, symbol: g.symbol, symbolSize: g.size, itemStyle: g.style, data: g.points.map(place), z: g.name === "Pareto front" ? 4 : 2 })),
        ].filter(Boolean),
      };
    },
    ready: opener(open, (event) => event.data?.point),
    table: () => ({ caption: "Points of the Pareto front", rows: front, columns: columnsOf(sweep) }),
  });
}

/** For a cell; the whole text stands in the point's panel and in the CSV. */
function clipped(reason) {
  const text = reason.replace(/^failed: program .*? ended with exit code \d+: /, "failed: ");
  return text.length > 56 ? text.slice(0, 55) + "…" : text;
}

export const columnsOf = (sweep, rows = sweep.points) => [
  ...sweep.parameters.map((p) => ({ title: p.name, value: (point) => (p.numeric ? p.of(point) : p.text(point)), show: (_, point) => p.text(point), number: p.numeric, csv: sweep.label(p) })),
  ...(rows.some((p) => p.reasons.length > 0) ? [{ title: "Why not", value: (point) => point.reasons.join("; "), show: clipped }] : []),
  ...sweep.metrics.map((m) => ({ title: m.name, unit: m.unit, csv: sweep.label(m), number: true, value: (point) => m.of(point), show: (v) => (Number.isFinite(v) ? tidy(v) : "") })),
];

export function parallel(sweep, open) {
  const axes = [...sweep.parameters, ...sweep.metrics.filter((m) => new Set(sweep.whole.map((p) => m.of(p)).filter(Number.isFinite)).size > 1).slice(0, 6)];
  if (axes.length < 2) return null;
  const colourBy = sweep.metrics.find((m) => m.id === "summary.energy_per_frame_mj") ?? sweep.metrics[0] ?? axes[0];
  const points = sweep.whole.filter((p) => axes.every((a) => Number.isFinite(a.of(p))));
  if (points.length === 0) return null;
  const values = points.map((p) => colourBy.of(p)).filter(Number.isFinite);
  const status = h("p", { class: "note", role: "status" });
  const figure = chart({
    name: "parallel", title: "All parameters and figures", height: 400, least: axes.length * 92, canvas: true,
    note: `One line a point, coloured by ${colourBy.name.toLowerCase()}. Drag along an axis to keep what passes there; click beside it to let go.`,
    summary: `${counted(points.length, "point")} on ${counted(axes.length, "axis").replace("axiss", "axes")}: ${axes.map((a) => a.name).join(", ")}.`,
    option: () => {
      const c = palette();
      return {
        parallel: { left: 56, right: 72, top: 56, bottom: 24, parallelAxisDefault: {
          nameTextStyle: { color: c.soft, fontSize: 11, lineHeight: 14 }, nameGap: 12, axisLine: { lineStyle: { color: c.faint } }, axisTick: { show: false },
          axisLabel: { color: c.ink, fontSize: 11, textBorderColor: c.page, textBorderWidth: 4 }, z: 4, areaSelectStyle: { width: 18, color: c.orange, opacity: 0.35, borderColor: c.orange, borderWidth: 1 } } },
        parallelAxis: axes.map((a, dim) => ({ dim, name: a.parameter ? shortName(a, "\n") : `${a.name}\n${a.unit}`, scale: true, minInterval: points.every((p) => Number.isInteger(a.of(p))) ? 1 : undefined, type: a.numeric ? "value" : "category", data: a.numeric ? undefined : a.words })),
        visualMap: { show: false, min: Math.min(...values), max: Math.max(...values), dimension: axes.length, inRange: { color: [c.green, c.yellow, c.vermillion] } },
        series: [{ type: "parallel", lineStyle: { width: points.length > 1000 ? 0.6 : 1.1, opacity: points.length > 1000 ? 0.25 : 0.6 }, inactiveOpacity: 0.03, progressive: 400,
          data: points.map((p) => [...axes.map((a) => a.of(p)), colourBy.of(p)]) }],
      };
    },
    ready: (instance, again) => again || instance.on("axisareaselected", () => {
      const series = instance.getModel().getSeriesByIndex(0);
      const kept = series.getRawIndicesByActiveState("active");
      status.textContent = kept.length === points.length ? "" : `${counted(kept.length, "point")} kept.`;
    }),
    table: () => ({ caption: "All points", rows: points, columns: columnsOf(sweep) }),
  });
  figure.append(status);
  return figure;
}

export function heatMap(sweep, open) {
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
      const key = `${xRank.get(x.of(p))},${yRank.get(y.of(p))}`;
      if (!cells.has(key)) cells.set(key, []);
      cells.get(key).push(p);
    }
    const all = [...cells].map(([key, points]) => {
      const numbers = points.filter((p) => !p.failed).map((p) => z.of(p)).filter(Number.isFinite);
      return { key: key.split(",").map(Number), points, mean: numbers.reduce((s, v) => s + v, 0) / numbers.length, bad: points.every((p) => p.reasons.length > 0) };
    });
    const data = all.filter((cell) => Number.isFinite(cell.mean));
    const failed = all.filter((cell) => !Number.isFinite(cell.mean) && cell.points.every((p) => p.failed));
    const means = data.map((cell) => cell.mean);
    const [least, most] = [Math.min(...means), Math.max(...means)];
    const place = (cell) => `${x.name} ${xs[cell.key[0]][1]}\n${y.name} ${ys[cell.key[1]][1]}\n`;
    const why = (cell) => (cell.points.length === 1 ? cell.points[0].reasons.map((reason) => "\n" + reason).join("") : "");
    const wide = Math.max(...ys.map((e) => e[1].length)) * 6.6 + 16;
    figure = chart({
      name: "heat-map", title: `${sweep.label(z)} over two parameters`, height: Math.min(560, Math.max(260, ys.length * 26 + 126)), least: Math.min(900, xs.length * 54 + wide + 60), canvas: data.length > 900,
      note: ["Mean where several points share a cell.", data.some((cell) => cell.bad) && "Outlined cells are not feasible or not proven.", failed.length > 0 && "Crossed cells failed."].filter(Boolean).join(" "),
      summary: means.length ? `From ${significant(least, 4)} to ${significant(most, 4)}.` : "No values.",
      option: () => {
        const c = palette();
        return {
          grid: { left: wide + 34, right: 24, top: 8, bottom: 100, outerBoundsMode: "none" },
          xAxis: axis({ type: "category", data: xs.map((e) => e[1]), name: x.name, splitLine: { show: false }, nameGap: 30 }),
          yAxis: axis({ type: "category", data: ys.map((e) => e[1]), splitLine: { show: false }, name: y.name, nameGap: wide }),
          visualMap: { type: "continuous", seriesIndex: 0, min: least, max: most, orient: "horizontal", left: "center", bottom: 0, itemWidth: 10, itemHeight: 180,
            text: [`${significant(most, 4)} ${z.unit}`, significant(least, 4)], textStyle: { color: c.soft }, inRange: { color: ramp() } },
          tooltip: { show: true, formatter: (p) => `${place(p.data.cell)}${p.seriesType === "custom" ? "no value" : `${z.name} ${significant(p.value[2], 4)} ${z.unit}`}${why(p.data.cell)}` },
          series: [{ type: "heatmap", label: { show: xs.length <= 12 && ys.length <= 24, formatter: (p) => significant(p.value[2], 4), fontSize: 11 },
            data: data.map((cell) => ({ value: [...cell.key, cell.mean], cell, label: { color: onRamp((cell.mean - least) / (most - least)) }, itemStyle: { borderColor: cell.bad ? c.vermillion : c.page, borderWidth: 1 } })) },
          { type: "custom", data: failed.map((cell) => ({ value: cell.key, cell })), renderItem: (_, api) => {
            const [px, py] = api.coord([api.value(0), api.value(1)]);
            const [width, height] = api.size([1, 1]).map((size) => size - 2);
            const [left, top] = [px - width / 2, py - height / 2];
            const arm = Math.min(5, height / 3, width / 3);
            const stroke = { stroke: c.vermillion, lineWidth: 1.2 };
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
  return h("div", {}, h("div", { class: "controls" }, choice("Figure", "z", sweep.metrics), choice("Across", "x", axes), choice("Up", "y", axes)), holder);
}

/** How far the mean of a figure moves over each parameter's range, as `markervp sensitivity` counts it. */
function swings(sweep, metric) {
  return sweep.parameters.map((parameter) => {
    const groups = new Map();
    for (const p of sweep.feasible) {
      const v = metric.of(p);
      if (!Number.isFinite(v)) continue;
      const key = parameter.of(p);
      if (!groups.has(key)) groups.set(key, { text: parameter.text(p), sum: 0, count: 0 });
      const group = groups.get(key);
      group.sum += v;
      group.count += 1;
    }
    const means = [...groups.values()].map((g) => ({ text: g.text, mean: g.sum / g.count })).sort((a, b) => a.mean - b.mean);
    return means.length > 1 ? { parameter, low: means[0], high: means.at(-1) } : null;
  }).filter(Boolean).sort((a, b) => (a.high.mean - a.low.mean) - (b.high.mean - b.low.mean));
}

export function tornado(sweep) {
  const metric = sweep.objectives[0] ?? sweep.fps ?? sweep.metrics[0];
  if (!metric) return null;
  const rows = swings(sweep, metric);
  if (rows.length === 0) return null;
  return chart({
    name: "tornado", title: `What moves ${sweep.label(metric)}`, height: 44 * rows.length + 70,
    note: `Mean over all points at the least and the most favourable value of each parameter${sweep.feasible.length < sweep.points.length ? "; only feasible points count" : ""}.`,
    summary: rows.slice().reverse().map((r) => `${r.parameter.name}: ${significant(r.low.mean, 4)} at ${r.low.text}, ${significant(r.high.mean, 4)} at ${r.high.text}`).join(". "),
    option: () => {
      const c = palette();
      return {
        grid: { left: 8, right: 30, top: 8, bottom: 8, containLabel: true },
        xAxis: axis({ type: "value", scale: true }),
        yAxis: axis({ type: "category", data: rows.map((r) => r.parameter.name), splitLine: { show: false }, axisLabel: { width: 220, overflow: "truncate" } }),
        tooltip: { show: true, formatter: (p) => { const r = rows[p.dataIndex]; return `${r.parameter.name}\n${r.low.text}: ${significant(r.low.mean, 4)}\n${r.high.text}: ${significant(r.high.mean, 4)}`; } },
        series: [{ type: "custom", encode: { x: [1, 2], y: 0 }, data: rows.map((r, i) => [i, r.low.mean, r.high.mean]), renderItem: (_, api) => {
          const a = api.coord([api.value(1), api.value(0)]), b = api.coord([api.value(2), api.value(0)]);
          return { type: "rect", shape: { x: a[0], y: a[1] - 8, width: Math.max(2, b[0] - a[0]), height: 16, r: 2 }, style: { fill: c.blue } };
        } }],
      };
    },
    table: () => ({ caption: `What moves ${metric.name}`, rows: rows.slice().reverse(), columns: [
      { title: "Parameter", value: (r) => r.parameter.name }, { title: "Least at", value: (r) => r.low.text }, { title: "Least", number: true, value: (r) => r.low.mean, show: (v) => significant(v, 4) },
      { title: "Most at", value: (r) => r.high.text }, { title: "Most", number: true, value: (r) => r.high.mean, show: (v) => significant(v, 4) }] }),
  });
}

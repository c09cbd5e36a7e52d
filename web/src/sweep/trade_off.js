// Any two figures against each other: the points, the front in both, lines of equal energy, limits that are dragged.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant, tidy } from "../kit/format.js";
import { palette } from "../kit/theme.js";
import { columnsOf, describe, opener, value } from "./charts.js";
import { groupsOf } from "./colouring.js";
import { frontOf } from "./selection.js";

/** Above so many points they are drawn at once, as small squares. */
const many = 2000;

/** A round step that parts `range` into about `parts`. */
function roundStep(range, parts) {
  const decade = 10 ** Math.floor(Math.log10(range / parts));
  return decade * [1, 2, 5, 10].find((n) => n * decade >= (range / parts) * 0.999);
}

/** From round number to round number, around all values. */
function scaleOf(values) {
  const [least, most] = [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
  const range = most - least || Math.abs(least) * 0.1 || 0.1;
  const tick = roundStep(range * 1.16, 8);
  const lowest = Math.floor((least - range * 0.08) / tick) * tick;
  // No room below 0 for what is never negative: a rate, a power.
  return { min: least >= 0 ? Math.max(0, lowest) : lowest, max: Math.ceil((most + range * 0.08) / tick) * tick, tick };
}

/** Lines of equal energy a frame, from edge to edge of the plot; none where it does not show rate and power. */
function isoLines({ x, y }, points, scales) {
  const turned = x.axis.id === "power.total_w.nominal" && y.axis.id === "summary.fps.mean";
  if (!turned && (x.axis.id !== "summary.fps.mean" || y.axis.id !== "power.total_w.nominal")) return [];
  const [fps, power] = turned ? [y.axis, x.axis] : [x.axis, y.axis];
  const [rates, watts] = turned ? [scales.y, scales.x] : [scales.x, scales.y];
  const energies = points.map((p) => 1e3 * power.of(p) / fps.of(p)).filter(Number.isFinite);
  const [least, most] = [energies.reduce((a, b) => Math.min(a, b), Infinity), energies.reduce((a, b) => Math.max(a, b), 0)];
  if (!(most > least)) return [];
  const step = roundStep(most - least, window.innerWidth < 620 ? 3 : 7);
  const lines = [];
  for (let mj = Math.ceil(least / step) * step; mj <= most; mj += step) {
    const from = Math.max(rates.min, watts.min * 1e3 / mj, 0), to = Math.min(rates.max, watts.max * 1e3 / mj);
    const place = (rate) => (turned ? [mj * rate / 1e3, rate] : [rate, mj * rate / 1e3]);
    if (to > from) lines.push({ mj, line: [place(from), place(to)] });
  }
  // Labels at the ends of lines that are too close would lie on each other.
  const apart = (a, b) => Math.abs(a[0] - b[0]) / (scales.x.max - scales.x.min) + Math.abs(a[1] - b[1]) / (scales.y.max - scales.y.min);
  return lines.reduce((kept, each) => (kept.length && apart(kept.at(-1).line[1], each.line[1]) < 0.05 ? kept : [...kept, each]), []);
}

/** What can stand at an axis: each figure with the way that is better, both ways where it is not said. */
function choices(sweep) {
  const known = [...new Set([...sweep.objectives, ...sweep.metrics, ...sweep.parameters.filter((p) => p.numeric)])];
  return known.flatMap((each) => (each.better ? [each.better] : [1, -1]).map((better) => ({ axis: { ...each, better }, of: each })));
}

/** The limit of an axis on its worse side. */
function limitOf(selection, { axis: { better }, of }) {
  const [low, high] = selection.range(of);
  return better > 0 ? low : high;
}

function setLimit(selection, { axis: { better }, of }, bound) {
  const [low, high] = selection.range(of);
  selection.set(of, [better > 0 ? [bound, Math.max(bound, high)] : [Math.min(bound, low), bound]]);
}

/** Handles of the limits, and a rectangle that sets both at once. */
function handles(selection, shown) {
  const layer = h("div", { class: "handles" });
  const frame = h("div", { class: "rubber", hidden: true });
  let plot = null;
  const along = (dim) => plot.getAxis(dim);
  const toPixel = (dim, number) => along(dim).toGlobalCoord(along(dim).dataToCoord(number));
  const toNumber = (dim, pixel) => along(dim).coordToData(along(dim).toLocalCoord(pixel));
  const extent = (dim) => along(dim).scale.getExtent();
  const worst = (dim) => (shown[dim].axis.better > 0 ? extent(dim)[0] : extent(dim)[1]);
  const bound = (dim) => { const limit = limitOf(selection, shown[dim]); return Number.isFinite(limit) ? limit : worst(dim); };
  const move = (dim, number) => {
    const [low, high] = extent(dim);
    const none = shown[dim].axis.better > 0 ? -Infinity : Infinity;
    setLimit(selection, shown[dim], shown[dim].axis.better > 0 ? (number <= low ? none : Math.min(number, high)) : (number >= high ? none : Math.max(number, low)));
  };
  const at = (event) => { const box = layer.getBoundingClientRect(); return { x: event.clientX - box.left, y: event.clientY - box.top }; };
  const handle = (dim) => {
    const { axis: figure } = shown[dim];
    const grip = h("div", { class: `grip ${dim}`, role: "slider", tabindex: "0", "aria-orientation": dim === "x" ? "horizontal" : "vertical", "aria-label": `${figure.name}, ${figure.better > 0 ? "at least" : "at most"}`,
      onpointerdown: (event) => { grip.setPointerCapture(event.pointerId); event.preventDefault(); grip.focus({ preventScroll: true }); },
      onpointermove: (event) => { if (grip.hasPointerCapture(event.pointerId)) move(dim, toNumber(dim, at(event)[dim])); },
      onkeydown: (event) => {
        const sign = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
        if (event.key === "Delete" || event.key === "Home") move(dim, worst(dim));
        else if (sign) move(dim, bound(dim) + sign * (extent(dim)[1] - extent(dim)[0]) / 100);
        else return;
        event.preventDefault();
      } });
    return grip;
  };
  const grips = { x: handle("x"), y: handle("y") };
  layer.append(grips.x, grips.y, frame);
  const place = () => {
    const { x: left, y: top, width, height } = plot.getRect();
    for (const dim of ["x", "y"]) {
      const { axis: figure } = shown[dim];
      const pixel = toPixel(dim, Math.min(Math.max(bound(dim), extent(dim)[0]), extent(dim)[1]));
      Object.assign(grips[dim].style, dim === "x" ? { left: `${pixel - 8}px`, top: `${top}px`, height: `${height}px` } : { top: `${pixel - 8}px`, left: `${left}px`, width: `${width}px` });
      const [low, high] = extent(dim);
      const limit = limitOf(selection, shown[dim]);
      for (const [name, text] of Object.entries({ valuemin: low, valuemax: high, valuenow: bound(dim), valuetext: Number.isFinite(limit) ? `${tidy(limit)} ${figure.unit}` : "no limit" })) grips[dim].setAttribute(`aria-${name}`, String(text));
    }
  };
  /** A rectangle drawn on `area` keeps what lies in it. */
  const rubber = (area) => {
    let from = null;
    const corners = (event) => {
      const { x: left, y: top, width, height } = plot.getRect();
      const to = at(event);
      const clip = ({ x, y }) => ({ x: Math.min(Math.max(x, left), left + width), y: Math.min(Math.max(y, top), top + height) });
      return [clip(from), clip(to)];
    };
    area.addEventListener("pointerdown", (event) => { if (event.button === 0 && event.pointerType !== "touch") from = at(event); });
    window.addEventListener("pointermove", (event) => {
      if (!from) return;
      const [a, b] = corners(event);
      if (Math.abs(a.x - b.x) + Math.abs(a.y - b.y) < 8) return;
      frame.hidden = false;
      Object.assign(frame.style, { left: `${Math.min(a.x, b.x)}px`, top: `${Math.min(a.y, b.y)}px`, width: `${Math.abs(a.x - b.x)}px`, height: `${Math.abs(a.y - b.y)}px` });
    });
    window.addEventListener("pointerup", (event) => {
      if (!from) return;
      const [a, b] = corners(event);
      from = null;
      if (frame.hidden) return;
      frame.hidden = true;
      for (const dim of ["x", "y"]) selection.set(shown[dim].of, [[toNumber(dim, a[dim]), toNumber(dim, b[dim])].sort((one, other) => one - other)]);
    });
  };
  const ready = (instance, again) => {
    plot = instance.getModel().getComponent("grid").coordinateSystem;
    place();
    if (!again) rubber(instance.getDom());
  };
  return { layer, ready };
}

/** `view`: {near: only the surroundings of the front, colour: an axis or null}. */
function figureOf(sweep, selection, shown, view, frontIn, open) {
  const { x, y } = shown;
  const known = sweep.whole.filter((p) => Number.isFinite(x.axis.of(p)) && Number.isFinite(y.axis.of(p)));
  if (known.length === 0) return h("p", { class: "note" }, "No point has both.");
  const faulty = known.some((p) => p.faults.length > 0);
  const reasons = [...new Set(known.flatMap((p) => p.faults))].sort((a, b) => a.length - b.length);
  const failed = sweep.points.length - sweep.whole.length;
  const large = known.length > many;
  const groups = view.colour ? groupsOf(view.colour, known.filter((p) => p.faults.length === 0)) : [];
  let parts = null, scales = null, lines = [];
  const sort = () => {
    const good = [], outside = [], bad = [];
    for (const p of known) (p.faults.length > 0 ? bad : selection.keeps(p) ? good : outside).push(p);
    const front = frontOf(good.filter((p) => !p.same_as), frontIn()).sort((a, b) => x.axis.of(a) - x.axis.of(b) || y.axis.of(a) - y.axis.of(b));
    const onFront = new Set(front);
    const behind = good.filter((p) => !onFront.has(p));
    // The bands were asked of the study's own objectives and limits.
    const judged = sweep.doubt && selection.asAsked() && frontIn().length === sweep.objectives.length && frontIn().every((each) => sweep.objectives.some(({ id, better }) => id === each.id && better === each.better));
    parts = { outside, bad, good: behind, front, sure: front.filter((p) => !judged || p.dominated === "no"), unsure: front.filter((p) => judged && p.dominated !== "no"), judged, groups: groups.map((g) => behind.filter(g.has)) };
    const seen = view.near && front.length > 0 ? front : known;
    scales = { x: scaleOf(seen.map(x.axis.of)), y: scaleOf(seen.map(y.axis.of)) };
    lines = isoLines(shown, seen, scales);
    return parts;
  };
  sort();
  const looks = () => {
    const c = palette();
    return [
      { name: "Outside the limits", points: parts.outside, symbol: "circle", size: 5, style: { color: c.grey, opacity: 0.25 } },
      ...(groups.length === 0 ? [{ name: "Feasible", points: parts.good, symbol: "circle", size: 6, style: { color: c.blue, opacity: 0.55 } }]
        : groups.map((g, i) => ({ name: g.name, points: parts.groups[i], symbol: "circle", size: 6, style: { color: g.colour(), opacity: 0.75 } }))),
      faulty && { name: "Not feasible or not proven", points: parts.bad, symbol: "triangle", size: 7, style: { color: c.vermilion, opacity: 0.6 } },
      ...[[parts.judged ? "Pareto front, for sure" : "Pareto front", parts.sure, false], ["Pareto front, perhaps", parts.unsure, true]].map(([name, points, perhaps]) => {
        const colour = ({ dataIndex }) => groups.find((g) => g.has(points[dataIndex]))?.colour() ?? c.green;
        if (perhaps) return { name, points, onFront: true, symbol: "diamond", size: 9, style: { color: groups.length ? colour : c.page, borderColor: c.green, borderWidth: 1.5 } };
        return { name, points, onFront: true, symbol: "diamond", size: 10, style: groups.length ? { color: colour, borderColor: c.green, borderWidth: 2 } : { color: c.green } };
      }).filter(({ name, points }) => points.length > 0 || name === "Pareto front"),
    ].filter(Boolean);
  };
  // A list of lists takes ECharts three times as long.
  const pairs = (points) => {
    const flat = new Float64Array(2 * points.length);
    points.forEach((p, i) => { flat[2 * i] = x.axis.of(p); flat[2 * i + 1] = y.axis.of(p); });
    return flat;
  };
  const scatter = (g) => ({
    type: "scatter", name: g.name, symbol: g.symbol, symbolSize: large && !g.onFront ? 3 : g.size, itemStyle: g.style, large: large && !g.onFront, largeThreshold: 0, progressive: 0,
    dimensions: ["x", "y"], data: pairs(g.points), z: g.onFront ? 4 : 2,
  });
  const pointAt = ({ seriesName, dataIndex }) => looks().find((g) => g.name === seriesName)?.points[dataIndex];
  const limitLines = (c) => ["x", "y"].flatMap((dim) => selection.range(shown[dim].of).filter((bound) => bound > scales[dim].min && bound < scales[dim].max).map((bound) => ({
    type: "line", name: "limit", silent: true, symbol: "none", z: 3, lineStyle: { color: c.orange, width: 1.5, type: "dashed" },
    data: dim === "x" ? [[bound, scales.y.min], [bound, scales.y.max]] : [[scales.x.min, bound], [scales.x.max, bound]] })));
  const both = [x, y].map(({ axis: { name, better } }) => `${better > 0 ? "most" : "least"} ${name.toLowerCase()}`).join(" and ");
  const overlay = handles(selection, shown);
  const click = opener(open, pointAt);
  const figure = chart({
    name: "trade-off", title: `${x.axis.name} and ${y.axis.name.toLowerCase()}`, height: 440, canvas: true, overlay: overlay.layer,
    note: `No feasible point within the limits beats one of the front in ${frontIn().length > 2 ? "all that the study asks for" : both}. ${parts.judged ? `${sweep.doubt}. ` : ""}Drag a limit by its grip at the edge, or a rectangle around points.${lines.length ? " Grey lines: equal energy a frame." : ""}${reasons.length ? " Triangles: not feasible, or not proven (" + reasons.slice(0, 2).join("; ") + (reasons.length > 2 ? "; …" : "") + ")." : ""}${failed ? ` ${counted(failed, "point")} that failed ${failed === 1 ? "is" : "are"} left out here; the table and the map say why.` : ""} A click opens a point.`,
    summary: () => `${counted(known.length, "point")}, ${fixed(parts.bad.length, 0)} of them not feasible or not proven, ${fixed(parts.outside.length, 0)} outside the limits. The front has ${counted(parts.front.length, "point")}` +
      (parts.front.length ? `, from ${value(x.axis, parts.front[0])} at ${value(y.axis, parts.front[0])} to ${value(x.axis, parts.front.at(-1))} at ${value(y.axis, parts.front.at(-1))}.` : "."),
    option: () => {
      const c = palette();
      sort();
      const scaled = (dim, more) => axis({ type: "value", min: scales[dim].min, max: scales[dim].max, interval: scales[dim].tick, name: sweep.label(shown[dim].axis), ...more,
        axisLabel: { formatter: (v) => (Number.isInteger(scales[dim].tick) ? fixed(v, 0) : significant(Number(v.toPrecision(9)), scales[dim].tick < 0.01 ? 4 : 3)) } });
      return {
        legend: { top: 0, left: 0, itemWidth: 9, itemHeight: 9, data: looks().map((g) => g.name), textStyle: { color: c.soft } },
        grid: { left: 20, right: 64, top: 36, bottom: 34, containLabel: true },
        xAxis: scaled("x"), yAxis: scaled("y", { nameGap: 44 }),
        tooltip: { show: true, trigger: "item", formatter: (p) => { const point = pointAt(p); return point ? describe(sweep, point, selection) : p.seriesName; } },
        series: [
          ...lines.map(({ mj, line }) => ({ type: "line", name: `${mj} mJ`, silent: true, symbol: "none", clip: true, data: line, z: 0,
            lineStyle: { color: c.faint, width: 1, type: "dotted", opacity: 0.8 }, endLabel: { show: true, distance: 2, formatter: `${tidy(Number(mj.toPrecision(6)))} mJ`, color: c.faint, fontSize: 11 } })),
          frontIn().length <= 2 && { type: "line", name: "front", silent: true, symbol: "none", data: parts.front.map((p) => [x.axis.of(p), y.axis.of(p)]), step: x.axis.better > 0 ? "start" : "end", lineStyle: { color: c.green, width: 1.5 }, z: 1 },
          ...limitLines(c), ...looks().filter((g) => g.points.length > 0).map(scatter),
        ].filter(Boolean),
      };
    },
    ready: (instance, again) => { overlay.ready(instance, again); click(instance, again); },
    table: () => ({ caption: "Points of the Pareto front", rows: sort().front, columns: columnsOf(sweep, selection, parts.front) }),
  });
  return figure;
}

export function tradeOff(sweep, selection, open) {
  const list = choices(sweep);
  const pick = (wanted, other) => list.find((c) => c.of === wanted) ?? list.find((c) => c !== other);
  const shown = {};
  shown.x = pick(sweep.objectives[0] ?? sweep.fps);
  shown.y = pick(sweep.objectives[1] ?? (shown.x?.of === sweep.power ? sweep.fps : sweep.power), shown.x);
  if (!shown.x || !shown.y) return null;
  let whole = sweep.objectives.length > 2;
  const frontIn = () => (whole ? sweep.objectives : [shown.x.axis, shown.y.axis]);
  const view = { near: false, colour: null };
  let figure = null;
  const holder = h("div");
  const build = () => {
    figure?.leave?.();
    figure = figureOf(sweep, selection, { ...shown }, { ...view }, frontIn, open);
    holder.replaceChildren(figure);
  };
  const name = ({ axis: each, of }) => `${each.name} (${each.better > 0 ? "most" : "least"})${of.parameter ? ", parameter" : ""}`;
  const select = (label, dim) => {
    const element = h("select", { onchange: () => { shown[dim] = list[element.value]; whole = false; if (study) study.value = "shown"; build(); } },
      list.map((c, i) => h("option", { value: String(i), selected: c === shown[dim] }, name(c))));
    return h("label", {}, label, element);
  };
  const study = whole && h("select", { onchange: () => { whole = study.value === "all"; build(); } },
    h("option", { value: "all" }, `all ${sweep.objectives.length} objectives`), h("option", { value: "shown" }, "the two shown"));
  const colours = [...new Set([...sweep.parameters, ...sweep.objectives, ...sweep.metrics])];
  const colour = h("select", { onchange: () => { view.colour = colours[colour.value] ?? null; build(); } },
    h("option", { value: "" }, "what they are"), colours.map((each, i) => h("option", { value: String(i) }, each.name + (each.parameter ? ", parameter" : ""))));
  const range = h("select", { onchange: () => { view.near = range.value === "front"; build(); } },
    h("option", { value: "" }, "all points"), h("option", { value: "front" }, "around the front"));
  const controls = h("div", { class: "controls" }, select("Across", "x"), select("Up", "y"), study && h("label", {}, "Front in", study),
    h("label", {}, "Colour by", colour), h("label", {}, "Show", range));
  build();
  selection.onChange(() => figure.update?.());
  return h("div", {}, controls, limitsBar(sweep, selection), holder);
}

/** What is kept, and what lets go of it again. */
function limitsBar(sweep, selection) {
  const said = h("span", { role: "status" });
  const list = h("div", { class: "limits" });
  const update = () => {
    const good = sweep.points.filter(selection.good).length;
    const axes = selection.axes();
    said.textContent = axes.length ? `${fixed(good, 0)} feasible of ${counted(sweep.points.length, "point")} within the limits:` : `${fixed(good, 0)} of ${counted(sweep.points.length, "point")} feasible; no limits.`;
    list.replaceChildren(said, ...axes.map((each) => h("button", { type: "button", "aria-label": `Let go of ${selection.text(each)}`, onclick: () => selection.set(each, []) }, `${selection.text(each)} ✕`)),
      ...(axes.length > 1 ? [h("button", { type: "button", onclick: selection.clear }, "Let go of all")] : []),
      ...(sweep.limits.length && !selection.asAsked() ? [h("button", { type: "button", onclick: selection.reset }, "As the study asks")] : []));
  };
  update();
  selection.onChange(update);
  return list;
}

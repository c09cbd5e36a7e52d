// Everything that happened, on one time axis: engines, then counters below.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, heading, significant, time, words } from "../kit/format.js";
import { isDark, palette } from "../kit/theme.js";

const groupColours = { PL: "blue", DMA: "orange", Interrupts: "vermilion", PS: "green", Frame: "grey" };
const row = 26; // px
const below = 96; // px of a counter's plot

/** The name of a bar in it, where it says more than the track's and there is room. */
function label(track, name, width, colour, count) {
  const text = words(name);
  if (track.group !== "PS" || count > 1 || width < text.length * 7 + 8) return {};
  return { textContent: { style: { text, fill: colour, fontSize: 11 } }, textConfig: { position: "inside" } };
}

function spanItem(tracks, marked, nameOf) {
  return (params, api) => {
    const index = api.value(0);
    const from = api.coord([api.value(1), index]);
    const to = api.coord([api.value(1) + api.value(2), index]);
    const area = params.coordSys;
    const height = Math.min(16, api.size([0, 1])[1] * 0.62);
    const x = Math.max(from[0], area.x);
    const right = Math.min(Math.max(to[0], from[0] + 0.7), area.x + area.width);
    if (right <= area.x || x >= area.x + area.width) return null;
    const colour = palette();
    const hot = api.value(4) === 1;
    return {
      type: "rect", shape: { x, y: from[1] - height / 2, width: right - x, height, r: right - x > 6 ? 2 : 0 },
      ...label(tracks[index], nameOf(api.value(3)), right - x, hot || !marked ? (isDark() ? "#14171b" : "#ffffff") : colour.ink, api.value(5)),
      style: { fill: colour[groupColours[tracks[index].group] ?? "blue"], opacity: hot || !marked ? 1 : 0.42, stroke: hot ? colour.ink : undefined, lineWidth: hot ? 1.2 : 0 },
    };
  };
}

/** Neighbours that cannot be told apart at this zoom are drawn as one. */
function thinned(spans, from, to) {
  const gap = (to - from) / 3000;
  const out = [];
  for (const span of spans) {
    if (span[0] + span[1] < from || span[0] > to) continue;
    const last = out.at(-1);
    if (last && last.count !== undefined && span[0] - (last.start + last.length) < gap && last.length < gap * 40 && span[1] < gap * 2 && last.name === span[2]) {
      last.length = span[0] + span[1] - last.start;
      last.count += 1;
    } else out.push({ start: span[0], length: span[1], name: span[2], count: 1, hot: span[3] === 1 });
  }
  return out;
}

export function gantt(run) {
  const timeline = run.extras.timeline;
  const { unit } = run;
  if (!timeline?.tracks?.length) return null;
  const tracks = timeline.tracks.filter((track) => track.spans.length > 0);
  const counters = (timeline.counters ?? []).filter((counter) => counter.points.length > 1);
  const marked = tracks.some((track) => track.spans.some((span) => span[3] === 1));
  const end = Math.max(...tracks.map((track) => track.spans.at(-1)[0] + track.spans.at(-1)[1]));
  const frames = timeline.frames ?? [];
  const whole = [0, end];
  const margin = (frame) => (frame.end - frame.start) * 0.01;
  const around = (frame) => [Math.max(0, frame.start - margin(frame)), frame.end + margin(frame)];
  let view = frames.length ? around(frames[0]) : whole;
  const axisTop = row * tracks.length + 20;
  const height = axisTop + 40 + counters.length * (below + 34);
  const nameOf = (index) => timeline.names[index] ?? "";
  let instance = null;

  const left = 132;
  const bars = () => tracks.flatMap((track, index) => thinned(track.spans, view[0], view[1])
    .map((span) => [index, span.start, span.length, span.name, span.hot ? 1 : 0, span.count]));
  const tip = (p) => {
    const [index, start, length, name, hot, count] = p.value;
    return `${tracks[index].name}${nameOf(name) ? `: ${words(nameOf(name))}` : ""}\n${count > 1 ? `${counted(count, "interval")} within ` : ""}${time(length)} from ${time(start)}` +
      (hot ? "\non the critical path" : "");
  };
  const option = () => {
    const colour = palette();
    const x = (grid, last) => axis({
      type: "value", gridIndex: grid, min: view[0], max: view[1],
      axisLabel: { show: last, formatter: (v) => fixed(v / 1e3, view[1] - view[0] < 400 ? 3 : view[1] - view[0] < 4000 ? 2 : 1) + " ms" },
      splitNumber: 8, name: undefined, axisPointer: { show: true, type: "line", lineStyle: { color: colour.faint, type: "solid" }, label: { show: false } },
    });
    return {
      axisPointer: { link: [{ xAxisIndex: "all" }] },
      grid: [{ left, right: 24, outerBoundsMode: "none", top: 6, height: row * tracks.length },
        ...counters.map((_, i) => ({ left, right: 24, outerBoundsMode: "none", top: axisTop + 40 + i * (below + 34), height: below }))],
      xAxis: [x(0, true), ...counters.map((_, i) => x(i + 1, false))],
      yAxis: [axis({ type: "category", inverse: true, data: tracks.map((track) => (track.name === "Frame" ? heading(unit) : track.name)), splitLine: { show: false }, axisLine: { show: false }, axisLabel: { color: colour.ink, hideOverlap: false, interval: 0 } }),
        ...counters.map((counter, i) => axis({ type: "value", gridIndex: i + 1, min: counter.from ?? 0, splitNumber: 2, scale: counter.from === null, name: `${counter.name}, ${counter.unit}`, nameLocation: "end", nameGap: 14, nameTextStyle: { color: colour.soft, align: "left", padding: [0, 0, 0, -left + 40] } }))],
      tooltip: { show: true, trigger: "item", formatter: (p) => (p.seriesType === "custom" ? tip(p) : `${p.seriesName}: ${significant(p.value[1], 4)}\nat ${time(p.value[0])}`) },
      series: [{ type: "custom", data: bars(), renderItem: spanItem(tracks, marked, nameOf), encode: { x: [1], y: 0 }, clip: true },
        ...counters.map((counter, i) => ({
          name: counter.name, type: "line", xAxisIndex: i + 1, yAxisIndex: i + 1, step: counter.step === false ? false : "end", symbol: "none", sampling: "max", data: held(counter.points, end),
          lineStyle: { width: 1.3, color: colour[i % 2 ? "purple" : "blue"] }, areaStyle: { opacity: 0.12, color: colour[i % 2 ? "purple" : "blue"] },
          markLine: counter.limit && Math.max(...counter.points.map((p) => p[1])) > counter.limit * 0.5
            ? { silent: true, symbol: "none", data: [{ yAxis: counter.limit }], lineStyle: { color: colour.vermilion, type: "dashed" }, label: { formatter: `depth ${counter.limit}`, color: colour.soft, position: "insideEndTop" } } : undefined,
        }))],
    };
  };
  const look = (range) => {
    const width = Math.max(range[1] - range[0], 0.05);
    const start = Math.min(Math.max(range[0], whole[0]), Math.max(whole[0], whole[1] - width));
    view = [start, Math.min(start + width, Math.max(whole[1], start + 0.05))];
    instance?.setOption({ ...option(), animation: false });
  };
  const zoom = (factor) => {
    const middle = (view[0] + view[1]) / 2;
    const half = (view[1] - view[0]) / 2 * factor;
    look([middle - half, middle + half]);
  };
  const pan = (share) => look(view.map((edge) => edge + (view[1] - view[0]) * share));
  const button = (text, label, act) => h("button", { type: "button", "aria-label": label, onclick: act }, text);
  const figure = chart({
    name: "timeline", title: "Timeline", height, canvas: true, option,
    note: `The first ${frames.length === 1 ? unit : `${frames.length} ${unit}s`}. Outlined bars are the critical path: shortening them shortens the ${unit}. Drag to move; Ctrl and the wheel zoom.${run.extras.waves ? " A double click shows the moment in the waves." : ""}`,
    summary: `${counted(tracks.length, "track")}: ${tracks.map((track) => `${track.name}, ${counted(track.spans.length, "interval")}`).join("; ")}.`,
    table: () => ({ caption: "Intervals of the timeline", rows: tracks.flatMap((track) => track.spans.map((span) => ({ track, span }))), columns: [
      { title: "Track", value: (r) => r.track.name }, { title: "What", value: (r) => nameOf(r.span[2]), show: words },
      { title: "From", unit: "µs", csv: "From us", number: true, value: (r) => r.span[0], show: (v) => fixed(v, 3) },
      { title: "Length", unit: "µs", csv: "Length us", number: true, value: (r) => r.span[1], show: (v) => fixed(v, 3) },
      { title: "Critical", value: (r) => (r.span[3] === 1 ? "yes" : "") }] }),
    ready: (chartInstance, again) => {
      instance = chartInstance;
      if (!again) follow(chartInstance);
    },
  });
  function follow(chartInstance) {
    const surface = chartInstance.getZr();
    chartInstance.on("dblclick", ({ value }) => run.moment.pointAt({ ps: value[1] * 1e6, frame: frames.find((frame) => value[1] >= frame.start && value[1] < frame.end)?.index }));
    let held = null;
    surface.on("mousewheel", (event) => {
      if (!event.event.ctrlKey) return;
      const share = (event.offsetX - left) / (chartInstance.getWidth() - left - 24);
      if (share < 0 || share > 1) return;
      event.stop();
      const at = view[0] + share * (view[1] - view[0]);
      const factor = event.wheelDelta > 0 ? 0.8 : 1.25;
      look([at - (at - view[0]) * factor, at + (view[1] - at) * factor]);
    });
    surface.on("mousedown", (event) => { held = { x: event.offsetX, view }; });
    surface.on("mousemove", (event) => {
      if (!held) return;
      const move = (held.x - event.offsetX) / (chartInstance.getWidth() - left - 24) * (held.view[1] - held.view[0]);
      if (move !== 0) look(held.view.map((edge) => edge + move));
    });
    surface.on("mouseup", () => { held = null; });
    surface.on("globalout", () => { held = null; });
  }
  const controls = h("div", { class: "tools", role: "group", "aria-label": "Part of the timeline" },
    frames.map((frame) => button(`${heading(unit)} ${frame.index + 1}`, `${heading(unit)} ${frame.index + 1} in the timeline`, () => look(around(frame)))),
    button("All", "All, show everything", () => look(whole)), button("−", "Zoom out", () => zoom(2)), button("+", "Zoom in", () => zoom(0.5)),
    button("‹", "Earlier", () => pan(-0.4)), button("›", "Later", () => pan(0.4)));
  figure.querySelector("figcaption").after(controls);
  return figure;
}

const held = (points, end) => (points.at(-1)[0] < end ? [...points, [end, points.at(-1)[1]]] : points);

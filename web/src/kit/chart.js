// A chart: drawn when scrolled to, with a text for those who do not see it, its numbers as a table, and exports.
import { download, h, newId, whenSeen } from "./dom.js";
import { echarts } from "./echarts.js";
import { onTheme, palette } from "./theme.js";
import { csvOf, dataTable } from "./table.js";

const charts = [];

/** What all charts share: quiet axes, one font. */
export function base() {
  const colour = palette();
  return {
    animation: false,
    backgroundColor: "transparent",
    textStyle: { fontFamily: "system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif", color: colour.soft, fontSize: 12 },
    grid: { left: 8, right: 20, top: 16, bottom: 8, containLabel: true },
    tooltip: {
      backgroundColor: colour.page, borderColor: colour.line, borderWidth: 1, padding: [8, 12], confine: true,
      textStyle: { color: colour.ink, fontSize: 12 }, extraCssText: "box-shadow: 0 4px 16px rgb(0 0 0 / 12%); border-radius: 6px",
      renderMode: "richText",
    },
  };
}

export function axis(options = {}) {
  const colour = palette();
  return {
    axisLine: { lineStyle: { color: colour.line } },
    axisTick: { show: false },
    axisLabel: { color: colour.soft, hideOverlap: true, ...options.axisLabel },
    splitLine: { lineStyle: { color: colour.line, width: 1, type: [2, 3] } },
    nameTextStyle: { color: colour.soft, fontSize: 12 },
    nameLocation: "middle",
    nameGap: 32,
    ...Object.fromEntries(Object.entries(options).filter(([key]) => key !== "axisLabel")),
  };
}

/** Puts the plot below its legend, however many lines that takes. Returns by how much the chart must be higher for it. */
function belowLegend(instance, { legend, grid }) {
  if (!legend) return 0;
  const drawn = instance.getViewOfComponentModel(instance.getModel().getComponent("legend")).group.getBoundingRect();
  const more = Math.max(0, Math.ceil(legend.top + drawn.height) + 8 - grid.top);
  instance.setOption({ grid: { top: grid.top + more } });
  return more;
}

/**
 * @param name      short, for file names
 * @param title     heading of the figure
 * @param summary   what one sees, in a sentence: read to those who cannot see it. It and `note` may be functions
 * @param height    px
 * @param least     px of width below which it is scrolled instead of squeezed
 * @param option    function that gives ECharts' option for the present theme
 * @param table     {columns, rows} of its numbers, as dataTable takes it
 * @param canvas    true: many points
 * @param ready     called with ECharts' instance once drawn
 * @param overlay   element that lies on the chart, and is no part of its exports
 * @param screen    draws into the element instead of ECharts, and returns {redraw, resize}; exports use `option`
 */
export function chart({ name, title, summary, note, height = 280, least, option, table, canvas = false, ready, screen, overlay }) {
  const words = (text) => (typeof text === "function" ? text() : text);
  const label = () => `${title}. ${words(summary)}`;
  const noted = note && h("p", { class: "note" }, words(note));
  const target = h("div", { class: "chart-area", role: "img", "aria-label": label(), style: { height: height + "px", minWidth: least ? least + "px" : "" } });
  let instance = null;
  const size = () => ({ width: target.clientWidth || 900, height: target.clientHeight || height });
  // Tooltips are drawn, not HTML: names of files stand in them.
  const full = () => {
    const common = base();
    const own = option();
    return { ...common, ...own, tooltip: own.tooltip ? { ...common.tooltip, ...own.tooltip } : { show: false } };
  };
  // The room that it will take, so that nothing moves when it is drawn: data do not change its legend.
  const reserve = () => {
    const { series = [], ...rest } = screen ? {} : full();
    if (instance || !rest.legend) return;
    const copy = echarts.init(null, null, { renderer: "svg", ssr: true, ...size() });
    copy.setOption({ ...rest, series: [series].flat().map(({ name, type }) => ({ name, type })) });
    target.style.height = `${height + belowLegend(copy, rest)}px`;
    copy.dispose();
  };
  const fit = () => {
    target.style.height = `${height + belowLegend(instance, option())}px`;
    instance.resize();
  };
  const draw = () => {
    if (instance) return instance;
    if (screen) {
      instance = screen(target, height);
      target.dataset.drawn = "true";
      return instance;
    }
    instance = echarts.init(target, null, { renderer: canvas ? "canvas" : "svg" });
    instance.setOption(full());
    fit();
    target.dataset.drawn = "true";
    ready?.(instance);
    return instance;
  };
  // Axes and legend stay: to lay them out again would cost more than the points.
  const update = () => {
    target.setAttribute("aria-label", label());
    if (noted) noted.textContent = words(note);
    const { grid, legend, ...rest } = full();
    instance.setOption(rest, { replaceMerge: ["series"] });
    ready?.(instance, true);
  };
  const stale = whenSeen(target, () => (instance ? update() : draw()), reserve);
  const entry = {
    target,
    redraw() {
      if (screen || !instance) return instance?.redraw();
      instance.setOption(full(), { notMerge: true });
      fit();
      ready?.(instance, true);
    },
    resize() {
      instance?.resize();
      if (instance && !screen) fit();
      else reserve();
    },
    instance: () => instance,
  };
  charts.push(entry);

  // All at once: what is drawn bit by bit would not be there yet.
  const whole = () => {
    const complete = { ...full(), backgroundColor: palette().page };
    for (const series of [complete.series ?? []].flat()) series.progressive = 0;
    return complete;
  };
  const svg = () => {
    const copy = echarts.init(null, null, { renderer: "svg", ssr: true, ...size() });
    copy.setOption(whole());
    belowLegend(copy, option());
    const text = copy.renderToSVGString();
    copy.dispose();
    return text;
  };
  const saveSvg = () => download(name + ".svg", svg(), "image/svg+xml");
  // Of the SVG: a canvas of ECharts' own paints on after it was read and given up, if the machine is busy.
  const savePng = async () => {
    const picture = new Image();
    picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(svg());
    await picture.decode();
    const { width, height } = size();
    const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height: 2 * height });
    canvas.getContext("2d").drawImage(picture, 0, 0, canvas.width, canvas.height);
    download(name + ".png", canvas.toDataURL("image/png"), "image/png");
  };

  const tableId = newId("table");
  let numbers = null;
  const tableButton = table && h("button", {
    type: "button", "aria-expanded": "false", "aria-controls": tableId,
    onclick: () => {
      const open = tableButton.getAttribute("aria-expanded") !== "true";
      tableButton.setAttribute("aria-expanded", String(open));
      holder.hidden = !open;
      if (open && !numbers) holder.append((numbers = dataTable({ ...table(), name })));
    },
  }, "Table");
  const holder = table && h("div", { id: tableId, hidden: true, class: "chart-table" });
  const figure = h("figure", { class: "chart" },
    h("figcaption", {},
      h("h3", {}, title),
      h("div", { class: "tools", role: "group", "aria-label": `Export ${title}` },
        tableButton,
        h("button", { type: "button", onclick: saveSvg, "aria-label": `${title} as SVG` }, "SVG"),
        h("button", { type: "button", onclick: savePng, "aria-label": `${title} as PNG` }, "PNG"),
        table && h("button", { type: "button", "aria-label": `${title} as CSV`, onclick: () => { const t = table(); download(name + ".csv", csvOf(t), "text/csv"); } }, "CSV"))),
    noted,
    least ? h("div", { class: "chart-scroll", tabindex: "0", role: "group", "aria-label": title }, target) : h("div", { class: "chart-stage" }, target, overlay), holder);
  /** What it shows has changed. */
  figure.update = () => {
    if (numbers) { numbers.remove(); numbers = null; }
    if (holder && !holder.hidden) holder.append((numbers = dataTable({ ...table(), name })));
    stale();
  };
  /** Another takes its place. */
  figure.leave = () => { charts.splice(charts.indexOf(entry), 1); instance?.dispose(); };
  return figure;
}

onTheme(() => charts.forEach((each) => each.redraw()));
let pending = 0;
window.addEventListener("resize", () => {
  cancelAnimationFrame(pending);
  pending = requestAnimationFrame(() => charts.forEach((each) => each.resize()));
});
window.addEventListener("beforeprint", () => charts.forEach((each) => { each.target.drawNow(); each.resize(); }));

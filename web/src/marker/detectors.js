// Detectors on the same images.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant } from "../kit/format.js";
import { dataTable } from "../kit/table.js";
import { palette, seriesColour } from "../kit/theme.js";

const figures = [
  ["seen", "Seen", null, 0], ["found", "Found", null, 0], ["markers", "Of", null, 0], ["false", "False", null, 0],
  ["corner_px", "Corner", "px", 4], ["corner_most_px", "Corner, most", "px", 4], ["translation_mm", "Translation", "mm", 3], ["rotation_deg", "Rotation", "°", 3],
  ["chip_fps", "Chip", "FPS", 1], ["chip_latency_ms", "Chip", "ms", 3], ["chip_energy_mj", "Chip", "mJ", 2], ["host_ms", "Host", "ms", 2],
];

function scoreTable(detectors) {
  const shown = figures.filter(([key]) => detectors.some((d) => d[key] !== undefined));
  return dataTable({ caption: "Detectors and what they found", name: "detectors", exportable: true, rows: detectors, columns: [
    { title: "Detector", head: true, value: (d) => d.name, node: (d) => h("span", { title: d.description }, d.name) },
    ...shown.map(([key, title, unit, places]) => ({ title, unit, csv: key, number: true, value: (d) => d[key], show: (v) => fixed(v, places) }))] });
}

/** A figure of each, ours in another colour than the libraries'. Errors are points: they differ by decades, and bars need a zero. */
function comparison(detectors, key, title, unit, isError) {
  const rows = detectors.filter((d) => d[key] > 0);
  if (rows.length < 2) return null;
  const values = rows.map((d) => d[key]);
  return chart({
    name: key, title: `${title}, ${unit}`, height: 34 * rows.length + 40, summary: rows.map((d) => `${d.name}: ${significant(d[key], 3)}`).join(", "),
    option: () => ({
      grid: { left: 8, right: 60, top: 8, bottom: 4, containLabel: true },
      xAxis: axis(isError ? { type: "log", min: 10 ** Math.floor(Math.log10(Math.min(...values))), max: 10 ** Math.ceil(Math.log10(Math.max(...values))) } : { type: "value", min: 0 }), yAxis: axis({ type: "category", inverse: true, data: rows.map((d) => d.name), splitLine: { show: isError } }),
      tooltip: { show: true, formatter: (p) => `${p.name}\n${significant(p.value[0], 4)} ${unit}` },
      series: [{ type: isError ? "scatter" : "bar", symbolSize: 13, barMaxWidth: 20, label: { show: true, position: "right", color: palette().soft, formatter: (p) => significant(p.value[0], 3) },
        data: rows.map((d) => ({ name: d.name, value: [d[key], d.name], itemStyle: { color: seriesColour(d.kind === "design" ? 0 : 1) } })) }],
    }),
    table: () => ({ caption: title, rows, columns: [{ title: "Detector", value: (d) => d.name }, { title, unit, number: true, value: (d) => d[key] }] }),
  });
}

export function detectorsPage(data) {
  const detectors = data.detectors.map((d) => ({ ...d, host_ms: data.host_ms?.[d.name] }));
  const section = (id, title, ...content) => h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), h("div", { class: "stack" }, content.filter(Boolean)));
  const errors = [comparison(detectors, "corner_px", "Corner error", "px", true), comparison(detectors, "translation_mm", "Translation error", "mm", true), comparison(detectors, "rotation_deg", "Rotation error", "°", true)].filter(Boolean);
  return {
    title: "Detectors compared", subtitle: `${counted(data.images.length, "image")}  ·  markers of ${data.dictionary}`,
    sections: [
      section("scores", "What each one found", scoreTable(detectors),
        h("p", { class: "note" }, "Chip: what a design takes on the Zynq. Host: this computer's time for an image, of a library's detection on one thread, or of a design's simulation.")),
      errors.length > 0 && section("errors", "Mean errors of what was found", errors),
      section("images", "Markers seen", comparison(detectors, "seen", "Seen in all images", "markers", false), h("details", {}, h("summary", {}, counted(data.images.length, "image")), h("p", {}, data.images.join(", ")))),
      section("about", "The detectors", h("ul", {}, detectors.map((d) => h("li", {}, h("strong", {}, d.name), ": ", d.description)), data.left_out.map((d) => h("li", {}, h("strong", {}, d.design), " was left out: ", d.why)))),
    ],
  };
}

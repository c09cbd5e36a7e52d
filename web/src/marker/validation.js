// The page of a validation: every published value with what the platform gives.
import { axis, chart } from "../kit/chart.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant, signed, tidy, words } from "../kit/format.js";
import { dataTable } from "../kit/table.js";
import { palette, seriesColour } from "../kit/theme.js";

const good = (verdict) => verdict.startsWith("met") || verdict === "input";
const tone = (verdict) => (good(verdict) ? "good" : verdict === "missed" ? "bad" : "");

function rowTable(rows) {
  const number = (v) => (v === undefined ? "" : tidy(v, 5));
  return dataTable({ caption: "Published and modelled values", name: "validation", exportable: true, rows, limit: 200, columns: [
    { title: "Value", head: true, value: (r) => r.id, node: (r) => h("span", { title: r.how }, r.id) }, { title: "Thesis", value: (r) => r.section }, { title: "System", value: (r) => r.system },
    { title: "Unit", value: (r) => r.unit }, { title: "Published", number: true, value: (r) => r.published, show: number },
    { title: "Modelled", number: true, value: (r) => r.modelled, show: (v, r) => number(v) + (r.modelled_spread !== undefined ? ` ± ${significant(r.modelled_spread, 2)}` : "") },
    { title: "Difference", unit: "%", csv: "Difference percent", number: true, value: (r) => r.difference_percent, show: (v) => signed(v, 1) },
    { title: "Use", value: (r) => r.use }, { title: "Verdict", value: (r) => r.verdict, node: (r) => h("span", { class: "tag " + tone(r.verdict) }, r.verdict) },
    { title: "Reason", value: (r) => r.reason }] });
}

function differences(data) {
  const rows = data.rows.filter((r) => r.kind === "timing" && Number.isFinite(r.difference_percent)).reverse();
  if (rows.length === 0) return null;
  const uses = [...new Set(rows.map((r) => r.use ?? "other"))];
  const clip = 30;
  return chart({
    name: "differences", title: "Times: difference to the thesis, %", height: 22 * rows.length + 90,
    note: `Band: ±${data.band_percent} %. Differences beyond ${clip} % are cut off here, not in the table.`,
    summary: `${rows.filter((r) => Math.abs(r.difference_percent) <= data.band_percent).length} of ${counted(rows.length, "time")} within ${data.band_percent} %.`,
    option: () => ({
      legend: { top: 0, left: 0, icon: "circle", itemWidth: 9, itemHeight: 9, textStyle: { color: palette().soft } },
      grid: { left: 8, right: 24, top: 34, bottom: 8, containLabel: true },
      xAxis: axis({ type: "value", min: -clip, max: clip }), yAxis: axis({ type: "category", data: rows.map((r) => r.id), splitLine: { show: false }, axisLabel: { interval: 0 } }),
      tooltip: { show: true, formatter: (p) => { const r = rows[p.data.index]; return r ? `${r.id}\nthesis ${r.published} ${r.unit}\nhere ${significant(r.modelled, 5)} ${r.unit} (${signed(r.difference_percent, 2)} %)\n${r.verdict}` : ""; } },
      series: uses.map((use, i) => ({ name: use, type: "scatter", symbolSize: 9, itemStyle: { color: seriesColour(i) },
        data: rows.map((r, index) => ((r.use ?? "other") === use ? { value: [Math.max(-clip, Math.min(clip, r.difference_percent)), index], index } : null)).filter(Boolean),
        markArea: i === 0 ? { silent: true, itemStyle: { color: palette().green, opacity: 0.1 }, data: [[{ xAxis: -data.band_percent }, { xAxis: data.band_percent }]] } : undefined })),
    }),
    table: () => ({ caption: "Differences", rows, columns: [{ title: "Value", value: (r) => r.id }, { title: "Difference", unit: "%", number: true, value: (r) => r.difference_percent }, { title: "Use", value: (r) => r.use }] }),
  });
}

function parseCsv(text) {
  const [head, ...lines] = text.trim().split("\n");
  const names = head.split(",");
  return lines.map((line) => { const cells = line.split(","); return Object.fromEntries(names.map((name, i) => [name, cells[i] === undefined || cells[i] === "" ? undefined : isNaN(cells[i]) ? cells[i] : Number(cells[i])])); });
}

/** Like the thesis' figures 5.19 to 5.45: a quantity over the images of a test. */
function figuresOf(frames) {
  const quantities = [["frame_us", "Frame time, ms", 1e-3], ["corner_px", "Corner error, px", 1], ["translation_mm", "Translation error, mm", 1], ["rotation_deg", "Rotation error, °", 1],
    ["feature_extraction_us", "Feature extraction, ms", 1e-3], ["corner_detection_us", "Corner detection, ms", 1e-3], ["threshold_us", "Threshold, ms", 1e-3], ["blob_detection_us", "Blob detection, ms", 1e-3],
    ["identification_us", "Identification, ms", 1e-3], ["pose_us", "Pose estimation, ms", 1e-3]];
  const tests = [...new Set(frames.map((f) => f.test))].filter((test) => frames.filter((f) => f.test === test && f.system === frames[0].system).length > 2);
  if (tests.length === 0) return null;
  const holder = h("div", { class: "columns" });
  let test = tests.find((name) => /square/.test(name)) ?? tests[0];
  const build = () => {
    const of = frames.filter((f) => f.test === test);
    const systems = [...new Set(of.map((f) => f.system))];
    const images = [...new Set(of.map((f) => f.image))];
    holder.replaceChildren(...quantities.filter(([key]) => of.some((f) => Number.isFinite(f[key]))).map(([key, title, scale]) => {
      const series = systems.map((system) => ({ system, data: images.map((image) => { const f = of.find((e) => e.system === system && e.image === image); return Number.isFinite(f?.[key]) ? f[key] * scale : null; }) })).filter((s) => s.data.some((v) => v !== null));
      const all = series.flatMap((s) => s.data).filter((v) => v !== null);
      return chart({
        name: `${test}-${key}`, title, height: 220, summary: `${test}: from ${significant(Math.min(...all), 4)} to ${significant(Math.max(...all), 4)}. ${series.map((s) => s.system).join(" and ")}.`,
        option: () => ({
          legend: { top: 0, right: 0, icon: "circle", itemWidth: 8, itemHeight: 8, textStyle: { color: palette().soft } }, grid: { left: 8, right: 12, top: 30, bottom: 4, containLabel: true },
          xAxis: axis({ type: "category", data: images.map((image) => String(image)) }), yAxis: axis({ type: "value" }),
          tooltip: { show: true, trigger: "axis", valueFormatter: (v) => (v == null ? "–" : significant(v, 4)) },
          series: series.map((s) => ({ s, i: systems.indexOf(s.system) })).map(({ s, i }) => ({ name: s.system, type: "line", data: s.data, symbol: i ? "diamond" : "circle", symbolSize: 6, lineStyle: { width: 1.5, color: seriesColour(i) }, itemStyle: { color: seriesColour(i) } })),
        }),
        table: () => ({ caption: title, rows: images.map((image, i) => ({ image, i })), columns: [{ title: "Image", value: (r) => r.image }, ...series.map((s) => ({ title: s.system, number: true, value: (r) => s.data[r.i], show: (v) => significant(v, 5) }))] }),
      });
    }));
  };
  build();
  const select = h("select", { onchange: () => { test = select.value; build(); } }, tests.map((name) => h("option", { value: name, selected: name === test }, words(name))));
  return h("section", { id: "figures", "aria-labelledby": "figures-title" }, h("h2", { id: "figures-title" }, "Figures"), h("div", { class: "controls" }, h("label", {}, "Test", select)), holder);
}

export function validationPage(data, csv) {
  const timing = data.rows.filter((r) => r.kind === "timing" && Number.isFinite(r.difference_percent));
  return {
    title: "Validation", subtitle: [`chapter 5 of the thesis`, `cost profile ${data.profile}`, counted(data.images ?? 0, "image"), data.fidelity === "clocked" ? "clock by clock" : "transaction level"].join("  ·  "),
    sections: [
      h("section", { id: "verdict", "aria-label": "Verdict" },
        h("ul", { class: "chips" }, h("li", { class: data.passed ? "good" : "bad" }, data.passed ? "✓ Passed" : "✕ Not passed"), h("li", { class: "good" }, `${timing.filter((r) => good(r.verdict)).length} of ${counted(timing.length, "time")} met`)),
        dataTable({ caption: "What had to hold", name: "gates", sortable: false, rows: data.gates ?? [], columns: [{ title: "What had to hold", head: true, value: (g) => g.name },
          { title: "Passed", value: (g) => g.passed, node: (g) => h("span", { class: "tag " + (g.passed ? "good" : "bad") }, g.passed ? "passed" : "failed") }, { title: "Result", value: (g) => g.text }] })),
      h("section", { id: "difference", "aria-labelledby": "difference-title" }, h("h2", { id: "difference-title" }, "Differences"), differences(data)),
      h("section", { id: "rows", "aria-labelledby": "rows-title" }, h("h2", { id: "rows-title" }, "Every value"), rowTable(data.rows)),
      csv && figuresOf(parseCsv(csv)),
      data.fitted?.length > 0 && h("section", { id: "fitted", "aria-labelledby": "fitted-title" }, h("h2", { id: "fitted-title" }, "Fitted constants"),
        dataTable({ caption: "Fitted constants", name: "fitted", rows: data.fitted, columns: [{ title: "Constant", head: true, value: (f) => f.name }, { title: "Value", number: true, value: (f) => f.value, show: (v) => fixed(v, 4) }, { title: "From", value: (f) => f.published?.join(", ") }] })),
    ],
  };
}

// Frames, configuration, provenance.
import { application } from "../application.js";
import { h } from "../kit/dom.js";
import { fixed, heading, shellWord, significant, words } from "../kit/format.js";
import { origin } from "../kit/origin.js";
import { dataTable } from "../kit/table.js";
import { countsOf, figuresOf } from "./facts.js";

export function frameTable(run) {
  if (run.frames.length === 0) return null;
  const has = (pick) => run.frames.some((frame) => pick(frame) !== undefined);
  const number = (title, unit, value, places, show) => ({ title, unit, value, number: true, csv: unit ? `${title} ${unit}` : title, show: show ?? ((v) => fixed(v, places)) });
  const own = application.columns(number, run);
  const columns = [
    number("#", null, (f) => f.index + 1, 0),
    { title: "Input", value: (f) => f.input, head: true },
    ...own.front,
    { title: "No result", value: (f) => (own.front.length > 0 ? undefined : f.gave_up) },
    ...run.stages.map((name) => number(words(name), "µs", (f) => f.time_us?.[name], 1)),
    number("Energy", "mJ", (f) => f.energy_mj?.total ?? f.energy_mj, 3),
    ...countsOf(run.frames).map((name) => number(words(name), null, (f) => f.counts[name], 0)),
    ...figuresOf(run.frames).map((name) => {
      const { title, unit } = run.figure(`frames.figures.${name}`);
      return number(title, unit, (f) => f.figures?.[name], 0, (v) => significant(v, 6));
    }),
    ...own.back,
    { title: "Warnings", value: (f) => f.warnings?.join("; ") },
  ].filter((column) => has(column.value));
  const left = (run.summary.frames ?? 0) - run.frames.length;
  return h("section", { id: "frames", "aria-labelledby": "frames-title" },
    h("h2", { id: "frames-title" }, `${heading(run.unit)}s`),
    left > 0 && h("p", { class: "note" }, `The first ${fixed(run.frames.length, 0)}; ${fixed(left, 0)} more stand in result.json.`),
    run.overTime?.(),
    dataTable({ columns, rows: run.frames, caption: `${heading(run.unit)}s with times, counts and figures`, name: "frames", exportable: true, limit: 25 }));
}

export function configuration(run) {
  const known = new Map((run.extras.parameters ?? []).map(([path, fallback, source, text]) => [path, { fallback, source, text }]));
  const rows = Object.entries(run.result.configuration ?? {}).map(([path, value]) => {
    const about = known.get(path);
    return { path, value, ...about, changed: about !== undefined && about.fallback !== value };
  });
  if (rows.length === 0) return null;
  const columns = [
    { title: "Parameter", head: true, value: (r) => r.path, node: (r) => h("code", {}, r.path) },
    { title: "Value", value: (r) => r.value },
    known.size > 0 && { title: "Default", value: (r) => r.fallback },
    known.size > 0 && { title: "Origin", value: (r) => r.source, node: (r) => (r.source ? origin(r.source, r.text) : "") },
    known.size > 0 && { title: "What it is", value: (r) => r.text },
  ].filter(Boolean);
  const changed = rows.filter((row) => row.changed);
  const rest = rows.filter((row) => !row.changed);
  return h("section", { id: "configuration", "aria-labelledby": "configuration-title" },
    h("h2", { id: "configuration-title" }, "Configuration"),
    known.size > 0 && (changed.length > 0
      ? [h("h3", {}, "Changed"), dataTable({ columns, rows: changed, caption: "Changed parameters", name: "changed" })]
      : h("p", { class: "note" }, "Every parameter has its default.")),
    h("details", {}, h("summary", {}, known.size > 0 ? `All other parameters (${rest.length})` : `All parameters (${rest.length})`),
      dataTable({ columns, rows: rest, caption: "Parameters", name: "configuration", exportable: true, limit: 1000 })));
}

export function provenance(run) {
  const { command_line: words_, ...rest } = run.result.provenance ?? {};
  const rows = Object.entries(rest);
  const command = ["markervp", ...(words_ ?? [])].map(shellWord).join(" ");
  return h("section", { id: "provenance", "aria-labelledby": "provenance-title" },
    h("h2", { id: "provenance-title" }, "Reproduce"),
    words_ && h("pre", { tabindex: "0", "aria-label": "Command line" }, h("code", {}, command)),
    h("dl", { class: "facts wide" }, rows.map(([name, value]) => h("div", {}, h("dt", {}, words(name)), h("dd", {}, String(value)))),
      ["fidelity", "system", "design", "profile"].map((name) => run.result[name] && h("div", {}, h("dt", {}, name), h("dd", {}, run.result[name])))));
}

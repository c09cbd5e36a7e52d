// Frames, configuration, provenance.
import { h } from "../kit/dom.js";
import { error, fixed, words } from "../kit/format.js";
import { origin } from "../kit/origin.js";
import { dataTable } from "../kit/table.js";
import { countsOf } from "./facts.js";

export function frameTable(run) {
  if (run.frames.length === 0) return null;
  const has = (pick) => run.frames.some((frame) => pick(frame) !== undefined);
  const first = (frame) => frame.markers[0];
  const number = (title, unit, value, places, show) => ({ title, unit, value, number: true, csv: unit ? `${title} ${unit}` : title, show: show ?? ((v) => fixed(v, places)) });
  const columns = [
    number("#", null, (f) => f.index + 1, 0),
    { title: "Input", value: (f) => f.input, head: true },
    { title: "Marker", value: (f) => f.markers.map((m) => m.id).join(", ") || (f.gave_up ? "no result" : "none") },
    ...run.stages.map((name) => number(words(name), "µs", (f) => f.time_us?.[name], 1)),
    number("Energy", "mJ", (f) => f.energy_mj?.total ?? f.energy_mj, 3),
    ...countsOf(run.frames).map((name) => number(words(name), null, (f) => f.counts[name], 0)),
    number("Error", "px", (f) => first(f)?.error?.corner_px, 2, (v) => error(v, 2)),
    number("Error", "mm", (f) => first(f)?.error?.translation_mm, 1, (v) => error(v, 1)),
    number("Error", "°", (f) => first(f)?.error?.rotation_deg, 2, (v) => error(v, 2)),
    { title: "Warnings", value: (f) => f.warnings?.join("; ") },
  ].filter((column) => has(column.value));
  const left = (run.summary.frames ?? 0) - run.frames.length;
  return h("section", { id: "frames", "aria-labelledby": "frames-title" },
    h("h2", { id: "frames-title" }, "Frames"),
    left > 0 && h("p", { class: "note" }, `The first ${fixed(run.frames.length, 0)}; ${fixed(left, 0)} more stand in result.json.`),
    run.overTime?.(),
    dataTable({ columns, rows: run.frames, caption: "Frames with times, counts and errors", name: "frames", exportable: true, limit: 25 }));
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

/** Words that a shell must not read otherwise, in quotes. */
export function shellWord(word) {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
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

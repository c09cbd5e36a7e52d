// How the first feature words are handed over, as a waveform.
import wavedrom from "wavedrom";
import { h } from "../kit/dom.js";
import { counted, fixed } from "../kit/format.js";
import { dataTable } from "../kit/table.js";

const most = 24; // changes that are drawn

const hex = (value) => value.toString(16).toUpperCase().padStart(8, "0");

/** Every time at which something changes, with the values of all signals from then on. */
function columnsOf(signals) {
  const times = [...new Set(signals.flatMap((s) => s.points.map((p) => p[0])))].sort((a, b) => a - b).slice(0, most);
  const at = (signal, time) => signal.points.findLast((p) => p[0] <= time)?.[1] ?? 0;
  return times.map((time) => ({ time, values: signals.map((signal) => at(signal, time)) }));
}

function wave(name, values, show) {
  const same = (value, i) => i > 0 && value === values[i - 1];
  if (!show) return { name, wave: values.map((v, i) => (same(v, i) ? "." : String(v))).join("") };
  return { name, wave: values.map((v, i) => (same(v, i) ? "." : "=")).join(""), data: values.filter((v, i) => !same(v, i)).map(show) };
}

function source(signals, columns) {
  return {
    config: { hscale: 2 },
    signal: [{ name: "µs", wave: columns.map(() => "x").join("").replaceAll("x", "="), data: columns.map((c) => fixed(c.time - columns[0].time, 3)) },
      ...signals.map((signal, i) => wave(signal.name, columns.map((c) => c.values[i]), signal.bits === 1 ? null : signal.bits > 8 ? hex : (v) => v.toString(2).padStart(signal.bits, "0")))],
  };
}

export function handshakes(run) {
  const [shown] = run.extras.timeline?.handshakes ?? [];
  const columns = shown ? columnsOf(shown.signals) : [];
  if (columns.length < 3) return null;
  const words = columns.filter((c, i) => i > 0 && c.values[1] !== columns[i - 1].values[1]).length;
  const summary = `${shown.name}: ${counted(columns.length, "change")} of ${shown.signals.map((s) => s.name).join(", ")}, ${counted(words, "new word")} in ${fixed(columns.at(-1).time - columns[0].time, 3)} µs`;
  const area = h("div", { class: "wave", role: "img", "aria-label": summary });
  const draw = () => {
    if (area.firstChild) return;
    const tree = wavedrom.renderAny(0, source(shown.signals, columns), wavedrom.waveSkin);
    const text = wavedrom.onml.stringify(tree);
    area.append(document.importNode(new DOMParser().parseFromString(text, "image/svg+xml").documentElement, true));
  };
  new IntersectionObserver((entries) => { if (entries.some((e) => e.isIntersecting)) draw(); }, { rootMargin: "200px" }).observe(area);
  window.addEventListener("beforeprint", draw);
  return h("section", { id: "handshakes", "aria-labelledby": "handshakes-title" }, h("h2", { id: "handshakes-title" }, "Handshakes"),
    h("p", { class: "note" }, `${shown.name}, the first of the run: how they are handed over, signal by signal. Each column is a change, at the time above it: not to scale.`),
    h("div", { class: "table-scroll", tabindex: "0", role: "group", "aria-label": `Waveform: ${shown.name}` }, area),
    h("details", {}, h("summary", {}, "As a table"), dataTable({ caption: "Changes of the handshake", name: "handshake", exportable: true, rows: columns, sortable: false, columns: [
      { title: "Time", unit: "µs", csv: "Time us", number: true, value: (c) => c.time, show: (v) => fixed(v, 3) },
      ...shown.signals.map((signal, i) => ({ title: signal.name, value: (c) => (signal.bits > 8 ? hex(c.values[i]) : c.values[i].toString(2).padStart(signal.bits, "0")) })),
      { title: "Word", value: (c) => shown.meanings?.[c.values[1]] ?? "" }] })));
}

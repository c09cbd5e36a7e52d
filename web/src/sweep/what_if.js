// Sliders over the swept parameters, and the computed point that is nearest: never one in between.
import { h } from "../kit/dom.js";
import { tidy } from "../kit/format.js";
import { dataTable } from "../kit/table.js";

/** The values of a parameter in order, and where each lies from 0 to 1; words have no order, and are all 1 apart. */
function scaleOf(sweep, parameter) {
  const texts = new Map(sweep.points.map((point) => [parameter.of(point), parameter.text(point)]));
  const values = [...texts.keys()].sort((a, b) => a - b);
  const [low, high] = [values[0], values.at(-1)];
  const places = values.map((value) => (parameter.numeric ? (value - low) / (high - low || 1) : 0));
  const ranks = new Map(values.map((value, rank) => [value, rank]));
  return { texts: values.map((value) => texts.get(value)), places, numeric: parameter.numeric, rank: (point) => ranks.get(parameter.of(point)) };
}

/** Finds points by the ranks of their values; of several that are as near the best. */
function finder(sweep, scales) {
  const ranks = sweep.points.map((point) => scales.map((scale) => scale.rank(point)));
  const apart = (scale, a, b) => (a === b ? 0 : scale.numeric ? Math.abs(scale.places[a] - scale.places[b]) : 1);
  return (asked) => {
    let nearest = 0, least = Infinity;
    for (let i = 0; i < ranks.length && least > 0; i++) {
      let distance = 0;
      for (let axis = 0; axis < asked.length && distance < least; axis++) distance += apart(scales[axis], ranks[i][axis], asked[axis]);
      if (distance < least) [nearest, least] = [i, distance];
    }
    return { point: sweep.points[nearest], ranks: ranks[nearest] };
  };
}

/** Any number of points side by side: `keep` adds one. */
export function comparison(sweep, selection) {
  const kept = [];
  const table = h("div");
  const element = h("section", { id: "compare", "aria-labelledby": "compare-title", hidden: true }, h("h2", { id: "compare-title" }, "Points side by side"), table);
  const rowsOf = () => [...sweep.parameters.map((p) => ({ name: p.name, unit: "", of: (point) => p.text(point) })),
    ...sweep.metrics.map((m) => ({ name: m.name, unit: m.unit, of: (point) => (Number.isFinite(m.of(point)) ? tidy(m.of(point)) : "–") })),
    { name: "Why not", unit: "", of: (point) => selection.why(point).join("; ") }];
  const update = () => {
    element.hidden = kept.length === 0;
    const columns = [{ title: "", value: (row) => row.name + (row.unit ? `, ${row.unit}` : ""), head: true }, ...kept.map((point) => ({ title: point.key.slice(0, 8), value: (row) => row.of(point) }))];
    const drop = (point) => h("button", { type: "button", "aria-label": `Drop point ${point.key.slice(0, 8)}`, onclick: () => { kept.splice(kept.indexOf(point), 1); update(); } }, `${point.key.slice(0, 8)} ✕`);
    table.replaceChildren(dataTable({ caption: "Points side by side", name: "compared", rows: rowsOf(), sortable: false, exportable: true, columns }), h("div", { class: "limits" }, kept.map(drop)));
  };
  selection.onChange(() => { if (kept.length) update(); });
  element.keep = (point) => { if (!kept.includes(point)) kept.push(point); update(); };
  return element;
}

export function whatIf(sweep, selection, open, compare) {
  if (sweep.parameters.length === 0) return null;
  const scales = sweep.parameters.map((parameter) => scaleOf(sweep, parameter));
  const find = finder(sweep, scales);
  const asked = scales.map((scale) => scale.rank(sweep.points[0]));
  let found = null;
  const said = h("p", { class: "note", role: "status" });
  const figures = h("dl", { class: "facts wide" });
  const why = h("ul", { class: "chips" });
  const update = () => {
    found = find(asked);
    const others = scales.flatMap((scale, axis) => (found.ranks[axis] === asked[axis] ? [] : [`${sweep.parameters[axis].name} ${scale.texts[found.ranks[axis]]}, not ${scale.texts[asked[axis]]}`]));
    said.textContent = others.length === 0 ? "This point was computed." : `This point was not computed. The nearest that was has ${others.join("; ")}.`;
    figures.replaceChildren(...sweep.metrics.filter((m) => Number.isFinite(m.of(found.point))).slice(0, 8)
      .map((m) => h("div", {}, h("dt", {}, m.name), h("dd", {}, `${tidy(m.of(found.point))} ${m.unit}`))));
    const reasons = selection.why(found.point);
    why.replaceChildren(...(reasons.length ? reasons.map((reason) => h("li", { class: "bad" }, reason)) : [h("li", { class: "good" }, "feasible")]));
  };
  const slider = (parameter, axis) => {
    const scale = scales[axis];
    const shown = h("output", {}, scale.texts[asked[axis]]);
    const input = h("input", { type: "range", min: "0", max: String(scale.texts.length - 1), step: "1", "aria-valuetext": scale.texts[asked[axis]], oninput: () => {
      asked[axis] = Number(input.value);
      shown.textContent = scale.texts[asked[axis]];
      input.setAttribute("aria-valuetext", shown.textContent);
      update();
    } });
    input.value = String(asked[axis]);
    return h("label", {}, parameter.name, input, shown);
  };
  const controls = h("div", { class: "controls" }, sweep.parameters.map(slider));
  update();
  selection.onChange(update);
  return h("div", {}, controls, said, why, figures,
    h("p", { style: { margin: "16px 0" } }, h("button", { type: "button", onclick: () => open(found.point) }, "Open this point"), " ", h("button", { type: "button", onclick: () => compare.keep(found.point) }, "Keep to compare")));
}

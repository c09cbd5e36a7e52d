// The points of a sweep as numbers: "50 MHz" is 50 on an axis in MHz.
const scales = { Hz: ["MHz", 1e-6], kHz: ["MHz", 1e-3], MHz: ["MHz", 1], GHz: ["MHz", 1e3] };

/** {number, unit} of a value of the configuration; number NaN for words. */
function parsed(text) {
  const match = String(text).match(/^(-?[\d.]+(?:e[-+]?\d+)?)\s*(\S*)$/i);
  if (!match) return { number: NaN, unit: "" };
  const [unit, scale] = scales[match[2]] ?? [match[2], 1];
  return { number: Number(match[1]) * scale, unit };
}

/** `numbers`: of each point, by its index. */
const axisOf = (facts, numbers) => ({ ...facts, of: (point) => numbers[point.index] });

function parameterAxis(sweep, index) {
  const texts = sweep.points.map((point) => String(point.swept[index]));
  const values = texts.map(parsed);
  const numeric = values.length > 0 && values.every((v) => Number.isFinite(v.number));
  const words = [...new Set(texts)];
  const places = new Map(words.map((word, place) => [word, place]));
  return axisOf({
    id: sweep.swept[index], name: sweep.swept[index], unit: numeric ? values[0].unit : "", better: 0, numeric, words, parameter: true,
    text: (point) => String(point.swept[index]),
  }, numeric ? values.map((v) => v.number) : texts.map((text) => places.get(text)));
}

function metricAxis(sweep, index) {
  const { path, title, unit, better, factor } = sweep.metrics[index];
  return axisOf({ id: path, name: title, unit, better, scale: factor, numeric: true }, sweep.points.map(({ metrics }) => (metrics[index] ?? NaN) * factor));
}

/** The axis of an objective: the page has a figure for each, or it is a parameter. */
function objectiveAxis(axes, { metric, better }) {
  const axis = axes.find(({ id }) => id === metric);
  return axis && Object.assign(axis, { better });
}

/** Of a constraint like "summary.fps.mean >= 200", which can be moved, the axis and the range within; else null. */
function limitOf(text, axes) {
  const [, path, relation, number] = text.match(/^`?([\w.]+)`? (>=|<=) (-?[\d.]+(?:e[-+]?\d+)?)$/i) ?? [];
  const axis = axes.find(({ id }) => id === path);
  if (!axis) return null;
  const bound = Number(number) * axis.scale;
  return { text, axis, range: relation === ">=" ? [bound, Infinity] : [-Infinity, bound] };
}

/** The feasible points front by front, in each the best first; then the others. */
function bestFirst(points, objective) {
  const rank = (p) => (p.reasons.length === 0 && p.front > 0 ? p.front : Infinity);
  const order = (a, b) => (rank(a) === rank(b) ? 0 : rank(a) - rank(b)) || Number(a.failed) - Number(b.failed) || (objective ? (objective.of(b) - objective.of(a)) * objective.better || 0 : 0);
  return points.map((p, i) => [p, i]).sort(([a, i], [b, j]) => order(a, b) || i - j).map(([p]) => p);
}

/** Names of values on an axis: those that differ, and the unit. */
export const shortName = (a, separator = " ") => a.name.split(".").slice(-2).join(separator) + (a.unit ? `, ${a.unit}` : "");

export function makeSweep(data) {
  const sweep = { ...data, points: data.points.map((point, index) => ({ ...point, index })) };
  // A run that failed stopped early: its means are not those of a whole one.
  const whole = sweep.points.filter((p) => !p.failed);
  const parameters = sweep.swept.map((_, index) => parameterAxis(sweep, index)).filter((axis) => axis.words.length > 1);
  const metrics = sweep.metrics.map((_, index) => metricAxis(sweep, index)).filter((axis) => sweep.points.some((p) => Number.isFinite(axis.of(p))));
  const find = (id) => metrics.find((axis) => axis.id === id);
  const fps = find("summary.fps.mean");
  const power = find("power.total_w.nominal");
  const objectives = sweep.objectives.map((objective) => objectiveAxis([...metrics, ...parameters], objective)).filter(Boolean);
  // What a constraint that can be moved says of a point, the selection says.
  const limits = sweep.constraints.map((text) => limitOf(text, metrics)).filter(Boolean);
  const movable = new Set(limits.map(({ text }) => `breaks ${text}`));
  for (const point of sweep.points) point.faults = point.reasons.filter((reason) => !movable.has(reason));
  return {
    ...sweep, parameters, metrics, fps, power, objectives, limits,
    points: bestFirst(sweep.points, objectives[0]),
    byPlace: sweep.points,
    whole,
    feasible: sweep.points.filter((p) => p.reasons.length === 0),
    label: (axis) => axis.name + (axis.unit ? `, ${axis.unit}` : ""),
  };
}

// The points of a sweep as numbers: "50 MHz" is 50 on an axis in MHz.

const names = {
  "summary/fps/mean": ["Frame rate", "frames/s", 1], "summary/latency_us/mean": ["Latency", "ms", -1, 1e-3], "summary/power_w/total": ["Power", "W", -1],
  "summary/energy_per_frame_mj": ["Energy per frame", "mJ", -1], "power/junction_c": ["Junction", "°C", -1], "summary/detected": ["Frames with marker", "", 1], "summary/frames": ["Frames", "", 1],
  "resources/total/lut": ["LUT", "", -1], "resources/total/ff": ["Flip-flops", "", -1], "resources/total/bram36": ["BRAM 36 Kb", "", -1],
  "resources/total/dsp": ["DSP", "", -1], "error/corner_px": ["Corner error", "px", -1], "error/translation_mm": ["Translation error", "mm", -1],
  "error/rotation_deg": ["Rotation error", "°", -1],
};

const scales = { Hz: ["MHz", 1e-6], kHz: ["MHz", 1e-3], MHz: ["MHz", 1], GHz: ["MHz", 1e3] };

/** {number, unit} of a value of the configuration; number NaN for words. */
function parsed(text) {
  const match = String(text).match(/^(-?[\d.]+(?:e[-+]?\d+)?)\s*(\S*)$/i);
  if (!match) return { number: NaN, unit: "" };
  const [unit, scale] = scales[match[2]] ?? [match[2], 1];
  return { number: Number(match[1]) * scale, unit };
}

function parameterAxis(sweep, index) {
  const values = sweep.points.map((point) => parsed(point.swept[index]));
  const numeric = values.length > 0 && values.every((v) => Number.isFinite(v.number));
  const words = [...new Set(sweep.points.map((point) => String(point.swept[index])))];
  return {
    id: sweep.swept[index], name: sweep.swept[index], unit: numeric ? values[0].unit : "", numeric, words, parameter: true,
    of: (point) => (numeric ? parsed(point.swept[index]).number : words.indexOf(String(point.swept[index]))),
    text: (point) => String(point.swept[index]),
  };
}

function metricAxis(sweep, index) {
  const path = sweep.metrics[index];
  const [name, unit, better, scale = 1] = names[path] ?? [path, "", 0];
  return {
    id: path, name, unit, better, numeric: true,
    of: (point) => (point.metrics[index] === null || point.metrics[index] === undefined ? NaN : point.metrics[index] * scale),
  };
}

/** Points that no other feasible one beats in rate and power. */
function paretoFront(points, fps, power) {
  const feasible = points.filter((p) => p.reasons.length === 0 && Number.isFinite(fps.of(p)) && Number.isFinite(power.of(p)))
    .sort((a, b) => power.of(a) - power.of(b) || fps.of(b) - fps.of(a));
  const front = [];
  for (const point of feasible) if (front.length === 0 || fps.of(point) > fps.of(front.at(-1))) front.push(point);
  return front;
}

/** Names of values on an axis: those that differ, and the unit. */
export const shortName = (a, separator = " ") => a.name.split(".").slice(-2).join(separator) + (a.unit ? `, ${a.unit}` : "");

export function makeSweep(sweep) {
  // A run that failed stopped early: its means are not those of a whole one.
  const whole = sweep.points.filter((p) => !p.failed);
  const parameters = sweep.swept.map((_, index) => parameterAxis(sweep, index)).filter((axis) => axis.words.length > 1);
  const metrics = sweep.metrics.map((_, index) => metricAxis(sweep, index)).filter((axis) => sweep.points.some((p) => Number.isFinite(axis.of(p))));
  const find = (id) => metrics.find((axis) => axis.id === id);
  const fps = find("summary/fps/mean");
  const power = find("summary/power_w/total");
  return {
    ...sweep, parameters, metrics, fps, power,
    whole,
    feasible: sweep.points.filter((p) => p.reasons.length === 0),
    front: fps && power ? paretoFront(sweep.points, fps, power) : [],
    label: (axis) => axis.name + (axis.unit ? `, ${axis.unit}` : ""),
    show: (axis, point) => (axis.parameter ? axis.text(point) : axis.of(point)),
  };
}

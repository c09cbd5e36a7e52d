// Points in colours by any figure or parameter.
import { tidy } from "../kit/format.js";
import { palette } from "../kit/theme.js";

/** More colours than these look alike. */
const most = 6;

/** Between the colours of a list, "#rrggbb", at `share` of the way. */
function between(colours, share) {
  const place = share * (colours.length - 1);
  const from = Math.min(Math.floor(place), colours.length - 2);
  const channel = (colour, i) => parseInt(colour.slice(1 + 2 * i, 3 + 2 * i), 16);
  const mixed = [0, 1, 2].map((i) => Math.round(channel(colours[from], i) + (place - from) * (channel(colours[from + 1], i) - channel(colours[from], i))));
  return `#${mixed.map((n) => n.toString(16).padStart(2, "0")).join("")}`;
}

/** Numbers with as many digits as it takes to tell them apart. */
function told(numbers) {
  const texts = (digits) => numbers.map((number) => tidy(Number(number.toPrecision(12)), digits));
  for (let digits = 4; digits < 9; ++digits) {
    if (new Set(texts(digits)).size === numbers.length) return texts(digits);
  }
  return texts(9);
}

/**
 * Groups of the points by an axis: one a value where these are few, else equal parts of the range; the last has those without a value.
 * @returns [{name, has(point), colour()}]
 */
export function groupsOf(axis, points) {
  const values = [...new Set(points.map(axis.of).filter(Number.isFinite))].sort((a, b) => a - b);
  const unit = axis.unit ? ` ${axis.unit}` : "";
  const words = axis.words && !axis.numeric;
  const few = values.length <= most;
  const step = (values.at(-1) - values[0]) / most;
  const edges = few || words ? values : Array.from({ length: most + 1 }, (_, i) => values[0] + i * step);
  const texts = words ? values.map((place) => axis.words[place]) : told(edges);
  const ranges = few ? values.map((one, i) => ({ name: texts[i], from: one }))
    : words ? values.slice(0, most).map((one, i) => ({ name: i + 1 < most ? texts[i] : "others", from: one }))
      : edges.slice(0, most).map((edge, i) => ({ name: `${texts[i]} to ${texts[i + 1]}`, from: edge }));
  ranges.forEach((range, i) => { range.below = ranges[i + 1]?.from ?? Infinity; });
  const groups = ranges.map(({ name, from, below }, i) => ({
    name: name + unit, has: (p) => axis.of(p) >= from && axis.of(p) < below,
    colour: () => { const c = palette(); return between([c.blue, c.purple, c.orange], ranges.length > 1 ? i / (ranges.length - 1) : 0); },
  }));
  if (points.some((p) => !Number.isFinite(axis.of(p)))) groups.push({ name: `no ${axis.name}`, has: (p) => !Number.isFinite(axis.of(p)), colour: () => palette().grey });
  return groups;
}

// Which points the reader keeps: ranges of figures, the same for all charts.
import { tidy } from "../kit/format.js";

/** The points that none of `points` beats in all `objectives`, axes that say which way is better. */
export function frontOf(points, objectives) {
  const known = points.filter((p) => objectives.every((o) => Number.isFinite(o.of(p))));
  const figures = known.map((point) => ({ point, values: objectives.map((o) => o.of(point) * o.better) }));
  const before = (a, b) => { for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return b[i] - a[i]; return 0; };
  figures.sort((a, b) => before(a.values, b.values));
  // Whatever beats a point comes before it, and is no worse anywhere.
  const front = [];
  for (const one of figures) {
    if (!front.some((other) => before(other.values, one.values) !== 0 && other.values.every((value, i) => value >= one.values[i]))) front.push(one);
  }
  return front.map(({ point }) => point);
}

const inside = (value, ranges) => ranges.some(([low, high]) => low <= value && value <= high);

export function makeSelection(sweep) {
  const chosen = new Map();  // axis → [[low, high]…]
  const listeners = [];
  let pending = 0;
  const changed = () => {
    cancelAnimationFrame(pending);
    pending = requestAnimationFrame(() => { for (const listener of listeners) listener(); });
  };
  const asked = new Map();
  for (const { axis, range: [low, high] } of sweep.limits) {
    const [[least, most]] = asked.get(axis) ?? [[-Infinity, Infinity]];
    asked.set(axis, [[Math.max(least, low), Math.min(most, high)]]);
  }
  const reset = () => { chosen.clear(); asked.forEach((ranges, axis) => chosen.set(axis, ranges)); };
  reset();
  const selection = {
    /** The ranges of an axis; empty: all of it. */
    ranges: (axis) => chosen.get(axis) ?? [],
    /** From the least to the greatest value kept. */
    range: (axis) => { const all = selection.ranges(axis).flat(); return all.length ? [Math.min(...all), Math.max(...all)] : [-Infinity, Infinity]; },
    axes: () => [...chosen.keys()],
    set(axis, ranges) {
      const wanted = ranges.filter(([low, high]) => low > -Infinity || high < Infinity);
      if (JSON.stringify(wanted) === JSON.stringify(selection.ranges(axis))) return;
      if (wanted.length) chosen.set(axis, wanted); else chosen.delete(axis);
      changed();
    },
    clear() { chosen.clear(); changed(); },
    /** The limits that the study sets. */
    reset() { reset(); changed(); },
    asAsked: () => chosen.size === asked.size && [...asked].every(([axis, ranges]) => JSON.stringify(ranges) === JSON.stringify(selection.ranges(axis))),
    /** What is kept of an axis: "Frame rate ≥ 200 frames/s". */
    text(axis) {
      const show = (number) => (axis.numeric ? tidy(number) : axis.words[Math.min(Math.max(Math.round(number), 0), axis.words.length - 1)]);
      const one = ([low, high]) => (low === -Infinity ? `≤ ${show(high)}` : high === Infinity ? `≥ ${show(low)}` : `${show(low)} to ${show(high)}`);
      return `${axis.name} ${selection.ranges(axis).map(one).join(" or ")} ${axis.unit}`.trim();
    },
    /** Why it is not good, the limits included. */
    why: (point) => [...point.faults, ...[...chosen].filter(([axis, ranges]) => !inside(axis.of(point), ranges)).map(([axis]) => `outside ${selection.text(axis)}`)],
    keeps(point) { for (const [axis, ranges] of chosen) if (!inside(axis.of(point), ranges)) return false; return true; },
    /** Kept, and nothing else is wrong with it. */
    good: (point) => point.faults.length === 0 && selection.keeps(point),
    /** `listener` is called before the next picture, once for all that changed. */
    onChange: (listener) => listeners.push(listener),
  };
  return selection;
}

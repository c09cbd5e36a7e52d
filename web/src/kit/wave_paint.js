// Draws rows of a recorded trace on a canvas. What changes more often than there are pixels costs a column of pixels, not a change.
import { extent, placeAt } from "./wave_data.js";

export const rowHeight = 26; // px
const low = 20, high = 5; // of a wave in its row

/** Time to px and back. */
export function scaleOf(view, width) {
  const perPx = (view.to - view.from) / width;
  return { x: (ps) => (ps - view.from) / perPx, time: (px) => view.from + px * perPx, perPx };
}

/** How a value looks that is neither 0 nor 1: null if it is drawn as a line. Undriven is no fault, as x is; u was never set. */
function shadeOf(state, colour) {
  return state === "z" ? null : state === "u" ? colour.unset : colour.unknown;
}

/** Text of a vector that is unknown as a whole: its one state; of another value undefined. */
const wholeState = (text) => /^(?:0x)?([xzuw-])$/.exec(text)?.[1];

/**
 * Walks over what is to be seen of a row: `piece(i, x, next)` for a value with room, `busy(i, j, x)` for the changes i to j - 1 that
 * fall into the column of pixels at x.
 */
function walk(row, view, scale, width, piece, busy) {
  const { times } = row;
  for (let i = Math.max(0, placeAt(times, view.from)); i < times.length && times[i] < view.to;) {
    const x = Math.max(scale.x(times[i]), -1);
    const next = i + 1 < times.length ? scale.x(times[i + 1]) : width;
    if (next - x >= 1) {
      piece(i, x, Math.min(next, width + 1));
      i += 1;
      continue;
    }
    const column = Math.floor(x);
    const end = placeAt(times, scale.time(column + 1), i) + 1;
    busy(i, end, column);
    // The last of them stays until the next change.
    i = end - 1 > i ? end - 1 : end;
    if (i + 1 < times.length && scale.x(times[i + 1]) - scale.x(times[i]) < 1) i += 1;
  }
}

function paintBit(paint, row, y) {
  const { context, colour } = paint;
  const levels = row.states.map((state) => (state === "0" ? y + low : state === "1" ? y + high : y + (low + high) / 2));
  const lines = new Path2D();
  let last = null;
  walk(row, paint.view, paint.scale, paint.width, (i, x, next) => {
    const value = row.values[i];
    const shade = value > 1 && shadeOf(row.states[value], colour);
    if (shade) {
      context.fillStyle = shade;
      context.fillRect(x, y + high, next - x, low - high);
    }
    if (last !== null && last !== levels[value]) { lines.moveTo(x, last); lines.lineTo(x, levels[value]); }
    lines.moveTo(x, levels[value]);
    lines.lineTo(next, levels[value]);
    last = levels[value];
  }, (i, j, x) => {
    context.fillStyle = colour.line;
    context.fillRect(x, y + high, 1, low - high);
    last = levels[row.values[j - 1]];
  });
  context.strokeStyle = colour.line;
  context.stroke(lines);
}

function label(context, text, x, next, y, colour) {
  const from = Math.max(x, 0) + 4;
  const room = Math.floor((next - from - 3) / 6.2);
  if (room < 1 || (room < text.length && room < 4)) return;
  context.fillStyle = colour;
  context.fillText(text.length > room ? text.slice(0, room - 1) + "…" : text, from, y + 17);
}

function paintWords(paint, row, y) {
  const { context, colour } = paint;
  walk(row, paint.view, paint.scale, paint.width, (i, x, next) => {
    const text = row.words[row.values[i]];
    if (text === "") return;
    const state = wholeState(text);
    context.fillStyle = colour.line;
    if (state === "z") { context.fillRect(x, y + (low + high) / 2, next - x, 1); return; }
    context.fillStyle = state ? shadeOf(state, colour) : colour.box;
    context.fillRect(x, y + high, next - x, low - high);
    context.fillStyle = colour.line;
    context.fillRect(x, y + high, 1, low - high);
    label(context, text, x, next, y, colour.ink);
  }, (i, j, x) => {
    context.fillStyle = colour.line;
    context.fillRect(x, y + high, 1, low - high);
  });
}

function paintReal(paint, row, y) {
  const { context, colour } = paint;
  const span = row.most - row.least || 1;
  const at = (value) => y + low - ((value - row.least) / span) * (low - high);
  context.fillStyle = context.strokeStyle = colour.line;
  const lines = new Path2D();
  let last = null;
  walk(row, paint.view, paint.scale, paint.width, (i, x, next) => {
    const value = row.curve[i];
    if (!Number.isFinite(value)) { last = null; return; }
    if (last !== null) { lines.moveTo(x, last); lines.lineTo(x, at(value)); }
    lines.moveTo(x, at(value));
    lines.lineTo(next, at(value));
    last = at(value);
  }, (i, j, x) => {
    const [least, most] = extent(row, i, j);
    if (least <= most) context.fillRect(x, at(most), 1, Math.max(1, at(least) - at(most)));
    last = Number.isFinite(row.curve[j - 1]) ? at(row.curve[j - 1]) : null;
  });
  context.stroke(lines);
}

function paintLane(paint, row, y) {
  const { context, colour, view, scale } = paint;
  let covered = -1;
  for (let i = Math.max(0, placeAt(row.times, view.from)); i < row.times.length && row.times[i] < view.to;) {
    const x = Math.max(scale.x(row.times[i]), -1), next = scale.x(row.ends[i]);
    const right = Math.max(next, x + 1);
    if (right > covered) {
      context.fillStyle = row.bad[i] ? colour.bad : colour.lane;
      context.fillRect(x, y + high, Math.max(right - x - (right - x > 3 ? 1 : 0), 1), low - high);
      if (right - x > 12) label(context, row.words[row.values[i]], x, right, y, colour.page);
      covered = right;
    }
    // Those that end in the same column of pixels are one.
    i = right - x > 1 ? i + 1 : Math.max(i + 1, placeAt(row.times, scale.time(Math.floor(x) + 1), i) + 1);
  }
}

const painters = { bit: paintBit, words: paintWords, real: paintReal, lane: paintLane };

/** Steps between the marks of the axis: 1, 2 or 5 times a power of ten. */
export function stepOf(span, count) {
  const least = Math.max(span / count, 1);
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((times) => times * power).find((step) => step >= least);
}

/** `rows`: those in sight, from the top; null for a title. */
export function paintRows(paint, rows) {
  paint.context.font = "11px ui-monospace, monospace";
  paint.context.lineWidth = 1.2;
  rows.forEach((row, i) => { if (row?.form) painters[row.form](paint, row, i * rowHeight + paint.top); });
}

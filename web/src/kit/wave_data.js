// A recorded trace, unpacked: for each signal the times of its changes and its values, in typed arrays.

/** Numbers of seven bits a byte, the lowest first. Exact up to 2^53. */
function numbersOf(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  let at = 0;
  return () => {
    let value = 0, scale = 1, byte;
    do {
      byte = bytes[at++];
      value += (byte & 0x7f) * scale;
      scale *= 128;
    } while (byte >= 0x80);
    return value;
  };
}

const states = ["0", "1", "x", "z", "u", "w", "-"]; // of a bit
const stateRoom = 8; // for one in a number

function unpackSignal(signal, from) {
  const next = numbersOf(signal.changes);
  const times = new Float64Array(signal.count);
  const values = new Uint32Array(signal.count);
  const bit = signal.form === "bit";
  for (let i = 0, now = from; i < signal.count; ++i) {
    const number = next();
    now += bit ? Math.floor(number / stateRoom) : number;
    times[i] = now;
    values[i] = bit ? number % stateRoom : next();
  }
  return { ...signal, changes: undefined, times, values, states, ...(signal.form === "real" && curveOf(values, signal.words)) };
}

/** The numbers of a curve with the least and the most of each 64: a column of pixels looks at few of them, however many it holds. */
function curveOf(values, words) {
  const numbers = Float64Array.from(words, Number);
  const curve = Float64Array.from(values, (value) => numbers[value]);
  const blocks = Math.ceil(curve.length / block);
  const low = new Float64Array(blocks).fill(Infinity), high = new Float64Array(blocks).fill(-Infinity);
  let least = Infinity, most = -Infinity;
  curve.forEach((value, i) => {
    if (!Number.isFinite(value)) return;
    const at = Math.floor(i / block);
    low[at] = Math.min(low[at], value);
    high[at] = Math.max(high[at], value);
    least = Math.min(least, value);
    most = Math.max(most, value);
  });
  return { curve, low, high, least, most };
}
const block = 64;

/** The least and the most of the values `begin` to `end` - 1; [∞, -∞] if none is a number. */
export function extent({ curve, low, high }, begin, end) {
  let least = Infinity, most = -Infinity;
  const take = (a, b) => { if (a < least) least = a; if (b > most) most = b; };
  for (let i = begin; i < end;) {
    if (i % block === 0 && i + block <= end) {
      take(low[i / block], high[i / block]);
      i += block;
    } else {
      if (Number.isFinite(curve[i])) take(curve[i], curve[i]);
      i += 1;
    }
  }
  return [least, most];
}

function unpackLane(lane, from) {
  const next = numbersOf(lane.spans);
  const times = new Float64Array(lane.count), ends = new Float64Array(lane.count);
  const values = new Uint32Array(lane.count), bad = new Uint8Array(lane.count);
  for (let i = 0, now = from; i < lane.count; ++i) {
    now += next();
    times[i] = now;
    ends[i] = now + next();
    const word = next();
    values[i] = Math.floor(word / 2);
    bad[i] = word % 2;
  }
  return { ...lane, spans: undefined, form: "lane", times, ends, values, bad };
}

/** The block of a page. */
export function unpack(data) {
  const signals = [];
  for (const signal of data.signals)
    signals.push(signal.sameAs === undefined ? unpackSignal(signal, data.from) : { ...signals[signal.sameAs], name: signal.name, alias: true });
  return { ...data, signals, lanes: data.lanes.map((lane) => unpackLane(lane, data.from)) };
}

/** The place of the last of the `times`, which rise, that is not after `time`; -1 before the first. */
export function placeAt(times, time, low = 0) {
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (times[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** What a row shows at a time, as text. */
export function valueAt(row, time) {
  const i = placeAt(row.times, time);
  if (row.form === "lane") return i >= 0 && time < row.ends[i] ? row.words[row.values[i]] : "";
  if (i < 0) return "x";
  return row.form === "bit" ? states[row.values[i]] : row.words[row.values[i]];
}

/** "12.345 µs", exact to the ps: with as many places as the time has. */
export function exactTime(ps) {
  const units = [[1e12, "s"], [1e9, "ms"], [1e6, "µs"], [1e3, "ns"], [1, "ps"]];
  const [scale, unit] = units.find(([size]) => Math.abs(ps) >= size) ?? units.at(-1);
  const places = Math.round(Math.log10(scale));
  const whole = Math.floor(ps / scale), rest = Math.round(ps - whole * scale);
  const part = String(rest).padStart(places, "0").replace(/0+$/, "");
  return `${whole}${part ? "." + part : ""} ${unit}`;
}

// Numbers as people read them: as many digits as matter, thin spaces between thousands.
// What is no number is a dash: a figure that one of two runs lacks, a rate without results.
const thin = "\u202f";

export function fixed(value, places) {
  if (!Number.isFinite(value)) return "–";
  const [whole, part] = Math.abs(value).toFixed(places).split(".");
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, thin) : whole;
  const sign = value < 0 && Number(value.toFixed(places)) !== 0 ? "\u2212" : "";
  return sign + grouped + (part ? "." + part : "");
}

/** With so many places; with two more if fewer than two digits were left of it, as on the console. */
export const error = (value, places) => fixed(value, value > 0 && value * 10 ** places < 10 ? places + 2 : places);

/** About `digits` significant digits. */
export function significant(value, digits = 3) {
  if (!Number.isFinite(value)) return fixed(value, 0);
  if (value === 0) return "0";
  const places = Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value))));
  return fixed(value, Math.min(places, 9));
}

/** The same, but whole numbers stay whole. */
export const tidy = (value, digits = 4) => (Number.isInteger(value) ? fixed(value, 0) : significant(value, digits));

export function signed(value, places) {
  return (value > 0 ? "+" : "") + fixed(value, places);
}

/** A time given in µs, in the unit that suits it. */
export function time(us) {
  if (!Number.isFinite(us)) return "–";
  const size = Math.abs(us);
  if (size >= 1e6) return significant(us / 1e6, 4) + " s";
  if (size >= 1e3) return significant(us / 1e3, 4) + " ms";
  if (size >= 1 || size === 0) return significant(us, 4) + " µs";
  return significant(us * 1e3, 3) + " ns";
}

export const percent = (share, places = 1) => (Number.isFinite(share) ? fixed(100 * share, places) + " %" : "–");

export const counted = (count, what) => `${fixed(count, 0)} ${what}${count === 1 ? "" : "s"}`;

/** "feature_extraction" → "feature extraction". */
export const words = (name) => String(name).replaceAll("_", " ");

/** The same at the head of a row. */
export const heading = (name) => words(name).replace(/^./, (first) => first.toUpperCase());

export function mean(values) {
  return values.length === 0 ? NaN : values.reduce((sum, value) => sum + value, 0) / values.length;
}

/** `values` in ascending order. */
export function quantile(values, share) {
  if (values.length === 0) return NaN;
  const place = (values.length - 1) * share;
  const low = Math.floor(place);
  const high = Math.min(low + 1, values.length - 1);
  return values[low] + (values[high] - values[low]) * (place - low);
}

/** Words that a shell must not read otherwise, in quotes. */
export function shellWord(word) {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

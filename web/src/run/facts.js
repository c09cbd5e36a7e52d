// A run as the sections of its page need it: result.json, and what stands only in the page.
import { mean, quantile } from "../kit/format.js";

export function makeRun(result, extras = {}) {
  const frames = result.frames ?? [];
  const latencies = frames.map((frame) => frame.time_us?.frame).filter(Number.isFinite).sort((a, b) => a - b);
  const errors = frames.flatMap((frame) => frame.markers.map((marker) => marker.error).filter(Boolean));
  const stages = [];
  for (const frame of frames) {
    for (const name of Object.keys(frame.time_us ?? {})) if (!stages.includes(name)) stages.push(name);
  }
  const configured = (path) => parseFloat(result.configuration?.[path]?.replaceAll(/[\s_]/g, " ") ?? "NaN");
  const megahertz = (path) => {
    const text = result.configuration?.[path];
    if (!text) return undefined;
    const scale = { Hz: 1e-6, kHz: 1e-3, MHz: 1, GHz: 1e3 }[text.split(" ")[1]];
    return scale ? parseFloat(text) * scale : undefined;
  };
  return {
    result, extras, frames, stages, errors, configured, megahertz,
    summary: result.summary ?? {},
    hybrid: result.system !== "ps-only",
    latency: latencies.length ? {
      low: latencies[0], median: quantile(latencies, 0.5), p95: quantile(latencies, 0.95), high: latencies.at(-1),
      mean: mean(latencies),
    } : null,
    error: errors.length ? {
      corner: mean(errors.map((e) => e.corner_px)),
      translation: mean(errors.map((e) => e.translation_mm).filter(Number.isFinite)),
      rotation: mean(errors.map((e) => e.rotation_deg).filter(Number.isFinite)),
      count: errors.length,
    } : null,
    stageMean: (name) => mean(frames.map((frame) => frame.time_us?.[name]).filter(Number.isFinite)),
  };
}

/** Power of each module over all its entries, most first: [{name, w}]. */
export function powerByModule(power) {
  const sums = new Map();
  for (const entry of power?.modules ?? []) if (entry.w > 0) sums.set(entry.name, (sums.get(entry.name) ?? 0) + entry.w);
  return [...sums].map(([name, w]) => ({ name, w })).sort((a, b) => b.w - a.w);
}

/** Names of stages that follow one another within a frame. */
export const partsOf = (run) => run.stages.filter((name) => name !== "frame" && name !== "upload");

// A run as the sections of its page need it: result.json, and what is only in the page.
import { application } from "../application.js";
import { fixed, heading, mean, quantile } from "../kit/format.js";

/** Of the table of figures: {title, unit, factor} of a path, in words for this unit of work. */
function figureIn(figures, path, unit) {
  const pattern = (text) => new RegExp(`^${text.replace(/[.]/g, "\\.").replace("*", ".+")}$`);
  const found = figures.find((figure) => figure.path === path) ?? figures.find((figure) => figure.path.includes("*") && pattern(figure.path).test(path));
  const name = heading(path.split(".").at(-1));
  const of = (text) => text.replaceAll("Frame", heading(unit)).replaceAll("frame", unit);
  return { title: of(found?.title || name).replace("*", name), unit: of(found?.people_unit ?? found?.unit ?? ""), factor: found?.factor ?? 1 };
}

/** What one part of the page points at and others show, a moment {ps, frame} or {signals} of a name: listeners get it, and who points at it. */
function sharedMoment() {
  const listeners = new Set();
  return {
    listen: (listener) => listeners.add(listener),
    pointAt: (moment, from) => listeners.forEach((listener) => listener(moment, from)),
  };
}

export function makeRun(result, extras = {}, figures = []) {
  const frames = result.frames ?? [];
  const delivered = frames.filter((frame) => !frame.gave_up);
  const whole = result.unit ?? "frame"; // the stage that a result's latency is
  const latencies = delivered.map((frame) => frame.time_us?.[whole]).filter(Number.isFinite).sort((a, b) => a - b);
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
  const run = {
    result, extras, frames, delivered, stages, configured, megahertz,
    moment: sharedMoment(),
    /** What a unit of work is called. */
    unit: whole,
    /** How people see a figure: {title, unit, factor}. */
    figure: (path) => figureIn(figures, path, whole),
    summary: result.summary ?? {},
    latency: latencies.length ? {
      low: latencies[0], median: quantile(latencies, 0.5), p95: quantile(latencies, 0.95), high: latencies.at(-1),
      mean: mean(latencies),
    } : null,
    /** What is known of a stage beside its times: {name, part_of, clock, why}. */
    stage: (name) => (result.stages ?? []).find((stage) => stage.name === name) ?? { name },
    stageMean: (name) => mean(delivered.map((frame) => frame.time_us?.[name]).filter(Number.isFinite)),
  };
  application.complete(run);
  return run;
}

/** Names of the figures that a design finds of its units. */
export const figuresOf = (frames) => [...new Set(frames.flatMap((frame) => Object.keys(frame.figures ?? {})))];

/** Power of each module over all its entries, most first: [{name, w}]. */
export function powerByModule(power) {
  const sums = new Map();
  for (const entry of power?.modules ?? []) if (entry.w > 0) sums.set(entry.name, (sums.get(entry.name) ?? 0) + entry.w);
  return [...sums].map(([name, w]) => ({ name, w })).sort((a, b) => b.w - a.w);
}

/** Names of stages that follow one another within a frame: parts of another stage that have no parts of their own. */
export function partsOf(run) {
  const stages = run.result.stages ?? [];
  const wholes = new Set(stages.map((stage) => stage.part_of));
  return stages.filter((stage) => stage.part_of && !wholes.has(stage.name)).map((stage) => stage.name);
}

/** Warnings of all frames, those that differ in their number only as one: [{text, frames}]. */
export function warningsOf(run) {
  const found = new Map();
  for (const frame of run.frames) {
    for (const warning of frame.warnings ?? []) {
      if (frame.gave_up && warning.endsWith(frame.gave_up)) continue; // told as what it is
      const [, number, rest] = warning.match(/^(\d+ )?(.*)$/s);
      const known = found.get(rest) ?? { rest, sum: 0, numbered: number !== undefined, frames: [] };
      found.set(rest, { ...known, sum: known.sum + Number(number ?? 0), frames: [...known.frames, frame] });
    }
  }
  return [...found.values()].map(({ rest, sum, numbered, frames }) => ({ text: numbered ? `${fixed(sum, 0)} ${rest}` : rest, frames }));
}

/** Counts that are not 0 in every frame, by name. */
export function countsOf(frames) {
  const names = new Set(frames.flatMap((frame) => Object.keys(frame.counts ?? {})));
  return [...names].filter((name) => frames.some((frame) => frame.counts?.[name] > 0));
}

/** "met", "missed", or "unknown": clocked above what a module is known to reach, which may work or not. */
export const timingOf = (module) => (module.met ? "met" : module.frequency_mhz > module.fmax_high_mhz ? "missed" : "unknown");

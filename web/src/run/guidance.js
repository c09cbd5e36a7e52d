// What limits this design point, in sentences.
import { h } from "../kit/dom.js";
import { counted, fixed, percent, significant, tidy, words } from "../kit/format.js";
import { value } from "../published.js";
import { losses, partsOf, powerByModule, timingOf } from "./facts.js";

const plain = (name) => words(name.replace(/^(pl|ps)\./, "")).replace(/\b(cpu|ddr|dma|ocm|axi|gpio|pl|ps|bram)\b/g, (word) => word.toUpperCase());
const pixelClock = "ps.fclk_clk1.frequency";

function limitingModule(run) {
  const modules = (run.result.timing?.modules ?? []).filter((m) => m.fmax_mhz > 0);
  const worst = (list) => list.reduce((a, b) => (b.margin_percent < a.margin_percent ? b : a));
  const missed = modules.filter((m) => timingOf(m) === "missed");
  if (missed.length > 0) return worst(missed);
  const unknown = modules.filter((m) => !m.met);
  if (unknown.length > 0) return worst(unknown);
  // The first to fail as the clocks rise.
  const most = (m) => m.fmax_high_mhz / m.frequency_mhz;
  if (modules.length > 0) return modules.reduce((a, b) => (most(b) < most(a) ? b : a));
  const clock = run.megahertz(pixelClock);
  const fmax = value("fmax.blob");
  if (!run.hybrid || !clock || !fmax) return null;
  return { name: "blob_detection", clock: "pixel", frequency_mhz: clock, fmax_mhz: fmax, met: clock <= fmax, published: true };
}

function timing(run, say) {
  const module = limitingModule(run);
  if (!module) return;
  const fmax = tidy(module.fmax_mhz);
  const now = tidy(module.frequency_mhz);
  if (timingOf(module) === "unknown") {
    say("bad", `${plain(module.name)} is known to work up to ${fmax} MHz, and its clock is ${now} MHz: nobody knows whether timing is met.`);
    return;
  }
  if (!module.met) {
    say("bad", `${plain(module.name)} misses timing: its Fmax is ${fmax} MHz, its clock ${now} MHz${module.reachable_mhz ? `; the next below that the PLLs make is ${tidy(module.reachable_mhz)} MHz` : ""}. What this page says holds for the model, not for a chip.`);
    return;
  }
  // Only a clock that the chip can have is worth a try.
  const next = module.reachable_mhz ?? module.fmax_mhz;
  const stream = run.stageMean("feature_extraction");
  const frame = run.stageMean("frame");
  const gain = stream * (1 - module.frequency_mhz / next);
  const more = Number.isFinite(gain) && run.hybrid && gain > 0
    ? ` At ${tidy(next)} MHz${next < module.fmax_mhz ? ", the next clock that the PLLs make," : ""} a frame would take about ${significant((frame - gain) / 1e3, 3)} ms: ${fixed(1e6 / (frame - gain), 0)} frames/s (derived).` : "";
  say("info", `${plain(module.name)}'s Fmax of ${fmax} MHz limits the pixel clock, now ${now} MHz.${more}`);
}

function stages(run, say) {
  const whole = run.stageMean("frame");
  const longest = partsOf(run).map((name) => ({ name, us: run.stageMean(name) })).sort((a, b) => b.us - a.us);
  if (!(whole > 0) || longest.length === 0) return;
  const [first, second] = longest;
  const why = first.name === "feature_extraction" && run.hybrid && run.megahertz(pixelClock)
    ? `: one pixel a clock at ${tidy(run.megahertz(pixelClock))} MHz, so it lasts as long as the image does` : "";
  say("info", `${words(first.name)} takes ${percent(first.us / whole, 0)} of a frame${why}.`);
  if (second && second.us / whole > 0.1) {
    const tried = run.frames.reduce((sum, f) => sum + (f.counts?.candidates ?? 0), 0) / Math.max(1, run.frames.length);
    const reason = second.name === "identification" ? `: ${fixed(tried, 1)} candidates a frame are tried one after the other until one is a marker` : "";
    say("info", `${words(second.name)} comes second with ${percent(second.us / whole, 0)}${reason}.`);
  }
}

function overflows(run, say) {
  for (const [key, text] of Object.entries(losses)) {
    const frames = run.frames.filter((frame) => frame.counts?.[key] > 0);
    const total = frames.reduce((sum, frame) => sum + frame.counts[key], 0);
    if (total > 0) say("bad", `${fixed(total, 0)} ${text} (${counted(frames.length, "frame")}, first ${frames[0].input}).`);
  }
}

function results(run, say) {
  const without = run.frames.filter((frame) => frame.gave_up);
  if (without.length > 0) say("bad", `The software gave up ${counted(without.length, "frame")}, first ${without[0].input}: ${without[0].gave_up}. Rates, latency and energy are those of delivered results.`);
}

function markers(run, say) {
  const without = run.delivered.filter((frame) => frame.markers.length === 0);
  if (without.length > 0) say("bad", `No marker in ${counted(without.length, "frame")}, first ${without[0].input}.`);
}

function budgets(run, say) {
  const { resources, power } = run.result;
  for (const kind of resources?.over ?? []) {
    const name = typeof kind === "string" ? kind : kind.name;
    say("bad", `The design needs more ${name.toUpperCase()} than ${resources.device} has: ${significant(resources.total[name], 4)} of ${significant(resources.available[name], 4)}.`);
  }
  const modules = powerByModule(power);
  const total = run.summary.power_w?.total;
  if (modules.length > 0 && total > 0) say("info", `${plain(modules[0].name)} draws most: ${significant(modules[0].w, 3)} of ${significant(total, 3)} W.`);
}

export function guidanceOf(run) {
  const list = [];
  const say = (kind, text) => list.push({ kind, text: text[0].toUpperCase() + text.slice(1) });
  results(run, say);
  markers(run, say);
  overflows(run, say);
  timing(run, say);
  stages(run, say);
  budgets(run, say);
  for (const warning of run.result.warnings ?? []) say("bad", warning);
  return list.sort((a, b) => (b.kind === "bad") - (a.kind === "bad"));
}

export function guidance(run) {
  const list = guidanceOf(run);
  if (list.length === 0) return null;
  return h("section", { id: "guidance", class: "guidance", "aria-labelledby": "guidance-title" },
    h("h2", { id: "guidance-title" }, "What limits it"),
    h("ul", {}, list.map(({ kind, text }) => h("li", { class: kind }, text))));
}

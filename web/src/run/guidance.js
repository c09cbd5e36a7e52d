// What limits this design point, in sentences.
import { application } from "../application.js";
import { h } from "../kit/dom.js";
import { counted, fixed, percent, significant, tidy, words } from "../kit/format.js";
import { partsOf, powerByModule, timingOf, warningsOf } from "./facts.js";

/** What a unit is known by. */
const nameOf = (unit) => unit.input ?? `number ${unit.index + 1}`;

const plain = (name) => words(name.replace(/^(pl|ps)\./, "")).replace(/\b(cpu|ddr|dma|ocm|axi|gpio|pl|ps|bram)\b/g, (word) => word.toUpperCase());

/** The module that the verdict names. */
const limitingModule = ({ result }) => result.timing?.modules.find((m) => m.name === result.verdict?.timing.by);

function timing(run, say) {
  const module = limitingModule(run);
  if (!module) return;
  const fmax = tidy(module.fmax_mhz);
  const now = tidy(module.frequency_mhz);
  if (timingOf(module) === "unknown") {
    if (module.fmax_mhz === undefined) return say("bad", `Whether ${plain(module.name)} meets timing is not known: there are no figures of its RTL.`);
    say("bad", `${plain(module.name)} is known to work up to ${fmax} MHz, and its clock is ${now} MHz: whether timing is met is not known.`);
    return;
  }
  if (!module.met) {
    say("bad", `${plain(module.name)} misses timing: its Fmax is ${fmax} MHz, its clock ${now} MHz${module.reachable_mhz ? `; the next below that the PLLs make is ${tidy(module.reachable_mhz)} MHz` : ""}. What this page says holds for the model, not for a chip.`);
    return;
  }
  // Only a clock that the chip can have is worth a try.
  const next = module.reachable_mhz ?? module.fmax_mhz;
  // Where later stages set the frame rate, the result is not there earlier for a shorter stage before them.
  const { kind, stages = [] } = run.result.limit ?? {};
  const paced = run.stages.filter((name) => run.stage(name).clock === module.clock && (kind !== "behind" || stages.includes(name)));
  const gain = paced.reduce((sum, name) => sum + run.stageMean(name), 0) * (1 - module.frequency_mhz / next);
  const frame = run.stageMean(run.unit);
  // Where frames overlap, the time of one says nothing of the rate.
  const rate = kind === "sequence" ? `: ${fixed(1e6 / (frame - gain), 0)} ${run.unit}s/s` : "";
  const more = gain > 0
    ? ` At ${tidy(next)} MHz${next < module.fmax_mhz ? ", the next clock that the PLLs make," : ""} a ${run.unit} would take about ${significant((frame - gain) / 1e3, 3)} ms${rate} (derived).` : "";
  say("info", `${plain(module.name)}'s Fmax of ${fmax} MHz limits its clock, now ${now} MHz.${more}`);
}

/** What sets the rate, in the words of the console, and with which lever it rises. */
function limit(run, say) {
  const found = run.result.limit;
  if (!found) return;
  const megahertz = found.clock && run.megahertz(`${found.clock}.frequency`);
  const now = megahertz ? `, now ${tidy(megahertz)} MHz` : "";
  say("info", `${found.text}.${found.faster_with ? ` Faster with ${found.faster_with}${now}.` : ""}`);
}

/** Where a result's latency comes from. What only waits is the cause of nothing. */
function stages(run, say) {
  const whole = run.stageMean(run.unit);
  const working = run.result.limit?.percent;
  const longest = partsOf(run).filter((name) => !working || name in working).map((name) => ({ name, us: run.stageMean(name) })).sort((a, b) => b.us - a.us);
  if (!(whole > 0) || longest.length === 0) return;
  const because = ({ name }) => {
    const { why, clock } = run.stage(name);
    const megahertz = clock && run.megahertz(`${clock}.frequency`);
    return why ? `: ${why}${megahertz ? `, at ${tidy(megahertz)} MHz` : ""}` : "";
  };
  const [first, second] = longest;
  say("info", `Of the time from a ${run.unit} to its result, ${words(first.name)} takes ${percent(first.us / whole, 0)}${because(first)}.`);
  if (second && second.us / whole > 0.1) say("info", `${words(second.name)} comes second with ${percent(second.us / whole, 0)}${because(second)}.`);
}

function losses(run, say) {
  for (const { text, frames } of warningsOf(run)) say("bad", `${text} (${counted(frames.length, run.unit)}, first ${nameOf(frames[0])}).`);
}

function results(run, say) {
  const without = run.frames.filter((frame) => frame.gave_up);
  if (without.length > 0) say("bad", `The software gave up ${counted(without.length, run.unit)}, first ${nameOf(without[0])}: ${without[0].gave_up}. Rates, latency and energy are those of delivered results.`);
}

function budgets(run, say) {
  const { resources, power } = run.result;
  for (const kind of resources?.over ?? []) {
    const name = typeof kind === "string" ? kind : kind.name;
    say("bad", `The design needs more ${name.toUpperCase()} than ${resources.device} has${resources.total ? `: ${significant(resources.total[name], 4)} of ${significant(resources.available[name], 4)}` : ""}.`);
  }
  const modules = powerByModule(power);
  const total = run.summary.power_w?.total;
  if (modules.length > 0 && total > 0) say("info", `${plain(modules[0].name)} draws most: ${significant(modules[0].w, 3)} of ${significant(total, 3)} W.`);
}

export function guidanceOf(run) {
  const list = [];
  const say = (kind, text) => list.push({ kind, text: text[0].toUpperCase() + text.slice(1) });
  results(run, say);
  application.guidance(run, say);
  losses(run, say);
  limit(run, say);
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

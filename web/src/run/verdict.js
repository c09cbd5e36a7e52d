// The answer before the details: figures with origin, band, and the thesis' value beside them.
import { application } from "../application.js";
import { h } from "../kit/dom.js";
import { counted, fixed, significant, tidy } from "../kit/format.js";
import { legend, origin } from "../kit/origin.js";

/** Whether units came fast enough: those of a fixed rate, if there is one; else real time. Undefined: nothing says. */
function keepsUp({ summary, result: { camera } }) {
  if (camera) return camera.dropped === 0;
  return application.realTime && summary.fps.mean >= application.realTime;
}
const tone = (good) => (good === undefined ? null : good ? "good" : "bad");

function tile({ label, number, unit, band, source, detail, thesis, tone }) {
  return h("div", { class: "tile" + (tone ? " " + tone : "") },
    h("dt", {}, label),
    h("dd", { class: "figure" }, h("span", { class: "value" }, number), unit && h("span", { class: "unit" }, " " + unit)),
    h("dd", { class: "band" }, band ?? "\u00a0"),
    h("dd", { class: "foot" }, origin(source, detail), thesis && h("span", { class: "thesis" }, thesis)));
}

function tiles(run) {
  const { summary, result } = run;
  const { camera } = result;
  const beside = application.beside(run);
  const { unit } = run;
  const list = [];
  const named = (path) => ({ label: run.figure(path).title, unit: run.figure(path).unit });
  if (summary.fps) {
    list.push(tile({
      ...named("summary.fps.mean"), number: fixed(summary.fps.mean, summary.fps.mean < 1e4 ? 1 : 0),
      band: camera
        ? `busy ${fixed(camera.utilisation_percent, 1)} % of ${significant(1e3 / camera.rate_fps, 3)} ms, slack at least ${significant(camera.slack_us.min / 1e3, 3)} ms`
        : run.delivered.length > 1 ? `${fixed(summary.fps.min, 1)} to ${fixed(summary.fps.max, 1)}` : "one result",
      source: "simulated", detail: `delivered results over simulated time, ${camera ? "waits for the next input included" : application.excluded}; times of software from the cost profile`,
      thesis: camera ? null : beside.fps,
      tone: tone(keepsUp(run)),
    }));
    list.push(tile({
      ...named("summary.latency_us.mean"), number: significant(summary.latency_us.mean * run.figure("summary.latency_us.mean").factor, 4),
      band: run.latency && run.delivered.length > 1
        ? `${significant(run.latency.low / 1e3, 4)} to ${significant(run.latency.high / 1e3, 4)}, 95 % within ${significant(run.latency.p95 / 1e3, 4)}`
        : `from the ${unit}'s start to its result`,
      source: "simulated", detail: `from the ${unit}'s start to its result`,
      thesis: beside.latency,
    }));
  }
  const power = summary.power_w;
  if (power) {
    const band = result.power?.total_w;
    list.push(tile({
      ...named("power.total_w.nominal"), number: significant(power.total, 3),
      band: band ? `${significant(band.low, 3)} to ${significant(band.high, 3)}` : null,
      source: "derived", detail: "activity of this run times energy per event; the modules' sources stand in the table of power",
      thesis: beside.power,
    }));
  }
  if (Number.isFinite(summary.energy_per_frame_mj)) {
    const band = result.power?.total_w;
    const scale = band ? summary.energy_per_frame_mj / band.nominal : NaN;
    list.push(tile({
      ...named("summary.energy_per_frame_mj"), number: significant(summary.energy_per_frame_mj, 3),
      band: band ? `${significant(band.low * scale, 3)} to ${significant(band.high * scale, 3)}` : null, source: "derived",
    }));
  }
  if (Number.isFinite(result.power?.junction_c)) {
    list.push(tile({
      ...named("power.junction_c"), number: fixed(result.power.junction_c, 1),
      band: Number.isFinite(result.power.ambient_c) ? `at ${fixed(result.power.ambient_c, 0)} °C around it` : null,
      source: "derived", tone: result.power.junction_c > 85 ? "bad" : null,
    }));
  }
  return [...list, ...application.tiles(run).map(tile)];
}

function chips(run) {
  const { summary, result } = run;
  const chip = (good, text) => h("li", { class: good ? "good" : "bad" }, h("span", { "aria-hidden": "true" }, good ? "✓" : "✕"), " ", text);
  const list = [];
  const said = { ran: "Ran to its end", job: "Did its job", fits: `Fits ${result.resources?.device ?? "the device"}`, clocks: "Clocks can be made", timing: "Meets timing" };
  for (const [name, text] of Object.entries(said)) {
    const part = result.verdict?.[name];
    const nothing = part?.holds === "yes" && ["fits", "timing"].includes(name) && !Number.isFinite(part.margin_percent); // no PL
    if (part && !nothing) list.push(chip(part.holds === "yes", part.holds === "yes" ? text : part.why[0].toUpperCase() + part.why.slice(1)));
  }
  for (const [good, text] of application.chips(run)) list.push(chip(good, text));
  const { camera } = result;
  if (camera) list.push(chip(keepsUp(run), `${keepsUp(run) ? "Keeps up with" : `Drops ${camera.dropped} of ${counted(camera.offered, run.unit)} at`} ${tidy(camera.rate_fps)} ${run.unit}s/s`));
  else if (summary.fps && application.realTime) list.push(chip(keepsUp(run), `${keepsUp(run) ? "Reaches" : "Misses"} ${application.realTime} ${run.unit}s/s`));
  return list;
}

export function verdict(run) {
  const figures = tiles(run);
  return h("section", { id: "verdict", "aria-label": "Verdict" },
    h("ul", { class: "chips" }, chips(run)),
    figures.length > 0 && h("dl", { class: "tiles" }, figures.map((each) => each)),
    figures.length > 0 && legend());
}

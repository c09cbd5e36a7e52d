// The answer before the details: figures with origin, band, and the thesis' value beside them.
import { h } from "../kit/dom.js";
import { counted, error, fixed, signed, significant, tidy } from "../kit/format.js";
import { legend, origin } from "../kit/origin.js";
import { value } from "../published.js";
import { thesisOf } from "./thesis.js";

const realTime = 60; // frames per second: what the thesis calls so
/** Whether the frames came fast enough: those of the camera, if it has a rate; else real time. */
const keepsUp = ({ summary, result: { camera } }) => (camera ? camera.dropped === 0 : summary.fps.mean >= realTime);

function tile({ label, number, unit, band, source, detail, thesis, tone }) {
  return h("div", { class: "tile" + (tone ? " " + tone : "") },
    h("dt", {}, label),
    h("dd", { class: "figure" }, h("span", { class: "value" }, number), unit && h("span", { class: "unit" }, " " + unit)),
    h("dd", { class: "band" }, band ?? "\u00a0"),
    h("dd", { class: "foot" }, origin(source, detail), thesis && h("span", { class: "thesis" }, thesis)));
}

function beside(ours, theirs) {
  if (!Number.isFinite(theirs) || !Number.isFinite(ours)) return null;
  return `thesis ${significant(theirs, 3)} (${signed(100 * (ours / theirs - 1), 0)} %)`;
}

function tiles(run) {
  const { summary, result } = run;
  const { camera } = result;
  const thesis = thesisOf(run);
  const list = [];
  if (summary.fps) {
    list.push(tile({
      label: "Frame rate", number: fixed(summary.fps.mean, 1), unit: "frames/s",
      band: camera
        ? `busy ${fixed(camera.utilisation_percent, 1)} % of ${significant(1e3 / camera.rate_fps, 3)} ms, slack at least ${significant(camera.slack_us.min / 1e3, 3)} ms`
        : run.delivered.length > 1 ? `${fixed(summary.fps.min, 1)} to ${fixed(summary.fps.max, 1)}` : "one result",
      source: "simulated", detail: `delivered results over simulated time, ${camera ? "waits for the camera included" : "image upload excluded as in the thesis"}; times of software from the cost profile`,
      thesis: camera ? null : beside(summary.fps.mean, 1e6 / thesis?.frameUs),
      tone: keepsUp(run) ? "good" : "bad",
    }));
    list.push(tile({
      label: "Latency", number: significant(summary.latency_us.mean / 1e3, 4), unit: "ms",
      band: run.latency && run.delivered.length > 1
        ? `${significant(run.latency.low / 1e3, 4)} to ${significant(run.latency.high / 1e3, 4)}, 95 % within ${significant(run.latency.p95 / 1e3, 4)}`
        : "from the frame's start to its result",
      source: "simulated", detail: "from the frame's start to its result",
      thesis: beside(summary.latency_us.mean / 1e3, thesis?.frameUs / 1e3),
    }));
  }
  const power = summary.power_w;
  if (power) {
    const band = result.power?.total_w;
    list.push(tile({
      label: "Power", number: significant(power.total, 3), unit: "W",
      band: band ? `${significant(band.low, 3)} to ${significant(band.high, 3)}` : null,
      source: "derived", detail: "activity of this run times energy per event; the modules' sources stand in the table of power",
      thesis: thesis && Number.isFinite(power.ps) ? `PS: thesis ${fixed(value("power.cpu"), 1)}, here ${significant(power.ps, 3)}` : null,
    }));
  }
  if (Number.isFinite(summary.energy_per_frame_mj)) {
    const band = result.power?.total_w;
    const scale = band ? summary.energy_per_frame_mj / band.nominal : NaN;
    list.push(tile({
      label: "Energy per frame", number: significant(summary.energy_per_frame_mj, 3), unit: "mJ",
      band: band ? `${significant(band.low * scale, 3)} to ${significant(band.high * scale, 3)}` : null, source: "derived",
    }));
  }
  if (Number.isFinite(result.power?.junction_c)) {
    list.push(tile({
      label: "Junction", number: fixed(result.power.junction_c, 1), unit: "°C",
      band: Number.isFinite(result.power.ambient_c) ? `at ${fixed(result.power.ambient_c, 0)} °C around it` : null,
      source: "derived", tone: result.power.junction_c > 85 ? "bad" : null,
    }));
  }
  if (run.error) {
    list.push(tile({
      label: "Error of the pose", number: error(run.error.translation, 1), unit: "mm",
      band: `${error(run.error.rotation, 2)}°, corners ${error(run.error.corner, 2)} px`,
      source: "simulated", detail: `mean over ${counted(run.error.count, "marker")} whose truth is known`,
      thesis: thesis && `thesis ${value("pose.all.translation")} mm, ${value("pose.all.rotation")}°`,
    }));
  }
  return list;
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
  if (summary.frames) list.push(chip(summary.detected === summary.frames, `Marker found in ${summary.detected} of ${counted(summary.frames, "frame")}`));
  const { camera } = result;
  if (camera) list.push(chip(keepsUp(run), `${keepsUp(run) ? "Keeps up with" : `Drops ${camera.dropped} of ${camera.offered} frames at`} ${tidy(camera.rate_fps)} frames/s`));
  else if (summary.fps) list.push(chip(keepsUp(run), `${keepsUp(run) ? "Reaches" : "Misses"} ${realTime} frames/s`));
  return list;
}

export function verdict(run) {
  const figures = tiles(run);
  return h("section", { id: "verdict", "aria-label": "Verdict" },
    h("ul", { class: "chips" }, chips(run)),
    figures.length > 0 && h("dl", { class: "tiles" }, figures.map((each) => each)),
    figures.length > 0 && legend());
}

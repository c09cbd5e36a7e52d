// What the marker application adds to the pages: its frames, its errors, the thesis beside them.
import { application } from "../application.js";
import { counted, error, fixed, mean, signed, significant } from "../kit/format.js";
import { detectorsPage } from "./detectors.js";
import { energyChart } from "./energy.js";
import { frameView } from "./frame_view.js";
import { value } from "./published.js";
import { systems, thesisOf } from "./thesis.js";
import { validationPage } from "./validation.js";

const markers = (frame) => frame.markers ?? [];

function meanErrors(frames) {
  const errors = frames.flatMap((frame) => markers(frame).map((marker) => marker.error).filter(Boolean));
  const of = (key) => mean(errors.map((e) => e[key]).filter(Number.isFinite));
  return errors.length ? { corner: of("corner_px"), translation: of("translation_mm"), rotation: of("rotation_deg"), count: errors.length } : null;
}

function beside(ours, theirs) {
  if (!Number.isFinite(theirs) || !Number.isFinite(ours)) return null;
  return `thesis ${significant(theirs, 3)} (${signed(100 * (ours / theirs - 1), 0)} %)`;
}

const stageNote = "Thesis: mean of the 15 images with one to fifteen squares (5.4.1), derived from its published differences; it gives no time for evaluation and reading features.";

Object.assign(application, {
  mark: "M0 0h6v6h-6zM1 1v1h1v-1zM3 1v1h2v-1zM2 2v2h1v-1h1v-1zM1 3v2h1v-2zM4 4v1h1v-1z", // a marker of 6 x 6 cells
  pages: { validation: (data, block) => validationPage(data, block("frames")), detectors: detectorsPage },
  complete(run) { run.error = meanErrors(run.frames); },
  realTime: 60, // frames a second: what the thesis calls so
  excluded: "image upload excluded as in the thesis",
  beside({ summary, ...run }) {
    const thesis = thesisOf(run);
    return {
      fps: beside(summary.fps?.mean, 1e6 / thesis?.frameUs),
      latency: beside(summary.latency_us?.mean / 1e3, thesis?.frameUs / 1e3),
      power: thesis && Number.isFinite(summary.power_w?.ps) ? `PS: thesis ${fixed(value("power.cpu"), 1)}, here ${significant(summary.power_w.ps, 3)}` : null,
    };
  },
  tiles(run) {
    if (!run.error) return [];
    return [{
      label: "Error of the pose", number: error(run.error.translation, 1), unit: "mm",
      band: `${error(run.error.rotation, 2)}°, corners ${error(run.error.corner, 2)} px`,
      source: "simulated", detail: `mean over ${counted(run.error.count, "marker")} whose truth is known`,
      thesis: thesisOf(run) && `thesis ${value("pose.all.translation")} mm, ${value("pose.all.rotation")}°`,
    }];
  },
  chips({ summary }) {
    const { detected, frames } = summary;
    return frames && detected !== undefined ? [[detected === frames, `Marker found in ${detected} of ${counted(frames, "frame")}`]] : [];
  },
  guidance(run, say) {
    const without = run.delivered.filter((frame) => frame.markers?.length === 0);
    if (without.length > 0) say("bad", `No marker in ${counted(without.length, "frame")}, first ${without[0].input}.`);
  },
  sections: (run) => [frameView(run)],
  columns(number, run) {
    const of = (key) => (frame) => markers(frame)[0]?.error?.[key];
    return {
      front: [{ title: "Marker", value: (f) => f.markers?.map((m) => m.id).join(", ") || (f.gave_up ? "no result" : f.markers && "none") }],
      back: [["corner_px", 2], ["translation_mm", 1], ["rotation_deg", 2]]
        .map(([key, places]) => number("Error", run.figure(`frames.error.${key}`).unit, of(key), places, (v) => error(v, places))),
    };
  },
  stages(run) {
    const rows = (thesisOf(run) ? systems : []).map(({ title, stages }) => ({ name: title, stages }));
    return { rows, note: rows.length === 0 ? undefined : stageNote };
  },
  energy: energyChart,
});

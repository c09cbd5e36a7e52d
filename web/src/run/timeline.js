// Where the time of a frame goes: stages beside the thesis', and everything that happened on one time axis.
import { h } from "../kit/dom.js";
import { gantt } from "./gantt.js";
import { stageBars, stagesOf } from "./stages.js";
import { systems, thesisOf } from "./thesis.js";

function stageChart(run) {
  if (run.delivered.length === 0) return null;
  const thesis = (thesisOf(run) ? systems : []).map(({ title, stages }) => ({ name: title, stages }));
  return stageBars([{ name: "This run", stages: stagesOf(run) }, ...thesis],
    thesis.length === 0 ? undefined : "Thesis: mean of the 15 images with one to fifteen squares (5.4.1), derived from its published differences; it gives no time for evaluation and reading features.");
}

export function timing(run) {
  if (run.frames.length === 0) return null;
  return h("section", { id: "time", "aria-labelledby": "time-title" }, h("h2", { id: "time-title" }, "Time"),
    h("div", { class: "stack" }, gantt(run), stageChart(run)));
}

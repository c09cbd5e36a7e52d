// Where the time of a unit goes: stages, and everything that happened on one time axis.
import { application } from "../application.js";
import { h } from "../kit/dom.js";
import { gantt } from "./gantt.js";
import { stageBars, stagesOf } from "./stages.js";

function stageChart(run) {
  if (run.delivered.length === 0) return null;
  const { rows, note } = application.stages(run);
  const own = stagesOf(run);
  return own.length + rows.length > 0 ? stageBars([{ name: "This run", stages: own }, ...rows], run.unit, note) : null;
}

export function timing(run) {
  if (run.frames.length === 0) return null;
  return h("section", { id: "time", "aria-labelledby": "time-title" }, h("h2", { id: "time-title" }, "Time"),
    h("div", { class: "stack" }, gantt(run), stageChart(run)));
}

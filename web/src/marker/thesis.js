// What the thesis states of its systems, to stand beside runs of the same PS program.
import text from "../../../data/thesis_systems.csv";
import { parse } from "./published.js";

/** [{system, title, logic, frameUs, stages: [{name, us}]}]; `logic`: it uses the PL. */
export const systems = [];
for (const row of parse(text)) {
  let system = systems.find((each) => each.system === row.system);
  if (!system) systems.push(system = { system: row.system, title: row.title, logic: row.logic === "yes", stages: [] });
  if (row.stage === "frame") system.frameUs = Number(row.us);
  else system.stages.push({ name: row.stage, us: Number(row.us) });
}

/** The system that a run models; undefined for one that the thesis does not know. */
export const thesisOf = (run) => systems.find((each) => each.system === run.result.system);

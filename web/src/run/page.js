// The page of a run.
import { application } from "../application.js";
import { counted } from "../kit/format.js";
import { makeRun } from "./facts.js";
import { diagram } from "./diagram.js";
import { guidance } from "./guidance.js";
import { handshakes } from "./handshakes.js";
import { power } from "./power.js";
import { profile } from "./profile.js";
import { resources } from "./resources.js";
import { overTime } from "./over_time.js";
import { configuration, frameTable, provenance } from "./tables.js";
import { timing } from "./timeline.js";
import { verdict } from "./verdict.js";
import { waves } from "./waves.js";

function title(run) {
  const names = [...new Set(run.frames.map((frame) => frame.input).filter(Boolean))];
  if (names.length === 0) return run.frames.length ? run.result.design : `A run without ${run.unit}s`;
  return names.length <= 3 ? names.join(", ") : `${names[0]} to ${names.at(-1)}`;
}

function subtitle(run) {
  const { system, design, fidelity, profile } = run.result;
  return [run.summary.frames !== undefined && counted(run.summary.frames, run.unit), system && `program ${system}`, design && `design ${design}`, fidelity === "clocked" ? "clock by clock" : "transaction level", profile && `cost profile ${profile}`].filter(Boolean).join("  ·  ");
}

export function runPage(result, extras, figures) {
  const run = makeRun(result, extras, figures);
  run.overTime = () => overTime(run);
  return {
    title: title(run), subtitle: subtitle(run),
    sections: [verdict(run), guidance(run), ...application.sections(run), timing(run), diagram(run), waves(run), profile(run), handshakes(run), power(run), resources(run), frameTable(run), configuration(run), provenance(run)],
  };
}

// The thesis' stage times, from its published differences.
import { value } from "../published.js";

const us = (id, scale) => (value(id) ?? NaN) * scale;

/** Stages of a frame in the thesis (5.4.1, mean of 15 images): [{name, us}]. */
export function thesisStages(system) {
  const list = system === "hybrid"
    ? [["feature_extraction", us("corner.hybrid", 1)], ["identification", us("identification.hybrid", 1e3)]]
    : [["capture", us("capture.offset", 1)],
      ["corner_detection", us("corner.hybrid", 1) + us("corner.delta", 1e3)],
      ["threshold", us("threshold.ps", 1e3)],
      ["blob_detection", us("blob.hybrid", 1) + us("blob.delta", 1e3)],
      ["identification", us("identification.hybrid", 1e3) * us("identification.speedup", 1)]];
  return [...list, ["pose", us("pose.duration", 1)]].filter(([, time]) => Number.isFinite(time)).map(([name, time]) => ({ name, us: time }));
}

// Data like those that the program writes, made here so that every section of the page has something to show.
"use strict";

/** Some of the table of figures, as the program puts it into pages. */
const figures = [
  ["summary.fps.mean", "Frame rate", "1/s", 1, { people_unit: "frames/s", factor: 1 }], ["summary.latency_us.mean", "Latency", "µs", -1, { people_unit: "ms", factor: 1e-3 }],
  ["power.total_w.nominal", "Power", "W", -1], ["summary.energy_per_frame_mj", "Energy per frame", "mJ", -1], ["power.junction_c", "Junction", "°C", -1],
  ["summary.detected", "Frames with a marker", "", 1], ["summary.frames", "Frames", "", 1], ["resources.total.lut", "LUT", "", -1], ["resources.total.ff", "Flip-flops", "", -1],
  ["resources.total.bram36", "BRAM 36 Kb", "", -1], ["resources.total.dsp", "DSP", "", -1], ["frames.error.corner_px", "Corner error", "px", -1],
  ["frames.error.translation_mm", "Translation error", "mm", -1], ["frames.error.rotation_deg", "Rotation error", "°", -1],
].map(([path, title, unit, better, people = {}]) => ({ path, unit, better, title, meaning: "", ...people }));

/** A metric of a sweep, as people see it. */
function metric(path) {
  const { title, unit, better, people_unit, factor = 1 } = figures.find((figure) => figure.path === path.replace(/^(frames\..*)\.mean$/, "$1"));
  return { path, title, unit: people_unit ?? unit, factor, better };
}

/** Always the same numbers, 0 to 1. */
function randomFrom(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

// A grey picture of 8 x 8 px.
const png = "iVBORw0KGgoAAAANSUhEUgAAAAgAAAAICAAAAADhZOFXAAAAE0lEQVR4nGNoYGBgYGD4z8DAAAAHBgGAkFFZ4QAAAABJRU5ErkJggg==";
const marker = (random) => {
  const x = 300 + 40 * random();
  const y = 200 + 30 * random();
  const square = [[x, y], [x + 60, y + 2], [x + 58, y + 62], [x - 2, y + 60]];
  const pose = { rotation: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], translation_m: [0, 0, 2] };
  return { id: 7, rotation: 1, side_m: 0.3, corners_px: square, pose, reprojection_px: 0.4, iterations: 2,
    truth: { corners_px: square, pose }, error: { corner_px: 0.5 + random(), translation_mm: 20 + 20 * random(), rotation_deg: 3 * random() } };
};

function frameOf(index, random, input) {
  const identification = 800 + 3000 * random();
  const evaluation = 20 + 200 * random();
  return {
    input, index, threshold: 128,
    counts: { corners: 40, blobs: 6, feature_words: 53, candidates: 3, feature_overflow: index === 3 ? 12 : 0, label_overflow: 0, bridge_overflow: 0, crossing_overflow: 0, software_overflow: 0, malformed: 0 },
    markers: index === 5 ? [] : [marker(random)],
    time_us: { upload: 4801.2, feature_extraction: 6146.1, receive: 41.2, evaluation, identification, pose: 41.2, frame: 6146.1 + 41.2 + evaluation + identification + 41.2 },
    ...(index === 3 ? { warnings: ["12 features dropped: a buffer of pl.feature_packaging was full"] } : {}),
    energy_mj: { total: 16.5, ps: 11.7, feature_extraction: 3, data_bridge: 0.2, image_memory: 0.1, static: 1.5 },
  };
}

/** A campaign: of each class some faults, the worst of which are listed. */
function faults({ hostile = "" } = {}) {
  const outcomes = ["masked", "recovered", "reported", "unnoticed", "hang", "broken"];
  const counts = (...numbers) => ({ faults: numbers.reduce((a, b) => a + b, 0), ...Object.fromEntries(outcomes.map((name, i) => [name, numbers[i] ?? 0])), silent_hangs: numbers[4] ? 1 : 0, interval: Object.fromEntries(outcomes.map((name) => [name, [0.01, 0.2]])) });
  const shot = (number, outcome) => ({ number, class: "bus", module: "pl.axi_dma_0", at_us: 12.5 * number, times: 1, outcome, fault: `{what: slverr, where: pl.axi_dma_0.link, at: ${number} us}`, sign: hostile, again: "markervp run z1.0 --set 'inject=[…]'" });
  return { faults: { seed: 1, units: 3, end_us: 35760, design: "thesis", inputs: ["z1.0", "z2.0"], outcomes, all: counts(80, 10, 5, 3, 2), classes: { bus: counts(40, 10, 5, 0, 2), memory: counts(40, 0, 0, 3) },
    modules: { "pl.axi_dma_0": counts(40, 10, 5, 0, 2), "pl.bram": counts(40, 0, 0, 3) }, bits: { "00": counts(3, 1), "02": counts(3), 10: counts(2, 0, 0, 1) }, shots: [shot(9, "unnoticed"), shot(17, "hang"), shot(20, "recovered")] } };
}

/** What sets the frame rate: one stage after the other, of which this one takes the longest. */
function limitOf(stages, stage, text, more = {}) {
  return { kind: "sequence", stages: [stage], stages_us: 1, period_us: 2, percent: { ...Object.fromEntries(stages.map((name) => [name, name === stage ? 100 : 0])), camera: 0 },
    levers: [], text: `${text} sets the frame rate: 1.0 of 2.0 us, one stage follows the other`, faster_with: "", ...more };
}

/** The blocks of a run's page. `name`: of its first input. */
function run({ frames = 200, name = "z1.0", seed = 1, clock = "50 MHz", fits = true } = {}) {
  const random = randomFrom(seed);
  const list = Array.from({ length: frames }, (_, i) => frameOf(i, random, i === 0 ? name : `roll${i}`));
  const latency = list.map((f) => f.time_us.frame);
  const mean = latency.reduce((a, b) => a + b, 0) / frames;
  const result = {
    schema: 1,
    provenance: { program: "markervp", version: "0.1.0", configuration_hash: "0123456789abcdef", command_line: ["run", name], host: "here", date: "2026-01-02T03:04:05Z", wall_time_s: 1.5 },
    fidelity: "tlm", system: "hybrid", design: "thesis", profile: "thesis",
    configuration: { fidelity: "tlm", "pl.width": "640 px", "ps.fclk_clk1.frequency": clock, "ps.cpu_clk.frequency": "666.666667 MHz" },
    frames: list,
    stages: [{ name: "upload" }, { name: "feature_extraction", part_of: "frame", clock: "ps.fclk_clk1", why: "one pixel a clock" },
      ...["receive", "evaluation", "identification", "pose"].map((stage) => ({ name: stage, part_of: "frame" })), { name: "frame" }],
    limit: limitOf(["feature_extraction", "receive", "evaluation", "identification", "pose"], "feature_extraction", "feature extraction", { clock: "ps.fclk_clk1", why: "one pixel a clock", faster_with: "a higher ps.fclk_clk1.frequency" }),
    summary: { frames, delivered: frames, detected: frames - (frames > 5 ? 1 : 0), fps: { mean: 1e6 / mean, min: 1e6 / Math.max(...latency), max: 1e6 / Math.min(...latency) }, latency_us: { mean, max: Math.max(...latency) },
      power_w: { total: 2.27, ps: 1.53, pl: 0.59, static: 0.15 }, energy_per_frame_mj: 16.4 },
    verdict: { feasible: fits ? "yes" : "no", ran: { holds: "yes" }, job: { holds: "yes", margin_percent: 0 },
      fits: fits ? { holds: "yes", margin_percent: 42, by: "lut" } : { holds: "no", margin_percent: -5, by: "lut", why: "too big for an xc7z020 (lut)" }, clocks: { holds: "yes", margin_percent: 0.05, by: "ps.cpu_clk" },
      timing: fits ? { holds: "yes", margin_percent: 10, by: "pl.blob_detection" } : { holds: "no", margin_percent: -8.3, by: "pl.blob_detection", why: "timing missed by pl.blob_detection" } },
    timing: { met: fits, modules: [
      { name: "pl.corner_detection", clock: "ps.fclk_clk1", frequency_mhz: 50, fmax_mhz: 100, fmax_high_mhz: 236, origin: "published", met: true, margin_percent: 100, source: "published: runs comfortably at it (thesis 4.6.1)" },
      { name: "pl.blob_detection", clock: "ps.fclk_clk1", frequency_mhz: fits ? 50 : 60, fmax_mhz: 55, fmax_high_mhz: 55, origin: "published", met: fits, margin_percent: fits ? 10 : -8.3, source: "published: the slowest module (thesis 4.6.1)" }] },
    resources: { device: "xc7z020", total: { lut: 37456, ff: 18863, bram36: 82, dsp: 0 }, available: { lut: 53200, ff: 106400, bram36: 140, dsp: 220 }, fits, over: fits ? [] : ["lut"],
      modules: [{ name: "pl.corner_detection", lut: 6460, ff: 2569, bram36: 4, dsp: 0, uncertainty_percent: 40, source: "derived from the structure of thesis 4.3.4" },
        { name: "pl.blob_detection", lut: 24206, ff: 5279, bram36: 0.5, dsp: 0, uncertainty_percent: 50, source: "derived from the structure of thesis 4.3.6" }] },
    power: { mode: "vivado-default", table: "zynq7020", ambient_c: 25, junction_c: 51.2, total_w: { low: 2.03, nominal: 2.27, high: 2.61 }, rails: { VCCINT: 0.8, VCCPINT: 0.7 },
      modules: [{ name: "ps.cpu", rail: "VCCPINT", kind: "dynamic", w: 1.2, mj: 9, source: "published: thesis 4.6.3" }, { name: "pl.blob_detection", rail: "VCCINT", kind: "dynamic", w: 0.4, mj: 3, source: "published: thesis 4.6.1" },
        { name: "pl.corner_detection", rail: "VCCINT", kind: "dynamic", w: 0.1, mj: 0.8, source: "derived: from its size" }, { name: "pl.corner_detection", rail: "VCCBRAM", kind: "dynamic", w: 0.025, mj: 0.2, source: "derived: from its size" }, { name: "pl", rail: "VCCINT", kind: "static", w: 0.15, mj: 1.1, source: "assumed: typical" }] },
  };
  const view = { width: 640, height: 480, camera: { fx: 381.36, fy: 381.36, cx: 320, cy: 240 }, png,
    corners: Array.from({ length: 40 }, () => [Math.floor(640 * random()), Math.floor(480 * random()), Math.floor(4 * random())]), blobs: [[300, 200, 362, 262]], candidates: [[[300, 200], [360, 202], [358, 262], [298, 260]]] };
  return { result, figures, extras: { frames: Object.fromEntries(list.slice(0, 3).map((f) => [f.index, view])), timeline: timeline(list[0].time_us), profile: profile(),
    parameters: [["fidelity", "tlm", "decision", "how the logic is modelled"], ["pl.width", "640 px", "published", "width of a frame"], ["ps.fclk_clk1.frequency", "50 MHz", "published", "pixel clock"], ["ps.cpu_clk.frequency", "666.666667 MHz", "published", "clock of the cores"]] } };
}

function profile() {
  return {
    functions: [["program", 0, 2, 0, 0, 1.5, 0, 1000, 0.4], ["run()", 0, 4, 10, 0, 2, 900, 8000, 3.3], ["filter(int)", 1, 10, 400, 100, 0.5, 0, 333667, 138.5],
      ["filter(int)", 2, 5, 40, 10, 0, 0, 33333, 13.8], ["wait() const", 1, 3, 0, 0, 30, 0, 20000, 8.3], ["interrupt handlers", 0, 6, 0, 0, 12, 0, 8000, 3.3]],
    calls: { "run()": 1, "filter(int)": 15 }, named: [["filter", 15, 540.5, 550.5]], handlers: 12,
    interrupts: [{ name: "29 ps.private_timer.irq", count: 4, mean: 0.3, worst: 0.6, worst_at: 812.5, counts: [0, 0, 0, 0, 0, 0, 0, 2, 1, 1] }],
  };
}

function timeline(times) {
  const start = times.upload;
  const many = (from, count, step, length, name) => Array.from({ length: count }, (_, i) => [from + i * step, length, name, 0]);
  let at = start;
  const stages = ["feature_extraction", "receive", "evaluation", "identification", "pose"].map((name, i) => {
    const span = [at, times[name], i + 1, i > 0 ? 1 : 0];
    at += times[name];
    return span;
  });
  return {
    names: ["frame", "feature_extraction", "receive", "evaluation", "identification", "pose", "transfer", "handler"],
    tracks: [{ group: "Frame", name: "Frame", spans: [[start, times.frame, 0, 0]] }, { group: "PL", name: "Sensor input", spans: [[start, 6144, 0, 1]] },
      { group: "DMA", name: "DMA 0, image in", spans: many(0, 2400, 2, 1.2, 6) }, { group: "DMA", name: "DMA 1, binary out", spans: many(start, 300, 20.4, 20, 6) },
      { group: "Interrupts", name: "Handler", spans: many(1, 2400, 2, 0.6, 7) }, { group: "PS", name: "PS stage", spans: stages }],
    counters: [{ name: "Corner buffer", unit: "words", limit: 100, points: Array.from({ length: 200 }, (_, i) => [start + i * 30, i % 7]) }, { name: "Power", unit: "W", limit: 0, points: [[0, 2.1], [start, 2.4], [start + 6144, 1.9]] }],
    frames: [{ index: 0, start, end: start + times.frame }],
    handshakes: [{ name: "Feature words", signals: [{ name: "ena", bits: 1, points: [[start, 1]] },
      { name: "feature", bits: 32, points: [[start, 0], [start + 12.5, 0x80000c05], [start + 14, 0x40080401]] }, { name: "ready", bits: 2, points: [[start, 0], [start + 13.25, 1]] }], meanings: { [0x80000c05]: "corner 5, 3", [0x40080401]: "blob 2 from 1, 1" } }],
  };
}

/** Everything on the PS: feature extraction contains four stages. */
function psOnly() {
  const blocks = run({ frames: 6 });
  const { result } = blocks;
  result.system = "ps-only";
  const parts = { capture: 6144, corner_detection: 40000, threshold: 13000, blob_detection: 16000 };
  const all = Object.values(parts).reduce((a, b) => a + b, 0);
  for (const frame of result.frames) {
    const { feature_extraction: before, upload, ...times } = frame.time_us;
    frame.time_us = { upload: 0, ...parts, feature_extraction: all, ...times, receive: 0, frame: times.frame - before - times.receive + all };
  }
  result.stages = [{ name: "upload" }, ...Object.keys(parts).map((stage) => ({ name: stage, part_of: "feature_extraction" })), { name: "feature_extraction", part_of: "frame" }, ...result.stages.slice(2)];
  result.limit = limitOf([...Object.keys(parts), "receive", "evaluation", "identification", "pose"], "corner_detection", "corner detection", { levers: ["sw.opt=O2"], faster_with: "sw.opt=O2" });
  return blocks;
}

/** A design that the page knows nothing of: its own stages, counts and words. */
function foreign() {
  const blocks = run({ frames: 6 });
  const { result } = blocks;
  Object.assign(result, { system: "histogram", design: "mine" });
  result.stages = [{ name: "count", part_of: "frame", clock: "ps.fclk_clk2", why: "a bin a clock" }, { name: "frame" }];
  delete result.limit;
  result.configuration["ps.fclk_clk2.frequency"] = "80 MHz";
  const module = { clock: "ps.fclk_clk2", frequency_mhz: 80, origin: "synthesised", met: true };
  result.timing.modules = [{ ...module, name: "pl.adder", fmax_mhz: 84, fmax_high_mhz: 84, margin_percent: 5 }, { ...module, name: "pl.histogram", fmax_mhz: 82, fmax_high_mhz: 300, margin_percent: 2.5 }];
  result.verdict.timing = { holds: "yes", margin_percent: 2.5, by: "pl.histogram" };
  for (const frame of result.frames) {
    frame.counts = { bins: 256, drops: frame.index === 2 ? 7 : 0, idle: 0 };
    frame.time_us = { count: 4000, frame: 5000 };
    frame.warnings = frame.index === 2 ? ["7 bins overflowed: widen them"] : [];
  }
  return blocks;
}

/** A run that gave frames up: some, or all. Its clocks are above what a module is known to reach. */
function gaveUp({ all = false } = {}) {
  const blocks = run({ frames: 6 });
  const { result } = blocks;
  result.frames.forEach((frame, i) => {
    if (!all && i !== 2) return;
    Object.assign(frame, { gave_up: "binary image timed out", markers: [], warnings: ["the software gave up: binary image timed out"] });
    Object.assign(frame.time_us, { frame: 100000, evaluation: 0, identification: 0, pose: 0 });
    delete frame.energy_mj;
  });
  Object.assign(result.summary, { delivered: all ? 0 : 5, detected: all ? 0 : 4 });
  if (all) for (const part of [result.summary, result]) for (const key of ["fps", "latency_us", "energy_per_frame_mj", "stages"]) delete part[key];
  Object.assign(result.verdict, { feasible: "no", job: { holds: "no", margin_percent: -100 / (all ? 1 : 6), why: `${all ? 6 : 1} of 6 frames without a result` },
    timing: { holds: "unknown", margin_percent: -16.7, by: "pl.corner_detection", why: "timing unknown for pl.corner_detection" } });
  result.timing = { met: false, modules: [{ ...result.timing.modules[0], frequency_mhz: 120, met: false, margin_percent: -16.7 }, result.timing.modules[1]] };
  return blocks;
}

/** The block of a sweep's page. `rate`: frames a second that the study asks for. */
function sweep({ points = 5000, seed = 2, rate = 0 } = {}) {
  const random = randomFrom(seed);
  const swept = ["ps.fclk_clk1.frequency", "ps.cpu_clk.frequency", "pl.blob_detection.label_count", "profile"];
  const list = Array.from({ length: points }, (_, i) => {
    const pixel = 30 + 5 * (i % 15);
    const cpu = [333, 400, 500, 600, 667, 800][Math.floor(i / 15) % 6];
    const labels = [32, 64, 96, 128, 256][Math.floor(i / 90) % 5];
    const profile = ["thesis", "a9-O2"][Math.floor(i / 450) % 2];
    const ms = 307.2 / pixel + (profile === "thesis" ? 950 : 300) / cpu * (1 + 0.4 * random());
    const watts = 0.7 + cpu * 0.00125 + pixel * 0.008 + labels * 0.0012 + 0.03 * random();
    const reasons = pixel > 55 ? ["misses timing: pl.blob_detection"] : labels > 200 ? ["too large: lut"] : [];
    const failed = pixel === 100 && cpu === 333;
    if (failed) reasons.unshift("failed: the binary image timed out");
    if (1e3 / ms < rate) reasons.push(`breaks summary.fps.mean >= ${rate}`);
    return { key: `${i.toString(16).padStart(8, "0")}cafe`, swept: [`${pixel} MHz`, `${cpu} MHz`, `${labels}`, profile], reasons, failed,
      metrics: i === 7 ? new Array(14).fill(null) : [1e3 / ms, ms * 1e3, watts, watts * ms, 25 + watts * 11.5, 41, 41, 9000 + labels * 184, 12000 + labels * 39, 82, 0, 1.2 + random() * 0.1, 40 + random() * 10, 4 + random()] };
  });
  // As the program ranks them; what has no rate is on no front.
  const ranked = list.filter((p) => p.metrics[0] !== null && p.reasons.length === 0);
  const beats = (q, p) => q.metrics[0] >= p.metrics[0] && q.metrics[2] <= p.metrics[2] && (q.metrics[0] > p.metrics[0] || q.metrics[2] < p.metrics[2]);
  for (const p of list) p.front = ranked.includes(p) ? 1 + Number(ranked.some((q) => beats(q, p))) : 0;
  for (const p of list) if (p.front > 1) p.better = list.findIndex((q) => q.front === 1 && beats(q, p));
  const progress = { points: [1, points / 2, points], hypervolume: [0, 0.4, 0.6] };
  const objectives = [{ metric: "summary.fps.mean", unit: "1/s", better: 1 }, { metric: "power.total_w.nominal", unit: "W", better: -1 }];
  const paths = ["summary.fps.mean", "summary.latency_us.mean", "power.total_w.nominal", "summary.energy_per_frame_mj", "power.junction_c", "summary.detected", "summary.frames", "resources.total.lut", "resources.total.ff", "resources.total.bram36", "resources.total.dsp", "frames.error.corner_px.mean", "frames.error.translation_mm.mean", "frames.error.rotation_deg.mean"];
  const influence = { metric: "summary.fps.mean", basis: "all else equal: points, compared where they differ in one parameter alone", note: "", rows: [
    { path: "profile", count: 90, size: 55, low: 60, low_at: "thesis", high: 125, high_at: "a9-O2" }, { path: "pl.blob_detection.label_count", count: 45, size: 0, low: 97.5, low_at: "32", high: 97.5, high_at: "32" }] };
  return { sweep: { objectives, constraints: ["summary.detected >= 40", ...(rate ? [`summary.fps.mean >= ${rate}`] : [])], name: "clocks", title: "Clocks and labels", text: "Which clocks does sixty frames a second need?", folder: "out/a sweep", swept, idle: "", influence, progress, missing: 3, points: list,
    counts: { points: list.length, feasible: list.filter((p) => p.reasons.length === 0).length, failed: list.filter((p) => p.failed).length },
    metrics: paths.map(metric) } };
}

/** The blocks of a validation's page. */
function validation() {
  const row = (id, unit, published, modelled, use, verdict, kind = "timing") => ({ id, section: "5.4.1", system: "hybrid", kind, unit, published, modelled, difference_percent: 100 * (modelled / published - 1), use, how: "mean over 15 images", verdict });
  const rows = [row("fps.average", "1/s", 134, 128.5, "predicted", "met"), row("corner.delta", "ms", 45.16, 45.2, "used for calibration", "met"), row("speedup.all", "x", 12.16, 11.03, "predicted", "missed, known"),
    row("pose.x.translation", "mm", 63.6, 60.1, undefined, "explained", "accuracy")];
  const lines = ["system,test,image,threshold,corners,feature_extraction_us,identification_us,pose_us,frame_us,corner_px,translation_mm,rotation_deg"];
  for (const system of ["hybrid", "ps-only"]) for (let i = 1; i <= 15; i += 1) lines.push(`${system},squares,squares${i},128,${i * 4},6144.6,${300 * i},41.35,${system === "hybrid" ? 7000 + 300 * i : 90000 + 200 * i},1.2,30,${i % 3}`);
  return { validation: { schema: 1, profile: "thesis", fidelity: "tlm", design: "thesis", images: 316, repetitions: 20, band_percent: 5, rows, passed: true,
    fitted: [{ name: "scale of threshold", value: 0.879, published: ["threshold.ps"] }], gates: [{ name: "predicted times within 5 %", passed: true, text: "13 of 17" }] }, frames: lines.join("\n") + "\n" };
}

/** The blocks of a page that compares two runs. */
function comparison() {
  const a = run({ frames: 40, seed: 5 });
  const b = run({ frames: 40, seed: 6, clock: "60 MHz", fits: false });
  const { result, extras } = a;
  return { result, extras, "result-b": b.result, "extras-b": b.extras, comparison: { folders: ["out/a", "out/b"], figures: rows(result, b.result) } };
}

/** The figures of two runs, as the program compares them. */
function rows(a, b) {
  const { title, unit, better } = metric("summary.fps.mean");
  const capture = (result) => result.frames[0].time_us.capture ?? null;
  return [{ title, unit, better, a: a.summary.fps?.mean ?? null, b: b.summary.fps?.mean ?? null }, { title: "Stage: capture", unit: "µs", better: -1, a: capture(a), b: capture(b) }];
}

/** A page that compares the first run of comparison() with another one. */
function comparedWith({ result: other }) {
  const blocks = comparison();
  return { ...blocks, "result-b": other, comparison: { ...blocks.comparison, figures: rows(blocks.result, other) } };
}

/** `template` with blocks, as the program puts them in. */
function page(template, blocks) {
  const scripts = Object.entries(blocks).map(([id, value]) => `<script type="application/json" id="${id}">${JSON.stringify(value).replaceAll("<", "\\u003c")}</script>\n`);
  return template.replace("<!--DATA-->", () => scripts.join(""));
}

function detectors() {
  const of = (name, kind, corner_px, more) => ({ name, kind, description: `${name}, a ${kind}`, seen: 41, found: 41, markers: 41, false: 0, corner_px, corner_most_px: 2 * corner_px, translation_mm: 40 * corner_px, rotation_deg: 5 * corner_px, ...more });
  const list = [of("improved", "design", 0.004, { chip_fps: 322.2, chip_latency_ms: 3.8, chip_energy_mj: 3.3 }), of("opencv", "library", 0.7), of("apriltag3", "library", 0.17, { seen: 73, false: 32 })];
  return { detectors: { schema: 1, dictionary: "4x4_250", images: ["z0.5", "z1.0"], detectors: list, host_ms: { improved: 0.8, opencv: 3, apriltag3: 45.6 }, left_out: [{ design: "hd", why: "it takes images of 1280x720 px" }] } };
}

/** Numbers of seven bits a byte, as the program packs them. */
function packed(numbers) {
  const bytes = [];
  for (let number of numbers) {
    for (; number >= 128; number = Math.floor(number / 128)) bytes.push(number % 128 + 128);
    bytes.push(number);
  }
  return Buffer.from(bytes).toString("base64");
}

/** A trace: a clock, a state with names, a number, a curve, a lane of reads, what the software runs, and with `accesses` what it reads. `changes`: of the clock. */
function waves({ changes = 2000, accesses = false } = {}) {
  const half = 5000, to = changes * half;
  const list = (count, of) => Array.from({ length: count }, (_, i) => of(i));
  const some = Math.max(4, Math.floor(changes / 20));
  const words = (name, of, form = "words") => ({ name, form, bits: 32, count: some, changes: packed(list(some, (i) => [i && 20 * half, i % 7]).flat()), words: list(7, of) });
  return {
    file: "t.vcd", path: "out/t.vcd", from: 0, to, dropped: 1, leftOut: 2, cursor: 50000,
    signals: [
      { name: "top.clk", form: "bit", bits: 1, count: changes, changes: packed(list(changes, (i) => (i && half) * 8 + i % 2)) },
      words("top.state", (i) => ["idle", "run", "</script><img src=x onerror='window.hacked=1'>", "x", "0x1F", "0xx", ""][i]),
      words("top.level", (i) => String(i * 1.5), "real"),
      words("ps.cpu.function_name", (i) => `step_${i}`),
      ...(accesses ? [words("ps.cpu.m_axi.access", (i) => ["read axi_gpio_0.GPIO_DATA", ""][i % 2]), words("pl.engine.state", (i) => `state_${i}`)] : []),
      { name: "top.copy", form: "bit", bits: 1, sameAs: 0 },
    ],
    lanes: [{ name: "top.m_axi.read_1", count: some, spans: packed(list(some, (i) => [i && 20 * half, 8 * half, i % 7 * 2 + (i % 5 === 0 ? 1 : 0)]).flat()), words: list(7, (i) => `read 0x${i}000 4 beats OKAY`) }],
  };
}

/** A block design of two parts, of which the PS is drawn twice, and the clocks, as Graphviz draws them. */
function diagram() {
  const node = (name, x) => `<g class="node"><title>${name}</title><polygon fill="#cfe8ff" stroke="black" points="${x},8 ${x + 90},8 ${x + 90},44 ${x},44"/><text x="${x + 10}" y="30">${name}</text></g>`;
  return {
    svg: `<svg width="480pt" height="60pt" viewBox="0 0 480 60" xmlns="http://www.w3.org/2000/svg"><g class="graph">${node("ps", 10)}${node("engine", 130)}${node("ps inputs", 250)}${node("clocks of parts", 370)}</g></svg>`,
    parts: [{ name: "ps", ip: "xilinx.com:ip:processing_system7:5.5", module: "ps2", registers: [], traffic: [] },
      { name: "engine", ip: "me:user:engine:1.0", module: "pl.engine", registers: [["0x43C00004", "STATUS", "ro", "what it does"]], traffic: [["pl.bus.engine.reads", 12345, "read transactions"]] }],
  };
}

module.exports = { diagram, waves, comparedWith, run, psOnly, foreign, gaveUp, sweep, validation, comparison, detectors, faults, page };

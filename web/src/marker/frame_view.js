// The image with what was found in it, each kind a layer to switch.
import { download, h, s } from "../kit/dom.js";
import { counted, error, fixed, heading, significant, time, words } from "../kit/format.js";
import { stageColour } from "../kit/theme.js";
import { countsOf, partsOf } from "../run/facts.js";

const directions = ["north", "south", "east", "west"]; // as the corner words number them

/** Pixel of a point of the marker, given in metres; null behind the camera. */
function projected(camera, pose, point) {
  const at = pose.rotation.map((row, i) => row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + pose.translation_m[i]);
  if (at[2] < 0.01) return null;
  return [camera.fx * at[0] / at[2] + camera.cx, camera.fy * at[1] / at[2] + camera.cy];
}

const outline = (points) => "M" + points.map((p) => p.join(" ")).join("L") + "Z";

function triangles(corners, direction) {
  const shape = [[[0, -5], [4, 3], [-4, 3]], [[0, 5], [4, -3], [-4, -3]], [[5, 0], [-3, 4], [-3, -4]], [[-5, 0], [3, 4], [3, -4]]][direction];
  return corners.filter((c) => c[2] === direction)
    .map(([x, y]) => outline(shape.map(([dx, dy]) => [x + 0.5 + dx * 0.8, y + 0.5 + dy * 0.8]))).join("");
}

function markerLayer(frame) {
  return frame.markers.map((marker) => {
    const top = marker.corners_px.reduce((a, b) => (b[1] < a[1] ? b : a));
    return [
      s("path", { class: "marker", d: outline(marker.corners_px) }),
      marker.corners_px.map(([x, y], i) => s("circle", { class: "marker-corner" + (i === 0 ? " first" : ""), cx: x, cy: y, r: i === 0 ? 3.4 : 2.2 })),
      s("text", { class: "marker-name", x: top[0], y: top[1] - 9 }, `ID ${marker.id}`),
    ];
  });
}

function axesLayer(frame, view) {
  return frame.markers.filter((marker) => marker.pose).map((marker) => {
    const from = projected(view.camera, marker.pose, [0, 0, 0]);
    const half = marker.side_m / 2;
    return [["u", [half, 0, 0]], ["v", [0, half, 0]], ["w", [0, 0, half]]].map(([name, point]) => {
      const to = projected(view.camera, marker.pose, point);
      if (!from || !to) return null;
      return [s("line", { class: `pose ${name}`, x1: from[0], y1: from[1], x2: to[0], y2: to[1] }),
        s("text", { class: `pose-name ${name}`, x: from[0] + (to[0] - from[0]) * 1.16, y: from[1] + (to[1] - from[1]) * 1.16 + 3 }, name)];
    });
  });
}

const truthLayer = (frame) => frame.markers.filter((m) => m.truth).map((m) => s("path", { class: "truth", d: outline(m.truth.corners_px) }));

function layersOf(frame, view) {
  const { corners = [], blobs = [], candidates = [] } = view;
  return [
    { id: "corners", name: "Corners", count: corners.length, on: true,
      nodes: directions.map((name, i) => s("path", { class: `corner ${name}`, d: triangles(corners, i) })) },
    { id: "blobs", name: "Blobs", count: blobs.length, on: true,
      nodes: s("path", { class: "blob", d: blobs.map(([sx, sy, ex, ey]) => `M${sx} ${sy}H${ex + 1}V${ey + 1}H${sx}Z`).join("") }) },
    { id: "candidates", name: "Candidates", count: candidates.length, on: true,
      nodes: s("path", { class: "candidate", d: candidates.map((c) => outline(c.map(([x, y]) => [x + 0.5, y + 0.5]))).join("") }) },
    { id: "marker", name: "Marker", count: frame.markers.length, on: true, nodes: markerLayer(frame) },
    { id: "axes", name: "Axes of the pose", count: frame.markers.filter((m) => m.pose).length, on: true, nodes: axesLayer(frame, view) },
    { id: "truth", name: "True outline", count: frame.markers.filter((m) => m.truth).length, on: false, nodes: truthLayer(frame) },
  ].filter((layer) => layer.count > 0);
}

function facts(frame) {
  const list = [];
  const add = (name, text) => list.push(h("div", {}, h("dt", {}, name), h("dd", {}, text)));
  for (const marker of frame.markers) {
    add("Marker", `ID ${marker.id}${marker.rotation ? `, turned ${90 * marker.rotation}°` : ", upright"}`);
    if (marker.pose) {
      add("Position", marker.pose.translation_m.map((m) => fixed(m, 3)).join(", ") + " m");
      if (marker.reprojection_px !== undefined)
        add("Reprojection", `${fixed(marker.reprojection_px, 2)} px` +
          (marker.iterations === undefined ? "" : ` after ${counted(marker.iterations, "iteration")}`));
    }
    if (marker.error) {
      add("Error", [`${error(marker.error.corner_px, 2)} px`, marker.error.translation_mm !== undefined && `${error(marker.error.translation_mm, 1)} mm`,
        marker.error.rotation_deg !== undefined && `${error(marker.error.rotation_deg, 2)}°`].filter(Boolean).join(", "));
    }
  }
  if (frame.markers.length === 0) add("Marker", "none found");
  for (const name of countsOf([frame])) add(heading(name), fixed(frame.counts[name], 0));
  if (frame.threshold !== undefined) add("Threshold", String(frame.threshold));
  if (Number.isFinite(frame.energy_mj?.total ?? frame.energy_mj)) add("Energy", significant(frame.energy_mj.total ?? frame.energy_mj, 3) + " mJ");
  return h("dl", { class: "facts" }, list);
}

/** One bar, as long as the frame. */
export function stageBar(run, frame) {
  if (frame.gave_up) return h("p", { class: "note" }, `No result, the software gave up: ${frame.gave_up}.`);
  const whole = frame.time_us.frame;
  const parts = partsOf(run).filter((name) => frame.time_us[name] > 0);
  return h("div", { class: "stages" },
    h("div", { class: "stage-bar", "aria-hidden": "true" }, parts.map((name) => h("span", {
      title: `${words(name)} ${time(frame.time_us[name])}`,
      style: { flexGrow: String(frame.time_us[name]), background: stageColour(name) },
    }))),
    h("ul", { class: "keys" }, parts.map((name) => h("li", {}, h("i", { style: { background: stageColour(name) } }), words(name),
      h("span", { class: "number" }, time(frame.time_us[name])), h("span", { class: "number faint" }, `${fixed(100 * frame.time_us[name] / whole, 1)} %`)))));
}

export function frameView(run) {
  const views = run.extras.frames ?? {};
  const shown = run.frames.filter((frame) => views[frame.index]);
  if (shown.length === 0) return null;
  const off = new Map();
  const picture = h("div", { class: "picture" });
  const aside = h("div", { class: "frame-side" });
  const heading = h("h3", { "aria-live": "polite" });
  let place = 0;
  let close = false;

  function whole(view) { return `0 0 ${view.width} ${view.height}`; }
  function around(frame, view) {
    const points = frame.markers.flatMap((m) => m.corners_px);
    const [left, right] = [Math.min(...points.map((p) => p[0])), Math.max(...points.map((p) => p[0]))];
    const [top, bottom] = [Math.min(...points.map((p) => p[1])), Math.max(...points.map((p) => p[1]))];
    const height = Math.max((bottom - top) * 1.7, (right - left) * 1.7 * view.height / view.width, 60);
    const width = height * view.width / view.height;
    return `${(left + right - width) / 2} ${(top + bottom - height) / 2} ${width} ${height}`;
  }

  function draw() {
    const frame = shown[place];
    const view = views[frame.index];
    const layers = layersOf(frame, view);
    const groups = new Map(layers.map((layer) => [layer.id, s("g", { class: "layer", "data-layer": layer.id }, layer.nodes)]));
    const on = (layer) => off.get(layer.id) ?? layer.on;
    for (const layer of layers) groups.get(layer.id).style.display = on(layer) ? "" : "none";
    const image = s("svg", {
      viewBox: close && frame.markers.length ? around(frame, view) : whole(view), role: "img", class: close ? "close" : null,
      "aria-label": `Image ${frame.input}: ${countsOf([frame]).map((name) => `${words(name)} ${frame.counts[name]}, `).join("")}` +
        (frame.markers.length ? frame.markers.map((m) => `marker ${m.id}`).join(", ") : "no marker"),
    }, s("image", { href: "data:image/png;base64," + view.png, width: view.width, height: view.height }), [...groups.values()]);
    picture.replaceChildren(image);
    heading.textContent = frame.input;
    aside.replaceChildren(
      h("fieldset", { class: "layers" }, h("legend", {}, "Layers"), layers.map((layer) => h("label", {},
        h("input", { type: "checkbox", checked: on(layer), "data-layer": layer.id, onchange: (event) => {
          off.set(layer.id, event.target.checked);
          groups.get(layer.id).style.display = event.target.checked ? "" : "none";
        } }), h("i", { class: `key ${layer.id}` }), layer.name, h("span", { class: "number faint" }, String(layer.count))))),
      facts(frame), stageBar(run, frame));
    select.value = String(place);
    before.disabled = place === 0;
    after.disabled = place === shown.length - 1;
  }
  const go = (to) => { place = Math.min(Math.max(to, 0), shown.length - 1); draw(); };
  const before = h("button", { type: "button", "aria-label": "Previous frame", onclick: () => go(place - 1) }, "‹");
  const after = h("button", { type: "button", "aria-label": "Next frame", onclick: () => go(place + 1) }, "›");
  const select = h("select", { "aria-label": "Frame", onchange: () => go(Number(select.value)) },
    shown.map((frame, i) => h("option", { value: String(i) }, `${frame.index + 1}  ${frame.input}`)));
  const zoom = h("button", { type: "button", "aria-pressed": "false", onclick: () => {
    close = !close;
    zoom.setAttribute("aria-pressed", String(close));
    draw();
  } }, "Zoom to marker");
  const save = h("button", { type: "button", "aria-label": "Picture as SVG", onclick: () => {
    const copy = picture.querySelector("svg").cloneNode(true);
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    const original = picture.querySelectorAll("svg *");
    copy.querySelectorAll("*").forEach((node, i) => {
      const look = getComputedStyle(original[i]);
      for (const name of ["fill", "stroke", "stroke-width", "font-family", "font-size", "display", "fill-opacity"]) node.style[name] = look[name];
    });
    download(`${shown[place].input}.svg`, new XMLSerializer().serializeToString(copy), "image/svg+xml");
  } }, "SVG");
  draw();
  run.moment.listen((moment) => {
    const to = shown.findIndex((frame) => frame.index === moment.frame);
    if (to >= 0) go(to);
  });
  const rest = run.frames.length - shown.length;
  return h("section", { id: "frame", "aria-labelledby": "frame-title" },
    h("div", { class: "section-head" }, h("h2", { id: "frame-title" }, "Frame"),
      h("div", { class: "tools", role: "group", "aria-label": "Which frame" }, shown.length > 1 && [before, select, after], zoom, save)),
    rest > 0 && h("p", { class: "note" }, `The first ${counted(shown.length, "frame")} with their images; pictures of all are files beside this page.`),
    h("div", { class: "frame-view" }, h("div", {}, picture), h("div", {}, heading, aside)));
}

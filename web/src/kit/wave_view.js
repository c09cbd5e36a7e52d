// A viewer of a recorded trace: names and values on the left, waves on one time axis on the right.
import { h } from "./dom.js";
import { shellWord } from "./format.js";
import { exactTime, placeAt, unpack, valueAt } from "./wave_data.js";
import { paintRows, rowHeight, scaleOf, stepOf } from "./wave_paint.js";
import { rowsOf } from "./wave_rows.js";
import { isDark, onTheme, palette } from "./theme.js";

const axisHeight = 26; // px
const mostRows = 20; // in sight

function coloursOf() {
  const colour = palette();
  const dark = isDark();
  return { ...colour, line: colour.blue, lane: colour.green, bad: colour.vermilion, unknown: dark ? "#6b3a28" : "#f3d4c4", unset: dark ? "#4a4a4a" : "#e4e4e4", box: dark ? "#1d3444" : "#e3f0f8", rule: colour.line };
}

/**
 * @param data    the block of the page
 * @param frames  [{name, from, to}] in ps: marked on the axis; may be empty
 * @param moved   called with the time of the cursor, ps
 */
export function waveView(data, { frames = [], moved = () => {} } = {}) {
  const waves = unpack(data);
  const rows = rowsOf(waves);
  const whole = { from: waves.from, to: waves.to };
  let view = { ...whole }, cursor = waves.from, second = null, search = "", chosen = null, list = [];

  const canvas = h("canvas", { role: "img", "aria-label": "Waves" });
  const names = h("div", { class: "wave-names" });
  const space = h("div", { class: "wave-space" });
  const sight = h("div", { class: "wave-sight" }, names, canvas);
  const scroller = h("div", { class: "wave-scroll", tabindex: "0", role: "group", "aria-label": "Waves: arrow keys move the cursor, plus and minus zoom, n and p go to the next and the previous change of the chosen row" }, sight, space);
  const status = h("p", { class: "note number", "aria-live": "polite" });
  const command = h("code", {});
  const elsewhere = h("p", { class: "note" }, "In Surfer or VaporView: ", command);
  let viewHeight = axisHeight + mostRows * rowHeight;

  const width = () => canvas.clientWidth || 800;
  const scale = () => scaleOf(view, width());
  const least = 100; // ps of the narrowest view

  function show(from, to) {
    const span = Math.min(Math.max(to - from, least), whole.to - whole.from);
    const start = Math.min(Math.max(from, whole.from), whole.to - span);
    view = { from: start, to: start + span };
    draw();
  }
  const zoom = (factor, about = Math.min(Math.max(cursor, view.from), view.to)) =>
    show(about - (about - view.from) * factor, about + (view.to - about) * factor);
  function setCursor(ps, keep = false) {
    cursor = Math.min(Math.max(Math.round(ps), whole.from), whole.to);
    const span = view.to - view.from;
    if (!keep && (cursor < view.from || cursor > view.to)) show(cursor - span / 2, cursor + span / 2);
    else draw();
    moved(cursor);
  }
  function step(direction) {
    const row = chosen ?? list.find((one) => one.form);
    if (!row) return;
    const at = placeAt(row.times, cursor);
    const next = direction > 0 ? at + 1 : row.times[at] === cursor ? at - 1 : at;
    if (next >= 0 && next < row.times.length) setCursor(row.times[next]);
  }

  function nameOf(row) {
    if (row.title) {
      const open = search !== "" || rows.isOpen(row.title);
      return h("button", { type: "button", class: "wave-title", "aria-expanded": String(open), onclick: () => { rows.toggle(row.title); relist(); } },
        `${open ? "▾" : "▸"} ${row.title}`, h("span", { class: "faint" }, ` ${row.count}`));
    }
    return h("button", { type: "button", class: row === chosen ? "wave-name chosen" : "wave-name", title: row.name, "aria-pressed": String(row === chosen), onclick: () => { chosen = row === chosen ? null : row; draw(); } },
      h("span", {}, row.label), h("b", { class: "number" }, valueAt(row, cursor)));
  }

  function paintAxis(context, colour, at) {
    const span = view.to - view.from;
    const mark = stepOf(span, width() / 130);
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "alphabetic";
    for (let time = Math.ceil(view.from / mark) * mark; time <= view.to; time += mark) {
      const x = Math.round(at.x(time)) + 0.5;
      context.fillStyle = colour.rule;
      context.fillRect(x, axisHeight - 6, 1, viewHeight);
      context.fillStyle = colour.soft;
      context.fillText(exactTime(time), x + 3, 13);
    }
    for (const frame of frames) {
      if (frame.to < view.from || frame.from > view.to) continue;
      context.fillStyle = colour.orange;
      context.fillRect(at.x(frame.from), axisHeight - 4, Math.max(1, at.x(frame.to) - at.x(frame.from) - 1), 3);
    }
  }
  function paintLine(context, at, time, colour) {
    if (time === null || time < view.from || time > view.to) return;
    context.fillStyle = colour;
    context.fillRect(Math.round(at.x(time)), 0, 1, viewHeight);
  }
  function draw() {
    const dense = window.devicePixelRatio || 1;
    const wide = width();
    canvas.width = Math.round(wide * dense);
    canvas.height = Math.round(viewHeight * dense);
    const context = canvas.getContext("2d");
    context.scale(dense, dense);
    const colour = coloursOf(), at = scale();
    const top = Math.floor(scroller.scrollTop / rowHeight);
    const count = Math.ceil((viewHeight - axisHeight) / rowHeight);
    const shown = list.slice(top, top + count);
    paintAxis(context, colour, at);
    paintRows({ context, colour, view, scale: at, width: wide, top: axisHeight }, shown);
    paintLine(context, at, second, colour.purple);
    paintLine(context, at, cursor, colour.vermilion);
    names.replaceChildren(...shown.map(nameOf));
    const delta = second === null ? "" : ` · ${exactTime(Math.abs(second - cursor))} to the second cursor`;
    status.textContent = `${exactTime(cursor)}${delta} · ${exactTime(Math.round(view.to - view.from))} in sight`;
    command.textContent = `markervp trace view ${[data.path, ...(chosen && chosen.form !== "lane" ? [chosen.name] : [])].map(shellWord).join(" ")} --at ${cursor}ps`;
    scroller.dataset.drawn = String(shown.length);
  }
  function relist() {
    list = rows.shown(search.trim());
    viewHeight = axisHeight + Math.min(Math.max(list.length, 6), mostRows) * rowHeight;
    scroller.style.height = `${viewHeight + 2}px`; // and its border
    space.style.height = `${Math.max(0, list.length * rowHeight + axisHeight - viewHeight + rowHeight)}px`;
    if (list.length * rowHeight < scroller.scrollTop) scroller.scrollTop = 0;
    draw();
  }

  const timeAt = (event) => scale().time(event.clientX - canvas.getBoundingClientRect().left);
  let dragged = null;
  canvas.addEventListener("pointerdown", (event) => { dragged = { x: event.clientX, view, far: false }; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    if (!dragged) return;
    const by = event.clientX - dragged.x;
    dragged.far ||= Math.abs(by) > 4;
    const perPx = (dragged.view.to - dragged.view.from) / width();
    if (dragged.far) show(dragged.view.from - by * perPx, dragged.view.to - by * perPx);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (dragged && !dragged.far) {
      if (event.shiftKey) { second = Math.round(timeAt(event)); draw(); } else setCursor(timeAt(event));
    }
    dragged = null;
  });
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.shiftKey) return; // the list scrolls
    event.preventDefault();
    const by = event.deltaY || event.deltaX;
    const span = view.to - view.from;
    if (event.ctrlKey) zoom(by > 0 ? 1.25 : 0.8, timeAt(event));
    else show(view.from + span * Math.sign(by) * 0.1, view.to + span * Math.sign(by) * 0.1);
  }, { passive: false });
  const keys = {
    "+": () => zoom(0.5), "=": () => zoom(0.5), "-": () => zoom(2), f: () => show(whole.from, whole.to), n: () => step(1), p: () => step(-1),
    ArrowLeft: () => setCursor(cursor - Math.max(1, scale().perPx * 10)), ArrowRight: () => setCursor(cursor + Math.max(1, scale().perPx * 10)),
  };
  scroller.addEventListener("keydown", (event) => {
    const act = !event.ctrlKey && !event.metaKey && keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  scroller.addEventListener("scroll", draw);
  onTheme(draw);
  new ResizeObserver(draw).observe(canvas);

  const button = (text, label, act) => h("button", { type: "button", "aria-label": label, onclick: act }, text);
  const find = h("input", { type: "search", placeholder: "Find signals", "aria-label": "Find signals", oninput: () => { search = find.value; relist(); } });
  const findText = (text) => { find.value = search = text; relist(); };
  const tools = h("div", { class: "controls" }, find,
    frames.length > 0 && h("select", { "aria-label": "Show", onchange: (event) => { const frame = frames[Number(event.target.value)] ?? whole; show(frame.from, frame.to); } },
      h("option", { value: "-1" }, "All"), frames.map((frame, i) => h("option", { value: String(i) }, frame.name))),
    h("div", { class: "tools" }, button("+", "Zoom in", () => zoom(0.5)), button("−", "Zoom out", () => zoom(2)), button("Fit", "Show all", () => show(whole.from, whole.to)),
      button("‹", "Previous change of the chosen row", () => step(-1)), button("›", "Next change of the chosen row", () => step(1))));
  relist();
  const byName = new Map(waves.signals.map((signal) => [signal.name, signal]));
  /** What a signal shows at a time; "" if it is not there. */
  const valueOf = (name, ps) => (byName.has(name) ? valueAt(byName.get(name), ps) : "");
  /** The last value of a signal that is not empty, up to a time. */
  function lastOf(name, ps) {
    const row = byName.get(name);
    for (let i = row ? placeAt(row.times, ps) : -1; i >= 0; --i) {
      if (row.words[row.values[i]] !== "") return row.words[row.values[i]];
    }
    return "";
  }
  return { element: h("div", { class: "waves" }, tools, scroller, status, elsewhere), setCursor, valueOf, lastOf, find: findText };
}

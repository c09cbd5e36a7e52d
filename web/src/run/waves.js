// The recorded trace of a run, or a trace alone: a viewer, and what the other parts of the page know of the cursor's moment.
import { h } from "../kit/dom.js";
import { counted, shellWord } from "../kit/format.js";
import { waveView } from "../kit/wave_view.js";

const psInUs = 1e6;

/** What has no room in the page, and where it is to be had. */
function leftOut(data) {
  const path = shellWord(data.path);
  const note = (count, what, why, how) => count > 0 && h("p", { class: "note" }, `${counted(count, what)} had no room here, ${why}: markervp trace ${how}.`);
  return [
    note(data.transactionsLeftOut, "transaction", "the last ones", `transactions ${path} lists them`),
    note(data.dropped, "signal", data.dropped === 1 ? "the one that changes most" : "those that change most", `plot ${path} SIGNAL… --window FROM:TO -o page.html shows them`),
    note(data.leftOut, "signal", "the last of the file", `plot ${path} SIGNAL… -o page.html shows those that you name`),
  ];
}

const help = () => h("p", { class: "note" }, "Click sets the cursor, Shift and a click a second one; drag or Shift and the wheel move, Ctrl and the wheel zoom. A row that you choose has its changes behind ‹ and ›.");

/** Of an access of the processor, "read axi_gpio_1.GPIO_DATA", the command that names the source lines of the last ones up to then. */
function sourceLine(access, ps) {
  const register = access.split(" ")[1];
  return [` · last access: ${access}, from which line: `, h("code", {}, `markervp history . --register ${shellWord(register)} --before ${Math.ceil(ps) + 1}ps`)];
}

/** The page of a trace alone. */
export function wavesPage(data) {
  const { element, setCursor } = waveView(data);
  if (data.cursor !== undefined) setCursor(data.cursor);
  return { title: data.file, subtitle: counted(data.signals.length, "signal"),
    sections: [h("section", { id: "waves", "aria-labelledby": "waves-title" }, h("h2", { id: "waves-title" }, "Waves"), help(), leftOut(data), element)] };
}

/** The section of a run's page; null without a trace. */
export function waves(run) {
  const data = run.extras.waves;
  const section = (...children) => h("section", { id: "waves", "aria-labelledby": "waves-title" }, h("h2", { id: "waves-title" }, "Waves"), children);
  if (data?.tooLarge) return section(h("p", { class: "note" }, `The trace is too large for this page: markervp trace plot ${shellWord(data.tooLarge)} --window FROM:TO -o page.html shows a part.`));
  if (data?.problem) return section(h("p", { class: "note" }, `No waves: ${data.problem}`));
  if (!data?.signals?.length) return null;
  const spans = (run.extras.timeline?.frames ?? []).map((frame) => ({ index: frame.index, name: `${run.unit} ${frame.index + 1}`, from: frame.start * psInUs, to: frame.end * psInUs }))
    .filter((frame) => frame.to > data.from && frame.from < data.to);
  const here = h("p", { class: "note" });
  const moved = (ps) => {
    const frame = spans.find((one) => ps >= one.from && ps < one.to);
    const software = viewer.valueOf("ps.cpu.handler_name", ps) || viewer.valueOf("ps.cpu.function_name", ps);
    const access = viewer.lastOf("ps.cpu.m_axi.access", ps);
    here.replaceChildren(
      frame ? h("button", { type: "button", class: "plain", onclick: () => {
        run.moment.pointAt({ ps, frame: frame.index }, section);
        document.getElementById("frame")?.scrollIntoView();
      } }, `in ${frame.name}`) : "",
      software && h("span", {}, " · software: ", run.extras.profile ? h("a", { href: "#profile" }, software) : software), ...(access ? sourceLine(access, ps) : []));
  };
  const viewer = waveView(data, { frames: spans, moved });
  run.moment.listen((moment, from) => {
    if (moment.signals !== undefined) viewer.find(moment.signals);
    if (from !== section && moment.ps !== undefined) viewer.setCursor(moment.ps);
  });
  return section(help(), leftOut(data), viewer.element, here);
}

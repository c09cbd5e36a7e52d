// Looks which data there are, and shows their page.
import { h, s } from "./kit/dom.js";
import { isDark, onTheme, toggleTheme } from "./kit/theme.js";
import { application } from "./application.js";
import { comparePage } from "./compare/page.js";
import { faultsPage } from "./faults/page.js";
import { runPage } from "./run/page.js";
import { wavesPage } from "./run/waves.js";
import { sweepPage } from "./sweep/page.js";

function block(id) {
  const element = document.getElementById(id);
  return element ? JSON.parse(element.textContent) : undefined;
}

function themeButton() {
  const button = h("button", { type: "button", onclick: toggleTheme });
  const name = () => { button.textContent = isDark() ? "Light" : "Dark"; button.setAttribute("aria-label", `${button.textContent} colours`); };
  onTheme(name);
  name();
  return button;
}

function frame({ title, subtitle, sections }) {
  document.title = `${title} · markervp`;
  const shown = sections.filter(Boolean);
  const links = shown.filter((section) => !section.hidden).map((section) => [section.id, section.querySelector("h2")?.textContent]).filter(([, name]) => name);
  document.getElementById("page").replaceChildren(
    h("header", { class: "bar" }, h("div", { class: "bar-inner" },
      h("div", { class: "mark" }, s("svg", { viewBox: "0 0 6 6", "aria-hidden": "true" }, s("path", { d: application.mark, "fill-rule": "evenodd" })), h("span", {}, "markervp")),
      h("nav", { "aria-label": "Sections" }, h("ul", {}, links.map(([id, name]) => h("li", {}, h("a", { href: "#" + id }, name))))),
      h("div", { class: "tools" }, themeButton(), h("button", { type: "button", onclick: () => window.print() }, "Print")))),
    h("main", {}, h("div", { class: "masthead" }, h("h1", {}, title), h("p", {}, subtitle)), shown),
    h("footer", {}, "Made by markervp. This page is one file and loads nothing. Charts: Apache ECharts, µPlot, WaveDrom."));
}

function show() {
  const result = block("result");
  const sweep = block("sweep");
  if (sweep) return frame(sweepPage(sweep));
  const faults = block("faults");
  if (faults) return frame(faultsPage(faults));
  for (const [id, page] of Object.entries(application.pages)) {
    const data = block(id);
    if (data) return frame(page(data, block));
  }
  const trace = block("waves");
  if (trace) return frame(wavesPage(trace));
  const comparison = block("comparison");
  if (comparison) return frame(comparePage(result, block("extras"), block("result-b"), block("extras-b"), comparison));
  if (result) return frame(runPage(result, block("extras"), block("figures")));
  return frame({ title: "Nothing to show", subtitle: "This page was made without data.", sections: [] });
}

const start = performance.now();
show();
document.documentElement.dataset.ready = String(Math.round(performance.now() - start));

// Makes one HTML file of src/: script and style inlined, nothing to load.
//   node build.js OUTPUT [MODULES [DEPFILE [APPLICATION]]]
// MODULES: folder of the npm packages, if not beside this file. DEPFILE: lists the sources, as a rule for make or ninja.
// APPLICATION: the folder of src/ whose main.js and page.css add to the pages; "" for the pages alone.
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve, sep } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const output = resolve(process.argv[2] ?? "report-template.html");
const modules = resolve(process.argv[3] ?? join(here, "node_modules"));
const application = process.argv[5] ?? "marker";
const script_file = join(here, "src", application, "main.js");
const style_file = join(here, "src", application || "style", "page.css");
const esbuild = createRequire(join(modules, "x.js"))("esbuild");

const common = { bundle: true, write: false, metafile: true, minify: true, nodePaths: [modules], logLevel: "warning" };
const script = await esbuild.build({
  ...common,
  entryPoints: [script_file],
  format: "iife",
  target: ["chrome100", "firefox100", "safari15"],
  loader: { ".csv": "text" },
  legalComments: "none",
});
const style = await esbuild.build({ ...common, entryPoints: [style_file] });

// Text inside <script> ends at the first "</script", and "<!--" changes how it is read.
const inScript = (text) => text.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
const frame = join(here, "src/page.html");
const html = readFileSync(frame, "utf8")
  .replace("/*STYLE*/", () => style.outputFiles[0].text.trim())
  .replace("/*SCRIPT*/", () => inScript(script.outputFiles[0].text.trim()));
if (html.split("<!--DATA-->").length !== 2) throw new Error("the page must hold <!--DATA--> once");
writeFileSync(output, html);

if (process.argv[4]) {
  const bundled = [script, style].flatMap(({ metafile }) => Object.keys(metafile.inputs).map((file) => resolve(file)));
  // The packages are covered by the lock file.
  const own = bundled.filter((file) => !file.startsWith(modules + sep));
  const escaped = (file) => file.replace(/[ #]/g, "\\$&").replace(/\$/g, "$$$$");
  writeFileSync(process.argv[4], `${escaped(output)}: ${[frame, ...own].map(escaped).join(" ")}\n`);
}

// Makes one HTML file of src/: script and style inlined, nothing to load.
//   node build.js OUTPUT [MODULES]     MODULES: folder of the npm packages, if not beside this file
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const output = resolve(process.argv[2] ?? "report-template.html");
const modules = resolve(process.argv[3] ?? join(here, "node_modules"));
const esbuild = createRequire(join(modules, "x.js"))("esbuild");

const common = { bundle: true, write: false, minify: true, nodePaths: [modules], logLevel: "warning" };
const script = await esbuild.build({
  ...common,
  entryPoints: [join(here, "src/main.js")],
  format: "iife",
  target: ["chrome100", "firefox100", "safari15"],
  loader: { ".csv": "text" },
  legalComments: "none",
});
const style = await esbuild.build({ ...common, entryPoints: [join(here, "src/style/page.css")] });

// Text inside <script> ends at the first "</script", and "<!--" changes how it is read.
const inScript = (text) => text.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
const html = readFileSync(join(here, "src/page.html"), "utf8")
  .replace("/*STYLE*/", () => style.outputFiles[0].text.trim())
  .replace("/*SCRIPT*/", () => inScript(script.outputFiles[0].text.trim()));
if (html.split("<!--DATA-->").length !== 2) throw new Error("the page must hold <!--DATA--> once");
writeFileSync(output, html);

// The build knows what the page is made of.
//   NODE_PATH=…/node_modules node --test build.test.cjs
"use strict";
const assert = require("node:assert/strict");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { test } = require("node:test");

const web = path.resolve(__dirname, "..");
const sources = fs.readdirSync(path.join(web, "src"), { withFileTypes: true, recursive: true })
  .filter((entry) => entry.isFile()).map((entry) => path.join(entry.parentPath ?? entry.path, entry.name));

test("the dependency file names every source, so that editing any of them makes the page again", () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "markervp build "));
  try {
    const page = path.join(folder, "page.html");
    execFileSync(process.execPath, [path.join(web, "build.js"), page, process.env.NODE_PATH, page + ".d"]);
    const [output, listed] = fs.readFileSync(page + ".d", "utf8").trim().split(": ");
    assert.equal(output, page.replaceAll(" ", "\\ "));
    const named = listed.split(" ").map((file) => path.relative(web, file)).sort();
    const data = ["published.csv", "thesis_systems.csv"].map((name) => path.join("..", "data", name));
    assert.deepEqual(named, [...data, ...sources.map((file) => path.relative(web, file))].sort());
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
});

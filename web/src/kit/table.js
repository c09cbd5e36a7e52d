// Tables that sort, and their CSV.
import { download, h } from "./dom.js";
import { counted } from "./format.js";

const page = 100;

const textOf = (column, row) => {
  const value = column.value(row);
  return value === undefined || value === null ? "" : column.show ? column.show(value, row) : String(value);
};

function quoted(value) {
  // A cell that begins like a formula would be one in a spreadsheet.
  let text = value === undefined || value === null || Number.isNaN(value) ? "" : String(value);
  if (typeof value === "string" && /^[=+\-@\t\r]/.test(text)) text = "'" + text;
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** RFC 4180. Numbers keep all their digits. */
export function csvOf({ columns, rows }) {
  const lines = [columns.map((column) => quoted(column.csv ?? column.title)).join(",")];
  for (const row of rows) lines.push(columns.map((column) => quoted(column.value(row))).join(","));
  return lines.join("\r\n") + "\r\n";
}

function compare(a, b) {
  const empty = (v) => v === undefined || v === null || Number.isNaN(v);
  if (empty(a) || empty(b)) return empty(a) - empty(b);
  return typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });
}

/**
 * @param columns  {title, unit, value(row), show(value, row), node(row), number}
 * @param rows     anything
 * @param caption  read to those who do not see the page
 * @param onrow    called with a row that is clicked
 */
export function dataTable({ columns, rows, caption, name = "table", onrow, sortable = true, exportable = false, limit = page }) {
  let order = rows.slice();
  let sorted = null;
  let shown = limit;
  const body = h("tbody");
  const more = h("button", { type: "button", class: "more", onclick: () => { shown += 10 * page; fill(); } });
  const cell = (column, row) => {
    const content = column.node ? column.node(row) : textOf(column, row);
    return h(column.head ? "th" : "td", { class: column.number ? "number" : null, scope: column.head ? "row" : null }, content);
  };
  function fill() {
    body.replaceChildren(...order.slice(0, shown).map((row) => {
      const line = h("tr", onrow ? { class: "link", onclick: () => onrow(row) } : {}, columns.map((column) => cell(column, row)));
      return line;
    }));
    more.hidden = order.length <= shown;
    more.textContent = `Show more (${counted(order.length - shown, "row")} left)`;
  }
  const heads = columns.map((column, index) => {
    const label = [column.title, column.unit && h("span", { class: "unit" }, ` ${column.unit}`)];
    const head = h("th", { scope: "col", class: column.number ? "number" : null });
    if (!sortable) { head.append(...label.filter(Boolean)); return head; }
    head.append(h("button", {
      type: "button",
      onclick: () => {
        const descending = sorted?.index === index && !sorted.descending;
        sorted = { index, descending };
        order = rows.slice().sort((a, b) => compare(column.value(a), column.value(b)) * (descending ? -1 : 1));
        heads.forEach((each) => each.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", descending ? "descending" : "ascending");
        fill();
      },
    }, label));
    return head;
  });
  fill();
  const table = h("table", {}, h("caption", { class: caption ? "hidden" : "hidden" }, caption ?? name),
    h("thead", {}, h("tr", {}, heads)), body);
  return h("div", { class: "table-block" },
    exportable && h("div", { class: "tools right" },
      h("button", { type: "button", "aria-label": `${caption ?? name} as CSV`, onclick: () => download(name + ".csv", csvOf({ columns, rows: order }), "text/csv") }, "CSV")),
    h("div", { class: "table-scroll", tabindex: "0", role: "group", "aria-label": caption ?? name }, table), more);
}

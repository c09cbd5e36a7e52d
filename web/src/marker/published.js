// What the thesis states, by the id of data/published.csv.
import text from "../../../data/published.csv";

/** The rows of a CSV file as objects. */
export function parse(csv) {
  const rows = [];
  for (const line of csv.trim().split("\n")) {
    const cells = [];
    for (const match of line.matchAll(/("(?:[^"]|"")*"|[^,]*)(,|$)/g)) {
      cells.push(match[1].startsWith('"') ? match[1].slice(1, -1).replaceAll('""', '"') : match[1]);
      if (match[2] === "") break;
    }
    rows.push(cells);
  }
  const [head, ...rest] = rows;
  return rest.map((cells) => Object.fromEntries(head.map((name, index) => [name, cells[index] ?? ""])));
}

export const published = parse(text);
const byId = new Map(published.map((row) => [row.id, row]));

/** The number of a row; undefined if there is no such row. */
export function value(id) {
  const row = byId.get(id);
  return row && row.value !== "" ? Number(row.value) : undefined;
}
export const row = (id) => byId.get(id);

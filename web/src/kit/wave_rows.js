// The rows of a recorded trace: groups of lanes and signals, which open and close.
const groupOf = (name) => {
  if (/(^|\.)(function_name|handler_name|function|handler|in_handler)$/.test(name)) return "Software";
  if (/(^|[._])(irq|irq_f2p|introut|interrupt)|introut$|\.gic\./i.test(name)) return "Interrupts";
  return name.includes(".") ? name.slice(0, name.lastIndexOf(".")) : "Signals";
};

/** Whether a name has all words of the search. */
const fits = (name, search) => search.toLowerCase().split(/\s+/).every((word) => name.toLowerCase().includes(word));

/** What a reader looks for first comes first. */
const order = ["Transactions", "Software", "Interrupts"];
const rank = (group) => (order.includes(group) ? order.indexOf(group) : order.length);

export function rowsOf(waves) {
  const groups = new Map(order.map((name) => [name, []]));
  const add = (group, row) => (groups.get(group) ?? groups.set(group, []).get(group)).push(row);
  for (const lane of waves.lanes) add("Transactions", { ...lane, label: lane.name });
  for (const signal of waves.signals) {
    const group = groupOf(signal.name);
    add(group, { ...signal, label: rank(group) < order.length ? signal.name : signal.name.slice(signal.name.lastIndexOf(".") + 1) });
  }
  const all = [...groups].filter(([, rows]) => rows.length > 0).sort(([a], [b]) => rank(a) - rank(b));
  const roomy = 40; // rows that are open at first
  let open = 0;
  const opened = new Set(all.filter(([, rows]) => (open += rows.length) <= roomy || open === rows.length).map(([name]) => name));
  return {
    toggle(name) { if (!opened.delete(name)) opened.add(name); },
    isOpen: (name) => opened.has(name),
    /** Titles and rows, as they lie below each other; of a search all groups are open. */
    shown(search) {
      return all.flatMap(([title, rows]) => {
        const found = search ? rows.filter((row) => fits(row.name, search)) : rows;
        if (found.length === 0) return [];
        return [{ title, count: found.length }, ...(search || opened.has(title) ? found : [])];
      });
    },
  };
}

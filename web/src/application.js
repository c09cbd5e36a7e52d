// What an application adds to the pages: its entry point fills this in before one is shown.
export const application = {
  /** The drawing beside the name, a path in 6 x 6. */
  mark: "M0 0h6v6h-6zM1 1v4h4v-4zM2 2h2v2h-2z",
  /** Pages of data of its own: {id of the block: (data, block) => page}. */
  pages: {},
  /** Adds to what makeRun() knows of a run. */
  complete() {},
  /** Units a second that are fast enough; undefined: the design has no such limit. */
  realTime: undefined,
  /** What the frame rate leaves out. */
  excluded: "upload of inputs excluded",
  /** What belongs beside figures of the verdict: {fps, latency, power}. */
  beside: () => ({}),
  /** Further tiles of the verdict, as tile() takes them. */
  tiles: () => [],
  /** Further chips of the verdict: [[whether it is good, text]]. */
  chips: () => [],
  /** Says what was found: say(kind, text). */
  guidance() {},
  /** Sections behind the guidance. */
  sections: () => [],
  /** Columns of the table of units: {front, back}. `number` makes one of numbers; `run` has the table of figures. */
  columns: () => ({ front: [], back: [] }),
  /** Bars beside the stages of a run: {rows, note}. */
  stages: () => ({ rows: [] }),
  /** A chart beside the power of the modules. */
  energy: () => null,
};

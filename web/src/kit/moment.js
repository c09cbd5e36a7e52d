// A moment of the run that one part of the page points at and others show: {ps, frame}.
const listeners = new Set();

/** `listener` gets each moment, and who points at it. */
export const onMoment = (listener) => listeners.add(listener);

export function pointAt(moment, from) {
  for (const listener of listeners) listener(moment, from);
}

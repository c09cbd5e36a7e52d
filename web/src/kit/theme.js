// Light or dark, and the colours of charts: Okabe and Ito's, told apart with any colour vision, each in a shade
// that differs from its background.
const colours = {
  light: {
    blue: "#0072b2", sky: "#3a9bd0", green: "#008a64", orange: "#d98c00", vermilion: "#cf5a00", purple: "#b85f93",
    yellow: "#b8a400", grey: "#8a9099",
    ink: "#16191d", soft: "#565d66", faint: "#8a9099", line: "#e3e5e8", page: "#ffffff", raised: "#f6f7f8",
  },
  dark: {
    blue: "#4aa3df", sky: "#86c8ee", green: "#2fbf94", orange: "#eeb040", vermilion: "#f08050", purple: "#d894bb",
    yellow: "#e6d84a", grey: "#808892",
    ink: "#eceef1", soft: "#a9b0ba", faint: "#7c848f", line: "#2b3037", page: "#14171b", raised: "#1b1f24",
  },
};

const media = window.matchMedia("(prefers-color-scheme: dark)");
let chosen = null;
const listeners = new Set();

export const isDark = () => (chosen ? chosen === "dark" : media.matches);
export const palette = () => colours[isDark() ? "dark" : "light"];
export const onTheme = (listener) => listeners.add(listener);

function apply() {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  for (const listener of listeners) listener();
}

export function toggleTheme() {
  chosen = isDark() ? "light" : "dark";
  apply();
}

media.addEventListener("change", () => chosen || apply());
apply();

const shades = ["blue", "sky", "orange", "green", "purple", "vermilion", "yellow", "grey", "soft"];
const spare = ["blue", "orange", "green", "purple", "sky", "vermilion", "yellow", "grey"];
const stages = [];

/** Always the same colour for the same stage on a page. */
export function stageColour(name) {
  if (!stages.includes(name)) stages.push(name);
  return palette()[shades[stages.indexOf(name) % shades.length]];
}
export const seriesColour = (index) => palette()[spare[index % spare.length]];

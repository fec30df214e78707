// Colours of the page and the register of figures, which are drawn anew whenever the colours change.

/** Colour-blind-safe sequences (after Okabe and Ito) for tooth pairs and contact kinds, on white and on black. */
const SEQUENCES = {
  light: ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8a6d3b"],
  dark: ["#4c9fe6", "#f0b429", "#2bbd93", "#e29ac3", "#a3d9fb", "#f07a3c", "#c4a46a"],
};

const sequence_colour = (i) => {
  const sequence = SEQUENCES[document.documentElement.dataset.theme === "dark" ? "dark" : "light"];
  return sequence[i % sequence.length];
};

const css_colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** The given opacity applied to a #rrggbb colour. */
const faded = (colour, opacity) => colour + Math.round(opacity * 255).toString(16).padStart(2, "0");

/** The colour of a design, the same in all figures: one for "before", one for all others. */
const design_colour = (design) => css_colour(design === "before" ? "before" : "after");

const figures = [];
const live_charts = new Set();

/** Draws every figure anew, in the colours of the theme that holds now. */
function redraw_all() {
  Chart.defaults.color = css_colour("muted");
  Chart.defaults.borderColor = css_colour("grid");
  figures.forEach((redraw) => redraw());
}

function use_theme(name) {
  document.documentElement.dataset.theme = name;
  const button = document.getElementById("theme");
  button.textContent = name === "dark" ? "Light" : "Dark";
  button.title = `Switch to the ${button.textContent.toLowerCase()} colours`;
  redraw_all();
}

/** Follows the system's preference until the reader chooses; paper is always light. */
function start_theme() {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const preferred = () => (system.matches ? "dark" : "light");
  let chosen = null;
  let opened = [];
  const current = () => chosen || preferred();

  document.getElementById("theme").addEventListener("click", () => {
    chosen = current() === "dark" ? "light" : "dark";
    use_theme(chosen);
  });
  system.addEventListener("change", () => use_theme(current()));
  addEventListener("beforeprint", () => {
    opened = [...document.querySelectorAll("main details:not([open])")];
    opened.forEach((details) => (details.open = true));
    use_theme("light");
  });
  addEventListener("afterprint", () => {
    opened.forEach((details) => (details.open = false));
    use_theme(current());
  });
  use_theme(current());
}

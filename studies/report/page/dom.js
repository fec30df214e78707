// Elements, numbers, tables, figures. Text is always set as text, never parsed as markup.

const SVG = "http://www.w3.org/2000/svg";

function fill_element(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

const el = (tag, attributes = {}, ...children) => fill_element(document.createElement(tag), attributes, children);
const svg = (tag, attributes = {}, ...children) =>
  fill_element(document.createElementNS(SVG, tag), attributes, children);

const is_number = (x) => typeof x === "number" && Number.isFinite(x);
const list = (x) => (Array.isArray(x) ? x : []);
const record = (x) => (x !== null && typeof x === "object" && !Array.isArray(x) ? x : {});
const numbers = (values) => list(values).filter(is_number);
const maximum = (values) => numbers(values).reduce((a, b) => Math.max(a, b), -Infinity);
const minimum = (values) => numbers(values).reduce((a, b) => Math.min(a, b), Infinity);
const unique = (values) => [...new Set(values)];

/** 10 to an integer power, as it is printed. */
const power_of_ten = (power) => `10${[...String(power)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c])).join("")}`;

/** Sizes that are written with a power of ten. */
const takes_power = (size) => size < 1e-4 || size >= 1e7;

/** A number at `digits` significant digits, a true minus sign, no padding zeros; a dash for what did not run. */
function fmt(x, digits = 4) {
  if (typeof x === "string") return x;
  if (typeof x === "boolean") return x ? "yes" : "no";
  if (!is_number(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  let text = String(Number(x.toPrecision(digits)));
  if (size >= 10 ** digits && size < 1e7) text = String(Math.round(x));
  if (takes_power(size)) {
    const [mantissa, power] = x.toExponential(1).split("e");
    text = `${mantissa}·${power_of_ten(Number(power))}`;
  }
  return text.replace(/-/g, "−");
}

/** A number with so many decimals, a true minus sign, and no minus before a 0. */
function fixed(x, decimals) {
  if (!is_number(x)) return "–";
  const text = x.toFixed(Math.max(0, Math.min(decimals, 12)));
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** Decimals to which a value with this error is written: one digit of the error, two where it begins with 1. */
const error_decimals = (error) => {
  const power = Math.floor(Math.log10(error));
  return (error / 10 ** power < 1.95 ? 1 : 0) - power;
};

/** A number rounded to so many decimals, below 0 to tens or hundreds. */
const rounded = (x, decimals) => (decimals < 0 ? fixed(Math.round(x / 10 ** -decimals) * 10 ** -decimals, 0) : fixed(x, decimals));

/**
 * "0.28 ± 0.01", "1200 ± 300", "(2.7 ± 0.6)·10⁷": a value rounded to the size of its error, both written alike; without an error, at `digits`
 * significant digits.
 */
function with_error(value, error, digits = 3) {
  // With an error below the fifth digit the value is exact to all digits shown.
  if (!is_number(value) || !is_number(error) || !(error > 0)) return fmt(value, digits);
  if (error < 1e-5 * Math.abs(value)) return fmt(value, 5);
  const size = Math.max(Math.abs(value), error), decimals = error_decimals(error);
  if (!takes_power(size)) return `${rounded(value, decimals)} ± ${rounded(error, decimals)}`;
  const power = Math.floor(Math.log10(size) + 1e-12), places = decimals + power;
  return `(${rounded(value / 10 ** power, places)} ± ${rounded(error / 10 ** power, places)})·${power_of_ten(power)}`;
}

/** A value and its unit; the value alone where the unit is that of a plain number. */
const in_unit = (text, unit) => (unit ? `${text} ${unit}` : `${text}`);

/** A time in its usual unit. */
const time_text = (s) => (!is_number(s) ? "–" : s < 0.1 ? `${fmt(1000 * s, 2)} ms` : s < 100 ? `${fmt(s, 2)} s` : s < 6000 ? `${fmt(s / 60, 2)} min` : `${fmt(s / 3600, 2)} h`);

/** Units as they are printed: um -> µm, Nm -> N·m; nothing for the "1" of a plain number. */
const pretty_unit = (unit) =>
  (typeof unit === "string" && unit !== "1" ? unit : "").replace(/\bum\b/g, "µm").replace(/\bNm\b/g, "N·m").replace(/\bdegC\b/g, "°C").replace(/^deg$/, "°").replace(/\^2\b/g, "²");

/** Plain names of keys and outputs, key -> {name, symbol, sense}, in the order of tables; they are stored in the page with the results. */
const NAMES = new Map();

function learn_names(names) {
  for (const [key, name, symbol, sense] of list(names)) NAMES.set(key, { name, symbol, sense });
}

/** The summary quantities of a loaded cycle, in the order of tables: {key, name, unit, topic, is_list, is_headline, has_error, smaller_is_worse}. */
const QUANTITIES = [];

function learn_quantities(quantities) {
  QUANTITIES.push(...list(quantities).map((of) => ({ ...of, unit: pretty_unit(of.unit) })));
}

/** A quantity's number in a summary, a list's first; with `suffix` "_error" its estimated error. */
const quantity_in = (summary, of, suffix = "") => (of.is_list ? list(summary[of.key + suffix])[0] : summary[of.key + suffix]);

/** A key, or a sum of keys, in words of the field. */
function words(text) {
  const of_word = (word) => NAMES.get(word)?.name ?? (/^\p{L}/u.test(word) ? word.replace(/_/g, " ").replace(/(\p{L})\.(?=\p{L})/gu, "$1 ") : word);
  return (typeof text === "string" ? text : "objective").split(" ").map(of_word).join(" ");
}

/** Plain text with the field's symbols: "0.1 b and m_n, 10 um" -> 0.1 b and mₙ, 10 µm. */
const in_symbols = (text) => text.replace(/\bm_n\b/g, "mₙ").replace(/\bum\b/g, "µm");

/** A label with its subscripts set: "K_Hβ at mid face" -> K, sub Hβ, at mid face. */
const symbols = (label) => el("span", {},
  ...label.split(/_(\p{L}+)/u).map((part, i) => (i % 2 ? el("sub", {}, part) : part)));

/** The same within a drawing's text; the dy after a subscript leads back to its line. */
const subscripts = (label) => label.split(/_(\p{L}+)/u).map((part, i) =>
  (i === 0 ? part : svg("tspan", i % 2 ? { dy: "0.25em", "font-size": "80%" } : { dy: "-0.2em" }, part)));

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** A fall of nearly 100 %, with one decimal or two and never rounded up to it. */
function nearly_all(percent) {
  if (percent === 100) return "100";
  return percent < 99.95 ? fixed(percent, 1) : fixed(Math.min(percent, 99.99), 2);
}

/** Change from a to b in per cent with its sign, or nothing where it has no meaning. */
function percent_change(a, b) {
  if (!is_number(a) || !is_number(b) || a === 0) return null;
  const percent = ((b - a) / Math.abs(a)) * 100;
  const size = Math.abs(percent);
  const text = percent < 0 && size >= 99.5 && size <= 100 ? nearly_all(size) : size < 10 || size >= 1e7 ? fmt(size, 2) : Math.round(size);
  return `${percent > 0 ? "+" : percent < 0 ? "−" : "±"}${text} %`;
}

// Text that a spreadsheet would take for a formula is kept as text by a leading apostrophe.
function csv_cell(value) {
  const text = value === null || value === undefined ? "" : String(value);
  const safe = typeof value === "string" && /^[=+@\t\r-]/.test(text) ? `'${text}` : text;
  return /[",\n]/.test(safe) ? `"${safe.replace(/"/g, '""')}"` : safe;
}

async function copy_text(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = el("textarea", { class: "offscreen" });
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}

/**
 * A titled table with a button that copies it as CSV.
 * @param columns  [{label, unit?, digits?}]; unit goes into the heading
 * @param rows     cells: number, string, boolean, null, or {text, value?, class?, draw?}
 */
function table(parent, { title, columns, rows, note }) {
  const heading = (column) => (column.unit ? `${column.label} [${column.unit}]` : column.label);
  const plain = (cell) => (cell !== null && typeof cell === "object" ? (cell.value ?? cell.text) : cell);
  const is_numeric = (i) => rows.some((row) => is_number(plain(row[i]))) && !rows.some((row) => {
    const value = plain(row[i]);
    return typeof value === "string" && value !== "";
  });
  const numeric = columns.map((_, i) => is_numeric(i));
  const csv = () => [columns.map(heading), ...rows.map((row) => row.map(plain))]
    .map((row) => row.map(csv_cell).join(",")).join("\n");

  const button = el("button", { type: "button", class: "button small no-print" }, "Copy as CSV");
  button.addEventListener("click", async () => {
    await copy_text(csv());
    button.textContent = "Copied";
    setTimeout(() => (button.textContent = "Copy as CSV"), 1500);
  });
  const cell_element = (cell, i) => {
    const rich = cell !== null && typeof cell === "object" ? cell : { text: fmt(cell, columns[i].digits) };
    const node = el("td", { class: [numeric[i] ? "number" : "", rich.class || ""].join(" ").trim() || null });
    node.append(rich.draw ? rich.draw() : (rich.text ?? "–"));
    return node;
  };
  parent.append(el("div", { class: "card table-card" },
    el("div", { class: "card-head" }, el("h3", {}, title), button),
    note ? el("p", { class: "caption" }, note) : null,
    el("div", { class: "scroll" }, el("table", {},
      el("thead", {}, el("tr", {}, ...columns.map((column, i) =>
        el("th", { scope: "col", class: numeric[i] ? "number" : null }, symbols(column.label),
          column.unit ? el("span", { class: "unit" }, ` [${column.unit}]`) : null)))),
      el("tbody", {}, ...rows.map((row) => el("tr", {}, ...row.map(cell_element))))))));
}

/** Empties a plot and releases the charts in it. */
function clear_plot(plot) {
  for (const chart of [...live_charts]) {
    if (!plot.contains(chart.canvas)) continue;
    chart.destroy();
    live_charts.delete(chart);
  }
  plot.replaceChildren();
}

/**
 * A titled figure with one sentence under it. draw(plot) is called now and whenever the colours change.
 * @return function that draws the figure anew
 */
function figure(parent, { title, caption, wide = false }, draw) {
  const plot = el("div", { class: "plot" });
  const card = el("figure", { class: wide ? "card wide" : "card" },
    el("div", { class: "card-head" }, el("h3", {}, title)), plot, el("figcaption", { class: "caption" }, caption));
  const redraw = () => {
    clear_plot(plot);
    draw(plot);
  };
  parent.append(card);
  figures.push(redraw);
  return redraw;
}

const figure_grid = (parent) => parent.appendChild(el("div", { class: "figures" }));

/** A labelled choice; calls back with the value of the option taken. */
function choice(label, options, value, on_change) {
  const select = el("select", {}, ...options.map((option) => el("option", { value: option.value }, option.label)));
  select.value = value;
  select.addEventListener("change", () => on_change(select.value));
  return { node: el("label", { class: "choice" }, `${label} `, select), select };
}

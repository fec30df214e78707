// The headline in plain words, the verdict, and the key numbers.

const plural = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

const COUNTS = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"];
const count_words = (count) => COUNTS[count] ?? String(count);

function loaded_headline(cases, results) {
  const worst = (key) => maximum(cases.map((load_case) => summary_of(final_entry(load_case))[key]));
  const stress = worst("peak_contact_stress_MPa"), te = worst("te_peak_to_peak_um");
  const parts = [];
  if (is_number(stress)) parts.push(`peak contact stress ${fmt(stress, 3)} MPa`);
  if (is_number(te)) parts.push(`peak-to-peak TE ${fmt(te, 3)} µm`);
  if (asks_for_te(results)) parts.reverse();
  if (parts.length === 0) return "The loaded contact was not obtained";
  const torques = unique(cases.map((load_case) => load_case.torque)).filter(is_number);
  const where = cases.length > 1 ? `: the worst of ${count_words(cases.length)} load cases`
    : torques.length === 1 ? ` at ${fmt(torques[0])} N·m` : "";
  return capital(parts.join(" and ")) + where;
}

/** The scene of the unloaded contact with the largest transmission error. */
function worst_unloaded(scenes) {
  const size = ({ data }) => record(data.mesh).peak_to_peak_arcsec ?? -Infinity;
  return scenes.reduce((worst, scene) => (size(scene) > size(worst) ? scene : worst));
}

function unloaded_headline(results) {
  const te = record(worst_unloaded(unloaded_scenes(results)).data.mesh).peak_to_peak_arcsec;
  const count = unloaded_scenes(results).length;
  if (!is_number(te)) return "Unloaded tooth contact of the pair";
  // Below a millionth of an arcsec there is nothing but round-off.
  if (te < 1e-6) return "Without load the pair runs free of transmission error";
  return `Unloaded TE ${fmt(te, 3)} arcsec peak to peak at the wheel${count > 1 ? `: the worst of ${count_words(count)} scenes` : ""}`;
}

/** A tile: label, value with unit, and a small second line. before → value where before is given. */
function tile(label, value, unit, { before, detail, error, digits = 3 } = {}) {
  const has_before = is_number(before) && is_number(value);
  const change = has_before ? percent_change(before, value) : null;
  const second = has_before ? `from ${fmt(before, digits)}${change ? `, ${change}` : ""}` : detail;
  return el("div", { class: "tile" },
    el("span", { class: "label" }, symbols(label)),
    el("span", { class: "value" }, with_error(value, error, digits), unit ? el("small", {}, ` ${unit}`) : ""),
    second ? el("span", { class: "detail" }, second) : null);
}

/** The largest of a summary's figure over the load cases {value, error, load_case}; null where none has it. */
function worst_of(cases, key, design) {
  const found = cases.map((load_case) => ({ load_case, summary: summary_of(design ? load_case.designs[design] : final_entry(load_case)) }))
    .filter(({ summary }) => is_number(summary[key]));
  if (found.length === 0) return null;
  const { load_case, summary } = found.reduce((a, b) => (b.summary[key] > a.summary[key] ? b : a));
  return { value: summary[key], error: summary[`${key}_error`], load_case };
}

function loaded_tiles(cases) {
  return QUANTITIES.filter((of) => of.is_headline && !of.is_list && !of.smaller_is_worse).map(({ key, name, unit }) => {
    const worst = worst_of(cases, key);
    if (!worst) return null;
    return tile(capital(name), worst.value, unit, { error: worst.error, before: worst_of(cases, key, "before")?.value,
      detail: cases.length > 1 ? worst.load_case.label : null });
  }).filter((made) => made !== null);
}

function pair_tiles(results) {
  const geometry = record(results.geometry), mesh = record(worst_unloaded(unloaded_scenes(results)).data.mesh);
  const tiles = [];
  if (!list(results.loaded).length && is_number(mesh.peak_to_peak_arcsec)) {
    tiles.push(tile("Peak-to-peak TE", mesh.peak_to_peak_arcsec, "arcsec", { detail: "unloaded, at the wheel" }));
    if (is_number(mesh.peak_to_peak_um)) {
      tiles.push(tile("Peak-to-peak TE", mesh.peak_to_peak_um, "µm", { detail: "along the line of action" }));
    }
  }
  const add = (label, value, unit) => is_number(value) && tiles.push(tile(label, value, unit));
  add("Contact ratio ε_γ", geometry.total_contact_ratio, "");
  if (!list(results.loaded).length) {
    add("Transverse ε_α", geometry.transverse_contact_ratio, "");
    add("Overlap ε_β", geometry.overlap_ratio, "");
    add("Backlash", geometry.backlash_um, "µm");
  }
  return tiles;
}

function analysis_headline(results, cases) {
  return cases.length > 0 ? loaded_headline(cases, results) : results.unloaded ? unloaded_headline(results) : "No analysis is stored in these results";
}

function draw_summary(results, cases) {
  document.getElementById("headline").textContent = task_part(results, "headline")(results, cases);
  const version = results.version ? `Flankwright ${results.version}` : null;
  document.getElementById("origin").textContent = [results.task, `${results.file ?? ""}`.split("/").pop(), version].filter(Boolean).join("  ·  ");
  const verdict = document.getElementById("verdict"), edges = edge_contact_sentence(cases);
  if (edges) verdict.append(el("p", { class: "banner", id: "tip-edges" }, edges));
  task_part(results, "verdict")?.(results, verdict);
  document.getElementById("tiles").append(...task_part(results, "tiles")(results, cases));
}

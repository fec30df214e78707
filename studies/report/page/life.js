// The load spectrum and what it does to the life of the pair: torque over time, damage and safety of each load case, film, and all of it in numbers.

/** Damage below this does not count: a millionth of what is borne. */
const LEAST_DAMAGE = 1e-6;
const MOST_LIFE_ROWS = 60;

const LIFE_GEARS = ["pinion", "wheel"];

/** Options of an axis in decades: at most nine ticks, all of them at powers of ten. */
function decades(low, high) {
  const from = Math.floor(Math.log10(low) + 1e-9), to = Math.ceil(Math.log10(high) - 1e-9), every = Math.max(1, Math.ceil((to - from) / 8));
  const ticks = [];
  for (let power = from; power <= to; power += every) ticks.push({ value: 10 ** power });
  return { type: "logarithmic", min: 10 ** from, max: 10 ** to, beginAtZero: false, afterBuildTicks: (axis) => (axis.ticks = ticks),
    ticks: { callback: (value) => power_of_ten(Math.round(Math.log10(value))), autoSkip: false } };
}

/** Load cases of one scene and design, in the order of the spectrum. */
const life_cases = (life, scene, design) => list(life.cases).map(record).filter((of) => of.scene === scene && of.design === design);

/** The life of a load case and design that the page shows; empty where there is none. */
const life_of = (life, entry) => life_cases(life, entry.scene, entry.design)
  .find((of) => (of.bin ?? null) === (entry.bin ?? null) && of.torque_Nm === entry.torque_Nm) ?? {};

const spectrum_of = (life, scene, design) => list(life.spectra).map(record).find((of) => of.scene === scene && of.design === design);

const has_number = (life, value_of) => list(life.cases).map(record).some((of) => is_number(value_of(of)));

/** A figure of one scene that follows the selection. */
function scene_figure(parent, selection, options, draw) {
  const redraw = figure(parent, options, (plot) => {
    if (unique(selection.cases.map(({ scene }) => scene)).length > 1) plot.append(el("p", { class: "shown" }, `Scene: ${selection.current.scene}`));
    draw(plot, selection.current.scene, designs_of(selection.current));
  });
  selection.listeners.push(redraw);
  return redraw;
}

/** Torque over the time or the revolutions that it is reached or exceeded, the largest first. */
function draw_spectrum(plot, life, scene, design) {
  const cases = [...life_cases(life, scene, design)].sort((a, b) => b.torque_Nm - a.torque_Nm);
  const by_hours = cases.every((of) => is_number(of.hours)), length_of = (of) => (by_hours ? of.hours : of.cycles);
  const unit = by_hours ? "h" : "revolutions", total = cases.reduce((sum, of) => sum + length_of(of), 0);
  if (!(total > 0)) return;
  const in_decades = total > 100 * length_of(cases[0]), begin = in_decades ? 10 ** Math.floor(Math.log10(0.5 * length_of(cases[0]))) : 0;
  const points = [], labels = [];
  let sum = 0;
  for (const of of cases) {
    const from = Math.max(begin, sum), to = (sum += length_of(of)), note = `${fmt(length_of(of), 3)} ${unit}`;
    points.push({ x: from, y: of.torque_Nm, note }, { x: to, y: of.torque_Nm, note });
    labels.push({ x: in_decades ? Math.sqrt(from * to) : 0.5 * (from + to), y: of.torque_Nm, text: `${fmt(of.torque_Nm)} N·m, ${note}`, above: true });
  }
  points.push({ x: sum, y: 0 });
  xy_chart(plot, {
    label: "Torque of the load spectrum", curves: [{ label: "Torque", points, colour: css_colour("after"), width: 2.6 }], labels,
    x: by_hours ? "duration with at least this torque [h]" : "pinion revolutions with at least this torque", y: "pinion torque [N·m]",
    x_range: in_decades ? decades(begin, sum) : { min: 0, max: sum }, y_range: { beginAtZero: true, suggestedMax: 1.15 * cases[0].torque_Nm },
    read_x: (x) => `up to ${fmt(x, 3)} ${unit}`, read_y: (y) => `${fmt(y)} N·m`,
  });
}

/** Bars of a quantity of both gears in each load case, before and after. @param sums  a last group, {design, gear} -> value */
function draw_life_bars(plot, life, scene, designs, { value_of, gears = LIFE_GEARS, sums, label, y, in_decades }) {
  const cases = life_cases(life, scene, designs[0]);
  const series = designs.flatMap((design) => gears.map((gear) => {
    const values = life_cases(life, scene, design).map((of) => value_of(of, gear) ?? null);
    const name = [gears.length > 1 ? capital(gear) : null, design === "given" ? null : DESIGN_LABEL[design].toLowerCase()].filter(Boolean).join(" ");
    return { label: capital(name) || DESIGN_LABEL[design], values: sums ? [...values, sums(design, gear) ?? null] : values,
      colour: gear === "wheel" ? faded(design_colour(design), 0.5) : design_colour(design) };
  })).filter((of) => numbers(of.values).length > 0);
  const labels = [...cases.map((of) => `${fmt(of.torque_Nm)}`), ...(sums ? ["sum"] : [])];
  const highest = maximum(series.flatMap((of) => of.values));
  if (in_decades) for (const of of series) of.values = of.values.map((value) => (value >= LEAST_DAMAGE ? value : null));
  bar_chart(plot, { label, labels, series, x: "pinion torque [N·m]", y, unit: "", height: 250, y_range: in_decades ? decades(LEAST_DAMAGE, Math.max(1, highest)) : {} });
}

const DAMAGE_CAPTION = "Part of each load case in the damage of the point that the spectrum damages most, by Palmgren and Miner; 1 is failure. Fainter bars are the wheel's.";

/** What each figure of bars shows, where the results have it. */
const LIFE_BARS = [
  { key: "contact_damage", title: "Contact damage of each load case", y: "damage [-]", in_decades: true, caption: DAMAGE_CAPTION, part: "contact" },
  { key: "root_damage", title: "Root damage of each load case", y: "damage [-]", in_decades: true, caption: DAMAGE_CAPTION, part: "root" },
  { key: "contact_safety", title: "Contact safety", y: "safety [-]",
    caption: "Stress that is borne for the load cycles of the case, the endurance limit where they are not given, over the largest contact stress. Fainter bars are the wheel's." },
  { key: "root_safety", title: "Root safety", y: "safety [-]",
    caption: "Stress that is borne for the load cycles of the case, the endurance limit where they are not given, over the largest stress of the fillet. Fainter bars are the wheel's." },
  { key: "specific_film_thickness", title: "Film thickness", y: "λ_GF [-]", of_pair: true,
    caption: "Least film thickness over the roughness anywhere on flank and tip edge, ISO/TS 6336-22, method A." },
  { key: "micropitting_safety", title: "Safety against micropitting", y: "safety [-]", of_pair: true, caption: "Least film thickness over the permissible one." },
];

function life_bars(body, grid, life, selection) {
  for (const { key, title, y, caption, in_decades, part, of_pair } of LIFE_BARS) {
    const value_of = of_pair ? (of) => of[key] : (of, gear) => record(of[gear])[key];
    const values = list(life.cases).map(record).flatMap((of) => numbers(LIFE_GEARS.map((gear) => value_of(of, gear))));
    if (values.length === 0) continue;
    if (in_decades && maximum(values) < LEAST_DAMAGE) {
      body.append(el("p", { class: "remark" }, `${title.split(" of ")[0]} is below ${power_of_ten(-6)} in every load case and scene. It does not limit the life.`));
      continue;
    }
    const sums = part ? (design, gear, scene) => record(record(record(spectrum_of(life, scene, design))[gear])[part]).damage : null;
    scene_figure(grid, selection, { title, caption }, (plot, scene, designs) => draw_life_bars(plot, life, scene, designs,
      { value_of, label: title, y, in_decades, gears: of_pair ? ["pinion"] : LIFE_GEARS, sums: sums ? (design, gear) => sums(design, gear, scene) : null }));
  }
}

/** The sum over each spectrum and where it is. */
function spectra_table(body, life) {
  const rows = list(life.spectra).map(record).flatMap((of) => LIFE_GEARS.map((gear) => {
    const contact = record(record(of[gear]).contact), root = record(record(of[gear]).root);
    const exceeded = contact.exceeds_static_limit || root.exceeds_static_limit;
    return [`${of.scene}`, { text: DESIGN_LABEL[of.design] ?? `${of.design}`, class: "word" }, gear, contact.damage ?? null, contact.z_mm ?? null, contact.radius_mm ?? null,
      root.damage ?? null, root.z_mm ?? null, { text: exceeded ? "exceeded" : "kept", class: exceeded ? "bad" : "" }];
  })).filter((row) => is_number(row[3]) || is_number(row[6]));
  if (rows.length === 0) return;
  table(body, { title: "Damage over the spectrum", note: "Of the point of each gear that the spectrum damages most; 1 is failure.",
    columns: [{ label: "Scene" }, { label: "Design" }, { label: "Gear" }, { label: "Contact damage", digits: 3 }, { label: "at z", unit: "mm" }, { label: "radius", unit: "mm", digits: 5 },
      { label: "Root damage", digits: 3 }, { label: "at z", unit: "mm" }, { label: "Static limit" }], rows });
}

/** The material of each gear as given, and the S-N curves as used. */
function strength_table(body, life) {
  const rows = LIFE_GEARS.flatMap((gear) => {
    const of = record(life[gear]), strength = record(of.strength);
    const material = strength.kind ? `${strength.kind.replace(/_/g, " ")}, ${strength.quality}, ${fmt(strength.hardness)} ${strength.hardness_scale}` : "–";
    return [["flank", "contact_sn_curve", "sigma_Hlim_MPa", "contact_limit_from"], ["root", "root_sn_curve", "sigma_Flim_MPa", "root_limit_from"]]
      .filter(([, curve]) => of[curve]).map(([where, curve, limit, from]) => [`${gear}, ${where}`, material, strength[limit] ?? null, strength[from] ?? "endurance limit of the study",
        ...["limit_MPa", "knee_cycles", "exponent", "exponent_beyond", "static_limit_MPa"].map((key) => of[curve][key] ?? null)]);
  });
  if (rows.length === 0) return;
  table(body, { title: "Strength, as given and as used",
    note: "ISO 6336-5 has σ_Hlim of the flank and σ_Flim of the root. The S-N curve of a root is that of the fillet's own stress, whose limit is twice σ_Flim.",
    columns: [{ label: "Gear" }, { label: "Material" }, { label: "ISO 6336-5", unit: "MPa" }, { label: "Limit used" }, { label: "S-N limit", unit: "MPa" }, { label: "at cycles" },
      { label: "Exponent" }, { label: "below the limit" }, { label: "Static limit", unit: "MPa" }], rows });
}

/** Every load case in numbers, without the columns that nothing is known of. */
function life_table(body, life) {
  const of_both = (key, pick) => (of) => {
    const values = numbers(LIFE_GEARS.map((gear) => record(of[gear])[key]));
    return values.length > 0 ? pick(values) : null;
  };
  const bare = (cell) => (cell !== null && typeof cell === "object" ? cell.value : cell);
  const known_to = (key) => (of) => {
    const value = of[key], error = of[`${key}_error`];
    return is_number(value) && is_number(error) ? { value, text: with_error(value, error, 3) } : value;
  };
  const overload_of = (of) => {
    const { K_A, K_v } = record(of.iso6336);
    return K_A * K_v > 1 ? K_A * K_v : null;
  };
  const least = (key) => of_both(key, minimum), most = (key) => of_both(key, maximum);
  const known = (quantities) => quantities.filter(([, , value_of]) => has_number(life, (of) => bare(value_of(of))));
  const of_strength = known([["Revolutions", "", (of) => of.cycles, 3], ["K_A·K_v", "", overload_of, 3], ["Contact damage", "", most("contact_damage"), 3], ["Root damage", "", most("root_damage"), 3],
    ["Contact safety", "", least("contact_safety"), 3], ["Root safety", "", least("root_safety"), 3], ["S_H", "", least("S_H"), 3], ["S_F", "", least("S_F"), 3]]);
  const of_oil = known([["Loss factor", "", known_to("loss_factor"), 3], ["Loss", "W", known_to("loss_power_W"), 3], ["Film λ_GF", "", known_to("specific_film_thickness"), 3],
    ["Micropitting safety", "", known_to("micropitting_safety"), 3], ["Contact temperature", "°C", known_to("contact_temperature_degC"), 3],
    ["Flash temperature", "K", known_to("flash_temperature_K"), 3], ["Scuffing safety", "", known_to("scuffing_safety"), 3]]);
  const cases = list(life.cases).map(record), rest = cases.length - MOST_LIFE_ROWS;
  const more = rest > 0 ? ` ${rest} load cases more are in life.csv.` : "";
  const load_factors_from = (of) => `${record(of.iso6336).K_from}`, are_mixed = new Set(cases.map(load_factors_from)).size > 1;
  const numbers_table = (title, note, quantities, last = []) => {
    if (quantities.length === 0) return;
    table(body, { title, note: `${note}${more}`,
      columns: [...case_columns, ...quantities.map(([label, unit, , digits]) => ({ label, unit, digits })), ...last.map(({ label }) => ({ label }))],
      rows: cases.slice(0, MOST_LIFE_ROWS).map((of) => [`${of.scene}`, of.torque_Nm ?? null, { text: DESIGN_LABEL[of.design] ?? `${of.design}`, class: "word" },
        ...quantities.map(([, , value_of]) => value_of(of) ?? null), ...last.map(({ cell }) => cell(of))]) });
  };
  numbers_table("Strength in numbers", "The worse of both gears. S_H is that of ISO 6336-2:2019, S_F that of ISO 6336-3:2006, both by method B; f_ZCa and Y_DT are 1.", of_strength,
    are_mixed ? [{ label: "K_H of S_H, S_F", cell: (of) => ({ text: load_factors_from(of), class: "word" }) }] : []);
  numbers_table("Loss, film and temperatures in numbers", "± is the estimated discretisation error where it is available.", of_oil);
}

/** Value and error of a design's worst load case or scene: [value, error, gear or null]; null where nothing is known. */
function worst_of_life(entries, is_worse) {
  const known = entries.filter(([value]) => is_number(value));
  return known.length === 0 ? null : known.reduce((a, b) => (is_worse(b[0], a[0]) ? b : a));
}

/**
 * The life of the final design for the first screen, with that before: damage over the spectrum, without one the least safety of flank and root; safety against
 * micropitting and scuffing. Each is the worst over scenes, load cases and gears.
 * @param said  names of outputs that the screen has elsewhere
 */
function life_facts(results, said = []) {
  const life = record(results.life), cases = list(life.cases).map(record), spectra = list(life.spectra).map(record);
  const last = ["after", "given"].find((design) => cases.some((of) => of.design === design));
  const larger = (a, b) => a > b, smaller = (a, b) => a < b;
  const sums = (part) => (design) => spectra.filter((of) => of.design === design)
    .flatMap((of) => LIFE_GEARS.map((gear) => [record(record(of[gear])[part]).damage, record(record(of[gear])[part]).damage_error, gear]));
  const of_gears = (key) => (design) => cases.filter((of) => of.design === design).flatMap((of) => LIFE_GEARS.map((gear) => [record(of[gear])[key], null, gear]));
  const of_pair = (key) => (design) => cases.filter((of) => of.design === design).map((of) => [of[key], of[`${key}_error`], null]);
  const row = (name, output, values, is_worse, is_bad) => {
    const worst = last && !said.includes(output) ? worst_of_life(values(last), is_worse) : null;
    if (!worst) return null;
    const [value, error, gear] = worst, before = last === "after" ? worst_of_life(values("before"), is_worse) : null;
    const could_be = value + (is_number(error) ? error : 0), is_unknown = is_number(error) && error > Math.abs(value);
    const shown = is_worse === larger && could_be < LEAST_DAMAGE ? `below ${power_of_ten(-6)}`
      : is_unknown ? `not known at this resolution (${with_error(value, error, 3)})` : with_error(value, error, 3);
    return [name, `${before ? `${fmt(before[0], 3)} → ` : ""}${shown}${gear ? `, ${gear}` : ""}`, is_bad(value) ? "bad" : null];
  };
  const has_sums = spectra.some((of) => of.design === last);
  const fails = (value) => value > 1, too_small = (value) => value < 1;
  return [
    has_sums ? row("Damage of the flank", "contact_damage", sums("contact"), larger, fails) : row("Safety of the flank", "contact_safety", of_gears("contact_safety"), smaller, too_small),
    has_sums ? row("Damage of the root", "root_damage", sums("root"), larger, fails) : row("Safety of the root", "root_safety", of_gears("root_safety"), smaller, too_small),
    row("Safety against micropitting", "micropitting_safety", of_pair("micropitting_safety"), smaller, too_small),
    row("Safety against scuffing", "scuffing_safety", of_pair("scuffing_safety"), smaller, too_small),
  ].filter(Boolean);
}

function build_life(results, body, selection) {
  const life = record(results.life);
  const controls = el("div", { class: "controls" });
  body.append(controls);
  selection.add_choice(controls);
  const grid = figure_grid(body);
  if (list(life.spectra).length > 0) {
    scene_figure(grid, selection, { title: "Load spectrum", wide: true,
      caption: "Each torque of the pinion over the time that it is reached or exceeded. Times without load are left out." },
    (plot, scene, designs) => draw_spectrum(plot, life, scene, designs[0]));
  }
  flank_life(grid, controls, life, selection);
  life_bars(body, grid, life, selection);
  spectra_table(body, life);
  life_table(body, life);
  strength_table(body, life);
}

add_sections({ life: build_life });

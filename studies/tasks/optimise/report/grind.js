// Modifications to grind: before and after, rounded to the steps of the machine, and the resulting topography.

/** The grinding step where the study gives none. */
const DEFAULT_STEP = { um: 0.1, mm: 0.1, 1: 0.01 };

const given_value = (results, key) => list(results.given).map(record).find((given) => given.key === key)?.value;

/** The step to which a modification is ground, in its unit: the variable's own, that of the study, or a tenth. */
function grinding_step(results, key, unit) {
  const own = Number(given_value(results, `optimise.variables.${key}.step`));
  if (own > 0) return own;
  const common = unit === "um" ? Number(given_value(results, "optimise.step")) : NaN;
  return common > 0 ? common : DEFAULT_STEP[unit] ?? null;
}

/** A value on the grid of a step, with no more decimals than the step has; without a step at three digits. */
function ground(value, step) {
  if (!is_number(value) || !(step > 0)) return fmt(value, 3);
  if (Math.round(value / step) === 0) return "0";
  const decimals = [0, 1, 2, 3].find((places) => Math.abs(step * 10 ** places - Math.round(step * 10 ** places)) < 1e-9) ?? 4;
  return fixed(Math.round(value / step) * step, decimals);
}

/**
 * All modifications to grind: [{gear, key, before, after, unit, step, given, bound}] in the order of the names. Left out: given amounts that
 * are 0, and heights and lengths of reliefs that are not ground.
 */
function grinding_rows(results) {
  const optimise = record(results.optimise), before = record(optimise.before), after = record(optimise.after);
  const units = { ...record(before.variable_units), ...record(after.variable_units) };
  const from = { ...record(before.variables), ...record(before.tied) }, to = { ...record(after.variables), ...record(after.tied) };
  const is_modification = (key) => /^(pinion|wheel)\.modification\./.test(key);
  const kept = list(results.given).map(record).filter(({ key }) => is_modification(`${key}`) && !(key in to));
  // The governing bounds are those of the optimum before choices, steps and scatter: the design that is ground has its own.
  const at_bound = (key, value, step) => {
    const range = `${given_value(results, `optimise.variables.${key}.range`) ?? given_value(results, `optimise.variables.${key}`) ?? ""}`;
    const [low, high] = (/^\[([^,\]]+),([^,\]]+)\]$/.exec(range)?.slice(1) ?? []).map((bound) => Number(bound.replace(/^\s*"|\s*(um)?"\s*$/g, "")));
    if (!Number.isFinite(low) || !Number.isFinite(high) || !is_number(value)) return undefined;
    const near = Math.max(0.5 * (step ?? 0), 1e-4 * (high - low));
    return Math.abs(value - low) < near ? "lower" : Math.abs(value - high) < near ? "upper" : undefined;
  };
  const rows = [
    ...Object.keys(to).map((key) => {
      const step = grinding_step(results, key, units[key]);
      return { key, before: from[key], after: to[key], unit: units[key], step, bound: at_bound(key, to[key], step) };
    }),
    ...kept.map(({ key, value, unit }) => {
      const number = Number(value);
      return Number.isFinite(number) ? { key, before: number, after: number, unit, step: null, given: true }
        : { key, text: `${value}`.replace(/^"|"$/g, ""), unit: "", given: true };
    }),
  ];
  const is_nothing = (row) => ["before", "after"].every((side) => !(Math.abs(row[side]) >= 0.5 * (row.step ?? 1e-9)));
  const amount_of = (key) => rows.find((row) => row.key === key.replace(/\.(height|length|shape)$/, ".amount"));
  const is_gone = (row) => !(Math.abs(row.after) >= 0.5 * (row.step ?? 1e-9));
  const shown = rows.filter((row) => {
    const amount = amount_of(row.key);
    if (amount && amount !== row) return !is_gone(amount);
    return !row.given || row.text !== undefined || !is_nothing(row);
  });
  const order = [...NAMES.keys()], place = (key) => (order.includes(key) ? order.indexOf(key) : order.length);
  return shown.map((row) => ({ ...row, gear: row.key.split(".")[0] })).sort((a, b) => place(a.key) - place(b.key));
}

/** Start of a relief as on drawings: "from d_Ca 219.8 mm". */
function relief_start(results, row) {
  const gear = record(record(results.geometry)[row.gear]), height = Number(ground(row.after, row.step ?? 1e-3));
  if (/tip_relief\.height$/.test(row.key) && is_number(gear.tip_form_diameter_mm)) return `from d_Ca ${fixed(gear.tip_form_diameter_mm - 2 * height, 2)} mm`;
  if (/root_relief\.height$/.test(row.key) && is_number(gear.active_root_diameter_mm)) return `up to d_Cf ${fixed(gear.active_root_diameter_mm + 2 * height, 2)} mm`;
  return null;
}

/** "pinion tip relief" -> "Tip relief" below the pinion's heading. */
const without_gear = (key, gear) => capital(words(key).replace(new RegExp(`^${gear} `), ""));

function grinding_table(plot, results) {
  const rows = grinding_rows(results);
  if (rows.length === 0) return plot.append(el("p", { class: "empty" }, "No modification is varied."));
  const body = [];
  for (const [i, gear] of unique(rows.map((row) => row.gear)).entries()) {
    body.push(el("tr", { class: "group" }, el("th", { colspan: 2, scope: "rowgroup" }, capital(gear)),
      ...["before", "grind"].map((design) => el("th", { class: "number" }, i === 0 ? design : "")), el("th")));
    for (const row of rows.filter((own) => own.gear === gear)) {
      const name = NAMES.get(row.key) ?? {}, tells = [name.sense && !/^Legendre/.test(name.sense) ? name.sense : null, relief_start(results, row), row.bound && row.unit !== "1" ? `at its ${row.bound} bound` : null,
        row.given ? "as given" : null].filter(Boolean).join(", ");
      const moved = !row.given && ground(row.before, row.step) !== ground(row.after, row.step);
      const unit = pretty_unit(row.unit);
      body.push(el("tr", { title: name.sense || null },
        el("td", { class: "symbol" }, name.symbol ? symbols(name.symbol) : ""),
        el("td", {}, without_gear(row.key, gear), tells ? el("small", {}, " ", symbols(tells)) : null),
        el("td", { class: "number" }, row.text !== undefined ? "" : ground(row.before, row.step)),
        el("td", { class: moved ? "number grind" : "number" }, row.text ?? ground(row.after, row.step)),
        el("td", { class: "unit" }, unit)));
    }
  }
  plot.append(el("table", { class: "grinding" },
    el("tbody", {}, ...body)));
  plot.append(el("p", { class: "fine" }, `${rounding_sentence(results)} ${amounts_count(results)}`));
}

/** What choices and steps cost: "In the grinder's steps, at a cost of 1.8 %." */
function rounding_sentence(results) {
  const optimise = record(results.optimise), { loss_percent: all, choices_loss_percent: choices = 0 } = record(optimise.rounded);
  const own_steps = grinding_rows(results).some((row) => Number(given_value(results, `optimise.variables.${row.key}.step`)) > 0) || Number(given_value(results, "optimise.step")) > 0;
  if (optimise.rounded && !is_number(all)) {
    const [from, to] = [optimise.exact, optimise.rounded].map((design) => in_unit(fmt(record(design).objective, 3), pretty_unit(optimise.objective_unit)));
    return `${own_steps ? "In the grinder's steps" : "Without what cannot be ground"}, with ${words(optimise.objective_name)} at ${to}${from === to ? "" : ` instead of ${from}`}.`;
  }
  if (!is_number(all)) return own_steps ? "In the grinder's steps." : "Rounded to 0.1 µm and 0.1 mm.";
  const of_list = list(optimise.stages).length > 1 ? ` in ${words(optimise.objective_name)}` : "";
  const cost = (percent) => (percent < -0.005 ? `with a gain of ${fmt(-percent, 2)} %${of_list}` : `at a cost of ${fmt(Math.max(0, percent), 2)} %${of_list}`);
  const steps = 100 * ((1 + all / 100) / (1 + choices / 100) - 1);
  if (!(Math.abs(choices) > 0)) return `${own_steps ? "In the grinder's steps" : "Without what cannot be ground"}, ${cost(all)}.`;
  return `Without what cannot be ground, ${cost(choices)}${own_steps ? `; in the grinder's steps, at ${fmt(Math.max(0, steps), 2)} % more` : ""}.`;
}

/** The flanks to grind, each as a small map with contour lines, on one scale. */
function small_topographies(plot, results, height) {
  const entries = topographies(results).filter((entry) => entry.design !== "before" && is_modified(entry.grid));
  if (entries.length === 0) return plot.append(el("p", { class: "empty" }, "Both flanks stay unmodified."));
  const scale = removal_scale(entries);
  const row = el("div", { class: "maps" });
  plot.append(row);
  const width = ((plot.clientWidth || 560) - 10 * (entries.length - 1)) / entries.length;
  for (const entry of entries) {
    const { gear, grid } = entry, peak = maximum(grid.rows.flat());
    const area = { z: [grid.z[0], grid.z[grid.z.length - 1]], r: [grid.r[0], grid.r[grid.r.length - 1]] };
    const low = minimum(grid.rows.flat()), levels = round_ticks(low, peak, 6).filter((level) => level > low && level < peak);
    const { canvas, pen } = sharp_canvas(width, height, `Topography to grind on the ${gear}, contour lines in µm`);
    const frame = { left: 58, top: 24, width: width - 66, height: height - 62 };
    const to_x = (z) => frame.left + (frame.width * (z - area.z[0])) / (area.z[1] - area.z[0]);
    const to_y = (r) => frame.top + frame.height * (1 - (r - area.r[0]) / (area.r[1] - area.r[0]));
    paint_raster(pen, frame, grid_raster(grid, area), scale);
    draw_contours(pen, grid, levels, to_x, to_y);
    draw_axes(pen, frame, { z: area.z, r: area.r, title: `${capital(gear)}, ${low < -0.05 ? `${fmt(low, 2)} to` : "up to"} ${fmt(peak, 2)} µm`, r_title: "radius [mm]" });
    row.append(canvas);
  }
  const bare = ["pinion", "wheel"].filter((gear) => entries.every((entry) => entry.gear !== gear));
  if (bare.length > 0) plot.append(el("p", { class: "fine" }, `The ${bare[0]} flank stays an unmodified involute.`));
}

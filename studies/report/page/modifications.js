// Modification topography of each flank, and the design variables before and after.

/** The grid of a modification {z_mm, radius_mm, removal_um} where it is one, else null. */
function topography_grid(modification) {
  const { z_mm, radius_mm, removal_um } = modification;
  const grid = { z: numbers(z_mm), r: numbers(radius_mm), rows: list(removal_um) };
  return grid.z.length > 1 && grid.r.length > 1 && grid.rows.length === grid.r.length ? grid : null;
}

/** The common range of removal of a gear's designs; an unmodified flank gets a range of 1 um. */
function removal_scale(entries) {
  const values = numbers(entries.flatMap(({ grid }) => grid.rows.flat()));
  const scale = { low: Math.min(0, minimum(values)), high: maximum(values) };
  return scale.high > scale.low ? scale : { ...scale, high: scale.low + 1 };
}

const design_title = ({ design, grid }) => {
  const peak = maximum(grid.rows.flat());
  return `${DESIGN_LABEL[design]}${peak > 0 ? `, up to ${fmt(peak, 3)} µm` : ", unmodified"}`;
};

/** The common levels that a grid reaches, or some of its own where it reaches none of them. */
function levels_within(grid, levels) {
  const [low, high] = [minimum(grid.rows.flat()), maximum(grid.rows.flat())];
  const inside = (level) => level > low && level < high, common = levels.filter(inside);
  return common.length > 0 ? common : round_ticks(low, high, 4).filter(inside);
}

function draw_topography(plot, gear, entries) {
  const grids = entries.map((entry) => entry.grid);
  const scale = removal_scale(entries);
  const area = {
    z: [minimum(grids.flatMap((grid) => grid.z)), maximum(grids.flatMap((grid) => grid.z))],
    r: [minimum(grids.flatMap((grid) => grid.r)), maximum(grids.flatMap((grid) => grid.r))],
  };
  const levels = round_ticks(scale.low, scale.high, 8).filter((level) => level > scale.low && level < scale.high);
  const maps = entries.map((entry) => {
    const { design, grid } = entry;
    return {
      name: DESIGN_LABEL[design].toLowerCase(),
      title: design_title(entry),
      raster: grid_raster(grid, area),
      read: (z, r) => {
        const removal = grid_value(grid, z, r);
        return removal === null ? "outside" : `${fmt(removal, 3)} µm`;
      },
      overlay: (pen, to_x, to_y) => draw_contours(pen, grid, levels_within(grid, levels), to_x, to_y),
    };
  });
  flank_maps(plot, { maps, area, scale, unit: "µm", r_title: `${gear} radius [mm]` });
}

/** An amount as it is shown: values below a nanometre, or a millionth of any other unit, are solver tolerance and become 0. */
const settled = (value, unit) => (Math.abs(value) < (unit === "um" ? 1e-3 : 1e-6) ? 0 : value ?? null);

/** cos(beta_b): normal to the flank an amount is so much of what it is in the transverse plane; null where both are the same. */
function normal_share(results) {
  const angle = record(results.geometry).base_helix_angle_deg;
  return is_number(angle) && angle !== 0 ? Math.cos((angle * Math.PI) / 180) : null;
}

/** How amounts count, for the note of a table. */
const amounts_count = (results) => (normal_share(results) === null ? "Amounts are material removed, positive into the tooth."
  : "Amounts are material removed, positive into the tooth, along the base tangent in the transverse plane; normal to the flank, as the measurement grid of "
    + `flankwright export has them, they are cos β_b = ${fixed(normal_share(results), 4)} of that.`);

/** Whether a grid of a topography has more than what is written as 0.0 µm. */
const is_modified = (grid) => grid.rows.flat().some((value) => Math.abs(value) > 0.05);

/** The flank that the pair works on, unless a scene says otherwise; null in results of an older version. */
const own_flank = (results) => record(record(results.used).pair).working_flank ?? null;

/** Every stored topography of the flanks that the pair works on, without those of single scenes: [{gear, design, grid}]. */
const topographies = (results) => all_topographies(results).filter((entry) => entry.flank === own_flank(results));

/** The same of all flanks. */
const all_topographies = (results) => list(results.modifications).map(record)
  .map((entry) => ({
    gear: entry.gear, flank: entry.flank ?? own_flank(results), design: DESIGN_LABEL[entry.design] ? entry.design : "given", grid: topography_grid(entry),
    process: String(entry.process ?? "none"), natural_twist_um: entry.natural_twist_um, contact_shift_mm: entry.contact_shift_mm,
  }))
  .filter((entry) => entry.grid !== null);

/** What the grinding adds to the lead modification, for a caption; empty where it adds nothing. */
function natural_twist_in_words(entries) {
  const twisted = entries.filter((entry) => is_number(entry.natural_twist_um) && entry.natural_twist_um !== 0);
  if (twisted.length === 0) return "";
  const each = twisted.map((entry) => `${fixed(entry.natural_twist_um, 1)} µm${entries.length > 1 ? ` (${DESIGN_LABEL[entry.design].toLowerCase()})` : ""}`);
  return ` It includes the natural twist of ${twisted[0].process.replace("_", " ")}: ${each.join(", ")} over profile and face; contact with the tool shifts by `
    + `${fixed(twisted[0].contact_shift_mm, 1)} mm along the face from root to tip.`;
}

function build_modifications(results, body) {
  const grid = figure_grid(body);
  const entries = all_topographies(results);
  const several = unique(entries.map((entry) => entry.flank)).length > 1;
  for (const [gear, side] of ["pinion", "wheel"].flatMap((gear) => unique(entries.map((entry) => entry.flank)).map((side) => [gear, side]))) {
    const own = entries.filter((entry) => entry.gear === gear && entry.flank === side)
      .sort((a, b) => DESIGN_ORDER.indexOf(a.design) - DESIGN_ORDER.indexOf(b.design));
    if (own.length === 0) continue;
    const flank = several ? `${side} flank of the ${gear}` : `${gear} flank`;
    if (!own.some((entry) => is_modified(entry.grid))) {
      body.append(el("p", { class: "remark" }, `The ${flank} is unmodified.`));
      continue;
    }
    figure(grid, {
      title: `Topography of the ${flank}`,
      wide: own.length > 1,
      caption: `Material removed from the involute ${flank}, along the base tangent, with its contour lines; `
        + `face width to the right, tip at the top.${natural_twist_in_words(own)}`,
    }, (plot) => draw_topography(plot, gear, own));
    const modified = own.filter((entry) => is_modified(entry.grid));
    const state = { degrees: -30 };
    figure(grid, {
      title: `The ${flank} as a surface`,
      wide: modified.length > 1,
      caption: "The surface lies below the unmodified flank (dashed frame) by the removed material; heights are magnified.",
    }, (plot) => draw_surfaces(plot, modified.map((entry) => ({ title: design_title(entry), grid: entry.grid })), removal_scale(own), gear, state));
  }
  task_part(results, "design_table")?.(body, results);
}

add_sections({ modifications: build_modifications });

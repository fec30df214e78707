// Damage over the spectrum, and safety, film and temperature in one load case, at every point of a flank.

/** Decades of damage that a map shows. */
const MAP_DECADES = 4;

const radius_key = (gear) => `${gear}_radius_mm`;

/** Points of a spectrum's map: the logarithm of the damage, no less than the floor. */
function damage_points(spectrum, gear, floor) {
  const { phase, tooth, z_mm, [radius_key(gear)]: radius, [`${gear}_damage`]: damage } = record(record(spectrum).map);
  return list(damage).map((value, i) => ({ z: list(z_mm)[i], r: list(radius)[i], phase: list(phase)[i], tooth: list(tooth)[i],
    value: value > 0 ? Math.max(floor, Math.log10(value)) : floor })).filter((point) => is_number(point.z) && is_number(point.r));
}

/** Maps of all designs on one scale; a text says what is at a point. @param designs  [{design, points, title}] */
function draw_life_maps(plot, designs, { gear, scale, rank, unit, words_at }) {
  const all = designs.flatMap(({ points }) => points);
  if (all.length === 0) {
    plot.append(el("p", { class: "empty" }, "No contact points are stored for this flank."));
    return;
  }
  const area = area_of(all);
  const maps = designs.map(({ design, points, title }) => {
    const raster = flank_raster(points, area, rank);
    const read = (z, r) => {
      const cell = raster_index(r, area.r, raster.rows) * raster.columns + raster_index(z, area.z, raster.columns);
      return raster.owner[cell] ? words_at(raster.owner[cell].value) : "no point near";
    };
    return { name: DESIGN_LABEL[design].toLowerCase(), raster, read, title };
  });
  flank_maps(plot, { maps, area, scale, unit, r_title: `${gear} radius [mm]` });
}

/** The scale ends at the largest damage of the last design, so that its map has the colours. */
function draw_damage_map(plot, life, selection, gear) {
  const designs = designs_of(selection.current), of = (design) => spectrum_of(life, selection.current.scene, design);
  const largest = (design) => maximum(list(record(record(of(design)).map)[`${gear}_damage`]));
  const top = largest(designs[designs.length - 1]);
  if (!(top > 0)) return;
  const high = Math.log10(top), floor = high - MAP_DECADES;
  const ticks = Array.from({ length: MAP_DECADES + 2 }, (_, i) => Math.ceil(floor) + i).filter((at) => at <= high).map((at) => ({ at, text: power_of_ten(at) }));
  const is_bare = (value) => value < floor + 1e-9;  // between points at the floor there is round-off
  draw_life_maps(plot, designs.map((design) => ({ design, points: damage_points(of(design), gear, floor), title: `${DESIGN_LABEL[design]}, largest ${fmt(largest(design), 3)}` })), {
    gear, unit: "damage", scale: { low: floor, high, ticks }, rank: { is_bare, outranks: (a, b) => a > b },
    words_at: (value) => (is_bare(value) ? `below ${fmt(10 ** floor, 2)}` : fmt(10 ** value, 3)),
  });
}

/** Never loaded where it is 0; of several points at a place the largest. */
const LOADED_RANK = { is_bare: (value) => value <= 0, outranks: (a, b) => a > b };

/** Maps of a quantity whose inverse is drawn, so that the worst point has the strongest colour; the colour bar has the quantity itself. @param of  (design) => {values: of columns, least} */
function draw_inverse_map(plot, selection, gear, { of, unit, word }) {
  const designs = designs_of(selection.current).map((design) => {
    const { values, least } = of(selection.current.designs[design]);
    return { design, points: contact_points(selection.current.designs[design], (_, columns) => values(columns), radius_key(gear)), title: `${DESIGN_LABEL[design]}, least ${fmt(least, 3)}` };
  });
  const high = maximum(designs[designs.length - 1].points.map((point) => point.value));
  if (!(high > 0)) return;
  const ticks = [];
  for (const value of [0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1, 1.2, 1.5, 2, 3, 5, 10, 20]) {
    const at = 1 / value;
    if (at <= high && (ticks.length === 0 || ticks[ticks.length - 1].at - at > 0.08 * high)) ticks.push({ at, text: fmt(value) });
  }
  draw_life_maps(plot, designs, { gear, unit, scale: { low: 0, high, ticks }, rank: LOADED_RANK,
    words_at: (value) => (value <= 0 ? "never loaded" : `${word} ${fmt(1 / value, 3)}`) });
}

/** The stress over that which is borne is linear between points as the stress is; the colour bar has its inverse, the safety. */
function draw_safety_map(plot, life, selection, gear) {
  draw_inverse_map(plot, selection, gear, { unit: "safety", word: "safety", of: (entry) => {
    const of = life_of(life, entry), least = record(of[gear]).contact_safety, borne = least * of.peak_contact_stress_MPa;
    return { least, values: (columns) => list(columns.contact_stress_MPa).map((stress) => (is_number(stress) ? stress / borne : null)) };
  } });
}

function draw_film_map(plot, life, selection, gear) {
  draw_inverse_map(plot, selection, gear, { unit: "λ_GF", word: "λ_GF", of: (entry) => ({ least: life_of(life, entry).specific_film_thickness,
    values: (columns) => list(columns.specific_film_thickness).map((film) => (is_number(film) && film > 0 ? 1 / film : 0)) }) });
}

/** From the bulk temperature, which unloaded points have, to the hottest point of the last design. */
function draw_temperature_map(plot, life, selection, gear) {
  const designs = designs_of(selection.current).map((design) => {
    const entry = selection.current.designs[design], of = life_of(life, entry);
    const points = contact_points(entry, (_, columns) => list(columns.flash_temperature_K), radius_key(gear));
    return { design, points, bulk: of.bulk_temperature_degC, title: `${DESIGN_LABEL[design]}, at most ${fmt(of.contact_temperature_degC, 3)} °C` };
  });
  const last = designs[designs.length - 1], high = maximum(last.points.map((point) => point.value));
  if (!(high > 0) || !is_number(last.bulk)) return;
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((share) => ({ at: share * high, text: fmt(last.bulk + share * high, 3) }));
  draw_life_maps(plot, designs, { gear, unit: "°C", scale: { low: 0, high, ticks }, rank: LOADED_RANK,
    words_at: (value) => (value <= 0 ? "never loaded" : `${fmt(last.bulk + value, 3)} °C, of which ${fmt(value, 3)} K flash`) });
}

/** The flank maps of the gear that a choice takes, that with the greater damage first. */
function flank_life(grid, controls, life, selection) {
  const has_safety = (gear) => has_number(life, (of) => record(of[gear]).contact_safety);
  const rated = LIFE_GEARS.filter(has_safety), has_film = has_number(life, (of) => of.specific_film_thickness);
  if (rated.length === 0 && !has_film) return;
  const gears = has_film ? LIFE_GEARS : rated;
  const damage = (gear) => maximum(list(life.cases).map((of) => record(record(of)[gear]).contact_damage));
  let gear = gears.reduce((a, b) => (damage(b) > damage(a) ? b : a));
  const redraws = [];
  if (gears.length > 1) {
    controls.append(choice("Flank", gears.map((value) => ({ value, label: value })), gear, (taken) => {
      gear = taken;
      redraws.forEach((redraw) => redraw());
    }).node);
  }
  const paired = selection.cases.some((load_case) => designs_of(load_case).length > 1), end = paired ? "The scale ends at the worst point after; what is worse before has the same colour. " : "";
  const said = (plot) => plot.append(el("p", { class: "shown" }, `Flank of the ${gear}`));
  if (list(life.spectra).map(record).some((of) => of.map)) {
    redraws.push(scene_figure(grid, selection, { title: "Damage of the flank over the spectrum", wide: paired,
      caption: `Sum over all load cases at each point, in decades; 1 is failure. ${end}Grey areas have less than a `
        + "ten-thousandth of the end of the scale." }, (plot) => {
      said(plot);
      draw_damage_map(plot, life, selection, gear);
    }));
  }
  if (rated.length > 0) redraws.push(case_figure(grid, selection, { title: "Safety of the flank in the load case", wide: paired,
    caption: "Stress that is borne for the load cycles of the case, the endurance limit where they are not given, over the contact stress at each point. " + `${end}Grey areas are never loaded.` }, (plot) => {
    said(plot);
    if (rated.includes(gear)) draw_safety_map(plot, life, selection, gear);
    else plot.append(el("p", { class: "empty" }, "The strength of this flank is not given."));
  }));
  if (!has_film) return;
  redraws.push(case_figure(grid, selection, { title: "Film of the flank in the load case", wide: paired,
    caption: `Specific film thickness λ_GF of ISO/TS 6336-22, method A, at each point; a tip edge in contact counts with its own pressure. ${end}Grey areas are never loaded.` }, (plot) => {
    said(plot);
    draw_film_map(plot, life, selection, gear);
  }));
  redraws.push(case_figure(grid, selection, { title: "Contact temperature in the load case", wide: paired,
    caption: `Bulk and flash temperature at each point; a tip edge in contact counts with its own pressure. ${end}Grey areas are never loaded.` }, (plot) => {
    said(plot);
    draw_temperature_map(plot, life, selection, gear);
  }));
}

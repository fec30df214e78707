// The gear unit around the pair: torques, bearing forces and deflections of each load case, and a drawing of the shafts.

/** Shafts with what sits on them, name -> {sections, bearings, gears: [position, width, diameter, label]}. */
function unit_shafts(results) {
  const used = record(results.used), unit = record(used.unit), shafts = new Map();
  for (const name of ["pinion", "wheel"]) {
    const gear = record(record(used.pair)[name]), shaft = record(gear.shaft);
    if (!Array.isArray(shaft.sections)) continue;
    const diameter = record(record(results.geometry)[name]).tip_diameter_mm;
    shafts.set(name, { ...shaft, gears: [[shaft.gear_position_mm, gear.face_width_mm, diameter, `pair, ${gear.teeth} teeth`]] });
  }
  for (const shaft of list(unit.shafts).map(record)) shafts.set(shaft.name, { ...shaft, gears: [] });
  for (const mesh of list(unit.meshes).map(record)) {
    for (const g of ["_1", "_2"]) {
      shafts.get(mesh[`shaft${g}`])?.gears.push([mesh[`position${g}_mm`], Math.max(mesh[`face_width${g}_mm`], 1), mesh[`working_pitch_diameter${g}_mm`],
        `${mesh.name}, ${mesh[`teeth${g}`]} teeth`]);
    }
  }
  return shafts;
}

/** Where each shaft begins along z, from the pair's mid face, name -> mm: mid faces of meshes lie at one place. */
function shaft_starts(results, shafts) {
  const unit = record(record(results.used).unit), starts = new Map();
  for (const name of ["pinion", "wheel"]) if (shafts.has(name)) starts.set(name, -shafts.get(name).gear_position_mm);
  const ties = [...list(unit.meshes).map(record).map((m) => [m.shaft_1, m.position_1_mm, m.shaft_2, m.position_2_mm]),
    ...list(unit.joints).map(record).map((j) => [j.shaft, j.position_mm, j.outer_shaft, j.outer_position_mm])];
  for (let k = 0; k <= ties.length; ++k) {
    for (const [one, at_one, two, at_two] of ties) {
      if (starts.has(one) && !starts.has(two)) starts.set(two, starts.get(one) + at_one - at_two);
      if (starts.has(two) && !starts.has(one)) starts.set(one, starts.get(two) + at_two - at_one);
    }
  }
  return starts;
}

const UNIT_TEXT = { row: 17, per_character: 7.1 };  // of a label [px]

/**
 * Labels in as many rows as keep them apart, each about its place.
 * @param labels  [{at, text}], at in px
 * @return {rows, placed: [{at, text, left, row}]}
 */
function label_rows(labels, width) {
  const ends = [], placed = [];
  for (const { at, text } of labels.filter((label) => label.text).sort((a, b) => a.at - b.at)) {
    const wide = UNIT_TEXT.per_character * text.length, left = Math.max(0, Math.min(at - wide / 2, width - wide));
    let row = ends.findIndex((end) => end + 8 <= left);
    if (row < 0) row = ends.push(0) - 1;
    ends[row] = left + wide;
    placed.push({ at, text, row, left });
  }
  return { rows: ends.length, placed };
}

/** The largest of 1, 2 or 5 times a power of ten that is at most `value`, > 0. */
function round_below(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((digit) => digit * power <= value * (1 + 1e-9)) * power;
}

/** The shafts below each other, their axes moved as under load, enlarged. Lengths are in px, so that labels have the size of all others. */
function draw_unit(plot, results, state) {
  const shafts = unit_shafts(results), starts = shaft_starts(results, shafts);
  const known = list(state.shafts).map(record).filter((shaft) => shafts.has(shaft.name) && starts.has(shaft.name));
  if (known.length === 0) return;
  const reach = (name) => Math.max(...shafts.get(name).sections.map((s) => s.outer_diameter_mm / 2), ...shafts.get(name).gears.map((g) => g[2] / 2));
  const ends = known.flatMap((shaft) => [starts.get(shaft.name), starts.get(shaft.name) + maximum(shaft.z_mm)]);
  const [low, high] = [minimum(ends), maximum(ends)], side = 12;
  const width = Math.max(320, plot.clientWidth || 560), most_height = 660;
  const px = Math.min((width - 2 * side) / (high - low), most_height / known.reduce((sum, shaft) => sum + 2 * reach(shaft.name), 0));
  const across = (z) => width / 2 + px * (z - (low + high) / 2);
  const largest = maximum(known.map((shaft) => shaft.largest_deflection_um));
  const scale = largest > 0 ? (0.8 * px * minimum(known.map((shaft) => reach(shaft.name)))) / largest : 0;  // px per um
  const lines = [["x_um", "none", "along x"], ["y_um", "7 4", "along y"]];
  const stroke = { fill: "none", stroke: css_colour("after"), "stroke-width": 2 };
  const parts = [], texts = [];
  const write = (x, y, text, name, more = {}) => texts.push(svg("text", { x, y, class: name, ...more }, text));
  let bottom = 0;
  for (const shaft of known) {
    const { sections, gears, bearings } = shafts.get(shaft.name), start = starts.get(shaft.name);
    const above = label_rows(gears.map(([position, , , text]) => ({ at: across(start + position), text })), width);
    const below = label_rows(list(bearings).map(record).map((bearing) => ({ at: across(start + bearing.position_mm), text: bearing.name })), width);
    write(0, bottom + 14, shaft.name, "strong");
    const top = bottom + 22 + UNIT_TEXT.row * above.rows, half = px * reach(shaft.name), axis = top + half, foot = top + 2 * half;
    for (const { left, row, text } of above.placed) write(left, top - 6 - UNIT_TEXT.row * (above.rows - 1 - row), text, "small");
    const box = (from, length, diameter, dashes) => parts.push(svg("rect", { x: across(from), y: axis - (px * diameter) / 2, width: px * length, height: px * diameter,
      fill: "none", stroke: "currentColor", "stroke-width": 1, "stroke-opacity": 0.55, ...(dashes ? { "stroke-dasharray": "4 3" } : {}) }));
    let from = start;
    for (const section of sections) {
      box(from, section.length_mm, section.outer_diameter_mm);
      from += section.length_mm;
    }
    parts.push(svg("line", { x1: across(start) - 10, y1: axis, x2: across(from) + 10, y2: axis, class: "pitch-circle", "stroke-width": 1, "stroke-dasharray": "12 3 3 3" }));
    for (const [position, length, diameter] of gears) box(start + position - length / 2, length, diameter, true);
    for (const bearing of list(bearings).map(record)) {
      const at = across(start + bearing.position_mm), edge = px * radius_at(sections, bearing.position_mm);
      for (const sign of [-1, 1]) {
        parts.push(svg("path", { d: `M ${at} ${axis + sign * edge} l 5 ${sign * 10} h -10 z`, fill: "currentColor", "fill-opacity": 0.55 }));
      }
      const label = below.placed.find((one) => one.text === bearing.name && one.at === at);
      if (!label) continue;
      const base = foot + 14 + UNIT_TEXT.row * label.row;
      parts.push(svg("line", { x1: at, y1: axis + edge + 10, x2: at, y2: base - 11, class: "grid-line" }));
      write(label.left, base, bearing.name, "small");
    }
    for (const [key, dashes] of lines) {
      parts.push(svg("polyline", { points: shaft.z_mm.map((z, i) => `${across(start + z)},${axis - scale * shaft[key][i]}`).join(" "), ...stroke, "stroke-dasharray": dashes }));
    }
    bottom = foot + UNIT_TEXT.row * below.rows + 16;
  }
  // What the lines are, and their scale.
  let x = 0;
  for (const [, dashes, text] of lines) {
    parts.push(svg("line", { x1: x, y1: bottom + 12, x2: x + 30, y2: bottom + 12, ...stroke, "stroke-dasharray": dashes }));
    write(x + 36, bottom + 16, text, "small");
    x += 36 + UNIT_TEXT.per_character * text.length + 20;
  }
  if (scale > 0) {
    const shown = round_below(24 / scale), bar = scale * shown;
    parts.push(svg("path", { d: `M ${x} ${bottom + 12 - bar / 2} h 8 m -4 0 v ${bar} m -4 0 h 8`, fill: "none", stroke: "currentColor" }));
    write(x + 14, bottom + 16, `${fmt(shown)} µm`, "small");
  }
  const picture = svg("svg", { viewBox: `0 0 ${width} ${bottom + 30}`, width: "100%", class: "teeth unit-drawing", role: "img", "aria-label": "Shafts of the unit with their deflections" });
  picture.append(...parts, ...texts);
  plot.append(picture);
}

/** Radius of the section at a place on a shaft. */
function radius_at(sections, position) {
  let end = 0;
  for (const section of sections) {
    end += section.length_mm;
    if (position <= end) return section.outer_diameter_mm / 2;
  }
  return sections.at(-1).outer_diameter_mm / 2;
}

/** Tables of each load case, and the drawing of the one with the largest torque; nothing where no unit is described. */
function build_unit(results, body) {
  const cases = list(results.loaded).map(record).filter((entry) => entry.unit !== undefined && entry.design !== "before");
  if (cases.length === 0) return;
  const label = (entry) => ({ text: cases.length > 1 ? `${entry.scene}, ${fmt(entry.torque_Nm)} N·m` : `${fmt(entry.torque_Nm)} N·m`, class: "word" });
  const rows = (part, cells) => cases.flatMap((entry) => list(record(entry.unit)[part]).map(record).map((of) => [label(entry), ...cells(of)]));
  const word = (text) => ({ text: text ?? "–", class: "word" });
  const tables = el("div", { class: "tables" }), wide = el("div", {});
  table(tables, { title: "Misalignment by the unit",
    note: symbols("f_sh of the pair by shafts, bearings and housing under mean forces, + opens the mesh at +z; and the part that other forces than the pair's make. Under the loads that are "
      + "found it is among the load cases in numbers. Bearings with clearance, or with a stiffness that depends on the load, are linearised where all mean forces are in equilibrium."),
    columns: [{ label: "Load case" }, { label: "Misalignment", unit: "µm" }, { label: "By other forces", unit: "µm" }, { label: "Bearings" }],
    rows: cases.map((entry) => [label(entry), entry.unit.mesh_misalignment_um, entry.unit.misalignment_by_other_forces_um, word(entry.unit.bearings_are)]) });
  table(wide, { title: "Meshes", note: "Torques on both gears by their shafts, about z.",
    columns: [{ label: "Load case" }, { label: "Mesh" }, { label: "Gears on" }, { label: "Torque 1", unit: "N·m" }, { label: "Torque 2", unit: "N·m" },
      { label: "Normal force", unit: "N" }, { label: "Driver" }],
    rows: rows("meshes", (mesh) => [word(mesh.name), word(`${mesh.shaft_1}, ${mesh.shaft_2}`), mesh.torque_1_Nm, mesh.torque_2_Nm, mesh.normal_force_N, word(mesh.driver)]) });
  table(wide, { title: "Bearings", note: "Forces on the shaft: x from pinion to wheel, z along the shafts.",
    columns: [{ label: "Load case" }, { label: "Bearing" }, { label: "Shaft" }, { label: "F_x", unit: "N" }, { label: "F_y", unit: "N" }, { label: "F_z", unit: "N" },
      { label: "Radial", unit: "N" }, { label: "Carries" }],
    rows: rows("bearings", (bearing) => [word(bearing.name), word(bearing.shaft), ...list(bearing.force_N), bearing.radial_force_N, bearing.carries]) });
  const by_load = rows("bearings", (bearing) => [bearing, word(bearing.name), bearing.radial_force_N]).filter(([, bearing]) => bearing.radial_stiffness !== undefined);
  if (by_load.length > 0) {
    table(wide, { title: "Bearings whose stiffness depends on the load",
      note: "Radial stiffness at the equilibrium under mean forces: the secant is force over deflection, the tangent is what the loaded contact has along the force.",
      columns: [{ label: "Load case" }, { label: "Bearing" }, { label: "Radial", unit: "N" }, { label: "By" }, { label: "Deflection", unit: "µm" }, { label: "Secant", unit: "N/µm" },
        { label: "Tangent", unit: "N/µm" }],
      rows: by_load.map(([load_case, bearing, name, force]) => {
        const { given, deflection_um, secant_N_per_um, used_N_per_um, beyond_table } = bearing.radial_stiffness;
        return [load_case, name, force, word(`${given}${beyond_table ? ", beyond its end" : ""}`), deflection_um, secant_N_per_um, used_N_per_um];
      }) });
  }
  table(tables, { title: "Shafts", columns: [{ label: "Load case" }, { label: "Shaft" }, { label: "Largest deflection", unit: "µm" }, { label: "Coupling torque", unit: "N·m" }],
    rows: rows("shafts", (shaft) => [word(shaft.name), shaft.largest_deflection_um, shaft.coupling_torque_Nm]) });
  const most = cases.reduce((a, b) => (b.torque_Nm > a.torque_Nm ? b : a));
  figure(figure_grid(body), {
    title: "Shafts of the unit",
    caption: `At ${fmt(most.torque_Nm)} N·m, below each other, z to the right; dashed boxes: gears at their tip or pitch circle; triangles: bearings. Blue: how the axes are moved along x (solid, `
      + `upwards) and y (dashed), enlarged; the largest displacement is ${fmt(maximum(list(most.unit.shafts).map((shaft) => shaft.largest_deflection_um)), 3)} µm.`,
  }, (plot) => draw_unit(plot, results, most.unit));
  body.append(tables, wide);
}

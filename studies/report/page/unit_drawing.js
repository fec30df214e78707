// The gear unit around the pair: torques, bearing forces and deflections of each load case, and a drawing of the shafts.

/** Shafts with what sits on them, name -> {sections, bearings, gears: [position, width, diameter]}. */
function unit_shafts(results) {
  const used = record(results.used), unit = record(used.unit), shafts = new Map();
  for (const name of ["pinion", "wheel"]) {
    const gear = record(record(used.pair)[name]), shaft = record(gear.shaft);
    if (!Array.isArray(shaft.sections)) continue;
    const diameter = record(record(results.geometry)[name]).tip_diameter_mm;
    shafts.set(name, { ...shaft, gears: [[shaft.gear_position_mm, gear.face_width_mm, diameter]] });
  }
  for (const shaft of list(unit.shafts).map(record)) shafts.set(shaft.name, { ...shaft, gears: [] });
  for (const mesh of list(unit.meshes).map(record)) {
    for (const g of ["_1", "_2"]) {
      shafts.get(mesh[`shaft${g}`])?.gears.push([mesh[`position${g}_mm`], Math.max(mesh[`face_width${g}_mm`], 1), mesh[`working_pitch_diameter${g}_mm`]]);
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

/** The shafts beside each other, their axes moved as under load, enlarged. */
function draw_unit(plot, results, state) {
  const shafts = unit_shafts(results), starts = shaft_starts(results, shafts);
  const known = list(state.shafts).map(record).filter((shaft) => shafts.has(shaft.name) && starts.has(shaft.name));
  if (known.length === 0) return;
  const reach = (name) => Math.max(...shafts.get(name).sections.map((s) => s.outer_diameter_mm / 2), ...shafts.get(name).gears.map((g) => g[2] / 2));
  const ends = known.flatMap((shaft) => [starts.get(shaft.name), starts.get(shaft.name) + maximum(shaft.z_mm)]);
  const [low, high] = [minimum(ends), maximum(ends)], gap = 0.06 * (high - low), line = 0.003 * (high - low);
  const largest = maximum(known.map((shaft) => shaft.largest_deflection_um));
  const scale = largest > 0 ? 0.8 * minimum(known.map((shaft) => reach(shaft.name))) / largest : 0;
  const parts = [];
  let bottom = 0;
  for (const shaft of known) {
    const { sections, gears, bearings } = shafts.get(shaft.name), start = starts.get(shaft.name), radius = reach(shaft.name), axis = bottom + radius;
    const box = (from, width, diameter, dashes) => parts.push(svg("rect", { x: from, y: axis - diameter / 2, width, height: diameter, fill: "none",
      stroke: "currentColor", "stroke-width": line, "stroke-opacity": 0.55, ...(dashes ? { "stroke-dasharray": `${3 * line} ${2 * line}` } : {}) }));
    let from = start;
    for (const section of sections) {
      box(from, section.length_mm, section.outer_diameter_mm);
      from += section.length_mm;
    }
    for (const [position, width, diameter] of gears) box(start + position - width / 2, width, diameter, true);
    for (const bearing of list(bearings).map(record)) {
      const side = 5 * line, at = start + bearing.position_mm;
      for (const sign of [-1, 1]) {
        const edge = axis + sign * radius_at(sections, bearing.position_mm);
        parts.push(svg("path", { d: `M ${at} ${edge} l ${side} ${sign * 2 * side} h ${-2 * side} z`, fill: "currentColor", "fill-opacity": 0.55 }));
      }
    }
    for (const [key, dashes] of [["x_um", "none"], ["y_um", `${6 * line} ${3 * line}`]]) {
      parts.push(svg("polyline", { points: shaft.z_mm.map((z, i) => `${start + z},${axis - scale * shaft[key][i]}`).join(" "), fill: "none",
        stroke: css_colour("after"), "stroke-width": 1.8 * line, "stroke-dasharray": dashes }));
    }
    const label = svg("text", { x: low, y: bottom - 0.15 * gap, "font-size": 0.55 * gap, fill: "currentColor" });
    label.textContent = shaft.name;
    parts.push(label);
    bottom = axis + radius + gap;
  }
  const picture = svg("svg", { viewBox: [low - gap, -gap, high - low + 2 * gap, bottom + gap].join(" "), class: "teeth body-section", role: "img",
    "aria-label": "Shafts of the unit with their deflections" });
  picture.append(...parts);
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
  const tables = el("div", { class: "tables" });
  table(tables, { title: "Misalignment by the unit",
    note: "F_βy of the pair by shafts, bearings and housing under mean forces, + opens the mesh at +z; and the part that other forces than the pair's make. Bearings with clearance, "
      + "or with a stiffness that depends on the load, are linearised where all mean forces are in equilibrium.",
    columns: [{ label: "Load case" }, { label: "Misalignment", unit: "µm" }, { label: "By other forces", unit: "µm" }, { label: "Bearings" }],
    rows: cases.map((entry) => [label(entry), entry.unit.mesh_misalignment_um, entry.unit.misalignment_by_other_forces_um, word(entry.unit.bearings_are)]) });
  table(tables, { title: "Meshes", note: "Torques on both gears by their shafts, about z.",
    columns: [{ label: "Load case" }, { label: "Mesh" }, { label: "Gears on" }, { label: "Torque 1", unit: "N·m" }, { label: "Torque 2", unit: "N·m" },
      { label: "Normal force", unit: "N" }, { label: "Driver" }],
    rows: rows("meshes", (mesh) => [word(mesh.name), word(`${mesh.shaft_1}, ${mesh.shaft_2}`), mesh.torque_1_Nm, mesh.torque_2_Nm, mesh.normal_force_N, word(mesh.driver)]) });
  table(tables, { title: "Bearings", note: "Forces on the shaft: x from pinion to wheel, z along the shafts.",
    columns: [{ label: "Load case" }, { label: "Bearing" }, { label: "Shaft" }, { label: "F_x", unit: "N" }, { label: "F_y", unit: "N" }, { label: "F_z", unit: "N" },
      { label: "Radial", unit: "N" }, { label: "Carries" }],
    rows: rows("bearings", (bearing) => [word(bearing.name), word(bearing.shaft), ...list(bearing.force_N), bearing.radial_force_N, bearing.carries]) });
  const by_load = rows("bearings", (bearing) => [bearing, word(bearing.name), bearing.radial_force_N]).filter(([, bearing]) => bearing.radial_stiffness !== undefined);
  if (by_load.length > 0) {
    table(tables, { title: "Bearings whose stiffness depends on the load",
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
    caption: `At ${fmt(most.torque_Nm)} N·m, beside each other, z to the right; dashed: gears at their tip or pitch circle. Lines: how the axes are moved along x (solid, up) and y (dashed), `
      + `enlarged; the largest is ${fmt(maximum(list(most.unit.shafts).map((shaft) => shaft.largest_deflection_um)), 3)} µm.`,
  }, (plot) => draw_unit(plot, results, most.unit));
  body.append(tables);
}

// Transmission error, its harmonics, load sharing and mesh stiffness over the mesh cycle, before and after; load cases in numbers.

/**
 * A curve over the mesh cycle [{x, y}], closed by its first point one pitch later. A cycle at given phases, which
 * has no harmonics, stays open.
 */
function cycle_points(entry, value_of) {
  const points = list(entry.cycle).map(record).map((position) => ({ x: position.phase, y: value_of(position) }))
    .map((point) => ({ ...point, y: is_number(point.y) ? point.y : null }));
  const is_whole = points.length > 1 && list(summary_of(entry).te_harmonics_um).length > 0 && points.every((point) => is_number(point.x));
  return is_whole ? [...points, { x: points[0].x + 1, y: points[0].y }] : points;
}

/**
 * One curve a load case and design: the selected case bold, all others thin behind it.
 * @param value_of  position of the cycle -> number
 */
function cycle_curves(selection, value_of, remove_mean) {
  const curve = (load_case, design, selected) => {
    const cycle = list(load_case.designs[design].cycle).map(record);
    const known = numbers(cycle.map(value_of));
    const mean = remove_mean && known.length ? known.reduce((a, b) => a + b, 0) / known.length : 0;
    const colour = design_colour(design);
    return {
      label: DESIGN_LABEL[design],
      points: cycle_points(load_case.designs[design], (position) => {
        const value = value_of(position);
        return is_number(value) ? value - mean : null;
      }),
      colour: selected ? colour : faded(colour, 0.3),
      width: selected ? 2.6 : 1,
      quiet: !selected,
      order: selected ? 0 : 1,
    };
  };
  return selection.cases.flatMap((load_case) =>
    designs_of(load_case).map((design) => curve(load_case, design, load_case === selection.current)));
}

/** Range of an axis with a margin around its curves, at least `least` wide; background curves that lie apart do not widen it. */
function readable_range(all, least, with_background = false) {
  const curves = with_background ? all : all.filter((curve) => !curve.quiet);
  const values = numbers(curves.flatMap((curve) => curve.points.map((point) => point.y)));
  if (values.length === 0) return {};
  const [low, high] = [minimum(values), maximum(values)];
  const half = Math.max(0.54 * (high - low), 0.5 * least), middle = 0.5 * (low + high);
  return { min: middle - half, max: middle + half };
}

/** The smallest range of TE to draw: four times its error, or a thousandth of its mean. */
function least_te_range(load_case) {
  const summaries = designs_of(load_case).map((design) => summary_of(load_case.designs[design]));
  return maximum(summaries.flatMap((s) => [4 * (s.te_peak_to_peak_um_error ?? 0), 1e-3 * Math.abs(s.te_mean_um ?? 0), 1e-6]));
}

function draw_te(plot, selection, remove_mean, height = 290) {
  const curves = cycle_curves(selection, (position) => position.te_um, remove_mean);
  xy_chart(plot, {
    label: "Transmission error over the mesh cycle",
    curves,
    x: "phase [base pitches]",
    y: remove_mean ? "TE less its mean [µm]" : "TE [µm]",
    y_range: readable_range(curves, least_te_range(selection.current), remove_mean),
    read_x: (x) => `phase ${fmt(x)}`,
    read_y: (y) => `${fmt(y, remove_mean ? 3 : 5)} µm`,
    height,
  });
}

function draw_te_cycle(plot, selection) {
  const box = el("input", { type: "checkbox" });
  box.checked = selection.remove_mean;
  const area = el("div");
  const draw = () => {
    clear_plot(area);
    draw_te(area, selection, box.checked);
  };
  box.addEventListener("change", () => {
    selection.remove_mean = box.checked;
    draw();
  });
  plot.append(el("label", { class: "choice no-print" }, box, " mean removed"), area);
  draw();
}

function draw_te_harmonics(plot, load_case, height = 290) {
  const designs = designs_of(load_case);
  const of = (design, key) => list(summary_of(load_case.designs[design])[key]);
  const count = Math.max(0, ...designs.map((design) => of(design, "te_harmonics_um").length));
  bar_chart(plot, {
    label: "Harmonics of the transmission error",
    labels: Array.from({ length: count }, (_, i) => String(i + 1)),
    series: designs.map((design) => ({
      label: DESIGN_LABEL[design], values: of(design, "te_harmonics_um"), errors: of(design, "te_harmonics_um_error"), colour: design_colour(design),
    })),
    x: "order of the tooth-mesh frequency",
    y: "amplitude [µm]",
    unit: "µm",
    height,
  });
}

function build_transmission_error(results, body, selection) {
  selection.remove_mean = true;
  selection.add_choice(body);
  const grid = figure_grid(body);
  const others = selection.cases.length > 1 ? " Thin lines are the other scenes." : "";
  case_figure(grid, selection, {
    title: "Transmission error over the mesh cycle",
    caption: "Lag of the wheel along the flank normal while the mesh advances by one base pitch. Its variation excites "
      + `noise; a constant lag does not.${others}`,
  }, (plot) => draw_te_cycle(plot, selection));
  const has_harmonics = selection.cases.some((load_case) =>
    designs_of(load_case).some((design) => list(summary_of(load_case.designs[design]).te_harmonics_um).length > 0));
  const has_errors = selection.cases.some((load_case) =>
    designs_of(load_case).some((design) => numbers(summary_of(load_case.designs[design]).te_harmonics_um_error).length > 0));
  if (!has_harmonics) return; // cycles at given phases have none
  case_figure(grid, selection, {
    title: "Harmonics of the transmission error",
    caption: "Amplitudes at multiples of the tooth-mesh frequency; the first orders are the audible ones."
      + (has_errors ? " Whiskers are the estimated discretisation error; a hollow bar is smaller than its error." : ""),
  }, (plot, load_case) => draw_te_harmonics(plot, load_case));
}

/** Fraction of the force that one tooth pair carries on its run through the mesh, from the teeth of all positions. */
function sharing_curve(entry) {
  const points = list(entry.cycle).map(record).flatMap((position) => list(position.teeth).map(record)
    .map((tooth) => ({ x: position.phase + tooth.tooth, y: is_number(tooth.share) ? 100 * tooth.share : null })));
  return points.filter((point) => is_number(point.x)).sort((a, b) => a.x - b.x);
}

function draw_sharing(plot, load_case) {
  xy_chart(plot, {
    label: "Load sharing of a tooth pair on its run through the mesh",
    curves: designs_of(load_case).map((design) => ({
      label: DESIGN_LABEL[design], points: sharing_curve(load_case.designs[design]), colour: design_colour(design), width: 2.6,
    })),
    x: "phase of the tooth pair's line [base pitches]",
    y: "fraction of the force [%]",
    read_x: (x) => `line phase ${fmt(x)}`,
    read_y: (y) => `${fmt(y, 3)} %`,
    y_range: { beginAtZero: true },
    height: 250,
  });
}

function build_stiffness(results, body, selection) {
  selection.add_choice(body);
  const grid = figure_grid(body);
  case_figure(grid, selection, {
    title: "Load sharing",
    caption: "Fraction of the whole force that one tooth pair carries from its first to its last contact. "
      + "With errors that differ from tooth to tooth the curve has a branch for each pair.",
  }, draw_sharing);
  case_figure(grid, selection, {
    title: "Mesh stiffness over the mesh cycle",
    caption: "Load along the flank normal per unit of face width and of deflection, for all tooth pairs together. "
      + "Steps occur where teeth enter and leave the mesh.",
  }, (plot) => {
    const curves = cycle_curves(selection, (position) => position.stiffness_N_per_mm_um, false);
    xy_chart(plot, {
      label: "Mesh stiffness over the mesh cycle",
      curves,
      x: "phase [base pitches]",
      y: "stiffness [N/(mm µm)]",
      y_range: readable_range(curves, 1e-3 * (summary_of(final_entry(selection.current)).mean_stiffness_N_per_mm_um ?? 0), true),
      read_x: (x) => `phase ${fmt(x)}`,
      read_y: (y) => `${fmt(y)} N/(mm µm)`,
      height: 250,
    });
  });
}

const percent = (share) => (is_number(share) ? 100 * share : null);

const case_columns = [{ label: "Scene" }, { label: "Torque", unit: "N·m", digits: 6 }, { label: "Design" }];
const case_cells = ({ load_case, design }) => [load_case.scene, load_case.torque, { text: DESIGN_LABEL[design], class: "word" }];

/** Load distribution factors by calculated stress, without and with spikes, beside those of ISO 6336. */
function load_factor_table(body, rows) {
  const factors = (entry, key) => record(record(summary_of(entry).load_factors)[key]);
  const peak = (entry, key) => record(record(summary_of(entry).peaks)[key]).contact_stress_MPa;
  const rated = rows.filter((row) => summary_of(row.load_case.designs[row.design]).load_factors);
  if (rated.length === 0) return;
  const intervals = record(summary_of(rated[0].load_case.designs[rated[0].design]).peaks).intervals;
  const lines = ({ load_case, design }) => {
    const entry = load_case.designs[design], iso = record(summary_of(entry).iso6336);
    const calculated = [["without spikes", "without_spikes"], ["with spikes", "with_spikes"], ["line load", "line_load"]].map(([label, key]) => {
      const k = factors(entry, key);
      return [label, k.K_Hbeta, k.K_Halpha, k.K_Hbeta_times_K_Halpha, k.K_H, peak(entry, key)];
    });
    return [...calculated, ["ISO 6336", iso.K_Hbeta, iso.K_Halpha, iso.K_H, iso.K_H, null]].map((values) =>
      [...case_cells({ load_case, design }), ...values.map((value) => value ?? null)]);
  };
  table(body, {
    title: "Load distribution factors",
    note: symbols("Squared ratios of the peak contact stress to that of the perfect pair on rigid shafts, and the ratio of the peak line loads without spikes. K_Hβ has only deviations along the face and "
      + "shafts, K_Hα only deviations along the profile and from tooth to tooth, K_H all of them; K_H is not the product of the two. Peaks are sought between the "
      + `positions too, with ${fmt(intervals)} intervals along a contact line. Values without spikes leave out short contact lines and `
      + "line ends on tip edges. Points where contact reaches a tip edge count in neither. ISO 6336 values follow method C with the stiffness of the standard, and with f_sh of the shafts where there are any."),
    columns: [...case_columns, { label: "By" },
      { label: "K_Hβ" }, { label: "K_Hα" }, { label: "K_Hβ·K_Hα" }, { label: "K_H" }, { label: "Peak stress", unit: "MPa" }],
    rows: rated.flatMap(lines),
  });
}

/** All numbers of all load cases; empty columns are left out. */
function build_load_cases(results, body, { cases }) {
  const iso = (key) => (entry) => record(summary_of(entry).iso6336)[key];
  const plain = (key) => (entry) => summary_of(entry)[key];
  const known_to = (of) => [{ label: capital(of.name), unit: of.unit }, (entry) => {
    const value = quantity_in(summary_of(entry), of), error = quantity_in(summary_of(entry), of, "_error");
    return is_number(value) && is_number(error) ? { value, text: with_error(value, error, 4) } : value;
  }];
  const residual = (entry) => {
    const worst = maximum(list(entry.cycle).map((position) => record(position).kkt_residual));
    return is_number(worst) ? worst : null;
  };
  const rows = cases.flatMap((load_case) => designs_of(load_case).map((design) => ({ load_case, design })));
  const bare = (cell) => (cell !== null && typeof cell === "object" ? cell.value : cell);
  const numbers_table = (title, note, quantities) => {
    const filled = quantities.filter(([, value]) => rows.some((row) => is_number(bare(value(row.load_case.designs[row.design])))));
    if (filled.length === 0) return;
    table(body, {
      title, note,
      columns: [...case_columns, ...filled.map(([column]) => column)],
      rows: rows.map((row) => [...case_cells(row), ...filled.map(([, value]) => value(row.load_case.designs[row.design]) ?? null)]),
    });
  };
  for (const topic of unique(QUANTITIES.map((of) => of.topic))) {
    numbers_table(`${topic} over the mesh cycle`,
      "Peaks are the largest values over the positions and all teeth in contact; ± is the estimated discretisation error where it is available.",
      QUANTITIES.filter((of) => of.topic === topic).map(known_to));
  }
  const rim = (gear, quantity) => (entry) => record(record(record(summary_of(entry).rims)[gear])[quantity]).mean;
  numbers_table("Rims on webs",
    "Means over the mesh cycle, relative to shaft or held bore: motion of the rim's centre away from the mate and towards +z, angle of its axis, and what the tilt opens "
      + "the mesh by at +z over the common face: of the whole rim, and of the rim below the loaded teeth.",
    ["pinion", "wheel"].flatMap((gear) => [["radial", "radial_um", "µm"], ["axial", "axial_um", "µm"], ["tilt", "tilt_mrad", "mrad"],
      ["misalignment", "misalignment_um", "µm"], ["at teeth", "misalignment_at_teeth_um", "µm"]]
      .map(([label, quantity, unit]) => [{ label: `${capital(gear)}, ${label}`, unit }, rim(gear, quantity)])));
  numbers_table("Numerical quality, and stiffness by ISO 6336",
    symbols("c′ and c_γ are those of ISO 6336; f_sh is the mean misalignment by the shafts. The change of harmonics is that by the last "
      + "doubling of positions. The KKT residual is the largest error of the contact conditions."), [
      [{ label: "f_sh", unit: "µm" }, plain("shaft_misalignment_um")],
      [{ label: "c′, ISO", unit: "N/(mm µm)" }, iso("c_prime")],
      [{ label: "c_γ, ISO", unit: "N/(mm µm)" }, iso("c_gamma")],
      [{ label: "Change of harmonics", unit: "µm" }, (entry) => record(summary_of(entry).te_convergence).harmonic_change_um],
      [{ label: "KKT residual" }, residual],
    ]);
  load_factor_table(body, rows);
}

add_sections({ "transmission-error": build_transmission_error, stiffness: build_stiffness, "load-cases": build_load_cases });

// Several runs side by side: compared_runs in the page's data, written by `flankwright compare`. Fills its sections with the means of the report.

const run_names = (data) => list(data.runs).map((run) => `${record(run).name}`);

/** "+1.2 %"; nothing where a run does not have the quantity. No change is good or bad by itself: that depends on what was asked for. */
const change_cell = (change) => (!is_number(change) ? null
  : { value: change, text: change === 0 ? "0" : `${change > 0 ? "+" : "−"}${fmt(Math.abs(change), 3)} %` });

const change_columns = (data) => run_names(data).slice(1).map((name) => ({ label: `Change, ${name}` }));

function build_compared_keys(data, body) {
  if (list(data.keys).length === 0) {
    body.append(el("p", { class: "remark" }, "The studies have the same keys and values."));
    return;
  }
  const is_requirement = ({ key }) => key.startsWith("expect.");
  const show = (title, keys) => keys.length > 0 && table(body, {
    title,
    columns: [{ label: "Key" }, ...run_names(data).map((label) => ({ label }))],
    rows: keys.map(({ key, values }) => [words(key), ...values.map((value) => (value === "" ? "not given" : value))]),
  });
  show("Keys that are not the same in all studies", data.keys.filter((key) => !is_requirement(key)));
  show("Requirements that are not the same", data.keys.filter(is_requirement));
}

function compared_table(data, body, title, values, note) {
  table(body, {
    title, note,
    columns: [{ label: "Quantity" }, { label: "Unit" }, ...run_names(data).map((label) => ({ label, digits: 5 })), ...change_columns(data)],
    rows: values.map((value) => [capital(value.words || words(value.name)), pretty_unit(value.unit), ...value.values, ...value.changes.map(change_cell)]),
  });
}

function build_headlines(data, body) {
  const shown = list(data.values).filter((value) => value.headline);
  for (const section of unique(shown.map((value) => value.section))) {
    compared_table(data, body, capital(section), shown.filter((value) => value.section === section));
  }
}

function build_all_values(data, body) {
  const sections = unique(list(data.values).map((value) => value.section));
  body.append(el("p", { class: "remark" }, "Changes are relative to the first run. An entry of a list, such as a harmonic, changes by a share of the largest entry."));
  for (const section of sections) {
    const details = el("details", {}, el("summary", {}, capital(section)));
    body.append(details);
    compared_table(data, details, capital(section), data.values.filter((value) => value.section === section));
  }
}

/** The names of the load cases that any run has, in the order of the first run. */
const case_names = (data) => unique(list(data.runs).flatMap((run) => list(run.loaded).map((entry) => entry.name)));
const case_of = (run, name) => list(run.loaded).find((entry) => entry.name === name);

/** A choice of the load case, where there are several, and a figure that follows it. */
function with_case(data, body, options, draw) {
  const names = case_names(data);
  let current = names[0];
  const grid = figure_grid(body);
  if (names.length > 1) {
    const { node } = choice("Load case", names.map((name) => ({ value: name, label: name })), current, (name) => {
      current = name;
      redraw();
    });
    node.classList.add("no-print");
    body.prepend(node);
  }
  const redraw = figure(grid, options, (plot) => {
    if (names.length > 1) plot.append(el("p", { class: "shown" }, `Load case: ${current}`));
    draw(plot, current);
  });
}

function build_compared_curves(data, body) {
  if (case_names(data).length === 0) {
    body.append(el("p", { class: "remark" }, "No run has a load case."));
    return;
  }
  with_case(data, body, {
    title: "Loaded transmission error over one pitch", wide: true,
    caption: "Along the flank normal, the wheel lags where it is positive; the mean of each run is removed and stands beside its name.",
  }, (plot, name) => {
    const curves = data.runs.map((run, i) => {
      const cycle = list(record(case_of(run, name)).cycle).filter((position) => is_number(position.te_um));
      const mean = cycle.reduce((sum, position) => sum + position.te_um, 0) / (cycle.length || 1);
      return { label: `${run.name} (mean ${fmt(mean, 4)} µm)`, colour: sequence_colour(i), dashed: i > 0,
        points: [...cycle, ...cycle.slice(0, 1).map((first) => ({ ...first, phase: first.phase + 1 }))]  // the next pitch begins as this one did
          .map((position) => ({ x: position.phase, y: position.te_um - mean })) };
    }).filter((curve) => curve.points.length > 0);
    xy_chart(plot, { label: "Loaded transmission error of all runs", curves, x: "phase [base pitches]", y: "transmission error less its mean [µm]" });
  });
}

/** What all maps have in common, so that equal colours are equal values. */
function common_area(points) {
  return { z: [minimum(points.map((p) => p.z)), maximum(points.map((p) => p.z))], r: [minimum(points.map((p) => p.r)), maximum(points.map((p) => p.r))] };
}

function build_compared_stresses(data, body) {
  if (case_names(data).length === 0) {
    body.append(el("p", { class: "remark" }, "No run has a load case."));
    return;
  }
  with_case(data, body, {
    title: "Contact stress on the pinion flank over the whole cycle", wide: true, caption: "All maps share one scale. Grey places carry no load.",
  }, (plot, name) => {
    const clouds = data.runs.map((run) => ({ run, points: contact_points(case_of(run, name), (_, columns) => list(columns.contact_stress_MPa)) }))
      .filter(({ points }) => points.length > 0);
    if (clouds.length === 0) {
      plot.append(el("p", { class: "empty" }, "No contact points are stored for this load case."));
      return;
    }
    const all = clouds.flatMap(({ points }) => points), area = common_area(all);
    const scale = { low: 0, high: maximum(all.map((point) => point.value)) || 1 };
    const rank = { is_bare: (value) => value <= 0, outranks: (a, b) => a > b };
    const maps = clouds.map(({ run, points }) => {
      const raster = flank_raster(points, area, rank);
      return { name: run.name, raster, title: `${run.name}, peak ${fmt(maximum(points.map((point) => point.value)), 4)} MPa`,
        read: (z, r) => {
          const value = raster.values[raster_index(r, area.r, raster.rows) * raster.columns + raster_index(z, area.z, raster.columns)];
          return is_number(value) ? `${fmt(value)} MPa` : "no point near";
        } };
    });
    flank_maps(plot, { maps, area, scale, unit: "MPa", r_title: "pinion radius [mm]" });
  });
}

function build_compared_topographies(data, body) {
  const entries = data.runs.flatMap((run) => topographies(run).map((entry) => ({ ...entry, run: run.name })));
  if (entries.length === 0) {
    body.append(el("p", { class: "remark" }, "No run has a modified flank."));
    return;
  }
  const grid = figure_grid(body);
  for (const gear of unique(entries.map((entry) => entry.gear))) {
    const own = entries.filter((entry) => entry.gear === gear), grids = own.map((entry) => entry.grid), scale = removal_scale(own);
    const area = common_area(grids.flatMap((g) => [{ z: minimum(g.z), r: minimum(g.r) }, { z: maximum(g.z), r: maximum(g.r) }]));
    const levels = round_ticks(scale.low, scale.high, 8).filter((level) => level > scale.low && level < scale.high);
    figure(grid, { title: `Topography of the ${gear} flank`, wide: true,
      caption: "Material removed, along the base tangent, with contour lines. All maps share one scale. A run without a map has an unmodified flank." }, (plot) =>
      flank_maps(plot, { area, scale, unit: "µm", r_title: `${gear} radius [mm]`,
        maps: own.map(({ run, grid: of }) => ({
          name: run, title: `${run}, up to ${fmt(maximum(of.rows.flat()), 3)} µm`, raster: grid_raster(of, area),
          read: (z, r) => (grid_value(of, z, r) === null ? "outside" : `${fmt(grid_value(of, z, r), 3)} µm`),
          overlay: (pen, to_x, to_y) => draw_contours(pen, of, levels_within(of, levels), to_x, to_y),
        })) }));
  }
}

function compare_main() {
  const data = JSON.parse(document.getElementById("results").textContent);
  learn_names(data.names);
  learn_quantities(data.quantities);
  const differ = list(data.values).filter((value) => value.changes.some((change) => change !== 0 && change !== "")).length;
  document.getElementById("headline").textContent = differ === 0 ? "All quantities are the same." : `${differ} of ${data.values.length} quantities differ.`;
  document.getElementById("origin").textContent = data.runs.map((run) => `${run.name}: ${run.title} (${run.task})`).join("  ·  ");
  const builders = { keys: build_compared_keys, headlines: build_headlines, curves: build_compared_curves, topographies: build_compared_topographies,
    stresses: build_compared_stresses, all: build_all_values };
  for (const [id, build] of Object.entries(builders)) {
    const body = document.querySelector(`#${id} > .body`);
    try {
      build(data, body);
    } catch (failure) {
      body.append(el("p", { class: "banner bad" }, `This section could not be built: ${failure.message}`));
      console.error(failure);
    }
  }
  start_theme();
}

compare_main();
